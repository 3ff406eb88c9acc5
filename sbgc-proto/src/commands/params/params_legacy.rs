//! Parameter commands of old boards.

use sbgc_proto_macros::message;

use crate::commands::{Confirm, ProfileId};

/// Requests the parameters of a profile, in the layout of old boards.
///
/// Deprecated: replaced by [`ReadParams3`](super::ReadParams3) and related commands. The answer of 32-bit boards is
/// unknown.
#[message(CMD_READ_PARAMS, outgoing, size = 1, answer = Params<'answer>)]
pub struct ReadParams {
    /// Profile to read; any number above 4 selects the active one.
    pub profile_id: ProfileId,
}

/// Parameters of a profile, in the layout of old boards.
///
/// Deprecated; the layout is not published. A driver for 8-bit boards reads 105 bytes, which start with those of
/// [`Params3`](super::Params3) up to `FOLLOW_OFFSET`.
#[message(CMD_READ_PARAMS, incoming, form = "undocumented", default, size = 0..=255)]
pub struct Params<'a> {
    /// Payload bytes.
    pub data: &'a [u8],
}

/// Writes the parameters of a profile, in the layout of old boards.
///
/// Deprecated; the layout is not published.
#[message(CMD_WRITE_PARAMS, outgoing, form = "undocumented", default, size = 0..=255, answer = Confirm)]
pub struct WriteParams<'a> {
    /// Payload bytes.
    pub data: &'a [u8],
}
