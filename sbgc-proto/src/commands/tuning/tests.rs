//! Golden bytes, all made by hand from the layouts.

use super::*;
use crate::commands::{AutoPidFlags, Axis, ProfileId};
use crate::units::{GainMargin, TestAngle, TestFrequencyFrom, TestFrequencyTo};
use crate::wire::{Float, ToWire};
use crate::{DecodeError, Message};

/// `message` is `payload`.
fn is<M: Message + ToWire>(message: &M, payload: &[u8]) {
    assert_eq!(message.encode(&mut [0; 255]), Ok(payload));
    assert!(M::accepts(payload.len()) && M::SIZE.contains(&payload.len()));
}

#[test]
fn first_version_starts_and_stops() {
    let mut payload = [0; 19];
    is(&AutoPidRequest::default(), &payload);
    payload[..5].copy_from_slice(&[4, 0xAC, 200, 1, 7]);
    payload[18] = 9;
    let message = AutoPidRequest::decode(&payload).unwrap();
    assert_eq!(message.profile_id, ProfileId::Profile5);
    let known = AutoPidFlags::YAW | AutoPidFlags::SEND_GUI | AutoPidFlags::TUNE_LPF_FREQ;
    assert_eq!(message.cfg_flags, known | AutoPidFlags::from_bits_retain(0x80));
    assert_eq!((message.gain_vs_stability, message.momentum), (200, 1));
    assert_eq!(message.action, AutoPidAction::Unknown(7));
    is(&message, &payload);
}

#[test]
fn first_version_tells_its_progress() {
    let mut payload = [0; 57];
    payload[..17].copy_from_slice(&[1, 2, 3, 4, 5, 6, 7, 8, 9, 0x2C, 0x01, 80, 0, 0, 1, 0x10, 0x27]);
    payload[17..21].copy_from_slice(&1.5_f32.to_le_bytes());
    payload[27..31].copy_from_slice(&[1, 0, 0xC0, 0xFF]);
    payload[37..41].copy_from_slice(&(-2.0_f32).to_le_bytes());
    payload[46] = 5;
    payload[56] = 6;
    let message = AutoPid::decode(&payload).unwrap();
    assert_eq!(message.p.into_array(), [1, 2, 3]);
    assert_eq!(message.i.into_array(), [4, 5, 6]);
    assert_eq!(message.d.into_array(), [7, 8, 9]);
    assert_eq!(message.lpf_freq.into_array(), [300, 80, 256]);
    assert_eq!(message.iteration_cnt, 10000);
    let errors = message.axes.map(|axis| axis.tracking_error);
    assert_eq!((errors.roll, errors.yaw), (Float::from(1.5), Float::from(-2.0)));
    assert_eq!(errors.pitch, Float::from_bits(0xFFC0_0001), "NaN keeps its bits");
    is(&message, &payload);
    assert_eq!(
        AutoPid::decode(&payload[..56]),
        Err(DecodeError::TooShort { command: "CMD_AUTO_PID", needed: 57, got: 56 })
    );
}

/// Both layouts put something else behind almost every byte.
fn second_version() -> [u8; 73] {
    let mut payload: [u8; 73] = core::array::from_fn(|index| u8::try_from(index).unwrap());
    payload[0] = 2;
    payload[1..3].copy_from_slice(&[1, 0]);
    payload[11] = 1;
    payload
}

