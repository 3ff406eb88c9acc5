//! Commands of the parameters of old boards.

use sbgc_proto_macros::message;

use crate::commands::{Confirm, ProfileId};

/// Requests the parameters of a profile, in the layout of old boards.
///
/// Deprecated: [`ReadParams3`](super::ReadParams3) and its fellows replace it. What boards of 32 bits answer is not
/// known.
#[message(CMD_READ_PARAMS, outgoing, size = 1, answer = Params<'answer>)]
pub struct ReadParams {
    /// Profile; any number above 4 selects the active one.
    pub profile_id: ProfileId,
}

/// The parameters of a profile, in the layout of old boards.
///
/// Deprecated, and not published. A driver for boards of 8 bits reads 105 bytes: at first those of
/// [`Params3`](super::Params3), up to `FOLLOW_OFFSET`.
#[message(CMD_READ_PARAMS, incoming, form = "undocumented", default, size = 0..=255)]
pub struct Params<'a> {
    /// Payload bytes.
    pub data: &'a [u8],
}

/// Writes the parameters of a profile, in the layout of old boards.
///
/// Deprecated, and not published.
#[message(CMD_WRITE_PARAMS, outgoing, form = "undocumented", default, size = 0..=255, answer = Confirm)]
pub struct WriteParams<'a> {
    /// Payload bytes.
    pub data: &'a [u8],
}
