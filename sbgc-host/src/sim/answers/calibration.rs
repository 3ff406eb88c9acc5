//! Calibrations: what they need, how long they take, and what they change.
//!
//! Real: a calibration is confirmed at once if its parameters are valid and once more when it ends; that of the
//! gyroscope fails while the camera turns and is cancelled by a control command; those that restart the board announce
//! it; that of the orientation needs the motors off and ends with parameters that nobody asked for; that with an
//! external reference is confirmed only if all its conditions are met; that of cogging ends with 255.
//!
//! Where the protocol leaves it open: the calibrations of gains, poles, offsets and encoders are confirmed once, at
//! once. One that cannot go on ends with `CMD_ERROR`.

use std::time::Duration;

use sbgc_proto::commands::{
    AccAxis, AccLimits, CalibAccExtRef, CalibAction, CalibBat, CalibCogging, CalibImu, CalibInfo, CalibMode,
    CoggingAction, ConfirmData, Error, ErrorCode, ErrorData, FailureCode, ForMotor, ImuCalibration, ImuType,
    ProfileId, Switch,
};
use sbgc_proto::units::{Angle, CalibrationTime, CorrectionAngle};
use sbgc_proto::wire::{PerAxis, PerXyz};
use sbgc_proto::{CommandId, OutgoingCommand};

use super::imu::is_connected;
use super::params::{packet, with_restart};
use crate::sim::eeprom::{Block, Cell};
use crate::sim::imu::{short, vectors};
use crate::sim::machine::{Call, Machine};
use crate::sim::power::Power;
use crate::sim::procedure::{Kind, Procedure};
use crate::sim::reply::{DONE, Packet, Refusal, Replies, Reply, done, message, silence};

/// How fast the camera may turn while the gyroscope is calibrated, in degrees per second.
const STILL: f64 = 2.0;

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    let id = CommandId::from(call.id);
    Some(match command {
        OutgoingCommand::CalibAccSimple(_)
        | OutgoingCommand::CalibGyroSimple(_)
        | OutgoingCommand::CalibMagSimple(_) => {
            let regular = ImuCalibration { action: CalibAction::Regular, ..ImuCalibration::default() };
            sensor(machine, call, &regular)
        }
        OutgoingCommand::CalibAcc(request) => sensor(machine, call, &request.0),
        OutgoingCommand::CalibGyro(request) => sensor(machine, call, &request.0),
        OutgoingCommand::CalibMag(request) => sensor(machine, call, &request.0),
        OutgoingCommand::CalibInfoRequest(request) => info(machine, call.now, request.imu_type),
        OutgoingCommand::CalibExtGain(_) => {
            start(machine, call, Kind::ExternalGain, CalibMode::ExtGain, 3000).and_then(|()| done(id))
        }
        OutgoingCommand::CalibPoles(_) => needs_motors(machine, true)
            .and_then(|()| start(machine, call, Kind::Poles, CalibMode::Poles, 5000))
            .and_then(|()| done(id)),
        OutgoingCommand::CalibOffset(_) => follow_offset(machine),
        OutgoingCommand::CalibBat(request) => battery(machine, call.now, request),
        OutgoingCommand::EncodersCalibOffset4Simple(_) => encoder_offset(machine, call, ForMotor::All),
        OutgoingCommand::EncodersCalibOffset4(request) => encoder_offset(machine, call, request.for_motor),
        OutgoingCommand::EncodersCalibFldOffset4Simple(_) => {
            encoder_field(machine, call, [Angle::from_degrees(40.0); 3].into())
        }
        OutgoingCommand::EncodersCalibFldOffset4(request) => {
            encoder_field(machine, call, request.calib_angle)
        }
        OutgoingCommand::EncodersCalibFldOffset4Speed(request) => {
            encoder_field(machine, call, request.calib_angle)
        }
        OutgoingCommand::EncodersCalibFldOffset4Flags(request) => {
            encoder_field(machine, call, request.calib_angle)
        }
        OutgoingCommand::CalibOrientCorr(_) => orientation(machine, call),
        OutgoingCommand::CalibAccExtRef(request) => external_reference(machine, call, request),
        OutgoingCommand::CalibCogging(request) => cogging(machine, call, request),
        _ => return None,
    })
}

