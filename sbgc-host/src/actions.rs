//! Things that the board does at once: restart, bootloader, pins, servo outputs, and sounds from notes.

use std::time::Duration;

use sbgc_proto::commands::{
    BeepSound, BeepSoundMode, BootMode3Extended, ResetExtendedRequest, ResetFlags, ServoOut, ServoOutExt,
    ServoOutputs, Switch, TriggerPin, TriggerPinId, TriggerPinState,
};
use sbgc_proto::units::{FirmwareVersion, NoteFrequency, ServoTime, SoundTime};
use sbgc_proto::wire::List;
use sbgc_proto::{CommandId, Message};

use crate::error::{Error, Result};
use crate::gimbal::{Gimbal, encode};
use crate::streams::Sample;

/// The first firmware that sets single servo outputs.
const SERVO_EXT_SINCE: FirmwareVersion = FirmwareVersion::new(2, 73, 2);

/// The first firmware that reports the level of a pin.
const PIN_LEVEL_SINCE: FirmwareVersion = FirmwareVersion::new(2, 74, 3);

/// Servo outputs of firmware before 2.73.2.
const SERVOS: usize = 8;

/// Lowest and highest frequency that a board plays, in Hz.
const NOTES: std::ops::RangeInclusive<f64> = 554.0..=20_999.0;

/// Most notes of a melody.
const MOST_NOTES: usize = 50;

/// The command that restarts the board after a delay, with a notice before.
pub fn reset_command(delay: Duration) -> ResetExtendedRequest {
    ResetExtendedRequest { flags: ResetFlags::CONFIRM, delay_ms: milliseconds(delay) }
}

/// The command that enters the bootloader after a delay, with a notice before.
pub fn boot_command(delay: Duration) -> BootMode3Extended {
    BootMode3Extended { confirm: Switch::On, delay_ms: milliseconds(delay) }
}

fn milliseconds(time: Duration) -> u16 {
    u16::try_from(time.as_millis()).unwrap_or(u16::MAX)
}

/// The command that sets servo outputs from `first` on, counted from 1: pulse times in microseconds, 0 for low, -1 for
/// floating.
///
/// Firmware before 2.73.2 sets all eight outputs at once; those without a time float.
///
/// # Errors
/// If there are no such outputs, or a time is out of range.
pub fn servo_command(firmware: FirmwareVersion, first: u8, times: &[i16]) -> Result<ServoCommand> {
    let most = if firmware >= SERVO_EXT_SINCE { 32 } else { SERVOS };
    let start = usize::from(first).checked_sub(1).unwrap_or(most);
    if start + times.len() > most || times.is_empty() {
        let value = f64::from(first) + f64::from(u32::try_from(times.len().max(1)).unwrap_or(u32::MAX)) - 1.0;
        let maximum = f64::from(u32::try_from(most).unwrap_or(u32::MAX));
        return Err(Error::OutOfRange { what: "servo output", value, minimum: 1.0, maximum, unit: "" });
    }
    if let Some(&time) = times.iter().find(|time| !(-1..=20_000).contains(*time)) {
        let (minimum, maximum) = (-1.0, 20_000.0);
        return Err(Error::OutOfRange {
            what: "pulse time",
            value: time.into(),
            minimum,
            maximum,
            unit: "us",
        });
    }
    if most == SERVOS {
        let mut servo_time = [ServoTime::FLOATING; SERVOS];
        for (place, time) in servo_time.iter_mut().skip(start).zip(times) {
            *place = ServoTime(*time);
        }
        return Ok(ServoCommand::All(ServoOut { servo_time }));
    }
    let bits = (start..start + times.len()).fold(0_u32, |bits, output| bits | 1 << output);
    let servo_time: List<ServoTime, 32> = times.iter().map(|time| ServoTime(*time)).collect();
    Ok(ServoCommand::Chosen(ServoOutExt { servo_bits: ServoOutputs::from_bits_retain(bits), servo_time }))
}

/// What sets servo outputs; see [`servo_command`].
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "one is made at a time")]
pub enum ServoCommand {
    /// All of them.
    All(ServoOut),
    /// Some of them.
    Chosen(ServoOutExt),
}

/// The level of a pin that was made an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PinLevel {
    /// Low.
    Low,
    /// High.
    High,
    /// The board does not know it.
    Unknown,
}

impl Gimbal {
    /// Restarts the board after a delay: returns when it has announced that.
    ///
    /// # Errors
    /// If the board does not announce it; it may restart all the same.
    pub async fn restart(&self, delay: Duration) -> Result<()> {
        let payload = encode(&reset_command(delay))?;
        self.request_raw(CommandId::Reset, payload, CommandId::Reset).await.map(drop)
    }

