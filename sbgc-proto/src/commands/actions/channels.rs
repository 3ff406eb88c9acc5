//! Virtual channels: signals that a host sends in place of a radio control receiver.

use sbgc_proto_macros::message;

use crate::units::{CoarseRcSignal, RcSignal};
use crate::wire::List;

/// Sets all 32 virtual channels.
///
/// Not confirmed.
///
/// [`RcSource::API_VIRT_CH`](crate::commands::RcSource::API_VIRT_CH) names channels 1 to 31 only, so the last may have
/// no use. One document has 31 channels here; the specification and all code have 32.
#[message(CMD_API_VIRT_CH_CONTROL, outgoing, form = "full", size = 64, length = 64..)]
pub struct ApiVirtChControl {
    /// The signal of each channel, -500 to 500 or slightly beyond.
    pub api_virt_ch: [CoarseRcSignal; 32],
}

/// Sets the first of the virtual channels.
///
/// Not confirmed.
#[message(CMD_API_VIRT_CH_CONTROL, outgoing, form = "variable", default, size = 2..=64, since = "2.70b5")]
pub struct ApiVirtChControlVariable {
    /// The signal of each channel, -500 to 500 or slightly beyond.
    pub api_virt_ch: List<CoarseRcSignal, 32>,
}

/// Sets the first of the virtual channels, with finer steps.
///
/// Not confirmed.
///
/// The specification has 31 channels in its tables and 32 in a title, newer documents 32. Up to 31 are safe.
#[message(CMD_API_VIRT_CH_HIGH_RES, outgoing, size = 2..=62, since = "2.68b7")]
pub struct ApiVirtChHighRes {
    /// The signal of each channel, -16384 to 16384 or slightly beyond.
    ///
    /// No signal is -32767, [`RcSignal::UNDEFINED_OLD`], in the specification of this form, and -32768,
    /// [`RcSignal::UNDEFINED`], in newer documents.
    pub api_virt_ch: List<RcSignal, 32>,
}
