//! Virtual channels: control signals sent by a host instead of an RC receiver.

use sbgc_proto_macros::message;

use crate::units::{CoarseRcSignal, RcSignal};
use crate::wire::List;

/// Sets all 32 virtual channels.
///
/// Not confirmed.
///
/// [`RcSource::API_VIRT_CH`](crate::commands::RcSource::API_VIRT_CH) covers channels 1 to 31 only, so channel 32 may be
/// unused. One document lists 31 channels here; the specification and all published code have 32.
#[message(CMD_API_VIRT_CH_CONTROL, outgoing, form = "full", size = 64, length = 64..)]
pub struct ApiVirtChControl {
    /// Signal of each channel, nominally -500 to 500; slightly larger values are allowed.
    pub api_virt_ch: [CoarseRcSignal; 32],
}

/// Sets any number of virtual channels, starting with the first.
///
/// Not confirmed.
#[message(CMD_API_VIRT_CH_CONTROL, outgoing, form = "variable", default, size = 2..=64, since = "2.70b5")]
pub struct ApiVirtChControlVariable {
    /// Signal of each channel, nominally -500 to 500; slightly larger values are allowed.
    pub api_virt_ch: List<CoarseRcSignal, 32>,
}

/// Sets any number of virtual channels, starting with the first, at high resolution.
///
/// Not confirmed.
///
/// The specification lists 31 channels in its tables and 32 in a heading; newer documents list 32. Up to 31 are safe.
#[message(CMD_API_VIRT_CH_HIGH_RES, outgoing, size = 2..=62, since = "2.68b7")]
pub struct ApiVirtChHighRes {
    /// Signal of each channel, nominally -16384 to 16384; slightly larger values are allowed.
    ///
    /// "No signal" is -32767 in the specification ([`RcSignal::UNDEFINED_OLD`]) and -32768 in newer documents
    /// ([`RcSignal::UNDEFINED`]).
    pub api_virt_ch: List<RcSignal, 32>,
}
