//! Descriptions of debug variables, and values that are read by them.

use super::*;
use crate::EncodeError;

/// Made by hand from the layout.
#[test]
fn variables_are_described() {
    let payload =
        [2, 4, b'E', b'R', b'R', b'1', 0x01, 0, 0, 5, b'A', b'N', b'G', b'_', b'P', 0x64, 0xAB, 0xCD];
    let info = DebugVarsInfo3::decode(&payload).unwrap();
    assert_eq!(info.debug_vars_num, 2);
    let [error, angle] = info.vars.iter().collect::<Vec<_>>()[..] else { panic!("two variables") };
    assert_eq!((error.var_name.as_str(), error.var_type.var_type()), (Ok("ERR1"), DebugVarType::U8));
    assert_eq!(angle.var_name.as_str(), Ok("ANG_P"));
    assert_eq!((angle.var_type.axis(), angle.var_type.is_angle()), (DebugVarAxis::Pitch, true));
    assert_eq!(angle.reserved.0, [0xAB, 0xCD]);
    assert_eq!(info.encode(&mut [0; 255]), Ok(&payload[..]));
}

/// Made by hand from the layout.
#[test]
fn the_number_of_variables_may_be_that_of_all_messages() {
    let payload = [200, 1, b'A', 3, 0, 0, 1, b'B', 0x84, 0, 0];
    let (info, rest) = DebugVarsInfo3::decode_prefix(&payload).unwrap();
    assert_eq!((info.vars.len(), rest), (2, &[][..]));
    assert_eq!(info.encode(&mut [0; 255]), Ok(&payload[..]));
    let (info, rest) = DebugVarsInfo3::decode_prefix(&payload[..10]).unwrap();
    assert_eq!((info.vars.len(), rest), (1, &payload[6..10]));
    assert_eq!(DebugVarsInfo3::decode(&[0]).unwrap().vars.len(), 0);
    assert!(DebugVarsInfo3::decode(&[]).is_err());
    let short = DebugVarsInfo3 { debug_vars_num: 1, ..info.clone() };
    assert!(short.encode(&mut [0; 255]).is_ok());
    let none = DebugVarsInfo3 { debug_vars_num: 0, ..info };
    assert_eq!(none.encode(&mut [0; 255]), Err(EncodeError::Count { field: "VARS", expected: 0, got: 1 }));
}

/// Made by hand from the layout.
#[test]
fn values_are_read_by_their_kinds() {
    let payload =
        [49, 0xBC, 0x58, 0x82, 0x1D, 0x75, 0x0B, 0xC6, 9, 0x3E, 0x78, 0x39, 0xBD, 0x22, 0, 0, 0xC0, 0x3F];
    let kinds = (1..=7).map(DebugVarKind);
    let message = DebugVars3::decode(&payload).unwrap();
    assert_eq!(message.encode(&mut [0; 255]), Ok(&payload[..]));
    let values: Vec<_> = message.values(kinds.clone()).map(Result::unwrap).collect();
    assert_eq!(
        values,
        [
            DebugVarValue::U8(49),
            DebugVarValue::I8(-68),
            DebugVarValue::U16(33368),
            DebugVarValue::I16(29981),
            DebugVarValue::U32(0x3E09_C60B),
            DebugVarValue::I32(0x22BD_3978),
            DebugVarValue::F32(1.5.into()),
        ]
    );
    let cut = DebugVars3::decode(&payload[..17]).unwrap();
    assert_eq!(
        cut.values(kinds).last(),
        Some(Err(DecodeError::Truncated {
            command: "CMD_DEBUG_VARS_3",
            field: "VAR_VALUE",
            offset: 14,
            needed: 4,
            got: 3
        }))
    );
    let mut unknown = message.values([DebugVarKind(1), DebugVarKind(0x18), DebugVarKind(1)]).skip(1);
    assert!(matches!(unknown.next(), Some(Err(DecodeError::UnknownType { raw: 8, .. }))));
    assert_eq!(unknown.next(), None);
    assert!((DebugVarKind(0x44).physical(DebugVarValue::I16(-4096)) + 90.0).abs() < 1e-9);
}

/// Made by hand from the layout.
#[test]
fn masks_choose_variables() {
    let request = DebugVars3ExtendedRequest::new([5, 1, 2, 3, 4]).unwrap();
    assert_eq!(request.encode(&mut [0; 32]), Ok(&[0x3E, 0, 0, 0][..]));
    let request = DebugVars3ExtendedRequest::new([0, 33, 255]).unwrap();
    assert_eq!(request.selected_mask.len(), 8);
    assert_eq!(request.variables().collect::<Vec<_>>(), [0, 33, 255]);
    assert!(DebugVars3ExtendedRequest::new([256]).is_err());
    assert!(DebugVars3Request::accepts(0) && !DebugVars3Request::accepts(4));

    let payload = [0x06, 0, 0, 0, 200, 0, 0xF0];
    let masked = DebugVars3::decode(&payload).unwrap().masked(1).unwrap();
    assert_eq!(masked.selected_mask[..], [6]);
    let values: Vec<_> = masked.values([DebugVarKind(1), DebugVarKind(100)]).map(Result::unwrap).collect();
    assert_eq!(values, [DebugVarValue::U8(200), DebugVarValue::I16(-4096)]);
    assert_eq!(masked.encode_with(1, &mut [0; 255]), Ok(&payload[..]));
    assert!(DebugVars3::decode(&payload).unwrap().masked(2).is_err());
}
