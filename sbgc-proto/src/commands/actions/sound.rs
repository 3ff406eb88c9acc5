//! Sounds.

use sbgc_proto_macros::message;

use crate::declare::flags;
use crate::units::{NoteFrequency, SoundTime};
use crate::wire::{List, Reserved};

/// Plays a standard sound or a melody on the motors or the buzzer.
///
/// Not confirmed.
///
/// The envelope, and the volume of the settings, count only in firmware with encoders or while the motors are off.
///
/// ```
/// use sbgc_proto::Message;
/// use sbgc_proto::commands::{BeepSound, BeepSoundMode};
/// use sbgc_proto::units::{NoteFrequency, SoundTime};
///
/// // One second of 3 kHz.
/// let beep = BeepSound {
///     mode: BeepSoundMode::CUSTOM_MELODY,
///     note_length: SoundTime::from_milliseconds(1000.0),
///     note_freq_hz: [NoteFrequency(3000)].into_iter().collect(),
///     ..BeepSound::default()
/// };
/// assert_eq!(beep.encode(&mut [0; 14])?, [0, 0x80, 0x7D, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xB8, 0x0B]);
/// # Ok::<(), sbgc_proto::EncodeError>(())
/// ```
#[message(CMD_BEEP_SOUND, outgoing, size = 12..=112)]
pub struct BeepSound {
    /// Sound to play.
    pub mode: BeepSoundMode,
    /// Length of each note of a melody, 1 to 255; ignored for the standard sounds.
    pub note_length: SoundTime,
    /// Decay of a note after a pause; 0 disables it.
    #[wire(range = 0..=15)]
    pub decay_factor: u8,
    pub reserved: Reserved<8>,
    /// The notes of a melody, with [`BeepSoundMode::CUSTOM_MELODY`] only: 554 to 21000 Hz, or a pause.
    ///
    /// [`NoteFrequency::RESTART`] starts the envelope anew; what is beyond it also pauses, see
    /// [`NoteFrequency::pause`].
    #[wire(range = 554..=65535)]
    pub note_freq_hz: List<NoteFrequency, 50>,
}

impl NoteFrequency {
    /// Restarts the envelope and pauses for so many samples of 8 ms, at most 44535.
    #[must_use]
    pub const fn pause(samples: u16) -> Self {
        Self(Self::RESTART.0.saturating_add(samples))
    }

    /// For how many samples of 8 ms this pauses, 0 for a note.
    pub const fn pause_samples(self) -> u16 {
        self.0.saturating_sub(Self::RESTART.0)
    }
}

flags! {
    /// A sound. Spec: `BEEP_SOUND_MODE`.
    ///
    /// These are not the bits of the parameter `BEEPER_MODES`. A melody must be requested alone.
    pub struct BeepSoundMode: u16, prefix "BEEPER_MODE_" {
        /// That of a calibration.
        const CALIBRATE = 1 << 0;
        /// That of a confirmation.
        const CONFIRM = 1 << 1;
        /// That of an error.
        const ERROR = 1 << 2;
        /// A click.
        const CLICK = 1 << 4;
        /// That of something completed.
        const COMPLETE = 1 << 5;
        /// That of the start.
        const INTRO = 1 << 6;
        /// The notes of the message.
        const CUSTOM_MELODY = 1 << 15;
    }
}
