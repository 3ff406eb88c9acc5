//! Motion, motors, the menu and restarts.

use std::time::Duration;

use sbgc_proto::CommandId;
use sbgc_proto::commands::{
    ConfirmData, Control, ControlConfig, ControlLegacy, ExecuteMenuFlags, MenuCommand, Reset,
    ResetExtendedRequest, ResetFlags,
};
use sbgc_proto::wire::PerAxis;

use super::{Packet, Refusal, Replies, Reply, confirm};
use crate::sim::machine::Machine;
use crate::sim::motion::Goal;

/// What a board that resets by itself waits after its notice.
const RESET_NOTICE: Duration = Duration::from_secs(1);

const DONE: ConfirmData = ConfirmData::U8(0);

impl Machine {
    pub(super) fn control_legacy(&mut self, now: Duration, command: &ControlLegacy) -> Replies {
        let control_mode = [command.control_mode; 3].into();
        self.control(now, &Control { control_mode, axes: command.axes })
    }

    pub(super) fn control(&mut self, now: Duration, command: &Control) -> Replies {
        let remote_control = self.parameters.remote_control();
        if self.steering.control(now, command, remote_control, &mut self.motion)? {
            confirm(CommandId::Control, DONE)
        } else {
            Ok(Vec::new())
        }
    }

    pub(super) fn control_config(&mut self, now: Duration, config: &ControlConfig) -> Replies {
        self.steering.configure(now, config, &mut self.motion);
        confirm(CommandId::ControlConfig, DONE)
    }

    /// The angles that were to be reported are reached.
    pub(in crate::sim) fn control_finished() -> Result<Packet, Refusal> {
        Packet::confirmation(CommandId::Control, ConfirmData::U8(1))
    }

    pub(super) fn motors(&mut self, command: CommandId, on: bool) -> Replies {
        self.motion.set_motors(on);
        confirm(command, DONE)
    }

    /// Runs a command of the menu. One that is not listed here is confirmed and has no effect.
    pub(super) fn menu(&mut self, command: MenuCommand, flags: ExecuteMenuFlags) -> Replies {
        let mut replies = Vec::new();
        if flags.contains(ExecuteMenuFlags::CONFIRM) {
            replies.extend(confirm(CommandId::ExecuteMenu, DONE)?);
        }
        let only = |roll, pitch, yaw| PerAxis { roll, pitch, yaw };
        let level = Some(0.0);
        match command {
            MenuCommand::Profile1 => self.parameters.activate(0),
            MenuCommand::Profile2 => self.parameters.activate(1),
            MenuCommand::Profile3 => self.parameters.activate(2),
            MenuCommand::Profile4 => self.parameters.activate(3),
            MenuCommand::Profile5 => self.parameters.activate(4),
            MenuCommand::MotorOn => self.motion.set_motors(true),
            MenuCommand::MotorOff | MenuCommand::MotorsSafeStop => self.motion.set_motors(false),
            MenuCommand::MotorToggle | MenuCommand::MotorsSafeToggle => {
                self.motion.set_motors(!self.motion.motors_on());
            }
            MenuCommand::LevelRollPitch => self.go_to(only(level, level, None)),
            MenuCommand::LevelRoll => self.go_to(only(level, None, None)),
            MenuCommand::LevelPitch => self.go_to(only(None, level, None)),
            MenuCommand::CenterYaw | MenuCommand::CenterYawShortest => self.go_to(only(None, None, level)),
            MenuCommand::HomePosition | MenuCommand::HomePositionShortest => {
                self.go_to(only(level, level, level));
            }
            MenuCommand::LookDown => self.go_to(only(None, Some(90.0), None)),
            MenuCommand::Reset => {
                replies.push(Reply::Send(Packet::of(&Reset {})?));
                replies.push(Reply::Reset { after: RESET_NOTICE });
            }
            _ => {}
        }
        if flags.contains(ExecuteMenuFlags::CONFIRM_ON_FINISH) {
            self.menu_runs = true;
        }
        Ok(replies)
    }

    /// What the menu had running is done.
    pub(in crate::sim) fn menu_finished() -> Result<Packet, Refusal> {
        Packet::confirmation(CommandId::ExecuteMenu, DONE)
    }

    pub(super) fn reset_request(request: Option<&ResetExtendedRequest>) -> Replies {
        let mut replies = Vec::new();
        if request.is_some_and(|request| request.flags.contains(ResetFlags::CONFIRM)) {
            replies.push(Reply::Send(Packet::of(&Reset {})?));
        }
        let delay = request.map_or(0, |request| request.delay_ms);
        replies.push(Reply::Reset { after: Duration::from_millis(delay.into()) });
        Ok(replies)
    }

    fn go_to(&mut self, angles: PerAxis<Option<f64>>) {
        for (axis, angle) in self.motion.each_mut().into_iter().zip(angles.into_array()) {
            if let Some(angle) = angle.filter(|_| axis.present) {
                axis.task = Some(Goal::Angle { angle, speed: None });
            }
        }
    }
}
