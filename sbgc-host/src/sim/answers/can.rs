//! Devices on the CAN bus: a motor driver and an inertial sensor.

use std::time::Duration;

use sbgc_proto::commands::{
    CanDevice, CanDeviceId, CanDeviceScan, CanDeviceType, CanDeviceTypeByte, CanDrvTelemetry,
    CanDrvTelemetryFlags as Flags, CanModule, CanModuleId, ModuleFlashWrite, ModuleList,
};
use sbgc_proto::units::ModuleVersion;
use sbgc_proto::wire::{Bytes, List};
use sbgc_proto::{CommandId, OutgoingCommand};

use super::realtime::timestamp;
use crate::sim::imu::short;
use crate::sim::machine::{Call, Machine};
use crate::sim::power::Power;
use crate::sim::reply::{Refusal, Replies, done, message, silence};

pub(super) fn answer(machine: &mut Machine, _: &Call<'_>, command: &OutgoingCommand<'_>) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::CanDeviceScanRequest(_) | OutgoingCommand::UdrvDeviceScan(_) => scan(),
        OutgoingCommand::ModuleListRequest(_) => modules(),
        OutgoingCommand::ModuleFlashStart(request) => {
            flash(machine, CommandId::ModuleFlashStart, request.device_id, Step::Start)
        }
        OutgoingCommand::ModuleFlashWrite(write) => flash_write(machine, write),
        OutgoingCommand::ModuleFlashFinish(request) => {
            flash(machine, CommandId::ModuleFlashFinish, request.device_id, Step::Finish)
        }
        // What is sent on to a port of a device gets no answer from the board itself.
        OutgoingCommand::TransparentSapiRequest(_) => silence(),
        _ => return None,
    })
}

fn scan() -> Replies {
    let kind = |kind| CanDeviceTypeByte::default().with_kind(kind);
    let devices = [
        CanDevice {
            uid: Bytes(*b"SIM CAN DRV1"),
            id: CanDeviceId::Drv1,
            device_type: kind(CanDeviceType::MotorDriver),
        },
        CanDevice {
            uid: Bytes(*b"SIM CAN IMU1"),
            id: CanDeviceId::ImuMain,
            device_type: kind(CanDeviceType::Imu),
        },
    ];
    let mut list = List::new();
    for device in devices {
        list.push(device).map_err(|_| Refusal::Failed)?;
    }
    message(&CanDeviceScan { devices: list })
}

fn modules() -> Replies {
    let module = |id| CanModule {
        id,
        board_ver: ModuleVersion(100),
        bootloader_ver: ModuleVersion(101),
        firmware_ver: ModuleVersion(120),
        ..CanModule::default()
    };
    let mut devices = List::new();
    for id in [CanModuleId::ImuMain, CanModuleId::Drv1] {
        devices.push(module(id)).map_err(|_| Refusal::Failed)?;
    }
    message(&ModuleList { devices })
}

#[derive(Clone, Copy)]
enum Step {
    Start,
    Finish,
}

fn is_there(device: CanModuleId) -> bool {
    matches!(device, CanModuleId::ImuMain | CanModuleId::Drv1)
}

fn flash(machine: &mut Machine, command: CommandId, device: CanModuleId, step: Step) -> Replies {
    if !is_there(device) {
        return Err(Refusal::Parameters);
    }
    match step {
        Step::Start => machine.flashing = Some(device.raw()),
        Step::Finish if machine.flashing == Some(device.raw()) => machine.flashing = None,
        Step::Finish => return Err(Refusal::State),
    }
    done(command)
}

fn flash_write(machine: &Machine, write: &ModuleFlashWrite<'_>) -> Replies {
    if machine.flashing != Some(write.device_id.raw()) {
        return Err(Refusal::State);
    }
    if crc32(write.data) != write.data_crc32 {
        return Err(Refusal::Failed);
    }
    done(CommandId::ModuleFlashWrite)
}

/// The usual sum of 32 bits.
pub(in crate::sim) fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| (sum >> 1) ^ ((sum & 1) * 0xEDB8_8320))
    })
}

/// The telemetry of a motor driver; there is one for each axis, counted from 0.
pub(super) fn telemetry(
    machine: &Machine,
    now: Duration,
    flags: Flags,
    driver: u8,
) -> Option<CanDrvTelemetry> {
    let index = usize::from(driver);
    let axis = machine.motion.axes().into_array().get(index).copied()?;
    let current = Power::motor_current(&machine.motion, index) * 1000.0;
    let has = |flag| flags.contains(flag);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is a few amperes")]
    let milliamperes = current.round() as u16;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is some volts")]
    let millivolts = (machine.power.voltage(now, &machine.motion) * 1000.0) as u16;
    Some(CanDrvTelemetry {
        drv_id: driver,
        timestamp_ms: timestamp(now),
        can_bus_flags: has(Flags::CAN_BUS_FLAGS).then_some(0),
        can_bus_err_cnt: has(Flags::CAN_BUS_ERR_CNT).then_some(0),
        temp_board: has(Flags::TEMP_BOARD).then(|| Power::temperatures(now).1),
        temp_motor: has(Flags::TEMP_MOTOR).then(|| Power::motor_temperature(&machine.motion, index)),
        avg_current: has(Flags::AVG_CURRENT).then_some(milliamperes),
        bus_voltage: has(Flags::BUS_VOLTAGE).then_some(millivolts),
        pin_state: has(Flags::PIN_STATE).then(Default::default),
        phase_current: has(Flags::PHASE_CURRENT)
            .then(|| [short(current), short(-current / 2.0), short(-current / 2.0)]),
        encoder_error_cnt: has(Flags::ENCODER_ERROR_CNT).then_some(0),
        iq_current: has(Flags::IQ_ID_CURRENT).then(|| short(current)),
        id_current: has(Flags::IQ_ID_CURRENT).then_some(0),
        motor_speed: has(Flags::MOTOR_SPEED).then(|| short(axis.speed / 6.0)),
        pid_pos_err: has(Flags::PID_POS_ERR).then(|| short((axis.setpoint - axis.angle) * 100.0)),
        pid_speed_err: has(Flags::PID_SPEED_ERR).then(|| short(axis.setpoint_speed - axis.speed)),
        iq_ref: has(Flags::IQ_REF).then(|| short(current)),
        pid_current_err: has(Flags::PID_CURRENT_ERR).then_some(0),
    })
}