/// Begins a procedure of the command, unless another one runs.
fn start(
    machine: &mut Machine,
    call: &Call<'_>,
    kind: Kind,
    mode: CalibMode,
    milliseconds: u64,
) -> Result<(), Refusal> {
    if machine.procedure.is_some() {
        return Err(Refusal::State);
    }
    machine.imu.calib_mode = mode;
    machine.procedure = Some(Procedure {
        command: call.id.into(),
        port: call.port,
        kind,
        mode,
        starts: call.now,
        ends: call.now.saturating_add(Duration::from_millis(milliseconds)),
        reported: false,
        next_progress: call.now,
        steps: 0,
        holds: true,
    });
    Ok(())
}

fn needs_motors(machine: &Machine, on: bool) -> Result<(), Refusal> {
    if machine.motion.motors_on() == on { Ok(()) } else { Err(Refusal::State) }
}

fn sensor(machine: &mut Machine, call: &Call<'_>, request: &ImuCalibration) -> Replies {
    let command = CommandId::from(call.id);
    let imu = match request.imu_idx {
        CalibImu::Current => None,
        CalibImu::Main => Some(ImuType::Main),
        CalibImu::Frame => Some(ImuType::Frame),
        _ => return Err(Refusal::Parameters),
    };
    let CalibrationTime(milliseconds) = request.time_ms;
    let time = Duration::from_millis(milliseconds.into());
    let restart = start_sensor(machine, call.now, call.port, command, imu, request.action, time, true)?;
    with_restart(done(command)?, restart)
}

/// Begins the calibration of a sensor. True if the board restarts for it instead.
#[allow(clippy::too_many_arguments, reason = "the menu has none of the command's parts")]
pub(super) fn start_sensor(
    machine: &mut Machine,
    now: Duration,
    port: u8,
    command: CommandId,
    imu: Option<ImuType>,
    action: CalibAction,
    time: Duration,
    reported: bool,
) -> Result<bool, Refusal> {
    let selected = machine.parameters.eeprom.cell(Cell::SelectedImu).max(1);
    let imu = imu.unwrap_or(ImuType::from(selected));
    if !is_connected(machine, imu) {
        return Err(Refusal::Parameters);
    }
    if machine.procedure.is_some() {
        return Err(Refusal::State);
    }
    let (usual, mode) = match (command, action) {
        (_, CalibAction::ResetAllAndRestart) => {
            machine.parameters.eeprom.set_cell(Cell::Calibrated, 0);
            machine.parameters.eeprom.set_cell(Cell::AccelerometerLimits, 0);
            machine.parameters.eeprom.set_cell(Cell::TemperatureCalibrations, 0);
            return Ok(true);
        }
        (_, CalibAction::EnableTempCalibAndRestart) => {
            return Ok(temperatures_in_use(machine, command, true));
        }
        (_, CalibAction::DisableTempCalibAndRestart) => {
            return Ok(temperatures_in_use(machine, command, false));
        }
        (_, CalibAction::CopySensorEepromToMain | CalibAction::CopyMainEepromToSensor) => {
            (500, CalibMode::WriteParams)
        }
        (CommandId::CalibGyro, CalibAction::Regular) => (4000, CalibMode::Gyro),
        (CommandId::CalibGyro, CalibAction::Temperature) => (20_000, CalibMode::GyroTemp),
        (CommandId::CalibAcc, CalibAction::Regular) => (4000, CalibMode::Acc),
        (CommandId::CalibAcc, CalibAction::Temperature) => (20_000, CalibMode::AccTemp),
        (CommandId::CalibMag, CalibAction::Regular) => (20_000, CalibMode::Mag),
        _ => return Err(Refusal::Parameters),
    };
    let time = if time.is_zero() { Duration::from_millis(usual) } else { time };
    machine.imu.calib_mode = mode;
    machine.procedure = Some(Procedure {
        command,
        port,
        kind: Kind::Sensor { imu, action },
        mode,
        starts: now,
        ends: now.saturating_add(time),
        reported,
        next_progress: now,
        steps: 0,
        holds: false,
    });
    Ok(false)
}

/// Begins the calibration of the momentum of all axes.
pub(super) fn start_momentum(machine: &mut Machine, now: Duration, port: u8) {
    if machine.procedure.is_none() && machine.motion.motors_on() {
        machine.imu.calib_mode = CalibMode::Momentum;
        machine.procedure = Some(Procedure {
            command: CommandId::ExecuteMenu,
            port,
            kind: Kind::Momentum,
            mode: CalibMode::Momentum,
            starts: now,
            ends: now.saturating_add(Duration::from_secs(3)),
            reported: false,
            next_progress: now,
            steps: 0,
            holds: true,
        });
    }
}