    /// Enters the bootloader after a delay; `true` if the board announced it, which not all firmware does.
    ///
    /// Send nothing else afterwards: it can confuse the bootloader.
    ///
    /// # Errors
    /// If the board refuses it, or the link is gone.
    pub async fn enter_bootloader(&self, delay: Duration) -> Result<bool> {
        let mut notices = self.listen(CommandId::Reset);
        let once = self.with_attempts(1);
        let command = boot_command(delay);
        tokio::select! {
            Some(Sample::Payload(_)) = notices.next() => Ok(true),
            confirmed = once.confirm(&command) => match confirmed {
                Ok(_) => Ok(true),
                Err(Error::Timeout { .. }) => Ok(false),
                Err(error) => Err(error),
            },
        }
    }

    /// Drives a pin; `false` if the board did not, because it has another function or is not there.
    ///
    /// # Errors
    /// If the board refuses it or does not answer.
    pub async fn pin_drive(&self, pin: TriggerPinId, state: TriggerPinState) -> Result<bool> {
        Ok(self.send_checked(&TriggerPin { pin_id: pin, state }).await?.is_some())
    }

    /// Makes a pin an input with a resistor to ground and reads its level. Firmware 2.74.3+.
    ///
    /// # Errors
    /// If the firmware is older, or the board does not answer.
    pub async fn pin_read(&self, pin: TriggerPinId) -> Result<PinLevel> {
        let firmware = self.board_info().await?.firmware_ver;
        if firmware < PIN_LEVEL_SINCE {
            let what = "the level of a pin";
            return Err(Error::TooOld { what, since: PIN_LEVEL_SINCE, firmware });
        }
        let command = TriggerPin { pin_id: pin, state: TriggerPinState::PulledDown };
        let Some(confirm) = self.send_checked(&command).await? else { return Ok(PinLevel::Unknown) };
        let [_, level, ..] = confirm.data.value().to_le_bytes();
        Ok(match level {
            0 => PinLevel::Low,
            1 => PinLevel::High,
            _ => PinLevel::Unknown,
        })
    }
}

