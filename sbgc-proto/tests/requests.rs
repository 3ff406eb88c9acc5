//! What answers a request, by the facts of the protocol: which id, and what of the request the answer repeats.

use sbgc_proto::commands::{
    AdjustableVariable, CalibInfoRequest, CanDrvTelemetryFlags, EepromReadRequest, ErrorReport, EventId,
    EventTypes, ExtMotors, ExtMotorsStateDataSet, ExtMotorsStateRequest, GetAdjVarsVal, ImuIndex, ImuType,
    MotorsOn, RealtimeDataCustomFlags, RealtimeDataCustomRequest, StreamSource,
};
use sbgc_proto::{CommandId, Expected, Message, RequestInfo};

fn expected(command: CommandId, payload: &[u8]) -> Expected {
    Expected::of_payload(command, payload).expect("a request")
}

/// Takes `right` for the answer and `wrong` not.
#[track_caller]
fn check(command: CommandId, request: &[u8], answer: CommandId, right: &[&[u8]], wrong: &[&[u8]]) {
    let expected = expected(command, request);
    assert_eq!(expected.answer(), answer);
    for payload in right {
        assert!(expected.matches(answer, payload), "{payload:?}");
        assert!(!expected.matches(CommandId::Unknown(0), payload));
    }
    for payload in wrong {
        assert!(!expected.matches(answer, payload), "{payload:?}");
    }
}

#[test]
fn confirmations_name_the_command() {
    let on = Expected::of(&MotorsOn);
    assert!(on.matches(CommandId::CONFIRM, &[77]) && on.matches(CommandId::CONFIRM, &[77, 1, 2]));
    assert!(!on.matches(CommandId::CONFIRM, &[109, 0]) && !on.matches(CommandId::MotorsOn, &[77]));
    assert_eq!(on, Expected::confirmation(CommandId::MotorsOn));
    assert!(on.overlaps(&on) && !on.overlaps(&Expected::confirmation(CommandId::MotorsOff)));
    assert!(on.overlaps(&Expected::any(CommandId::CONFIRM)));
}

/// The width of the address is not known; what is there counts.
#[test]
fn a_written_block_is_confirmed_with_its_address() {
    let request = [0x40, 0x01, 0, 0, 1, 2, 3];
    let right: [&[u8]; 5] =
        [&[47], &[47, 0x40], &[47, 0x40, 0x01], &[47, 0x40, 0x01, 0], &[47, 0x40, 0x01, 0, 0]];
    check(CommandId::EepromWrite, &request, CommandId::CONFIRM, &right, &[&[47, 0x80], &[47, 0x40, 2]]);
    let other = expected(CommandId::EepromWrite, &[0x80, 0x01, 0, 0, 1]);
    assert!(expected(CommandId::EepromWrite, &request).overlaps(&other), "one without address answers both");
}

#[test]
fn parameters_name_their_profile_unless_it_is_the_current_one() {
    for command in [
        CommandId::ReadParams3,
        CommandId::ReadParamsExt,
        CommandId::ReadParamsExt2,
        CommandId::ReadParamsExt3,
    ] {
        check(command, &[4], command, &[&[4, 9], &[]], &[&[0, 9], &[3, 4]]);
        for current in [5, 253, 254, 255] {
            check(command, &[current], command, &[&[0, 9], &[4, 9]], &[]);
            assert!(expected(command, &[current]).overlaps(&expected(command, &[1])));
        }
        assert!(!expected(command, &[0]).overlaps(&expected(command, &[1])));
        assert!(expected(command, &[1]).overlaps(&expected(command, &[1])));
    }
}

