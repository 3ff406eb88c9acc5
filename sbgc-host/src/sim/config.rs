//! What kind of board is simulated.

use std::time::Duration;

use sbgc_proto::units::{BoardVersion, FirmwareVersion};

use super::faults::Fault;

/// From this version on the board knows everything that is published.
const NEW: FirmwareVersion = FirmwareVersion::new(2, 73, 0);

/// What kind of board is simulated, and the state it starts in.
///
/// ```
/// use sbgc_host::sim::{Board, Config};
///
/// let board = Board::new(Config { bit_rate: Some(115_200), ..Config::default() });
/// assert!(board.motion().motors_on());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// Version of the board.
    pub board: BoardVersion,
    /// Version of the firmware. Before 2.73 the board does not know commands, forms and flags that came later; from
    /// 2.73 on it knows everything that is published, up to 2.74.
    pub firmware: FirmwareVersion,
    /// Number of motors: with 2 the yaw axis neither moves nor counts, with 1 roll does not either.
    pub axes: u8,
    /// Bits per second of the line, ten for each byte; `None` for a line like USB that is never the bottleneck.
    pub bit_rate: Option<u32>,
    /// Whether the motors are on after the start, unless the parameters say otherwise.
    pub motors_on: bool,
    /// How long the board is deaf after a reset.
    pub boot: Duration,
    /// The profile that is active after the first start, 0 to 4.
    pub profile: u8,
    /// Blocks of parameters that replace the ones the board would have from the factory.
    pub parameters: Vec<StoredBlock>,
    /// Size of the EEPROM in bytes.
    pub eeprom_size: usize,
    /// What goes wrong.
    pub faults: Vec<Fault>,
    /// What the noise of the sensors and random faults begin with; a run with the same seed repeats itself.
    pub seed: u64,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            board: BoardVersion(36),
            firmware: FirmwareVersion::new(2, 73, 5),
            axes: 3,
            bit_rate: None,
            motors_on: true,
            boot: Duration::from_millis(300),
            profile: 0,
            parameters: Vec::new(),
            eeprom_size: 32 * 1024,
            faults: Vec::new(),
            seed: 0,
        }
    }
}

impl Config {
    /// Whether the firmware has what came with this version.
    pub(super) fn has(&self, since: &str) -> bool {
        since.parse().is_ok_and(|since| self.knows(Some(since)))
    }

    /// Whether the firmware has what came with this version, or from the first or an unknown one on.
    pub(super) fn knows(&self, since: Option<FirmwareVersion>) -> bool {
        self.firmware >= NEW || since.is_none_or(|since| self.firmware >= since)
    }
}

/// One block of parameters of one profile, as the payload that carries it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StoredBlock {
    /// Id of the command that reads it.
    pub id: sbgc_proto::CommandId,
    /// The profile, 0 to 4.
    pub profile: u8,
    /// The payload. It has the length that the board's own block has, else it is passed over.
    pub payload: Vec<u8>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn old_firmware_has_only_what_it_came_with() {
        let old = Config { firmware: FirmwareVersion::new(2, 68, 9), ..Config::default() };
        assert!(old.knows(None));
        for since in ["2.61", "2.68", "2.68b7"] {
            assert!(old.has(since), "{since}");
        }
        for since in ["2.69b3", "2.70b4", "2.73.4", "2.74.2"] {
            assert!(!old.has(since) && Config::default().has(since), "{since}");
        }
    }
}
