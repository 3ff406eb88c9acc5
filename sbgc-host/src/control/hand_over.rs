//! Motion without an owner: moves that are left to the board, and the end of all motion.

use bytes::Bytes;
use sbgc_proto::commands::{Control, ControlConfig};
use sbgc_proto::units::{ControlRate, FirmwareVersion};
use sbgc_proto::{CommandId, Message};

use super::session::TIMEOUT_SINCE;
use super::setpoint::Setpoint;
use crate::gimbal::encode;
use crate::{Gimbal, Result};

impl Setpoint {
    /// The commands that hand it over to the board: itself, and that no time-out ends it.
    ///
    /// # Errors
    /// If the firmware does not know it.
    pub fn hand_over_frames(self, firmware: FirmwareVersion) -> Result<Vec<(CommandId, Bytes)>> {
        let mut frames = vec![self.frame(firmware)?];
        if firmware >= TIMEOUT_SINCE {
            frames.push((ControlConfig::ID, encode(&ControlConfig::default())?));
        }
        Ok(frames)
    }
}

impl Gimbal {
    /// Hands a move over to the board, which completes it by itself: returns once the board has confirmed it.
    ///
    /// A time-out that another program has left armed is disarmed, since it would end the move.
    ///
    /// # Errors
    /// If the firmware does not know the set-point, if the board refuses it, or does not confirm it.
    pub async fn hand_over(&self, setpoint: Setpoint, firmware: FirmwareVersion) -> Result<()> {
        let mut frames = setpoint.hand_over_frames(firmware)?.into_iter();
        if let Some((command, payload)) = frames.next() {
            self.request_raw(command, payload, CommandId::CONFIRM).await?;
        }
        for (command, payload) in frames {
            self.send_raw(command, payload).await?;
        }
        Ok(())
    }
}

/// The commands that stop all axes and return control to the board's other sources, each to be confirmed.
pub fn stop_commands() -> [Control; 2] {
    [Control::speeds([ControlRate::default(); 3].into()), Control::release()]
}
