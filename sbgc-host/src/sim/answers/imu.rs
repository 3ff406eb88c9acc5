//! The inertial sensors: which one is meant, and what corrects them.

use sbgc_proto::CommandId;
use sbgc_proto::OutgoingCommand;
use sbgc_proto::commands::{
    AhrsHelper, AhrsHelperMode, CalibImu, DevicePort, ExtImuCmd, ExtImuDebugInfo, ExtSensCmd,
    FrameImuPosition, GpsImuCmd, HelperData, ImuType,
};
use sbgc_proto::units::FrameHeading;
use sbgc_proto::wire::{Float, PerXyz};

use crate::sim::eeprom::Cell;
use crate::sim::imu::{float, vectors};
use crate::sim::machine::{Call, Machine};
use crate::sim::reply::{Refusal, Replies, done, message, silence};

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::SelectImu3(request) => select(machine, request.imu_type.raw()),
        OutgoingCommand::SelectImu3Extended(request) => match request.imu_type {
            CalibImu::Current => done(CommandId::SelectImu3),
            imu => select(machine, imu.raw()),
        },
        OutgoingCommand::AhrsHelperRequest(request) => {
            helper(machine, call, request.mode, request.z_vect, request.h_vect)
        }
        OutgoingCommand::AhrsHelperLegacyRequest(request) => {
            helper(machine, call, request.mode.into(), request.z_vect, request.h_vect)
        }
        OutgoingCommand::AhrsHelperShortRequest(request) => {
            let mode = AhrsHelperMode::from(request.mode);
            // To set an attitude the vectors have to be there.
            if mode.set() { Err(Refusal::Silent) } else { message(&attitude(machine, mode.frame_imu())) }
        }
        OutgoingCommand::HelperData(data) => helper_data(machine, data),
        OutgoingCommand::HelperDataLegacy(data) => {
            let (roll, pitch) = (data.frame_angle_roll.degrees(), data.frame_angle_pitch.degrees());
            let acc = data.frame_acc.map(|part| f64::from(part.g()));
            machine.imu.help_frame(acc, roll.into(), pitch.into(), &mut machine.motion);
            silence()
        }
        OutgoingCommand::GyroCorrection(_) => silence(),
        OutgoingCommand::ExtImuDebugInfoRequest(_) => debug_info(machine, call),
        OutgoingCommand::ExtImuCmdRequest(request) => match sensor(machine, request.cmd_id) {
            Some((cmd_id, data)) => message(&ExtImuCmd { cmd_id, data: &data }),
            None => silence(),
        },
        OutgoingCommand::ExtSensCmdRequest(request) => match sensor(machine, request.cmd_id) {
            Some((cmd_id, data)) => message(&ExtSensCmd { cmd_id, data: &data }),
            None => silence(),
        },
        _ => return None,
    })
}

/// Whether this IMU is connected.
pub(super) fn is_connected(machine: &Machine, imu: ImuType) -> bool {
    match imu {
        ImuType::Main => machine.imu.connected,
        ImuType::Frame => machine.settings().params.frame_imu_pos != FrameImuPosition::Disabled,
        _ => false,
    }
}

/// The one that is not connected is ignored.
fn select(machine: &mut Machine, imu: u8) -> Replies {
    if !is_connected(machine, imu.into()) {
        return silence();
    }
    machine.parameters.eeprom.set_cell(Cell::SelectedImu, imu);
    done(CommandId::SelectImu3)
}

/// The attitude of the camera or of the frame.
pub(super) fn attitude(machine: &Machine, frame: bool) -> AhrsHelper {
    let angles = if frame { machine.motion.frame() } else { machine.motion.axes().map(|axis| axis.angle) };
    let (down, north) = vectors(angles);
    AhrsHelper { z_vect: down.map(float), h_vect: north.map(float) }
}

fn helper(
    machine: &mut Machine,
    call: &Call<'_>,
    mode: AhrsHelperMode,
    z_vect: PerXyz<Float>,
    h_vect: PerXyz<Float>,
) -> Replies {
    if !mode.set() {
        return message(&attitude(machine, mode.frame_imu()));
    }
    let vector = |part: PerXyz<Float>| part.map(|part| f64::from(part.get()));
    let (down, north) = (vector(z_vect), vector(h_vect));
    let is_unit = |vector: &PerXyz<f64>| {
        let square: f64 = vector.into_array().into_iter().map(|part| part * part).sum();
        (0.8..1.2).contains(&square)
    };
    // What is no direction is of no use.
    if (mode.h_only() || is_unit(&down)) && (mode.z_only() || is_unit(&north)) {
        machine.imu.help(call.now, mode, down, north, &mut machine.motion);
    }
    silence()
}

fn helper_data(machine: &mut Machine, data: &HelperData) -> Replies {
    let (roll, pitch) = (data.frame_angle_roll.degrees(), data.frame_angle_pitch.degrees());
    let acc = data.frame_acc.map(|part| f64::from(part.g()));
    machine.imu.help_frame(acc, roll.into(), pitch.into(), &mut machine.motion);
    if data.flags.use_frame_heading() {
        let heading = (data.frame_heading != FrameHeading::STOP_REFERENCE)
            .then(|| f64::from(data.frame_heading.degrees()));
        machine.imu.help_heading(heading, &mut machine.motion);
    }
    silence()
}

fn debug_info(machine: &Machine, call: &Call<'_>) -> Replies {
    let one = Float::from(1.0);
    let zero = Float::from(0.0);
    message(&ExtImuDebugInfo {
        ahrs_debug_info: machine.imu.debug_info(call.now),
        dcm: [one, zero, zero, zero, one, zero, zero, zero, one],
        acc_body: [zero; 3].into(),
    })
}

/// What an external sensor answers, if the parameters say that there is one.
fn sensor(machine: &Machine, command: GpsImuCmd) -> Option<(GpsImuCmd, Vec<u8>)> {
    let connected = !matches!(machine.settings().ext3.ext_imu_port, DevicePort::Disabled);
    connected.then(|| match command {
        GpsImuCmd::GetDeviceInfo => (GpsImuCmd::DeviceInfo, vec![10, 1, 0, 0, 0, 0, 0, 0]),
        GpsImuCmd::GetData => (GpsImuCmd::Data, vec![0; 16]),
        other => (GpsImuCmd::Confirm, vec![other.raw()]),
    })
}
