//! Automatic tuning and Bode tests.
//!
//! Real: tuning is confirmed at once, reports its progress where that was asked for, and ends with the parameters of
//! the profile that it has changed, unasked. The second version keeps its configuration in the EEPROM and has error
//! codes of its own. A Bode test sends its samples and then its end.
//!
//! Simplified: tuning takes 8 seconds and finds the same values each time.

use sbgc_proto::units::PidTerm;
use std::time::Duration;

use sbgc_proto::commands::{
    AutoPid, AutoPid2, AutoPid2Action, AutoPid2Axis, AutoPid2Error, AutoPid2GeneralFlags, AutoPid2Request,
    AutoPidError, AutoPidFlags, AutoPidRequest, BodeSample, BodeStimulusType, BodeTestData,
    BodeTestStartStop, BodeTestStartStopRequest, BodeTestSystem, CalibMode, ProfileId,
};
use sbgc_proto::wire::{List, PerAxis};
use sbgc_proto::{CommandId, OutgoingCommand};

use super::params::packets;
use crate::sim::eeprom::Region;
use crate::sim::imu::float;
use crate::sim::machine::{Call, Machine};
use crate::sim::motion::CYCLE;
use crate::sim::parameters::PROFILES;
use crate::sim::procedure::{Kind, Procedure};
use crate::sim::reply::{Packet, Refusal, Replies, Reply, done};

/// How long tuning takes, and how often it reports.
const TUNING: Duration = Duration::from_secs(8);
const PROGRESS: Duration = Duration::from_millis(500);

/// Number of samples in a message of a Bode test.
const SAMPLES: u32 = 20;

/// What marks a configuration of tuning in the EEPROM.
const CONFIGURED: u8 = 0xA5;

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::AutoPidRequest(request) => auto_pid(machine, call, request),
        OutgoingCommand::AutoPid2SimpleRequest(request) => match request.action {
            AutoPid2Action::Stop => stop(machine),
            AutoPid2Action::Read => read(machine),
            AutoPid2Action::Start | AutoPid2Action::StartSave | AutoPid2Action::Save => {
                Err(Refusal::Tuning(AutoPid2Error::WrongCommandSize))
            }
            _ => Err(Refusal::Tuning(AutoPid2Error::UnknownAction)),
        },
        OutgoingCommand::AutoPid2Request(request) => auto_pid_2(machine, call, request),
        OutgoingCommand::BodeTestStartStopRequest(request) => bode(machine, call, request),
        _ => return None,
    })
}

fn procedure(
    now: Duration,
    port: u8,
    command: CommandId,
    kind: Kind,
    mode: CalibMode,
    time: Duration,
) -> Procedure {
    Procedure {
        command,
        port,
        kind,
        mode,
        starts: now,
        ends: now.saturating_add(time),
        reported: false,
        next_progress: now.saturating_add(PROGRESS),
        steps: 0,
        holds: true,
    }
}

fn can_run(machine: &Machine) -> bool {
    machine.procedure.is_none() && machine.motion.motors_on()
}

fn auto_pid(machine: &mut Machine, call: &Call<'_>, request: &AutoPidRequest) -> Replies {
    if request.cfg_flags.is_empty() {
        machine.procedure.take_if(|procedure| matches!(procedure.kind, Kind::AutoPid { .. }));
        return done(CommandId::AutoPid);
    }
    if request.action.raw() != 0 {
        return Err(Refusal::Parameters);
    }
    if !can_run(machine) {
        return Err(Refusal::State);
    }
    let profile = request.profile_id;
    if profile.raw() < PROFILES {
        machine.parameters.activate(profile.raw());
    }
    let kind = Kind::AutoPid { profile, flags: request.cfg_flags };
    let procedure = procedure(call.now, call.port, CommandId::AutoPid, kind, CalibMode::AutoPid, TUNING);
    machine.imu.calib_mode = CalibMode::AutoPid;
    machine.procedure = Some(procedure);
    done(CommandId::AutoPid)
}

/// Tunes all axes of the active profile.
pub(super) fn start_from_menu(machine: &mut Machine, now: Duration, port: u8) {
    if can_run(machine) {
        let kind = Kind::AutoPid2 { all_profiles: false, axes: [true; 3] };
        machine.imu.calib_mode = CalibMode::AutoPid;
        machine.procedure =
            Some(procedure(now, port, CommandId::ExecuteMenu, kind, CalibMode::AutoPid, TUNING));
    }
}

