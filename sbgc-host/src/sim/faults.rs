//! What goes wrong on purpose: on the line, and in the board.

use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use super::noise::Noise;

/// Which way a frame goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// To the board.
    In,
    /// To the host.
    Out,
}

/// Something that goes wrong. Random ones follow the seed of the board, so that a run repeats itself.
///
/// ```
/// use std::time::Duration;
///
/// use sbgc_host::sim::{Fault, Way};
///
/// assert_eq!("drop:in=0.01".parse(), Ok(Fault::Drop { probability: 0.01, way: Way::In }));
/// let fault = Fault::Unplug { at: Duration::from_secs(5), lasts: Duration::from_secs(2) };
/// assert_eq!("unplug=5s/2s".parse(), Ok(fault));
/// assert!("melt".parse::<Fault>().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// Frames arrive with a wrong bit (`corrupt=0.01`).
    Corrupt {
        /// How likely it is for each frame, 0 to 1.
        probability: f64,
        /// Which frames.
        way: Way,
    },
    /// Frames do not arrive (`drop=0.01`).
    Drop {
        /// How likely it is for each frame, 0 to 1.
        probability: f64,
        /// Which frames.
        way: Way,
    },
    /// Frames arrive twice (`duplicate=0.01`).
    Duplicate {
        /// How likely it is for each frame, 0 to 1.
        probability: f64,
        /// Which frames.
        way: Way,
    },
    /// Frames arrive later (`delay=20ms`).
    Delay {
        /// By how much.
        time: Duration,
        /// Which frames.
        way: Way,
    },
    /// The board announces a reset, resets, and is deaf as after power-on (`reset=5s`).
    Reset {
        /// When, from the start of the board.
        at: Duration,
    },
    /// The line is dead both ways, while the board runs on (`unplug=5s/2s`).
    Unplug {
        /// When, from the start of the board.
        at: Duration,
        /// For how long.
        lasts: Duration,
    },
    /// The board neither reads nor sends, and then works off what has come (`stall=5s/1s`).
    Stall {
        /// When, from the start of the board.
        at: Duration,
        /// For how long.
        lasts: Duration,
    },
    /// Nothing is confirmed (`no-confirm`).
    NoConfirm,
    /// The battery empties (`low-battery`).
    LowBattery,
    /// The sensor of the camera does not answer (`sensor`).
    Sensor,
}

/// The text is not a fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FaultError(String);

impl fmt::Display for FaultError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for FaultError {}

/// The kinds of faults, as users write them.
const KINDS: &str = "corrupt, drop, duplicate, delay (each also with :in), reset, unplug, stall, no-confirm, low-battery, sensor";

impl FromStr for Fault {
    type Err = FaultError;

    fn from_str(text: &str) -> Result<Self, FaultError> {
        let (name, value) = text.split_once('=').map_or((text, None), |(name, value)| (name, Some(value)));
        let (kind, way) = match name.split_once(':') {
            Some((kind, "in")) => (kind, Way::In),
            Some((_, way)) => return Err(FaultError(format!("unknown direction \"{way}\"; expected `in`"))),
            None => (name, Way::Out),
        };
        let wanted = || FaultError(format!("`{kind}` needs a value, e.g. {}", example(kind)));
        let value_or = || value.ok_or_else(wanted);
        let both_ways = matches!(kind, "corrupt" | "drop" | "duplicate" | "delay");
        if way == Way::In && !both_ways {
            return Err(FaultError(format!("`{kind}` has no direction")));
        }
        let fault = match kind {
            "corrupt" => Self::Corrupt { probability: probability(value_or()?)?, way },
            "drop" => Self::Drop { probability: probability(value_or()?)?, way },
            "duplicate" => Self::Duplicate { probability: probability(value_or()?)?, way },
            "delay" => Self::Delay { time: time(value_or()?)?, way },
            "reset" => Self::Reset { at: time(value_or()?)? },
            "unplug" | "stall" => {
                let (at, lasts) = value_or()?.split_once('/').ok_or_else(wanted)?;
                let (at, lasts) = (time(at)?, time(lasts)?);
                if kind == "unplug" { Self::Unplug { at, lasts } } else { Self::Stall { at, lasts } }
            }
            "no-confirm" => Self::NoConfirm,
            "low-battery" => Self::LowBattery,
            "sensor" => Self::Sensor,
            _ => return Err(FaultError(format!("unknown fault \"{kind}\"; available: {KINDS}"))),
        };
        match (fault, value) {
            (Self::NoConfirm | Self::LowBattery | Self::Sensor, Some(_)) => {
                Err(FaultError(format!("`{kind}` takes no value")))
            }
            _ => Ok(fault),
        }
    }
}

