//! Payloads made by hand from the layouts, and what must not be mixed up in them.

use crate::Message;
use crate::commands::*;
use crate::wire::ToWire;

fn bytes<M: Message + ToWire>(message: &M) -> Vec<u8> {
    message.encode(&mut [0; 255]).unwrap().to_vec()
}

#[test]
fn the_eeprom_is_read_in_blocks() {
    let request = EepromReadRequest { addr: 0x7FC0, size: 192 };
    assert_eq!(bytes(&request), [0xC0, 0x7F, 0, 0, 0xC0, 0]);
    assert_eq!(EepromReadRequest::decode(&bytes(&request)), Ok(request));

    let answer = [0xC0, 0x7F, 0, 0, 1, 2, 3];
    assert_eq!(EepromRead::decode(&answer), Ok(EepromRead { addr: 0x7FC0, data: &[1, 2, 3] }));
    assert!(EepromRead::decode(&answer[..3]).is_err());
}

#[test]
fn the_eeprom_is_written_in_blocks() {
    let payload = [0x40, 0x48, 0, 0, 9, 8];
    let message = EepromWrite::decode(&payload).unwrap();
    assert_eq!(message, EepromWrite { addr: 18_496, data: &[9, 8] });
    assert_eq!(bytes(&message), payload);
}