#[test]
fn second_version_takes_a_configuration() {
    let payload = second_version();
    let message = AutoPid2Request::decode(&payload).unwrap();
    assert_eq!((message.action, message.cfg_version), (AutoPid2Action::StartSave, 1));
    assert_eq!(message.cmd_flags, AutoPid2CmdFlags::SEND_PARAMS_ON_FINISH);
    assert_eq!(
        message.axes.pitch,
        AutoPid2Axis {
            axis_flags: AutoPid2AxisFlags(25),
            gain: 26,
            stimulus_gain: 0x1C1B,
            effective_freq: 29,
            problem_freq: 30,
            problem_margin: GainMargin(31),
            reserved: [32, 33, 34, 35, 36, 37].into(),
        }
    );
    assert_eq!(message.general_flags.bits(), 0x3433);
    assert_eq!((message.test_freq_from, message.test_freq_to), (TestFrequencyFrom(54), TestFrequencyTo(55)));
    assert_eq!(message.multi_pos_flags, AutoPid2Positions::POS4 | AutoPid2Positions::from_bits_retain(0x30));
    assert_eq!(message.multi_pos_angle, [57, 58, 59, 60].map(TestAngle));
    is(&message, &payload);
    assert!(AutoPid2SimpleRequest::accepts(11) && !AutoPid2SimpleRequest::accepts(73));
    let stop = AutoPid2SimpleRequest { action: AutoPid2Action::Stop, ..AutoPid2SimpleRequest::default() };
    is(&stop, &[5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
}

#[test]
fn second_version_had_another_layout() {
    let payload = second_version();
    let message = AutoPid2LegacyRequest::decode(&payload).unwrap();
    assert_eq!((message.action, message.cfg_version), (AutoPid2Action::StartSave, 1));
    assert_eq!(
        message.axes.yaw,
        AutoPid2LegacyAxis {
            axis_flags: AutoPid2AxisFlags(36),
            gain: 37,
            stimulus: 38,
            effective_freq: 39,
            problem_freq: 40,
            problem_margin: GainMargin(41),
            reserved: [42, 43, 44, 45, 46, 47].into(),
        }
    );
    assert_eq!(message.general_flags.bits(), 0x3130);
    assert_eq!(message.startup_cfg, AutoPid2StartupCfg::Unknown(50));
    is(&message, &payload);
}

#[test]
fn axis_flags_hold_a_number() {
    let flags = AutoPid2AxisFlags::default().with_enabled(true).with_notch_num(2);
    assert_eq!(flags, AutoPid2AxisFlags(0b1001));
    assert!(!flags.tune_lpf());
    assert_eq!(flags.with_notch_num(9).notch_num(), 3);
}

#[test]
fn bode_tests_start_and_end() {
    let mut payload = [0; 30];
    payload[..14].copy_from_slice(&[2, 3, 0xE8, 0x03, 120, 0, 198, 0x88, 0x13, 0, 0, 0, 3, 0]);
    payload[29] = 1;
    let message = BodeTestStartStopRequest::decode(&payload).unwrap();
    assert_eq!((message.axis, message.system), (Axis::Yaw, BodeTestSystem::PlantClosedLoop));
    assert_eq!(message.stimulus_type, BodeStimulusType::ExponentialSineSweep);
    assert_eq!((message.stimulus_gain, message.samples_num), (1000, 5000));
    assert_eq!((message.start_freq, message.end_freq), (3, 120));
    is(&message, &payload);

    let mut payload = [0; 22];
    payload[..7].copy_from_slice(&[0x87, 0x13, 0, 0, 0x02, 0x01, 1]);
    let message = BodeTestStartStop::decode(&payload).unwrap();
    assert_eq!((message.samples_count, message.error_code, message.mode), (4999, 258, 1));
    is(&message, &payload);
}

#[test]
fn bode_samples_have_their_scale() {
    let mut payload = [0; 97];
    payload[0] = 250;
    for (place, value) in [(1, -1.0_f32), (5, 0.0), (9, 1.0), (13, 65534.0)] {
        payload[place..place + 4].copy_from_slice(&value.to_le_bytes());
    }
    payload[17..25].copy_from_slice(&[0xFE, 0xFF, 0, 0, 0xFF, 0x7F, 0x34, 0x12]);
    let message = BodeTestData::decode(&payload[..25]).unwrap();
    assert_eq!(message.sample_counter, 250);
    let values: Vec<_> = message.values().collect();
    for ((input, output), expected) in values.iter().zip([(1.0, 0.0), (0.0, 4660.0)]) {
        assert!((input - expected.0).abs() < 1e-6 && (output - expected.1).abs() < 1e-2);
    }
    is(&message, &payload[..25]);
    is(&BodeTestData::decode(&payload[..17]).unwrap(), &payload[..17]);
    is(&BodeTestData::decode(&payload).unwrap(), &payload);
    assert!(BodeTestData::decode(&payload[..16]).is_err());
}

#[test]
fn unpublished_payloads_stay_bytes() {
    is(&AutoPid2::decode(&[1, 2]).unwrap(), &[1, 2]);
}
