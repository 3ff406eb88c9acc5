//! Correction of motors that do not turn evenly.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::Confirm;
use crate::declare::flags;
use crate::units::CorrectionPeriod;
use crate::wire::{PerAxis, Reserved};

/// Measures or deletes the correction of cogging, the unevenness of a motor over its turn.
///
/// **The gimbal moves.** Prepare it first as described in the user manual. The board confirms at the start, and with
/// data 255 at the end, which one of the vendor's libraries waits for. How long it takes depends on angles, speeds and
/// iterations; `CMD_COGGING_CALIB_INFO` seems to report the progress, in a layout that is not published.
///
/// The specification of firmware 2.6x names the command without its payload, which is that of newer documents. One of
/// the vendor's libraries lets its compiler pad each axis to 16 bytes, which makes 60 in all; the others have 57 bytes
/// as here.
#[message(CMD_CALIB_COGGING, outgoing, size = 57, answer = Confirm)]
pub struct CalibCogging {
    /// Action to perform.
    pub action: CoggingAction,
    /// For which axes.
    pub axis_to_calibrate: CoggingAxes,
    /// Calibration settings of each axis.
    #[wire(group)]
    pub axes: PerAxis<CoggingAxis>,
    /// Number of measurements of each axis.
    #[wire(range = 2..=255)]
    pub iterations_num: u8,
    pub reserved_2: Reserved<9>,
}

/// Cogging measurement settings of one axis.
#[record(size = 15)]
#[derive(Copy)]
pub struct CoggingAxis {
    /// The range to turn through.
    #[wire(unit = "deg", range = 20..=360)]
    pub angle: u16,
    /// Smoothing of the curve.
    #[wire(unit = "%", range = 0..=100)]
    pub smooth: u8,
    /// Speed of the motion, without a defined unit.
    pub speed: u8,
    /// The period that the curve is expected to have.
    pub period: CorrectionPeriod,
    pub reserved: Reserved<9>,
}

/// Action on the cogging correction. Spec: `COGGING_ACTION`.
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
