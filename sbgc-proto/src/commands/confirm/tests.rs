//! Confirmations and errors in all their widths.

use super::*;
use crate::wire::Bytes;
use crate::{DecodeError, Message};

fn check<M: for<'a> FromWire<'a> + ToWire + Message>(payload: &[u8]) -> M {
    let message = M::decode(payload).unwrap();
    assert_eq!(message.encode(&mut [0; 255]), Ok(payload));
    message
}

/// Made by hand from the layout.
#[test]
fn a_confirmation_keeps_the_width_of_its_data() {
    let params = CommandId::WriteParams3;
    let data = |payload| check::<Confirm>(payload).data;
    assert_eq!(check::<Confirm>(&[22]), Confirm { cmd_id: params, data: ConfirmData::None });
    assert_eq!(data(&[22, 0]), ConfirmData::U8(0));
    assert_eq!(data(&[22, 0, 1]), ConfirmData::U16(256));
    assert_eq!(data(&[22, 0, 1, 0]), ConfirmData::U24(256.try_into().unwrap()));
    assert_eq!(data(&[22, 0, 1, 0, 0]), ConfirmData::U32(256));
    assert_eq!(data(&[22, 0, 1, 0]).value(), 256);
    assert_eq!(Confirm::decode_prefix(&[22, 0, 1, 0, 0, 9]).unwrap().1, [9]);
    assert_eq!(
        Confirm::decode(&[]),
        Err(DecodeError::TooShort { command: "CMD_CONFIRM", needed: 1, got: 0 })
    );
}

/// Made by hand from the layout.
#[test]
fn the_length_of_an_error_tells_its_form() {
    let legacy = check::<ErrorLegacy>(&[6, 1, 2, 3, 4]);
    assert_eq!(legacy.error_code, ErrorCode::UnknownCommand);
    assert_eq!(legacy.error_data, Some(Bytes([1, 2, 3, 4])));
    assert_eq!(check::<ErrorLegacy>(&[6]).error_data, None);
    let full = check::<Error>(&[22, 2, 1, 2, 3, 4]);
    assert_eq!(full.cmd_id, CommandId::WriteParams3);
    assert_eq!(full.error_code, FailureCode::General(ErrorCode::WrongParams));
    assert_eq!(full.error_data.as_bytes(), [1, 2, 3, 4]);
    for length in 2..=4 {
        check::<Error>(&[22, 2, 1, 2][..length]);
    }
    assert!([1, 5].into_iter().all(ErrorLegacy::accepts));
    assert!([0, 2, 3, 4, 6, 7].into_iter().all(|length| !ErrorLegacy::accepts(length)));
    assert!(Error::decode(&[22]).is_err());
}

#[test]
fn the_command_chooses_the_list_of_codes() {
    let name = |command: CommandId, raw| FailureCode::from_raw(command, raw).name();
    assert_eq!(name(CommandId::WriteFile, 4), Some("ERR_NO_FREE_SPACE"));
    assert_eq!(name(CommandId::Control, 4), Some("ERR_CRYPTO"));
    assert_eq!(name(CommandId::AutoPid2, 4), Some("UNKNOWN_ACTION"));
    assert_eq!(name(CommandId::AutoPid2, 9), Some("ERR_NOT_SUPPORTED"));
    assert_eq!(name(CommandId::Control, 99), None);
    for raw in 0..=255 {
        for command in (0..=255).map(CommandId::from_raw) {
            assert_eq!(FailureCode::from_raw(command, raw).raw(), raw);
        }
    }
}

#[cfg(feature = "reflect")]
#[test]
fn fields_show_the_width_and_the_list() {
    use crate::reflect::{Input, Leaf, set, walk};

    let mut shown = Vec::new();
    walk(&check::<Confirm>(&[22, 0, 1, 0]), &mut |leaf: &Leaf<'_>| {
        shown.push(format!("{}@{} {} {:?}", leaf.path, leaf.offset, leaf.type_name(), leaf.raw));
    });
    walk(&check::<Error>(&[54, 4]), &mut |leaf: &Leaf<'_>| {
        shown.push(leaf.label().map(|label| label.to_string()).unwrap_or_default());
    });
    assert_eq!(
        shown,
        ["cmd_id@0 u8 Number(22)", "data.u24@1 u24 Number(256)", "CMD_WRITE_FILE", "ERR_NO_FREE_SPACE", ""]
    );

    let mut data = ConfirmData::None;
    for (path, value, expected) in [
        ("", 7, ConfirmData::U8(7)),
        ("u16", 7, ConfirmData::U16(7)),
        ("", 700, ConfirmData::U16(700)),
        ("U24", 7, ConfirmData::U24(7_u32.try_into().unwrap())),
        ("u32", 1, ConfirmData::U32(1)),
    ] {
        set(&mut data, path, Input::Raw(value)).unwrap();
        assert_eq!(data, expected);
    }
    data = ConfirmData::None;
    set(&mut data, "", Input::Text("0x10000")).unwrap();
    assert_eq!(data, ConfirmData::U24(0x1_0000.try_into().unwrap()));
    for (path, value) in [("", 1 << 24), ("u8", 256), ("u48", 1), ("u16", -1)] {
        assert!(set(&mut data, path, Input::Raw(value)).is_err());
        assert_eq!(data, ConfirmData::U24(0x1_0000.try_into().unwrap()), "{path}");
    }
}

#[cfg(feature = "reflect")]
#[test]
fn codes_of_every_list_are_taken_by_name() {
    use crate::reflect::{Input, set};

    let mut code = FailureCode::default();
    for (text, raw) in [
        ("ERR_WRONG_PARAMS", 2),
        ("ERR_WRONG_PARAMS (10)", 10),
        ("ERR_CRC", 7),
        ("ERR_CRYPTO (4)", 4),
        ("99", 99),
    ] {
        set(&mut code, "", Input::Text(text)).unwrap();
        assert_eq!(code.raw(), raw, "{text}");
    }
    assert!(set(&mut code, "", Input::Text("ERR_WRONG_PARAMS (3)")).is_err());
}