/// The bit of a sensor in the cells that remember calibrations.
fn sensor_bit(command: CommandId) -> u8 {
    match command {
        CommandId::CalibAcc => 1,
        CommandId::CalibGyro => 2,
        _ => 4,
    }
}

fn temperatures_in_use(machine: &mut Machine, command: CommandId, enabled: bool) -> bool {
    let eeprom = &mut machine.parameters.eeprom;
    let before = eeprom.cell(Cell::TemperatureCalibrations);
    let bit = sensor_bit(command);
    eeprom.set_cell(Cell::TemperatureCalibrations, if enabled { before | bit } else { before & !bit });
    true
}

fn info(machine: &mut Machine, now: Duration, imu: ImuType) -> Replies {
    if matches!(imu, ImuType::Unknown(_)) {
        return Err(Refusal::Parameters);
    }
    let progress = machine.procedure.as_ref().map_or(0.0, |procedure| procedure.progress(now));
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is within 0 to 100")]
    let progress = (progress * 100.0) as u8;
    let acc_data = match imu {
        ImuType::Frame => machine.imu.frame_sensors(&machine.motion).1,
        _ => machine.imu.acc(&machine.motion),
    };
    let gyro = machine.imu.gyro(&machine.motion).map(|rate| f64::from(rate.0));
    let amplitude = gyro.into_iter().map(|rate| rate * rate).sum::<f64>().sqrt();
    let eeprom = &machine.parameters.eeprom;
    let temperatures = eeprom.cell(Cell::TemperatureCalibrations);
    let enabled = |command| if temperatures & sensor_bit(command) != 0 { Switch::On } else { Switch::Off };
    let limits = AccLimits::from_bits_retain(eeprom.cell(Cell::AccelerometerLimits));
    message(&CalibInfo {
        progress,
        imu_type: imu,
        acc_data,
        gyro_abs_val: u16::try_from(short(amplitude)).unwrap_or_default(),
        acc_cur_axis: upright_axis(machine).0,
        acc_limits_info: limits,
        imu_temp_cels: Power::temperatures(now).0,
        temp_calib_gyro_enabled: enabled(CommandId::CalibGyro),
        temp_calib_gyro_t_min_cels: 10,
        temp_calib_gyro_t_max_cels: 45,
        temp_calib_acc_enabled: enabled(CommandId::CalibAcc),
        temp_calib_acc_t_min_cels: 10,
        temp_calib_acc_t_max_cels: 45,
        ..CalibInfo::default()
    })
}

/// The axis of the sensor that gravity is along, and which limit of the accelerometer that is.
fn upright_axis(machine: &Machine) -> (AccAxis, AccLimits, f64) {
    let down = vectors(machine.motion.axes().map(|axis| axis.angle)).0;
    let parts = [
        (AccAxis::X, AccLimits::PLUS_X, AccLimits::MINUS_X, down.x),
        (AccAxis::Y, AccLimits::PLUS_Y, AccLimits::MINUS_Y, down.y),
        (AccAxis::Z, AccLimits::PLUS_Z, AccLimits::MINUS_Z, down.z),
    ];
    let longest = parts.into_iter().max_by(|(.., a), (.., b)| a.abs().total_cmp(&b.abs()));
    longest.map_or((AccAxis::Z, AccLimits::PLUS_Z, 1.0), |(axis, plus, minus, part)| {
        (axis, if part >= 0.0 { plus } else { minus }, part.abs())
    })
}

/// Takes the present position of the camera against the frame as the one that following leads to.
fn follow_offset(machine: &mut Machine) -> Replies {
    let joints = machine.motion.joints();
    #[allow(clippy::cast_possible_truncation, reason = "it is within -127 to 127")]
    let offset = joints.map(|angle| angle.clamp(-127.0, 127.0).round() as i8);
    machine.parameters.change(|settings| settings.params.follow_offset = offset);
    done(CommandId::CalibOffset)
}