#[test]
fn blocks_and_parts_of_files_name_their_place() {
    let eeprom = [0x40, 1, 0, 0, 64, 0];
    let id = CommandId::EepromRead;
    check(id, &eeprom, id, &[&[0x40, 1, 0, 0, 5, 5]], &[&[0x80, 1, 0, 0, 5], &[0x40, 1, 0, 1, 5]]);
    let request = EepromReadRequest { addr: 0x140, size: 64 };
    assert_eq!(Expected::of(&request), expected(id, &eeprom));

    let mut file = [0; 20];
    (file[0], file[2]) = (1, 3);
    let id = CommandId::ReadFile;
    check(id, &file, id, &[&[0, 1, 3, 0, 7], &[2]], &[&[3, 0, 4, 0, 7], &[0, 1, 3, 1]]);
    let first = expected(id, &[0; 20]);
    assert!(!first.overlaps(&expected(id, &file)));
}

#[test]
fn variables_are_told_apart_by_all_their_ids() {
    for (command, answer) in [
        (CommandId::GetAdjVarsVal, CommandId::SetAdjVarsVal),
        (CommandId::GetAdjVarsValF, CommandId::SetAdjVarsValF),
    ] {
        let right: &[u8] = &[2, 7, 0, 0, 0, 0, 9, 1, 1, 1, 1];
        let wrong: [&[u8]; 3] = [
            &[2, 7, 0, 0, 0, 0, 8, 1, 1, 1, 1],
            &[1, 7, 0, 0, 0, 0],
            &[3, 7, 0, 0, 0, 0, 9, 1, 1, 1, 1, 10, 0, 0, 0, 0],
        ];
        check(command, &[2, 7, 9], answer, &[right], &wrong);
        assert!(!expected(command, &[2, 7, 9]).overlaps(&expected(command, &[2, 7, 10])));
        assert!(!expected(command, &[1, 7]).overlaps(&expected(command, &[2, 7, 9])));
    }
    let all: Vec<u8> = std::iter::once(40).chain(100..140).collect();
    let request = GetAdjVarsVal { param_id: (100..140).map(AdjustableVariable::from_raw).collect() };
    let expected = Expected::of(&request);
    assert_eq!(expected, Expected::of_payload(CommandId::GetAdjVarsVal, &all).unwrap());
    let mut answer = vec![40];
    (100..140).for_each(|id| answer.extend([id, 1, 2, 3, 4]));
    assert!(expected.matches(CommandId::SetAdjVarsVal, &answer));
    answer[1 + 39 * 5] = 7;
    assert!(!expected.matches(CommandId::SetAdjVarsVal, &answer), "the last of forty");
}

#[test]
fn lists_of_variables_go_on_from_where_they_were_asked_for() {
    let id = CommandId::AdjVarsInfo;
    let page = |first| [60, first, 1, b'A', 0, 0, 0, 0, 0, 0, 0, 0];
    check(id, &[25], id, &[&page(25), &page(30), &[60]], &[&page(0), &page(24)]);
    check(id, &[], id, &[&page(0), &page(25)], &[]);
}

#[test]
fn debug_variables_repeat_their_masks() {
    let id = CommandId::DebugVars3;
    check(id, &[5, 0, 0, 0], id, &[&[5, 0, 0, 0, 1, 2]], &[&[4, 0, 0, 0, 1]]);
    let eight: Vec<u8> = (1..=32).collect();
    let mut other = eight.clone();
    other[31] = 0;
    check(id, &eight, id, &[&eight], &[&other]);
    assert!(!expected(id, &eight).overlaps(&expected(id, &other)));
    check(id, &[], id, &[&[], &[1, 2]], &[]);
    assert!(expected(id, &[]).overlaps(&expected(id, &eight)), "values look like anything");
}

#[test]
fn each_auxiliary_motor_answers_for_itself() {
    let request = ExtMotorsStateRequest {
        for_motors: ExtMotors::MOTOR1 | ExtMotors::MOTOR3,
        data_set: ExtMotorsStateDataSet::TORQUE,
    };
    let motors = Expected::of(&request);
    let answers = |motor, set| motors.matches(CommandId::ExtMotorsState, &[motor, set, 0, 0, 0, 1, 1]);
    assert!(answers(0, 2) && answers(2, 2));
    assert!(!answers(1, 2) && !answers(0, 6) && !answers(200, 2));
    let second = Expected::of(&ExtMotorsStateRequest { for_motors: ExtMotors::MOTOR2, ..request });
    let third = Expected::of(&ExtMotorsStateRequest { for_motors: ExtMotors::MOTOR3, ..request });
    assert!(!motors.overlaps(&second) && motors.overlaps(&third));
}

