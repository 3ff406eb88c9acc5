//! Commands of the menu.
//!
//! Real: profiles, motors, moves to fixed positions as automated tasks, calibrations, scripts, profile sets, inversion
//! of remote control, follow mode, camera events, tripod, servo and shake mode, and when they are confirmed.
//!
//! Simplified: receiver binding and online calibrations of gyroscopes are confirmed and change nothing. A frame upside
//! down is shown in the state flags alone: here nobody turns the frame over.

use std::time::Duration;

use sbgc_proto::commands::{
    CalibAction, EventId, EventTypes, ExecuteMenuFlags, GeneralFlags1, MenuCommand, RcAxisMode, Reset,
    SystemStateFlags,
};
use sbgc_proto::units::Angle;
use sbgc_proto::wire::PerAxis;
use sbgc_proto::{CommandId, OutgoingCommand};

use super::{actions, calibration, scripts, tuning};
use crate::sim::events::Happened;
use crate::sim::machine::{Call, Machine, MenuRequest};
use crate::sim::motion::Goal;
use crate::sim::reply::{Packet, RESET_NOTICE, Refusal, Replies, Reply, done};
use crate::sim::steering::speed_of;

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::ExecuteMenu(menu) => execute(machine, call, menu.cmd_id, ExecuteMenuFlags::CONFIRM),
        OutgoingCommand::ExecuteMenuExtended(menu) => execute(machine, call, menu.cmd_id, menu.flags),
        _ => return None,
    })
}

fn execute(machine: &mut Machine, call: &Call<'_>, command: MenuCommand, flags: ExecuteMenuFlags) -> Replies {
    let mut replies = Vec::new();
    if flags.contains(ExecuteMenuFlags::CONFIRM) {
        replies.extend(done(CommandId::ExecuteMenu)?);
    }
    replies.extend(run(machine, call.now, call.port, command)?);
    if flags.contains(ExecuteMenuFlags::CONFIRM_ON_FINISH) {
        machine.menu_reports = Some(call.port);
    }
    Ok(replies)
}

/// Runs what scripts and trigger slots have asked for.
pub(super) fn poll(machine: &mut Machine, now: Duration, replies: &mut Vec<(u8, Reply)>) {
    while let Some(MenuRequest { command, port }) = machine.menu.pop_front() {
        let follows = run(machine, now, port, command).unwrap_or_default();
        replies.extend(follows.into_iter().map(|reply| (port, reply)));
    }
}

