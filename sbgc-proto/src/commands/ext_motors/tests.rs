//! Payloads of auxiliary motors byte by byte.

use super::*;
use crate::wire::ToWire;
use crate::{EncodeError, Message};

fn bytes<M: Message + ToWire>(message: &M) -> Vec<u8> {
    message.encode(&mut [0; 255]).unwrap().to_vec()
}

/// Made by hand from the layout.
#[test]
fn actions_keep_their_arguments() {
    let payload = [0x81, 6, 1, 2];
    let action = ExtMotorsAction::decode(&payload).unwrap();
    assert_eq!(action.for_motors, ExtMotors::MOTOR1 | ExtMotors::CONFIRM);
    assert_eq!((action.action, action.args), (ExtMotorAction::SearchHome, &[1, 2][..]));
    assert_eq!(bytes(&action), payload);
}

/// Made by hand from the layout: every width of both numbers.
#[test]
fn each_chosen_motor_has_a_setpoint() {
    let payload = [0xC1, 0, 1, 2, 0xFE, 0xFF];
    let control = ExtMotorsControl::decode(&payload).unwrap();
    assert_eq!(control.motors.len(), 2);
    assert_eq!(control.motors[1].setpoint, Some(-2));
    assert_eq!(bytes(&control), payload);

    for (set, size) in [(0, 2), (1, 4), (2, 4), (3, 6), (4, 6), (5, 8), (6, 4), (7, 6), (0xF8, 2)] {
        let payload = [&[0xFF, set][..], &[7; 56][..7 * size]].concat();
        let (control, rest) = ExtMotorsControl::decode_prefix(&payload).unwrap();
        assert!(rest.is_empty());
        assert_eq!(control.motors.len(), 7);
        assert_eq!(bytes(&control), payload);
        assert!(ExtMotorsControl::decode(&payload[..payload.len() - 1]).is_err());
    }

    let none = ExtMotorsControl { for_motors: ExtMotors::MOTOR3, ..ExtMotorsControl::default() };
    let error = EncodeError::Count { field: "MOTORS", expected: 1, got: 0 };
    assert_eq!(none.encode(&mut [0; 9]), Err(error));
    assert_eq!(bytes(&ExtMotorsControl::default()), [0, 0]);
}

/// Made by hand from the layout.
#[test]
fn config_has_what_its_set_says() {
    let payload = [2, 0x0D, 0x80, 9, 5, 0, 100, 0];
    let config = ExtMotorsControlConfig::decode(&payload).unwrap();
    assert_eq!(config.mode, Some(ExtMotorControlMode::Unknown(9)));
    assert_eq!(config.max_speed, None);
    assert_eq!(config.max_acceleration, Some(MotorAccelerationLimit::from_degrees_per_second2(10.0)));
    assert_eq!(config.jerk_slope, Some(100));
    assert_eq!(bytes(&config), payload);
}

/// Made by hand from the layout.
#[test]
fn state_has_what_its_set_says() {
    let payload = [6, 0x21, 8, 8, 0x80, 2, 0x40, 0x42, 0x0F, 0, 7, 0xFF, 0xEC];
    let state = ExtMotorsState::decode(&payload).unwrap();
    assert_eq!(state.control_mode, Some(ExtMotorControlMode::Torque));
    assert!((state.speed32.unwrap().radians_per_second() - 1.0).abs() < 1e-9);
    let flags = state.state_flags.unwrap();
    assert_eq!((flags.power(), flags.index_pin(), flags.0), (ExtMotorPower::OffSafeStop, true, 0xFF07));
    assert_eq!(state.driver_temperature, Some(-20));
    assert_eq!(bytes(&state), payload);

    let all = [&[0, 0xFF, 0xFF, 0x0F, 0][..], &[0xA5; 45]].concat();
    let (state, rest) = ExtMotorsState::decode_prefix(&all).unwrap();
    assert!(rest.is_empty());
    assert_eq!(bytes(&state), all);
    assert!(ExtMotorsState::decode(&all[..49]).is_err());
    assert_eq!(bytes(&ExtMotorsStateRequest::decode(&all).unwrap()), [0, 0xFF, 0xFF, 0x0F, 0]);
}
