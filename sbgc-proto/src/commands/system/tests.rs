//! Payloads made by hand from the layouts.

use crate::commands::*;
use crate::wire::{Bytes, ToWire};
use crate::{CommandId, Message};

fn bytes<M: Message + ToWire>(message: &M) -> Vec<u8> {
    message.encode(&mut [0; 255]).unwrap().to_vec()
}

#[test]
fn messages_are_signed() {
    let mut payload = [9; 33];
    payload[0] = 2;
    let request = SignMessageRequest { sign_type: 2, message: Bytes([9; 32]) };
    assert_eq!(bytes(&request), payload);
    assert_eq!(SignMessageRequest::decode(&payload), Ok(request));
    assert_eq!(SignMessage::decode(&[9; 32]), Ok(SignMessage { signature: Bytes([9; 32]) }));
}

#[test]
fn an_empty_password_is_a_length_of_zero() {
    let payload = [0x12, 0, 0, 0, 0, 0, 0, 0, 0];
    let message = PassProtectWrite::decode(&payload).unwrap();
    assert_eq!(message.flags, PassProtectFlags::ENCRYPT_PARAMS | PassProtectFlags::CHANNEL_1_ENABLED);
    assert!(message.new_password.0.is_empty());
    assert_eq!(bytes(&message), payload);

    let payload = [0, 0, 0, 0x80, 0, 0, 0, 0, 2, b'n', b'o'];
    let message = PassProtectWrite::decode(&payload).unwrap();
    assert_eq!(message.flags.bits(), 1 << 31);
    assert_eq!(message.new_password.as_str(), Ok("no"));
    assert_eq!(bytes(&message), payload);

    let payload = [2, 0, 0, 0, 1, 2, 3, 4];
    assert_eq!(bytes(&PassProtectRead::decode(&payload).unwrap()), payload);
}

#[test]
fn targets_are_a_device_and_a_port() {
    assert_eq!(SapiTarget::new(SapiDevice::Sbgc32, 0), SapiTarget(4));
    let payload = [0xEC, 1, 2];
    let message = TransparentSapi::decode(&payload).unwrap();
    assert_eq!((message.target.device(), message.target.port()), (SapiDevice::CanDrv4, 0));
    assert!(message.target.wait());
    assert_eq!(bytes(&message), payload);
    assert_eq!(bytes(&TransparentSapiRequest { target: message.target, data: &[] }), [0xEC]);
}

#[test]
fn the_debug_port_shows_other_ports() {
    let payload = [0x34, 0x12, 0x82, 67, 1, 0];
    let message = SetDebugPort::decode(&payload).unwrap();
    assert_eq!((message.port_and_dir.port(), message.port_and_dir.direction()), (2, true));
    assert_eq!((message.cmd_id, message.payload), (CommandId::from_raw(67), &[1, 0][..]));
    assert_eq!(bytes(&message), payload);

    let filter = DebugPortFilter::CONTROL | DebugPortFilter::GET_ANGLES;
    let request = SetDebugPortRequest {
        action: DebugPortAction::Start,
        cmd_filter: filter,
        ..SetDebugPortRequest::default()
    };
    assert_eq!(bytes(&request), [1, 0x20, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
}