fn battery(machine: &mut Machine, now: Duration, request: &CalibBat) -> Replies {
    let shown = machine.power.voltage(now, &machine.motion);
    let scale = (f64::from(request.actual_voltage.volts()) / shown * 128.0).round();
    if !(64.0..=255.0).contains(&scale) {
        return Err(Refusal::Parameters);
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is within 64 to 255")]
    machine.parameters.eeprom.set_cell(Cell::VoltageScale, scale as u8);
    done(CommandId::CalibBat)
}

fn encoder_offset(machine: &mut Machine, call: &Call<'_>, motor: ForMotor) -> Replies {
    if matches!(motor, ForMotor::Unknown(_)) {
        return Err(Refusal::Parameters);
    }
    start(machine, call, Kind::EncoderOffset(motor), CalibMode::EncoderOffset, 500)?;
    done(call.id.into())
}

fn encoder_field(machine: &mut Machine, call: &Call<'_>, range: PerAxis<Angle>) -> Replies {
    needs_motors(machine, true)?;
    let range = range.map(|angle| f64::from(angle.degrees()));
    start(machine, call, Kind::EncoderField(range), CalibMode::EncoderFldOffset, 6000)?;
    done(call.id.into())
}

fn orientation(machine: &mut Machine, call: &Call<'_>) -> Replies {
    needs_motors(machine, false)?;
    start(machine, call, Kind::Orientation, CalibMode::ImuOrientationCorr, 2000)?;
    done(call.id.into())
}

/// Nothing is answered unless one axis of the sensor is within 20 degrees of gravity and the reference is one of
/// about 1 g along it.
fn external_reference(machine: &mut Machine, call: &Call<'_>, request: &CalibAccExtRef) -> Replies {
    let reference: PerXyz<f64> = request.acc_ref.map(|part| part.g().into());
    let length = reference.into_array().into_iter().map(|part| part * part).sum::<f64>().sqrt();
    let upright = upright_axis(machine).2 >= 20.0_f64.to_radians().cos();
    let frame = vectors(machine.motion.frame()).0;
    let along = frame.into_array().into_iter().zip(reference.into_array()).map(|(a, b)| a * b).sum::<f64>();
    if !upright || !(0.9..1.1).contains(&length) || along / length < 20.0_f64.to_radians().cos() {
        return silence();
    }
    if start(machine, call, Kind::ExternalReference, CalibMode::AccExtRef, 500).is_err() {
        return silence();
    }
    if let Some(procedure) = &mut machine.procedure {
        procedure.reported = true;
    }
    silence()
}

fn cogging(machine: &mut Machine, call: &Call<'_>, request: &CalibCogging) -> Replies {
    let axes = request.axis_to_calibrate;
    let delete = match request.action {
        CoggingAction::Calibrate => false,
        CoggingAction::Delete => true,
        _ => return Err(Refusal::Parameters),
    };
    let chosen = (0..3).zip(request.axes.into_array()).filter(|(bit, _)| axes.bits() >> bit & 1 != 0);
    let valid = delete
        || request.iterations_num >= 2
            && chosen.into_iter().all(|(_, axis)| (20..=360).contains(&axis.angle) && axis.smooth <= 100);
    if axes.is_empty() || !valid {
        return Err(Refusal::Parameters);
    }
    if !delete {
        needs_motors(machine, true)?;
    }
    let time = if delete { 500 } else { 10_000 };
    start(machine, call, Kind::Cogging { axes, delete }, CalibMode::Cogging, time)?;
    done(call.id.into())
}

/// A control command cancels the calibration of a gyroscope, which is then reported as failed.
pub(super) fn cancelled_by_control(machine: &mut Machine) -> Option<Reply> {
    let cancelled = machine.procedure.take_if(|procedure| procedure.mode == CalibMode::Gyro)?;
    machine.imu.calib_mode = CalibMode::None;
    failed(&cancelled).filter(|_| cancelled.reported)
}

fn failed(procedure: &Procedure) -> Option<Reply> {
    let error_code = FailureCode::General(ErrorCode::OperationFailed);
    let error = Error { cmd_id: procedure.command, error_code, error_data: ErrorData::new(&[0; 4]) };
    Packet::of(&error).ok().map(Reply::Send)
}

/// Ends the calibration that has come to its end, with what it changes.
pub(super) fn poll(machine: &mut Machine, now: Duration, replies: &mut Vec<(u8, Reply)>) {
    let still = machine.motion.axes().into_array().iter().all(|axis| axis.speed.abs() < STILL);
    let moved =
        machine.procedure.as_ref().is_some_and(|procedure| procedure.mode == CalibMode::Gyro) && !still;
    let over = machine
        .procedure
        .as_ref()
        .is_some_and(|procedure| is_calibration(procedure.kind) && (procedure.ends <= now || moved));
    let Some(procedure) = machine.procedure.take_if(|_| over) else { return };
    machine.imu.calib_mode = CalibMode::None;
    let port = procedure.port;
    let needs_power =
        matches!(procedure.kind, Kind::Poles | Kind::EncoderField(_) | Kind::Cogging { delete: false, .. });
    if moved || (needs_power && !machine.motion.motors_on()) {
        replies.extend(failed(&procedure).map(|reply| (port, reply)));
        return;
    }
    let data = finish(machine, &procedure, replies);
    let data = data.or(procedure.reported.then_some(DONE));
    if let Some(data) = data
        && let Ok(packet) = Packet::confirmation(procedure.command, data)
    {
        replies.push((port, Reply::Send(packet)));
    }
}

fn is_calibration(kind: Kind) -> bool {
    matches!(
        kind,
        Kind::Sensor { .. }
            | Kind::ExternalGain
            | Kind::Poles
            | Kind::EncoderOffset(_)
            | Kind::EncoderField(_)
            | Kind::Orientation
            | Kind::ExternalReference
            | Kind::Cogging { .. }
            | Kind::Momentum
    )
}

/// Changes what the calibration changes; the data of its last confirmation, where it always has one.
fn finish(
    machine: &mut Machine,
    procedure: &Procedure,
    replies: &mut Vec<(u8, Reply)>,
) -> Option<ConfirmData> {
    let joints = machine.motion.joints();
    let limit = upright_axis(machine).1.bits();
    match procedure.kind {
        Kind::Sensor { action: CalibAction::Regular, .. } => {
            let eeprom = &mut machine.parameters.eeprom;
            let calibrated = eeprom.cell(Cell::Calibrated) | sensor_bit(procedure.command);
            eeprom.set_cell(Cell::Calibrated, calibrated);
            if procedure.command == CommandId::CalibAcc {
                let limits = eeprom.cell(Cell::AccelerometerLimits) | limit;
                eeprom.set_cell(Cell::AccelerometerLimits, limits);
            }
        }
        Kind::Sensor { action: CalibAction::Temperature, .. } => {
            temperatures_in_use(machine, procedure.command, true);
        }
        Kind::Momentum => machine.parameters.change(|settings| settings.ext2.momentum = [220; 3].into()),
        Kind::ExternalGain => machine.parameters.change(|settings| settings.params.ext_fc_gain = [40, 40]),
        Kind::Poles => machine.parameters.change(|settings| {
            let PerAxis { roll, pitch, yaw } = &mut settings.params.motors;
            for motor in [roll, pitch, yaw] {
                motor.poles = 22;
                motor.invert = Switch::Off;
            }
        }),
        Kind::EncoderOffset(motor) => {
            #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
            let measured = joints.map(|angle| Angle::from_degrees(angle as f32)).into_array();
            machine.parameters.change(|settings| {
                let PerAxis { roll, pitch, yaw } = &mut settings.ext.encoder_offset;
                for (index, (place, angle)) in (0..).zip([roll, pitch, yaw].into_iter().zip(measured)) {
                    if motor == ForMotor::All || motor.raw() == index {
                        *place = angle;
                    }
                }
            });
        }
        Kind::EncoderField(range) => {
            #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
            let found = range.map(|angle| Angle::from_degrees((angle / 8.0) as f32));
            machine.parameters.change(|settings| settings.ext.encoder_fld_offset = found);
        }
        Kind::Orientation => {
            let found = [CorrectionAngle(15), CorrectionAngle(-20), CorrectionAngle(5)];
            machine.parameters.change(|settings| settings.ext2.imu_orientation_corr = found.into());
            let packet = packet(machine, Block::Ext2, ProfileId::Current);
            replies.extend(packet.ok().map(|packet| (procedure.port, Reply::Send(packet))));
        }
        Kind::Cogging { axes, delete } => {
            let before = machine.parameters.eeprom.cell(Cell::Cogging);
            let after = if delete { before & !axes.bits() } else { before | axes.bits() };
            machine.parameters.eeprom.set_cell(Cell::Cogging, after);
            return Some(ConfirmData::U8(255));
        }
        _ => {}
    }
    None
}