fn stop(machine: &mut Machine) -> Replies {
    machine.procedure.take_if(|procedure| matches!(procedure.kind, Kind::AutoPid2 { .. }));
    done(CommandId::AutoPid2)
}

fn read(machine: &Machine) -> Replies {
    let saved = machine.parameters.eeprom.region(Region::Tuning);
    let Some((&CONFIGURED, config)) = saved.split_first() else {
        return Err(Refusal::Tuning(AutoPid2Error::ReadEepromFailed));
    };
    let mut replies = done(CommandId::AutoPid2)?;
    let data = config.get(..73).unwrap_or_default();
    replies.push(Reply::Send(Packet::of(&AutoPid2 { data })?));
    Ok(replies)
}

fn auto_pid_2(machine: &mut Machine, call: &Call<'_>, request: &AutoPid2Request) -> Replies {
    match request.action {
        AutoPid2Action::Stop => return stop(machine),
        AutoPid2Action::Read => return read(machine),
        AutoPid2Action::Start | AutoPid2Action::StartSave | AutoPid2Action::Save => {}
        _ => return Err(Refusal::Tuning(AutoPid2Error::UnknownAction)),
    }
    if request.action != AutoPid2Action::Save && !can_run(machine) {
        return Err(Refusal::Tuning(AutoPid2Error::CannotRunNow));
    }
    if request.action != AutoPid2Action::Start {
        let config: Vec<u8> = std::iter::once(CONFIGURED).chain(call.payload.iter().copied()).collect();
        machine.parameters.eeprom.set_region(Region::Tuning, &config);
    }
    if request.action != AutoPid2Action::Save {
        let enabled = |axis: AutoPid2Axis| axis.axis_flags.enabled();
        let kind = Kind::AutoPid2 {
            all_profiles: request.general_flags.contains(AutoPid2GeneralFlags::SAVE_TO_ALL_PROFILES),
            axes: request.axes.map(enabled).into_array(),
        };
        machine.imu.calib_mode = CalibMode::AutoPid;
        machine.procedure =
            Some(procedure(call.now, call.port, CommandId::AutoPid2, kind, CalibMode::AutoPid, TUNING));
    }
    done(CommandId::AutoPid2)
}

fn bode(machine: &mut Machine, call: &Call<'_>, request: &BodeTestStartStopRequest) -> Replies {
    let axis = usize::from(request.axis.raw());
    let known = !matches!(request.stimulus_type, BodeStimulusType::Unknown(_))
        && !matches!(request.system, BodeTestSystem::Unknown(_));
    if axis > 2 || !known || request.mode != 0 || request.stimulus_gain == 0 || request.samples_num == 0 {
        return Err(Refusal::Parameters);
    }
    if !can_run(machine) {
        return Err(Refusal::State);
    }
    let (samples, system, gain) = (request.samples_num, request.system, request.stimulus_gain);
    let kind = Kind::Bode { axis, samples, system, gain };
    let time = CYCLE.saturating_mul(samples);
    let mut procedure =
        procedure(call.now, call.port, CommandId::BodeTestStartStop, kind, CalibMode::BodeTest, time);
    procedure.next_progress = call.now.saturating_add(CYCLE.saturating_mul(SAMPLES.min(samples)));
    machine.imu.calib_mode = CalibMode::BodeTest;
    machine.procedure = Some(procedure);
    done(CommandId::BodeTestStartStop)
}

/// Reports the progress of what runs, and ends it.
pub(super) fn poll(machine: &mut Machine, now: Duration, replies: &mut Vec<(u8, Reply)>) {
    let Some(mut procedure) = machine.procedure.clone() else { return };
    let port = procedure.port;
    let before = procedure.steps;
    match procedure.kind {
        Kind::AutoPid { flags, .. } if flags.contains(AutoPidFlags::SEND_GUI) => {
            while procedure.next_progress <= now && procedure.next_progress < procedure.ends {
                procedure.steps += 1;
                procedure.next_progress = procedure.next_progress.saturating_add(PROGRESS);
                let packet = Packet::of(&progress(machine, &procedure, now));
                replies.extend(packet.ok().map(|packet| (port, Reply::Send(packet))));
            }
        }
        Kind::Bode { samples, gain, .. } => {
            let over = procedure.ends <= now;
            while (over || procedure.next_progress <= now) && procedure.steps * SAMPLES < samples {
                let count = SAMPLES.min(samples - procedure.steps * SAMPLES);
                let packet = Packet::of(&bode_data(procedure.steps, count, gain));
                replies.extend(packet.ok().map(|packet| (port, Reply::Send(packet))));
                procedure.steps += 1;
                procedure.next_progress =
                    procedure.next_progress.saturating_add(CYCLE.saturating_mul(SAMPLES));
            }
            if !machine.motion.motors_on() {
                procedure.ends = now;
            }
        }
        Kind::AutoPid { .. } | Kind::AutoPid2 { .. } | Kind::SyncMotors { .. } => {}
        _ => return,
    }
    if procedure.ends > now {
        if procedure.steps != before {
            machine.procedure = Some(procedure);
        }
        return;
    }
    machine.procedure = None;
    machine.imu.calib_mode = CalibMode::None;
    finish(machine, &procedure, replies);
}