fn example(kind: &str) -> &'static str {
    match kind {
        "delay" => "delay=20ms",
        "reset" => "reset=5s",
        "unplug" => "unplug=5s/2s",
        "stall" => "stall=5s/1s",
        _ => "drop=0.01",
    }
}

fn probability(text: &str) -> Result<f64, FaultError> {
    let number = text.parse::<f64>().ok().filter(|number| (0.0..=1.0).contains(number));
    number.ok_or_else(|| FaultError(format!("expected a probability of 0 to 1, got \"{text}\"")))
}

fn time(text: &str) -> Result<Duration, FaultError> {
    let digits = text.trim_end_matches(|letter: char| letter.is_ascii_alphabetic());
    let unit = match text.get(digits.len()..) {
        Some("ms") => Some(0.001),
        Some("s") => Some(1.0),
        Some("m") => Some(60.0),
        _ => None,
    };
    let seconds = digits.parse::<f64>().ok().zip(unit).map(|(number, unit)| number * unit);
    let time = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    time.ok_or_else(|| FaultError(format!("expected a time, e.g. 20ms or 5s, got \"{text}\"")))
}

/// What happens to the frames that go one way.
#[derive(Debug)]
pub(super) struct Tamper {
    noise: Noise,
    corrupt: f64,
    drop: f64,
    duplicate: f64,
    pub(super) delay: Duration,
}

impl Tamper {
    pub(super) fn new(seed: u64) -> Self {
        Self { noise: Noise::new(seed), corrupt: 0.0, drop: 0.0, duplicate: 0.0, delay: Duration::ZERO }
    }

    /// Takes in a fault of this way.
    pub(super) fn set(&mut self, fault: Fault) {
        match fault {
            Fault::Corrupt { probability, .. } => self.corrupt = probability,
            Fault::Drop { probability, .. } => self.drop = probability,
            Fault::Duplicate { probability, .. } => self.duplicate = probability,
            Fault::Delay { time, .. } => self.delay = time,
            _ => {}
        }
    }

    pub(super) fn clear(&mut self) {
        (self.corrupt, self.drop, self.duplicate, self.delay) = (0.0, 0.0, 0.0, Duration::ZERO);
    }

    /// How often a frame arrives, and whether with a wrong bit.
    pub(super) fn fate(&mut self) -> (usize, bool) {
        if self.noise.chance(self.drop) {
            return (0, false);
        }
        let copies = if self.noise.chance(self.duplicate) { 2 } else { 1 };
        (copies, self.noise.chance(self.corrupt))
    }

    /// Turns over a bit.
    pub(super) fn spoil(&mut self, frame: &mut [u8]) {
        let length = frame.len().max(1);
        let place = usize::from(self.noise.byte()) % length;
        if let Some(byte) = frame.get_mut(place) {
            *byte ^= 1 << (self.noise.byte() % 8);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_are_written_as_they_are_documented() {
        let ms = Duration::from_millis;
        let way = Way::Out;
        for (text, fault) in [
            ("corrupt=0.01", Fault::Corrupt { probability: 0.01, way }),
            ("duplicate:in=1", Fault::Duplicate { probability: 1.0, way: Way::In }),
            ("delay=20ms", Fault::Delay { time: ms(20), way }),
            ("delay:in=0.5s", Fault::Delay { time: ms(500), way: Way::In }),
            ("reset=2m", Fault::Reset { at: ms(120_000) }),
            ("stall=5s/1s", Fault::Stall { at: ms(5000), lasts: ms(1000) }),
            ("no-confirm", Fault::NoConfirm),
            ("low-battery", Fault::LowBattery),
            ("sensor", Fault::Sensor),
        ] {
            assert_eq!(text.parse(), Ok(fault), "{text}");
        }
    }

    #[test]
    fn what_is_no_fault_says_what_would_be() {
        for (text, part) in [
            ("melt", "available: corrupt"),
            ("drop", "needs a value"),
            ("drop=2", "probability of 0 to 1"),
            ("drop=nan", "probability of 0 to 1"),
            ("drop:out=0.1", "expected `in`"),
            ("delay=20", "expected a time"),
            ("delay=-1s", "expected a time"),
            ("unplug=5s", "unplug=5s/2s"),
            ("reset:in=5s", "no direction"),
            ("sensor=1", "takes no value"),
        ] {
            let error = text.parse::<Fault>().unwrap_err().to_string();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
