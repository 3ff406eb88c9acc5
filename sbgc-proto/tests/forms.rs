//! The form of a command that is built unless another is asked for.

use std::collections::BTreeMap;

use sbgc_proto::{Direction, IncomingCommand, MessageInfo, OutgoingCommand};

/// Of every command with several forms the one to build: documented for present firmware, and harmless where fields
/// are left out. The others delete, start, set up or store something then, or are of old firmware.
const DEFAULTS: &[(Direction, &str, &str)] = {
    use Direction::{Incoming, Outgoing};
    &[
        (Outgoing, "CMD_SELECT_IMU_3", "simple"),
        (Outgoing, "CMD_ENCODERS_CALIB_OFFSET_4", "extended"),
        (Outgoing, "CMD_ENCODERS_CALIB_FLD_OFFSET_4", "simple"),
        (Outgoing, "CMD_SAVE_PARAMS_3", "simple"),
        (Outgoing, "CMD_API_VIRT_CH_CONTROL", "variable"),
        (Outgoing, "CMD_ADJ_VARS_STATE", "extended"),
        (Outgoing, "CMD_BOOT_MODE_3", "extended"),
        (Outgoing, "CMD_WRITE_FILE", "write"),
        (Outgoing, "CMD_AHRS_HELPER", "mode2u"),
        (Outgoing, "CMD_CALIB_MAG", "extended"),
        (Outgoing, "CMD_CALIB_ACC", "extended"),
        (Outgoing, "CMD_CONTROL", "extended"),
        (Outgoing, "CMD_EXECUTE_MENU", "simple"),
        (Outgoing, "CMD_HELPER_DATA", "extended"),
        (Outgoing, "CMD_BOARD_INFO", "simple"),
        (Outgoing, "CMD_CALIB_GYRO", "extended"),
        (Outgoing, "CMD_AUTO_PID2", "simple"),
        (Outgoing, "CMD_MOTORS_OFF", "extended"),
        (Outgoing, "CMD_RESET", "extended"),
        (Outgoing, "CMD_DEBUG_VARS_INFO_3", "extended"),
        (Outgoing, "CMD_DEBUG_VARS_3", "simple"),
        (Incoming, "CMD_READ_FILE", "success"),
        (Incoming, "CMD_AHRS_HELPER", "full"),
        (Incoming, "CMD_ERROR", "full"),
    ]
};

fn all() -> impl Iterator<Item = &'static MessageInfo> {
    OutgoingCommand::ALL.iter().chain(IncomingCommand::ALL)
}

#[test]
fn every_command_has_one_default_form() {
    let mut forms: BTreeMap<(u8, &str), Vec<&MessageInfo>> = BTreeMap::new();
    for info in all() {
        forms.entry((info.id.raw(), info.direction.as_str())).or_default().push(info);
    }
    let mut several = 0;
    for forms in forms.values() {
        let defaults: Vec<_> = forms.iter().filter(|info| info.is_default).collect();
        let [default] = defaults[..] else { panic!("{}: {} defaults", forms[0].spec, defaults.len()) };
        if forms.len() > 1 {
            several += 1;
            let expected = (default.direction, default.spec, default.form);
            assert!(DEFAULTS.contains(&expected), "{expected:?}");
        }
    }
    assert_eq!(several, DEFAULTS.len());
}

/// The form of what is built when no field is given; `None` where it cannot be sent without some.
fn blank_form(info: &MessageInfo) -> Option<&'static str> {
    let mut buffer = [0; 255];
    if info.direction == Direction::Outgoing {
        let blank = OutgoingCommand::blank(info.id, info.form).expect("it is in the list");
        let payload = blank.encode(&mut buffer).ok()?;
        Some(OutgoingCommand::decode(info.id, payload).expect("it was written").0.form())
    } else {
        let blank = IncomingCommand::blank(info.id, info.form).expect("it is in the list");
        let payload = blank.encode(&mut buffer).ok()?;
        Some(IncomingCommand::decode(info.id, payload).expect("it was written").0.form())
    }
}

/// Above all, a file that is written without data is not deleted.
#[test]
fn no_form_becomes_another_by_what_is_left_out() {
    for info in all() {
        let form = blank_form(info);
        let incomplete = [
            ("CMD_WRITE_FILE", "write"),
            ("CMD_SAVE_PARAMS_3", "extended"),
            ("CMD_DEBUG_VARS_3", "extended"),
            ("CMD_SELECT_IMU_3", "extended"),
        ];
        let expected = (!incomplete.contains(&(info.spec, info.form))).then_some(info.form);
        assert_eq!(form, expected, "{} {}", info.spec, info.form);
    }
}