fn progress(machine: &Machine, procedure: &Procedure, now: Duration) -> AutoPid {
    let params = &machine.settings().params;
    let rest = 1.0 - procedure.progress(now);
    let error = AutoPidError { tracking_error: float(0.2 + rest * 3.0), ..AutoPidError::default() };
    AutoPid {
        p: params.motors.map(|motor| motor.p.0),
        i: params.motors.map(|motor| motor.i.0),
        d: params.motors.map(|motor| motor.d.0),
        lpf_freq: machine.settings().ext.lpf_freq,
        iteration_cnt: u16::try_from(procedure.steps).unwrap_or(u16::MAX),
        axes: [error; 3].into(),
        ..AutoPid::default()
    }
}

fn bode_data(step: u32, count: u32, gain: u16) -> BodeTestData {
    let mut samples = List::new();
    for index in 0..count {
        let phase = f64::from(step * SAMPLES + index) * 0.3;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is within 0 to 65534")]
        let level = |value: f64| (f64::midpoint(value, 1.0) * 65534.0).round() as u16;
        let sample = BodeSample { input: level(phase.sin()), output: level((phase - 0.4).sin()) };
        if samples.push(sample).is_err() {
            break;
        }
    }
    let [sample_counter, ..] = step.to_le_bytes();
    let most = f64::from(gain);
    BodeTestData {
        sample_counter,
        input_min: float(-most),
        output_min: float(-most * 0.7),
        input_max: float(most),
        output_max: float(most * 0.7),
        samples,
    }
}

fn finish(machine: &mut Machine, procedure: &Procedure, replies: &mut Vec<(u8, Reply)>) {
    let port = procedure.port;
    let mut send = |packet: Packet| replies.push((port, Reply::Send(packet)));
    match procedure.kind {
        Kind::AutoPid { profile, flags } => {
            let axes =
                [AutoPidFlags::ROLL, AutoPidFlags::PITCH, AutoPidFlags::YAW].map(|axis| flags.contains(axis));
            let all = flags.contains(AutoPidFlags::ALL_PROFILES);
            tune(machine, all, axes);
            if all {
                for profile in 0..PROFILES {
                    packets(machine, profile.into()).for_each(&mut send);
                }
            } else {
                packets(machine, profile).for_each(&mut send);
            }
        }
        Kind::AutoPid2 { all_profiles, axes } => {
            tune(machine, all_profiles, axes);
            packets(machine, ProfileId::Current).for_each(&mut send);
        }
        Kind::Bode { samples, .. } => {
            let samples_count = samples.min(procedure.steps.saturating_mul(SAMPLES));
            let finished = BodeTestStartStop { samples_count, ..BodeTestStartStop::default() };
            if let Ok(packet) = Packet::of(&finished) {
                send(packet);
            }
        }
        Kind::SyncMotors { .. } => machine.set_motors(false),
        _ => {}
    }
}

/// Puts the values that were found into the active profile, or into all.
fn tune(machine: &mut Machine, all: bool, axes: [bool; 3]) {
    let active = machine.parameters.active();
    for profile in (0..PROFILES).filter(|profile| all || *profile == active) {
        machine.parameters.change_in(profile, |settings| {
            let PerAxis { roll, pitch, yaw } = &mut settings.params.motors;
            for (motor, _) in [roll, pitch, yaw].into_iter().zip(axes).filter(|(_, tuned)| *tuned) {
                (motor.p, motor.i, motor.d) = (PidTerm(72), PidTerm(31), PidTerm(64));
            }
        });
    }
}
