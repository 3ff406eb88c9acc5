//! Moving the gimbal.

use sbgc_proto_macros::{message, open_enum, record};

use crate::units::{Angle, ControlRate};
use crate::wire::{PerAxis, bit_enums, bit_fields};

/// Speed and angle of one axis.
#[record(size = 4)]
#[derive(Copy)]
pub struct ControlAxis {
    /// Speed.
    pub speed: ControlRate,
    /// Angle.
    pub angle: Angle,
}

/// Moves.
#[message(CMD_CONTROL, outgoing, form = "extended", size = 15)]
pub struct Control {
    /// Mode of each axis.
    pub control_mode: PerAxis<ControlMode>,
    /// Speed and angle of each axis.
    pub axes: PerAxis<ControlAxis>,
}

bit_fields! {
    /// Mode byte.
    pub struct ControlMode: u8 {
        /// What the axis follows.
        0..=3 => mode / with_mode "CONTROL_MODE": Mode,
        /// Flags.
        4..=7 => flags / with_flags "CONTROL_FLAG": u8,
    }
}

/// What.
#[open_enum(u8)]
pub enum Mode {
    /// No.
    #[wire(spec = "MODE_NO_CONTROL")]
    NoControl = 0,
}
bit_enums!(Mode);
