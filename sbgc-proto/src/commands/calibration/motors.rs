//! Correction of motors that do not turn evenly.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::Confirm;
use crate::units::CorrectionPeriod;
use crate::wire::{PerAxis, Reserved, flags};

/// Measures or deletes the correction of cogging, the unevenness of a motor over its turn.
///
/// The gimbal moves. `CMD_CONFIRM` comes at the start, and a second one with data 255 at the end; the second is known from one library
/// only. How long it takes depends on angles, speeds and iterations. The gimbal has to be prepared as the user manual
/// tells.
///
/// Only newer sources publish this payload; that older firmware with this command uses the same one is likely, not
/// certain. One library lets its compiler pad each axis to 16 bytes, which makes 60 in all; two others have 57 bytes as
/// here.
#[message(CMD_CALIB_COGGING, outgoing, size = 57, answer = Confirm)]
pub struct CalibCogging {
    /// What to do.
    pub action: CoggingAction,
    /// For which axes.
    pub axis_to_calibrate: CoggingAxes,
    /// How to do it, for each axis.
    pub axes: PerAxis<CoggingAxis>,
    /// How often to measure.
    #[wire(range = 2..=255)]
    pub iterations_num: u8,
    pub reserved_2: Reserved<9>,
}

/// How to measure the cogging of one axis.
#[record(size = 15)]
#[derive(Copy)]
pub struct CoggingAxis {
    /// The range to turn through.
    #[wire(unit = "deg", range = 20..=360)]
    pub angle: u16,
    /// How much to smooth the curve.
    #[wire(unit = "%", range = 0..=100)]
    pub smooth: u8,
    /// How fast to turn, in no particular unit.
    pub speed: u8,
    /// The period that the curve is expected to have.
    pub period: CorrectionPeriod,
    pub reserved: Reserved<9>,
}

/// What to do with the correction of cogging. Spec: `COGGING_ACTION`.
#[open_enum(u8)]
pub enum CoggingAction {
    /// Measure it.
    Calibrate = 1,
    /// Delete it.
    Delete = 2,
}

flags! {
    /// Axes whose cogging is meant. Spec: `COGGING_AXIS`.
    pub struct CoggingAxes: u8 {
        /// Roll.
        const ROLL = 1 << 0;
        /// Pitch.
        const PITCH = 1 << 1;
        /// Yaw.
        const YAW = 1 << 2;
    }
}