/// A melody from notes as text: names (`C5`, `F#5`, `Bb4`), frequencies (`880`, `880Hz`) and pauses (`-`).
///
/// The board plays 554 Hz and up. If a named note is lower, all named notes are played as many octaves higher as it
/// takes.
///
/// ```
/// use std::time::Duration;
/// use sbgc_host::actions::melody;
///
/// let beep = melody(&["A5", "880", "-"], Duration::from_millis(200)).unwrap();
/// assert_eq!(beep.note_freq_hz[0], beep.note_freq_hz[1]);
/// assert!(melody(&["H5"], Duration::from_millis(200)).is_err());
/// ```
///
/// # Errors
/// If a note cannot be read, there are none or more than 50, or they cannot be played.
pub fn melody(notes: &[&str], length: Duration) -> Result<BeepSound> {
    let note_length = SoundTime::try_from_milliseconds(length.as_secs_f32() * 1000.0);
    let note_length = note_length.ok().filter(|length| length.0 > 0).ok_or(Error::OutOfRange {
        what: "length of a note",
        value: length.as_secs_f64() * 1000.0,
        minimum: 8.0,
        maximum: 2040.0,
        unit: "ms",
    })?;
    if !(1..=MOST_NOTES).contains(&notes.len()) {
        let value = f64::from(u32::try_from(notes.len()).unwrap_or(u32::MAX));
        return Err(Error::OutOfRange {
            what: "number of notes",
            value,
            minimum: 1.0,
            maximum: 50.0,
            unit: "",
        });
    }
    let mut tones = Vec::with_capacity(notes.len());
    for note in notes {
        tones.push(tone(note).ok_or_else(|| Error::BadNote { note: (*note).to_owned() })?);
    }
    let lowest = tones.iter().filter_map(Tone::named).fold(f64::INFINITY, f64::min);
    let octaves = if lowest < *NOTES.start() { (NOTES.start() / lowest).log2().ceil() } else { 0.0 };
    let pause = NoteFrequency::pause(note_length.0.into());
    let mut list = List::new();
    for tone in tones {
        let frequency = match tone {
            Tone::Pause => {
                let _ = list.push(pause);
                continue;
            }
            Tone::Named(frequency) => frequency * octaves.exp2(),
            Tone::Frequency(frequency) => frequency,
        };
        if !NOTES.contains(&frequency) {
            let (minimum, maximum) = (*NOTES.start(), *NOTES.end());
            return Err(Error::OutOfRange { what: "note", value: frequency, minimum, maximum, unit: "Hz" });
        }
        #[allow(clippy::cast_possible_truncation, reason = "it is in the range of notes")]
        let _ = list.push(NoteFrequency::from_hertz(frequency.round() as f32));
    }
    Ok(BeepSound {
        mode: BeepSoundMode::CUSTOM_MELODY,
        note_length,
        note_freq_hz: list,
        ..BeepSound::default()
    })
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Tone {
    Named(f64),
    Frequency(f64),
    Pause,
}

impl Tone {
    fn named(&self) -> Option<f64> {
        if let Tone::Named(frequency) = self { Some(*frequency) } else { None }
    }
}

fn tone(text: &str) -> Option<Tone> {
    let text = text.trim();
    if matches!(text, "-" | "_" | "r" | "R") {
        return Some(Tone::Pause);
    }
    let digits = text.strip_suffix("Hz").or_else(|| text.strip_suffix("hz")).unwrap_or(text).trim_end();
    if digits.starts_with(|first: char| first.is_ascii_digit()) {
        return digits.parse().ok().filter(|frequency: &f64| frequency.is_finite()).map(Tone::Frequency);
    }
    let mut rest = text.chars();
    let step = match rest.next()?.to_ascii_uppercase() {
        'C' => 0,
        'D' => 2,
        'E' => 4,
        'F' => 5,
        'G' => 7,
        'A' => 9,
        'B' => 11,
        _ => return None,
    };
    let rest = rest.as_str();
    let (shift, octave) = match (rest.strip_prefix(['#', '♯']), rest.strip_prefix(['b', '♭'])) {
        (Some(octave), _) => (1, octave),
        (_, Some(octave)) => (-1, octave),
        _ => (0, rest),
    };
    let octave: i32 = if octave.is_empty() { 5 } else { octave.parse().ok()? };
    if !(0..=10).contains(&octave) {
        return None;
    }
    // Half tones from A4, which is 440 Hz.
    let half_tones = step + shift + 12 * (octave - 4) - 9;
    Some(Tone::Named(440.0 * (f64::from(half_tones) / 12.0).exp2()))
}

/// A standard sound.
///
/// ```
/// use sbgc_host::actions::sound;
/// use sbgc_host::proto::commands::BeepSoundMode;
///
/// assert_eq!(sound(BeepSoundMode::CONFIRM).mode, BeepSoundMode::CONFIRM);
/// ```
pub fn sound(mode: BeepSoundMode) -> BeepSound {
    BeepSound { mode, ..BeepSound::default() }
}

impl ServoCommand {
    /// Id and payload.
    ///
    /// # Errors
    /// If the message cannot be written.
    pub fn frame(&self) -> Result<(CommandId, bytes::Bytes)> {
        Ok(match self {
            Self::All(command) => (ServoOut::ID, encode(command)?),
            Self::Chosen(command) => (ServoOutExt::ID, encode(command)?),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIFTH: Duration = Duration::from_millis(200);

    fn frequencies(notes: &[&str]) -> Vec<u16> {
        melody(notes, FIFTH).unwrap().note_freq_hz.iter().map(|note| note.0).collect()
    }

    #[test]
    fn notes_are_frequencies() {
        assert_eq!(
            frequencies(&["A5", "a5", "C6", "E6", "G#5", "Ab5", "880", "880 Hz"]),
            [880, 880, 1047, 1319, 831, 831, 880, 880]
        );
        // C5 is below what the board plays, so all go an octave up.
        assert_eq!(frequencies(&["C5", "E5", "600"]), [1047, 1319, 600]);
        assert_eq!(frequencies(&["A4"]), [880]);
        assert_eq!(frequencies(&["-"]), [21_000 + 25]);
        for wrong in ["H5", "C#", "5C", "C99", "500", "30000", "", "Cb#4", "nan"] {
            let made = melody(&[wrong], FIFTH);
            assert_eq!(made.is_ok(), wrong == "C#", "{wrong}: {made:?}");
        }
        assert!(melody(&[], FIFTH).is_err() && melody(&["A5"; 51], FIFTH).is_err());
        assert!(melody(&["A5"], Duration::from_secs(3)).is_err() && melody(&["A5"], Duration::ZERO).is_err());
    }

    #[test]
    fn servo_outputs_are_chosen_where_the_firmware_can() {
        let new = FirmwareVersion::new(2, 73, 5);
        let ServoCommand::Chosen(chosen) = servo_command(new, 2, &[1500, -1]).unwrap() else { panic!() };
        assert_eq!((chosen.servo_bits.bits(), chosen.servo_time[0]), (0b110, ServoTime(1500)));
        let old = FirmwareVersion::new(2, 68, 0);
        let ServoCommand::All(all) = servo_command(old, 8, &[0]).unwrap() else { panic!() };
        assert_eq!(all.servo_time[7], ServoTime::LOW);
        assert_eq!(all.servo_time[0], ServoTime::FLOATING);
        assert!(servo_command(old, 8, &[1, 1]).is_err() && servo_command(old, 0, &[1]).is_err());
        assert!(servo_command(new, 1, &[20_001]).is_err() && servo_command(new, 1, &[]).is_err());
    }
}