#[test]
fn others_repeat_what_chose_their_fields() {
    let id = CommandId::ControlQuatStatus;
    check(id, &[1, 0, 0, 0], id, &[&[1, 0, 0, 0, 2]], &[&[3, 0, 0, 0, 2]]);
    let frame = Expected::of(&CalibInfoRequest { imu_type: ImuType::Frame, ..Default::default() });
    assert!(frame.matches(CommandId::CalibInfo, &[50, 2]) && !frame.matches(CommandId::CalibInfo, &[50, 1]));
    // Flags come back only with their highest bit, after the time stamp.
    for id in [CommandId::RealtimeDataCustom, CommandId::RealtimeDataCustom2] {
        let with = [1, 0, 0, 0x80, 0, 0, 0, 0, 0, 0];
        check(id, &with, id, &[&[9, 9, 1, 0, 0, 0x80, 7]], &[&[9, 9, 2, 0, 0, 0x80, 7]]);
        check(id, &[1, 0, 0, 0, 0, 0, 0, 0, 0, 0], id, &[&[9, 9, 1, 0, 0, 0x80], &[9, 9, 7]], &[]);
    }
}

#[test]
fn what_repeats_nothing_needs_the_id_only() {
    check(CommandId::RealtimeData, &[], CommandId::RealtimeData3, &[&[1, 2, 3], &[]], &[]);
    check(CommandId::I2cReadRegBuf, &[0xA0, 1, 4], CommandId::I2cReadRegBuf, &[&[1, 2, 3, 4]], &[]);
    for command in [CommandId::Reset, CommandId::CanDrvState, CommandId::Unknown(7)] {
        assert_eq!(Expected::of_payload(command, &[]), None);
    }
}

#[test]
fn what_a_request_does_is_declared() {
    let info = |command, payload: &[u8]| RequestInfo::of_payload(command, payload).expect("a command");
    let acts = |command, payload: &[u8]| info(command, payload).acts;
    // Reads may be sent again by themselves.
    assert!(!acts(CommandId::ReadParams3, &[0]) && !acts(CommandId::BoardInfo, &[]));
    // The longer form sets up the port.
    assert!(acts(CommandId::BoardInfo, &[0, 0]));
    for command in [
        CommandId::Reset,
        CommandId::BootMode3,
        CommandId::CanDeviceScan,
        CommandId::UdrvDeviceScan,
        CommandId::MotorsOn,
        CommandId::FsClearAll,
    ] {
        assert!(acts(command, &[]), "{command}");
    }
    assert!(acts(CommandId::ExtImuCmd, &[2]) && acts(CommandId::ExtSensCmd, &[0, 2]));
    assert!(info(CommandId::FsClearAll, &[]).slow && !info(CommandId::MotorsOn, &[]).slow);
    assert!(RequestInfo::of_payload(CommandId::Unknown(7), &[]).is_none());
    assert_eq!(<sbgc_proto::commands::Confirm as Message>::REQUEST.answer, None);
}

#[test]
fn errors_name_their_command_in_the_newer_form_only() {
    for (payload, command, code, data) in [
        (&[6][..], None, 6, &[][..]),
        (&[6, 1, 2, 3, 4], None, 6, &[1, 2, 3, 4]),
        (&[22, 6], Some(CommandId::WriteParams3), 6, &[]),
        (&[22, 6, 1, 2, 3, 4], Some(CommandId::WriteParams3), 6, &[1, 2, 3, 4]),
    ] {
        let report = ErrorReport::from_payload(payload).unwrap();
        assert_eq!((report.command, report.code, report.data.as_bytes()), (command, code, data));
    }
    assert!(ErrorReport::from_payload(&[]).is_err());
}

