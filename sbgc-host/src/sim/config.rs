//! What kind of board is simulated.

use std::time::Duration;

use sbgc_proto::units::{BoardVersion, FirmwareVersion};
use sbgc_proto::wire::PerAxis;

use super::motion::Limits;

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
    /// Version of the firmware. It is only told: the simulated board behaves as 2.73 does.
    pub firmware: FirmwareVersion,
    /// Number of motors: with 2 the yaw axis neither moves nor counts, with 1 roll does not either.
    pub axes: u8,
    /// Bits a second of the line, ten for each byte; `None` for a line like USB that is never the bottleneck.
    pub bit_rate: Option<u32>,
    /// Whether the motors are on after start.
    pub motors_on: bool,
    /// How long the board is deaf after a reset.
    pub boot: Duration,
    /// How fast each axis moves where a command does not say.
    pub limits: PerAxis<Limits>,
    /// The profile that is active after the first start, 0 to 4.
    pub profile: u8,
    /// Blocks of parameters that replace the ones the board would have from the factory.
    pub parameters: Vec<StoredBlock>,
    /// Size of the EEPROM in bytes.
    pub eeprom_size: usize,
}

impl Default for Config {
    fn default() -> Self {
        let limits = Limits { speed: 60.0, acceleration: 300.0 };
        Self {
            board: BoardVersion(36),
            firmware: FirmwareVersion::new(2, 73, 5),
            axes: 3,
            bit_rate: None,
            motors_on: true,
            boot: Duration::from_millis(300),
            limits: PerAxis { roll: limits, pitch: limits, yaw: limits },
            profile: 0,
            parameters: Vec::new(),
            eeprom_size: 32 * 1024,
        }
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
