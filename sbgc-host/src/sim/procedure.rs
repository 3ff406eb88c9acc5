//! Calibrations and tunings: what takes its time and changes something when it is done.

use std::time::Duration;

use sbgc_proto::CommandId;
use sbgc_proto::commands::{
    AutoPidFlags, BodeTestSystem, CalibAction, CalibMode, CoggingAxes, ForMotor, ImuType, ProfileId,
};
use sbgc_proto::wire::PerAxis;

/// What runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// Accelerometer, gyroscope or magnetometer.
    Sensor {
        imu: ImuType,
        action: CalibAction,
    },
    ExternalGain,
    Poles,
    EncoderOffset(ForMotor),
    EncoderField(PerAxis<f64>),
    Orientation,
    ExternalReference,
    Cogging {
        axes: CoggingAxes,
        delete: bool,
    },
    AutoPid {
        profile: ProfileId,
        flags: AutoPidFlags,
    },
    AutoPid2 {
        all_profiles: bool,
        axes: [bool; 3],
    },
    Bode {
        axis: usize,
        samples: u32,
        system: BodeTestSystem,
        gain: u16,
    },
    SyncMotors {
        axis: usize,
    },
    Momentum,
    SafeStop,
}

/// A procedure that runs.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Procedure {
    /// The command that started it.
    pub(super) command: CommandId,
    /// The port that receives its progress and its end.
    pub(super) port: u8,
    pub(super) kind: Kind,
    pub(super) mode: CalibMode,
    pub(super) starts: Duration,
    pub(super) ends: Duration,
    /// Whether its end is confirmed.
    pub(super) reported: bool,
    /// When the next message of its progress is due, and how many there were.
    pub(super) next_progress: Duration,
    pub(super) steps: u32,
    /// Whether the motors have to stand still for it.
    pub(super) holds: bool,
}

impl Procedure {
    /// How much of it is done, 0 to 1.
    pub(super) fn progress(&self, now: Duration) -> f64 {
        let whole = self.ends.saturating_sub(self.starts).as_secs_f64().max(1e-9);
        (now.saturating_sub(self.starts).as_secs_f64() / whole).clamp(0.0, 1.0)
    }
}
