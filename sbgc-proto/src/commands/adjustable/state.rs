//! Current state of signals and of the variables that they change.

use sbgc_proto_macros::{bit_fields, message};

use super::AdjustableVariable;
use crate::commands::{MenuCommand, RcSource};
use crate::declare::BitField;
use crate::units::RcSignal;
use crate::wire::{Float, Reserved};

/// Requests the state of one trigger slot, two signals and two variables.
#[message(
    CMD_ADJ_VARS_STATE,
    outgoing,
    form = "extended", default,
    size = 7,
    length = 7..,
    since = "2.62b5",
    answer = AdjVarsState
)]
pub struct AdjVarsStateRequest {
    /// Trigger slot, counted from 0.
    #[wire(range = 0..=9)]
    pub trigger_slot: u8,
    /// Signal of an analog slot.
    pub analog_src_id: WideRcSource,
    /// Variable of an analog slot.
    pub analog_var_id: AdjustableVariable,
    /// Signal of a lookup table.
    pub lut_src_id: WideRcSource,
    /// Variable of a lookup table.
    pub lut_var_id: AdjustableVariable,
}

/// State of one trigger slot, two signals and two variables: the answer to [`AdjVarsStateRequest`].
///
/// The legacy form has the same length; only the firmware version or the request distinguishes them.
#[message(CMD_ADJ_VARS_STATE, incoming, form = "extended", default, size = 15, since = "2.62b5")]
pub struct AdjVarsState {
    /// Value of the signal of the trigger slot.
    #[wire(range = -16384..=16384)]
    pub trigger_rc_data: RcSignal,
    /// Menu command that the trigger slot currently runs.
    pub trigger_action: MenuCommand,
    /// Value of the requested analog signal.
    #[wire(range = -16384..=16384)]
    pub analog_src_value: RcSignal,
    /// Value of the requested analog variable. A float, although the vendor's library reads an integer.
    pub analog_var_value: Float,
    /// Value of the requested signal of a lookup table.
    #[wire(range = -16384..=16384)]
    pub lut_src_value: RcSignal,
    /// Value of the requested variable of a lookup table. A float, although the vendor's library reads an integer.
    pub lut_var_value: Float,
}

/// Requests the state of one trigger slot and one analog slot (firmware before 2.62b5).
#[message(
    CMD_ADJ_VARS_STATE,
    outgoing,
    form = "legacy",
    size = 2,
    length = 2,
    answer = AdjVarsStateLegacy
)]
pub struct AdjVarsStateLegacyRequest {
    /// Trigger slot, counted from 0.
    #[wire(range = 0..=9)]
    pub trigger_slot: u8,
    /// Analog slot, counted from 0.
    #[wire(range = 0..=14)]
    pub analog_slot: u8,
}

/// State of one trigger slot and one analog slot (firmware before 2.62b5): the answer to [`AdjVarsStateLegacyRequest`].
///
/// The newer form has the same length; only the firmware version or the request distinguishes them.
#[message(CMD_ADJ_VARS_STATE, incoming, form = "legacy", size = 15)]
pub struct AdjVarsStateLegacy {
    /// Value of the signal of the trigger slot.
    #[wire(range = -500..=500)]
    pub trigger_rc_data: i16,
    /// Menu command that the trigger slot currently runs.
    pub trigger_action: MenuCommand,
    /// Value of the signal of the analog slot.
    #[wire(range = -500..=500)]
    pub analog_rc_data: i16,
    /// Resulting value of the variable of the analog slot.
    pub analog_value: i32,
    pub reserved: Reserved<6>,
}

/// Signal source in two bytes. All known sources fit into the low byte.
#[bit_fields(u16)]
pub struct WideRcSource {
    /// Signal source.
    #[wire(bits = 0..=7, spec = "RC_MAP")]
    pub source: RcSource,
}

impl From<RcSource> for WideRcSource {
    fn from(source: RcSource) -> Self {
        Self::default().with_source(source)
    }
}

impl BitField for RcSource {
    fn from_bits(bits: u32) -> Self {
        Self(u8::from_bits(bits))
    }

    fn into_bits(self) -> u32 {
        self.0.into()
    }
}

#[cfg(feature = "reflect")]
impl crate::declare::BitLabels for RcSource {}
