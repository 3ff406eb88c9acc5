//! Frames in the log.

use std::fmt;

use sbgc_proto::frame::Version;
use sbgc_proto::{CommandId, Direction};

/// A frame as the log shows it: its name, and its payload in hex.
pub(super) struct Shown<'a>(pub(super) Direction, pub(super) Version, pub(super) u8, pub(super) &'a [u8]);

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(direction, version, id, payload) = *self;
        let name = CommandId::from_raw(id).spec_name(direction).unwrap_or("unknown command");
        let bytes = if payload.len() == 1 { "byte" } else { "bytes" };
        write!(f, "{name} ({id}), version {}, {} {bytes}", version.number(), payload.len())?;
        if !payload.is_empty() {
            f.write_str(": ")?;
        }
        payload.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_shown_with_name_and_payload() {
        let shown = |direction, id, payload: &[u8]| Shown(direction, Version::V2, id, payload).to_string();
        assert_eq!(shown(Direction::Outgoing, 86, &[]), "CMD_BOARD_INFO (86), version 2, 0 bytes");
        assert_eq!(
            shown(Direction::Incoming, 67, &[0x5D, 0xFF]),
            "CMD_CONFIRM (67), version 2, 2 bytes: 5dff"
        );
        assert_eq!(shown(Direction::Incoming, 200, &[1]), "unknown command (200), version 2, 1 byte: 01");
    }
}