/// Runs a command, and returns what follows besides its confirmation.
#[allow(clippy::too_many_lines, reason = "it is a list")]
fn run(machine: &mut Machine, now: Duration, port: u8, command: MenuCommand) -> Replies {
    let only = |roll, pitch, yaw| PerAxis { roll, pitch, yaw };
    let level = Some(0.0);
    let yaw = machine.motion.axes().yaw.setpoint;
    match command {
        MenuCommand::Profile1 => activate(machine, now, 0),
        MenuCommand::Profile2 => activate(machine, now, 1),
        MenuCommand::Profile3 => activate(machine, now, 2),
        MenuCommand::Profile4 => activate(machine, now, 3),
        MenuCommand::Profile5 => activate(machine, now, 4),
        MenuCommand::MotorOn => turn_on(machine, true),
        MenuCommand::MotorOff => turn_on(machine, false),
        MenuCommand::MotorToggle => turn_on(machine, !machine.motion.motors_on()),
        MenuCommand::MotorsSafeStop => actions::safe_stop(machine, now, port),
        MenuCommand::MotorsSafeToggle => {
            if machine.motion.motors_on() {
                actions::safe_stop(machine, now, port);
            } else {
                turn_on(machine, true);
            }
        }
        MenuCommand::LevelRollPitch => go_to(machine, only(level, level, None)),
        MenuCommand::LevelRoll => go_to(machine, only(level, None, None)),
        MenuCommand::LevelPitch => go_to(machine, only(None, level, None)),
        MenuCommand::CenterYaw => go_to(machine, only(None, None, Some(machine.motion.frame().yaw))),
        MenuCommand::CenterYawShortest => go_to(machine, only(None, None, Some(nearest(machine)))),
        MenuCommand::HomePosition => {
            let home = home(machine);
            go_to(machine, home.map(Some));
        }
        MenuCommand::HomePositionShortest => {
            let home = home(machine);
            let turns = ((yaw - home.yaw) / 360.0).round();
            go_to(machine, PerAxis { yaw: home.yaw + turns * 360.0, ..home }.map(Some));
        }
        MenuCommand::HomePositionMotors => {
            let frame = machine.motion.frame();
            go_to(machine, frame.map(Some));
        }
        MenuCommand::UntwistCables => {
            let home = yaw.rem_euclid(360.0);
            go_to(machine, only(None, None, Some(if home > 180.0 { home - 360.0 } else { home })));
        }
        MenuCommand::LookDown => go_to(machine, only(None, Some(90.0), None)),
        MenuCommand::RotateYaw180 | MenuCommand::RotateYaw180FrameRel => {
            go_to(machine, only(None, None, Some(yaw + 180.0)));
        }
        MenuCommand::SwitchYaw180FrameRel => {
            let frame = machine.motion.frame().yaw;
            let turned = (yaw - frame).abs() > 90.0;
            go_to(machine, only(None, None, Some(if turned { frame } else { frame + 180.0 })));
        }
        MenuCommand::SwitchPosRoll90 => {
            let turned = machine.motion.axes().roll.setpoint.abs() > 45.0;
            go_to(machine, only(Some(if turned { 0.0 } else { 90.0 }), None, None));
        }
        MenuCommand::SnapToFixedPosition => {
            let snapped = machine.motion.axes().map(|axis| Some((axis.setpoint / 90.0).round() * 90.0));
            go_to(machine, snapped);
        }
        MenuCommand::RetractedPosition => {
            let angles = machine.settings().ext3.retracted_angle.map(|angle| Some(f64::from(angle)));
            machine.modes.insert(SystemStateFlags::RETRACTED_POSITION);
            machine.events.push(Happened::new(EventId::RetractedPosition, EventTypes::ON, 0));
            go_to(machine, angles);
        }
        MenuCommand::SetAngle | MenuCommand::SetCurPosAsHome => {
            let here = machine.motion.axes().map(|axis| axis.wire_angle());
            machine.parameters.change(|settings| settings.params.rc_memory = here);
        }
        MenuCommand::Reset => {
            return Ok(vec![Reply::Send(Packet::of(&Reset {})?), Reply::Reset { after: RESET_NOTICE }]);
        }
        MenuCommand::CalibAcc => calibrate(machine, now, port, CommandId::CalibAcc, CalibAction::Regular),
        MenuCommand::CalibGyro => calibrate(machine, now, port, CommandId::CalibGyro, CalibAction::Regular),
        MenuCommand::CalibMag => calibrate(machine, now, port, CommandId::CalibMag, CalibAction::Regular),
        MenuCommand::CalibAccTemp => {
            calibrate(machine, now, port, CommandId::CalibAcc, CalibAction::Temperature);
        }
        MenuCommand::CalibGyroTemp => {
            calibrate(machine, now, port, CommandId::CalibGyro, CalibAction::Temperature);
        }
        MenuCommand::AutoPid | MenuCommand::AutoPidGainOnly => tuning::start_from_menu(machine, now, port),
        MenuCommand::RunScript1 => scripts::start(machine, now, port, 0, false),
        MenuCommand::RunScript2 => scripts::start(machine, now, port, 1, false),
        MenuCommand::RunScript3 => scripts::start(machine, now, port, 2, false),
        MenuCommand::RunScript4 => scripts::start(machine, now, port, 3, false),
        MenuCommand::RunScript5 => scripts::start(machine, now, port, 4, false),
        MenuCommand::StopScript => scripts::stop(machine),
        MenuCommand::LoadProfileSet1 => load_set(machine, now, 1),
        MenuCommand::LoadProfileSet2 => load_set(machine, now, 2),
        MenuCommand::LoadProfileSet3 => load_set(machine, now, 3),
        MenuCommand::LoadProfileSet4 => load_set(machine, now, 4),
        MenuCommand::LoadProfileSet5 => load_set(machine, now, 5),
        MenuCommand::LoadProfileSetBackup => load_set(machine, now, 6),
        MenuCommand::SwapPitchRoll => machine.rc.pitch_swapped ^= true,
        MenuCommand::SwapYawRoll => machine.rc.yaw_swapped ^= true,
        MenuCommand::FrameUpsideDown => machine.parameters.change(|settings| {
            settings.params.general_flags1.toggle(GeneralFlags1::IS_UPSIDE_DOWN);
        }),
        MenuCommand::InvertRcRoll => invert(machine, |modes| &mut modes.roll),
        MenuCommand::InvertRcPitch => invert(machine, |modes| &mut modes.pitch),
        MenuCommand::InvertRcYaw => invert(machine, |modes| &mut modes.yaw),
        MenuCommand::ForcedFollowToggle => machine.steering.follow_forced ^= true,
        MenuCommand::DisableFollowToggle => machine.steering.follow_disabled ^= true,
        MenuCommand::CameraRecPhotoEvent => {
            machine.events.push(Happened::new(EventId::Camera, EventTypes::REC_PHOTO, 0));
        }
        MenuCommand::CameraPhotoEvent => {
            machine.events.push(Happened::new(EventId::Camera, EventTypes::PHOTO, 0));
        }
        MenuCommand::ButtonPress => {
            machine.events.push(Happened::new(EventId::MenuButton, EventTypes::ON, 0));
            machine.events.push(Happened::new(EventId::MenuButton, EventTypes::OFF, 100));
        }
        MenuCommand::TripodModeOn => machine.modes.insert(SystemStateFlags::TRIPOD_MODE_ENABLED),
        MenuCommand::TripodModeOff => machine.modes.remove(SystemStateFlags::TRIPOD_MODE_ENABLED),
        MenuCommand::ShakeGeneratorOn => machine.modes.insert(SystemStateFlags::SHAKE_GEN_ENABLED),
        MenuCommand::ShakeGeneratorOff => machine.modes.remove(SystemStateFlags::SHAKE_GEN_ENABLED),
        MenuCommand::ServoModeOn => machine.modes.insert(SystemStateFlags::SERVO_MODE_ENABLED),
        MenuCommand::ServoModeOff => machine.modes.remove(SystemStateFlags::SERVO_MODE_ENABLED),
        MenuCommand::ServoModeToggle => machine.modes.toggle(SystemStateFlags::SERVO_MODE_ENABLED),
        MenuCommand::CalibMomentum => calibration::start_momentum(machine, now, port),
        MenuCommand::StartTimelapse | MenuCommand::RepeatTimelapse => timelapse(machine),
        MenuCommand::SetRcTrim => set_trim(machine),
        MenuCommand::Unknown(_) => return Err(Refusal::Parameters),
        _ => {}
    }
    Ok(Vec::new())
}

