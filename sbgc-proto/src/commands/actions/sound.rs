//! Sounds.

use sbgc_proto_macros::message;

use crate::declare::flags;
use crate::units::{NoteFrequency, SoundTime};
use crate::wire::{List, Reserved};

/// Plays a standard sound or a melody on the motors or the buzzer.
///
/// Not confirmed.
///
/// The envelope and the volume setting apply only in firmware for encoders, or while the motors are off.
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
    /// Decay rate of notes after a pause; 0 disables the decay.
    #[wire(range = 0..=15)]
    pub decay_factor: u8,
    pub reserved: Reserved<8>,
    /// Notes of a melody, 554 to 21000 Hz, or pauses. Used with [`BeepSoundMode::CUSTOM_MELODY`] only.
    ///
    /// [`NoteFrequency::RESTART`] restarts the envelope; larger values also pause, see [`NoteFrequency::pause`].
    #[wire(range = 554..=65535)]
    pub note_freq_hz: List<NoteFrequency, 50>,
}

impl NoteFrequency {
    /// Restarts the envelope and pauses for a number of samples of 8 ms, at most 44535.
    #[must_use]
    pub const fn pause(samples: u16) -> Self {
        Self(Self::RESTART.0.saturating_add(samples))
    }

    /// Duration of the pause in samples of 8 ms; 0 for a note.
    pub const fn pause_samples(self) -> u16 {
        self.0.saturating_sub(Self::RESTART.0)
    }
}

flags! {
    /// Sound to play. Spec: `BEEP_SOUND_MODE`.
    ///
    /// These bits differ from those of the parameter `BEEPER_MODES`. A melody cannot be combined with other sounds.
    pub struct BeepSoundMode: u16, prefix "BEEPER_MODE_" {
        /// Calibration sound.
        const CALIBRATE = 1 << 0;
        /// Confirmation sound.
        const CONFIRM = 1 << 1;
        /// Error sound.
        const ERROR = 1 << 2;
        /// Click.
        const CLICK = 1 << 4;
        /// Completion sound.
        const COMPLETE = 1 << 5;
        /// Start-up sound.
        const INTRO = 1 << 6;
        /// Melody given by the notes of the message.
        const CUSTOM_MELODY = 1 << 15;
    }
}
