//! Payloads of actions byte by byte. Where nothing else is said they are made by hand from the layout.

use super::*;
use crate::commands::{MenuCommand, Switch};
use crate::wire::{FromWire, ToWire};
use crate::{DecodeError, Message};

/// `payload` and `message` are each other's bytes and meaning.
#[track_caller]
pub(super) fn same<M: Message + for<'a> FromWire<'a> + ToWire + PartialEq + core::fmt::Debug>(
    message: M,
    payload: &[u8],
) {
    assert_eq!(message.encode(&mut [0; 255]), Ok(payload));
    assert_eq!(M::decode_prefix(payload), Ok((message, &[][..])));
}

#[test]
fn motors_and_menu() {
    same(MotorsOn {}, &[]);
    same(MotorsOffSimple {}, &[]);
    same(MotorsOff { mode: MotorsOffMode::SafeStop }, &[2]);
    same(MotorsOff { mode: MotorsOffMode::Unknown(9) }, &[9]);
    same(ExecuteMenu { cmd_id: MenuCommand::MotorToggle }, &[10]);
    let both = ExecuteMenuFlags::CONFIRM | ExecuteMenuFlags::CONFIRM_ON_FINISH;
    same(ExecuteMenuExtended { cmd_id: MenuCommand::CalibAcc, flags: both }, &[6, 3]);
    same(
        ExecuteMenuExtended {
            cmd_id: MenuCommand::Unknown(200),
            flags: ExecuteMenuFlags::from_bits_retain(0xF0),
        },
        &[200, 0xF0],
    );
    assert!(MotorsOffSimple::accepts(0) && !MotorsOffSimple::accepts(1));
    assert!(ExecuteMenuExtended::accepts(2) && !ExecuteMenuExtended::accepts(1));
    assert!(ExecuteMenu::decode(&[]).is_err());
}

#[test]
fn restarts() {
    same(ResetRequest {}, &[]);
    same(ResetExtendedRequest { flags: ResetFlags::CONFIRM, delay_ms: 500 }, &[1, 0xF4, 1]);
    same(ResetExtendedRequest { flags: ResetFlags::from_bits_retain(0x83), delay_ms: 0 }, &[0x83, 0, 0]);
    same(Reset {}, &[]);
    same(BootMode3 {}, &[]);
    same(BootMode3Extended { confirm: Switch::On, delay_ms: 0x0203 }, &[1, 3, 2]);
    assert_eq!(
        ResetExtendedRequest::decode(&[1, 2]),
        Err(DecodeError::TooShort { command: "CMD_RESET", needed: 3, got: 2 })
    );
}
