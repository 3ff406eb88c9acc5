//! Calibrations of the sensors.
//!
//! Real: the extended forms are confirmed at once and once more when they end, they take their time, real-time data
//! tells that one runs, and a second one is refused meanwhile.
//!
//! Simplified: nothing is calibrated, and the camera may move. Where the protocol leaves it open: the simple forms are
//! confirmed once, at once.

use std::time::Duration;

use sbgc_proto::CommandId;
use sbgc_proto::commands::{CalibMode, ConfirmData, ImuCalibration};

use super::{Packet, Refusal, Replies, confirm};
use crate::sim::machine::Machine;

/// A calibration that runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::sim) struct Calibration {
    command: CommandId,
    ends: Duration,
    reported: bool,
}

impl Machine {
    /// Starts the calibration of `command`, with what its extended form says about it.
    pub(super) fn calibrate(
        &mut self,
        now: Duration,
        command: CommandId,
        request: Option<&ImuCalibration>,
    ) -> Replies {
        if self.calibration.is_some() {
            return Err(Refusal::State);
        }
        let given = request.map_or(0, |request| request.time_ms.0);
        let takes = match (given, command) {
            (0, CommandId::CalibMag) => Duration::from_secs(20),
            (0, _) => Duration::from_secs(4),
            (given, _) => Duration::from_millis(given.into()),
        };
        let ends = now.saturating_add(takes);
        self.calibration = Some(Calibration { command, ends, reported: request.is_some() });
        confirm(command, ConfirmData::U8(0))
    }

    /// What real-time data says about it.
    pub(super) fn calibration_mode(&self) -> CalibMode {
        match self.calibration.map(|calibration| calibration.command) {
            Some(CommandId::CalibAcc) => CalibMode::Acc,
            Some(CommandId::CalibGyro) => CalibMode::Gyro,
            Some(CommandId::CalibMag) => CalibMode::Mag,
            _ => CalibMode::None,
        }
    }

    /// Ends the calibration that has come to its end, and says so where that was asked for.
    pub(in crate::sim) fn calibration_finished(&mut self, now: Duration) -> Option<Packet> {
        let ended = self.calibration.take_if(|calibration| calibration.ends <= now)?;
        let packet = ended.reported.then(|| Packet::confirmation(ended.command, ConfirmData::U8(0)));
        packet?.ok()
    }
}