fn activate(machine: &mut Machine, now: Duration, profile: u8) {
    machine.parameters.activate(profile);
    machine.steer(now);
}

fn turn_on(machine: &mut Machine, on: bool) {
    if !on {
        machine.set_motors(false);
    } else if machine.may_turn_on() {
        machine.end_stop();
        machine.set_motors(true);
    }
}

/// The position that was set as home, in the angles of the protocol.
fn home(machine: &Machine) -> PerAxis<f64> {
    machine.settings().params.rc_memory.map(|angle: Angle| f64::from(angle.degrees()))
}

/// The yaw of the frame on the shorter way.
fn nearest(machine: &Machine) -> f64 {
    let (frame, yaw) = (machine.motion.frame().yaw, machine.motion.axes().yaw.setpoint);
    frame + ((yaw - frame) / 360.0).round() * 360.0
}

/// Moves axes as an automated task, with the speed of such tasks.
fn go_to(machine: &mut Machine, angles: PerAxis<Option<f64>>) {
    let speed = Some(speed_of(machine.settings().ext2.auto_speed));
    let tasks = angles.map(|angle| angle.map(|angle| Goal::Angle { angle, speed }));
    machine.motion.give_task(tasks);
}

fn calibrate(machine: &mut Machine, now: Duration, port: u8, command: CommandId, action: CalibAction) {
    let _ = calibration::start_sensor(machine, now, port, command, None, action, Duration::ZERO, false);
}

fn load_set(machine: &mut Machine, now: Duration, slot: u8) {
    let _ = machine.parameters.load_set(slot);
    machine.steer(now);
}

fn invert(machine: &mut Machine, axis: fn(&mut PerAxis<RcAxisMode>) -> &mut RcAxisMode) {
    machine.parameters.change(|settings| {
        let mut modes = settings.params.rc.map(|rc| rc.rc_mode);
        let mode = axis(&mut modes);
        *mode = mode.with_inverted(!mode.inverted());
        let PerAxis { roll, pitch, yaw } = &mut settings.params.rc;
        for (rc, mode) in [roll, pitch, yaw].into_iter().zip(modes.into_array()) {
            rc.rc_mode = mode;
        }
    });
}

/// Moves through the yaw range in the time of the parameters.
fn timelapse(machine: &mut Machine) {
    let seconds = f64::from(machine.settings().ext2.timelapse_time.max(1));
    let rc = machine.settings().params.rc.yaw;
    let (from, to) = (f64::from(rc.rc_min_angle), f64::from(rc.rc_max_angle));
    let start = machine.motion.axes().yaw.setpoint;
    let speed = ((to - start).abs() / seconds).max((to - from).abs() / seconds / 100.0);
    machine.motion.give_task(PerAxis {
        yaw: Some(Goal::Angle { angle: to, speed: Some(speed) }),
        ..PerAxis::default()
    });
}

/// Takes the present signals as the middle.
fn set_trim(machine: &mut Machine) {
    let sources = crate::sim::rc::RcInputs::assigned(machine.settings());
    let signals = sources.map(|source| machine.rc.signal(source, machine.settings()));
    machine.parameters.change(|settings| {
        let PerAxis { roll, pitch, yaw } = &mut settings.params.rc_trim;
        for (trim, signal) in [roll, pitch, yaw].into_iter().zip(signals) {
            if let Some(signal) = signal {
                #[allow(clippy::cast_possible_truncation, reason = "it is within -127 to 127")]
                let steps = (-signal * 500.0).clamp(-127.0, 127.0).round() as i8;
                *trim = steps;
            }
        }
    });
}
