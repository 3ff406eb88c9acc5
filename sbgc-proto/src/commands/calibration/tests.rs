//! Golden bytes, all made by hand from the layouts.

use super::*;
use crate::commands::{ImuType, Switch};
use crate::units::{Acceleration, Angle, CalibrationTime, CorrectionPeriod, SensorRate, Voltage};
use crate::wire::{PerAxis, PerXyz, ToWire};
use crate::{CommandId, DecodeError, Message};

/// `message` is `payload`, which must have all of its declared size.
fn is<M: Message + ToWire>(message: &M, payload: &[u8]) {
    assert_eq!(message.encode(&mut [0; 255]), Ok(payload));
    assert!(M::accepts(payload.len()) && M::SIZE.contains(&payload.len()));
}

#[test]
fn sensors_are_calibrated_alike() {
    let payload = [2, 7, 0xE8, 0x03, 1, 2, 3, 4, 5, 6, 7, 8];
    let inner = ImuCalibration {
        imu_idx: CalibImu::Frame,
        action: CalibAction::CopyMainEepromToSensor,
        time_ms: CalibrationTime::from_milliseconds(1000.0),
        reserved: [1, 2, 3, 4, 5, 6, 7, 8].into(),
    };
    assert_eq!(CalibAcc::decode(&payload), Ok(CalibAcc(inner.clone())));
    is(&CalibAcc(inner.clone()), &payload);
    is(&CalibGyro(inner.clone()), &payload);
    is(&CalibMag(inner), &payload);
    assert_eq!(
        [CalibAcc::ID, CalibGyro::ID, CalibMag::ID].map(CommandId::raw),
        [65, 103, 59],
        "each has its own command"
    );
    let unknown = [9, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    let message = CalibGyro::decode(&unknown).unwrap();
    assert_eq!(message.0.action, CalibAction::Unknown(0));
    is(&message, &unknown);
}

#[test]
fn lengths_tell_the_forms_apart() {
    for simple in [CalibAccSimple::accepts, CalibGyroSimple::accepts, CalibMagSimple::accepts] {
        assert!(simple(0) && !simple(1) && !simple(12));
    }
    is(&CalibAccSimple {}, &[]);
    assert_eq!(
        CalibAcc::decode(&[1, 1]),
        Err(DecodeError::TooShort { command: "CMD_CALIB_ACC", needed: 12, got: 2 })
    );
    assert!(EncodersCalibFldOffset4Simple::accepts(0) && !EncodersCalibFldOffset4Simple::accepts(6));
    assert!(EncodersCalibFldOffset4::accepts(6) && !EncodersCalibFldOffset4::accepts(12));
    assert!(EncodersCalibFldOffset4Speed::accepts(12) && !EncodersCalibFldOffset4Speed::accepts(14));
    assert!(EncodersCalibFldOffset4Flags::accepts(14));
}

#[test]
fn progress_is_told() {
    is(&CalibInfoRequest { imu_type: ImuType::Frame, ..CalibInfoRequest::default() }, &{
        let mut payload = [0; 12];
        payload[0] = 2;
        payload
    });
    let payload = [
        0x2A, 0x02, 0x00, 0xFE, 0x2C, 0x01, 0xFF, 0x01, 0xD2, 0x04, 0x02, 0x25, 0xF9, 0x01, 0xEC, 0x37, 0x00,
        0x03, 0x02, 0x01, 0x00, 0x01, 0x02, 0xF6, 0x3C, 0x57, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    ];
    let info = CalibInfo::decode(&payload).unwrap();
    assert_eq!(
        info,
        CalibInfo {
            progress: 42,
            imu_type: ImuType::Frame,
            acc_data: PerXyz { x: Acceleration(-512), y: Acceleration(300), z: Acceleration(511) },
            gyro_abs_val: 1234,
            acc_cur_axis: AccAxis::Z,
            acc_limits_info: AccLimits::PLUS_X | AccLimits::PLUS_Y | AccLimits::MINUS_Z,
            imu_temp_cels: -7,
            temp_calib_gyro_enabled: Switch::On,
            temp_calib_gyro_t_min_cels: -20,
            temp_calib_gyro_t_max_cels: 55,
            temp_calib_acc_enabled: Switch::Off,
            temp_calib_acc_slot_num: [3, 2, 1, 0, 1, 2],
            temp_calib_acc_t_min_cels: -10,
            temp_calib_acc_t_max_cels: 60,
            h_err_length: 87,
            ..CalibInfo::default()
        }
    );
    is(&info, &payload);
    is(&CalibInfo::decode(&[0xFF; 33]).unwrap(), &[0xFF; 33]);
    assert!(CalibInfo::decode(&payload[..32]).is_err());
}

#[test]
fn small_calibrations_say_little() {
    is(&CalibBat { actual_voltage: Voltage::from_volts(16.8) }, &[0x90, 0x06]);
    is(&CalibExtGain {}, &[]);
    is(&CalibOffset {}, &[]);
    is(&CalibPoles {}, &[]);
    is(&CalibOrientCorr::default(), &[0; 16]);
    let acc_ref = PerXyz { x: Acceleration(0), y: Acceleration(-1), z: Acceleration::from_g(1.0) };
    let mut payload = [0; 20];
    payload[2..6].copy_from_slice(&[0xFF, 0xFF, 0x00, 0x02]);
    is(&CalibAccExtRef { acc_ref, ..CalibAccExtRef::default() }, &payload);
}

#[test]
fn cogging_has_fifteen_bytes_an_axis() {
    let mut payload = [0; 57];
    payload[..8].copy_from_slice(&[1, 0b101, 0x68, 0x01, 50, 7, 45, 0]);
    payload[17..23].copy_from_slice(&[20, 0, 0, 0, 0, 0]);
    payload[32..38].copy_from_slice(&[90, 0, 100, 255, 0, 1]);
    payload[46..48].copy_from_slice(&[0xAA, 3]);
    payload[56] = 0xBB;
    let message = CalibCogging::decode(&payload).unwrap();
    assert_eq!(message.action, CoggingAction::Calibrate);
    assert_eq!(message.axis_to_calibrate, CoggingAxes::ROLL | CoggingAxes::YAW);
    assert_eq!(
        message.axes.roll,
        CoggingAxis {
            angle: 360,
            smooth: 50,
            speed: 7,
            period: CorrectionPeriod(45),
            ..CoggingAxis::default()
        }
    );
    assert_eq!((message.axes.pitch.angle, message.axes.pitch.period), (20, CorrectionPeriod::AUTO));
    assert_eq!((message.axes.yaw.speed, message.axes.yaw.period), (255, CorrectionPeriod(256)));
    assert_eq!(message.iterations_num, 3);
    is(&message, &payload);
}

#[test]
fn encoders_take_more_with_each_firmware() {
    is(&EncodersCalibOffset4Simple {}, &[]);
    is(&EncodersCalibOffset4 { for_motor: ForMotor::All }, &[255]);
    let calib_angle = PerAxis { roll: Angle(1820), pitch: Angle(-16384), yaw: Angle(16384) };
    let payload = [0x1C, 0x07, 0x00, 0xC0, 0x00, 0x40, 100, 0, 0xFF, 0xFF, 0, 0, 0x03, 0x80];
    is(&EncodersCalibFldOffset4Simple {}, &[]);
    is(&EncodersCalibFldOffset4 { calib_angle }, &payload[..6]);
    let calib_speed = PerAxis { roll: SensorRate(100), pitch: SensorRate(-1), yaw: SensorRate(0) };
    is(&EncodersCalibFldOffset4Speed { calib_angle, calib_speed }, &payload[..12]);
    let message = EncodersCalibFldOffset4Flags::decode(&payload).unwrap();
    assert_eq!((message.calib_angle, message.calib_speed), (calib_angle, calib_speed));
    let both = EncoderCalibFlags::IGNORE_IMU_CHECK | EncoderCalibFlags::IGNORE_ENCODER_CHECK;
    assert_eq!(message.calib_flags, both | EncoderCalibFlags::from_bits_retain(0x8000));
    is(&message, &payload);
}