#[test]
fn selected_fields_determine_the_length_of_the_answer() {
    use RealtimeDataCustomFlags as Flags;

    let of = |flags| Expected::of(&RealtimeDataCustomRequest { flags, ..Default::default() });
    let answer = CommandId::RealtimeDataCustom;
    let (angles, targets) = (of(Flags::IMU_ANGLES), of(Flags::TARGET_ANGLES));
    assert_eq!((angles.answer_len(), targets.answer_len()), (Some(8), Some(8)));
    assert!(angles.fits(answer, &[0; 8]) && !angles.fits(answer, &[0; 7]) && angles.matches(answer, &[0; 7]));
    assert!(!angles.fits(CommandId::RealtimeData4, &[0; 8]));
    assert!(!angles.is_distinct_from(&targets));
    let both = of(Flags::IMU_ANGLES | Flags::TARGET_ANGLES);
    assert!(both.is_distinct_from(&angles) && both.overlaps(&angles));
    // The bytes of the same request.
    assert_eq!(Expected::of_payload(answer, &[3, 0, 0, 0, 0, 0, 0, 0, 0, 0]), Some(both));
    assert_eq!(Expected::of_stream(StreamSource::RealtimeDataCustom(Flags::IMU_ANGLES)), angles);
}

/// Firmware leaves out what it does not know, but flags that are repeated tell what is there.
#[test]
fn repeated_flags_tell_more_than_a_length() {
    use RealtimeDataCustomFlags as Flags;

    let of = |flags| Expected::of_stream(StreamSource::RealtimeDataCustom(flags | Flags::INCLUDE_FLAGS));
    let (angles, targets) = (of(Flags::IMU_ANGLES), of(Flags::TARGET_ANGLES));
    assert!(angles.is_distinct_from(&targets));
    let sample = [9, 9, 1, 0, 0, 0x80, 0, 0, 0, 0];
    let answer = CommandId::RealtimeDataCustom;
    assert_eq!(angles.answer_len(), Some(12));
    assert!(angles.fits(answer, &sample) && !targets.fits(answer, &sample));
}

#[test]
fn streams_have_the_samples_they_were_registered_for() {
    let event = |event_id, event_type| Expected::of_stream(StreamSource::Event { event_id, event_type });
    let (buttons, motors) =
        (event(EventId::MenuButton, EventTypes::all()), event(EventId::MotorState, EventTypes::ON));
    assert!(buttons.is_distinct_from(&motors));
    assert!(buttons.fits(CommandId::Event, &[1, 4, 0, 0]) && !buttons.fits(CommandId::Event, &[2, 1, 0, 0]));
    assert!(motors.fits(CommandId::Event, &[2, 2, 0, 0]) && !motors.fits(CommandId::Event, &[2, 1, 0, 0]));

    let (main, frame) = (StreamSource::AhrsHelper(ImuIndex::Main), StreamSource::AhrsHelper(ImuIndex::Frame));
    assert!(
        !Expected::of_stream(main).is_distinct_from(&Expected::of_stream(frame)),
        "nothing tells them apart"
    );
    let telemetry = StreamSource::CanDrvTelemetry { flags: CanDrvTelemetryFlags::TEMP_MOTOR, drv_id: 1 };
    assert_eq!(Expected::of_stream(telemetry).answer_len(), Some(4));

    // Which requests have the same answers as a stream.
    assert_eq!(StreamSource::of_request(CommandId::AhrsHelper, &[2]), Some(frame));
    assert_eq!(StreamSource::of_request(CommandId::AhrsHelper, &[0, 0]), Some(main));
    assert_eq!(StreamSource::of_request(CommandId::BoardInfo, &[]), None);
    let custom = StreamSource::RealtimeDataCustom(RealtimeDataCustomFlags::IMU_ANGLES);
    let request = [1, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    assert_eq!(StreamSource::of_request(CommandId::RealtimeDataCustom, &request), Some(custom));
}
