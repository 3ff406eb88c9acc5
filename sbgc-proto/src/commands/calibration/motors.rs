//! Correction of motor cogging.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::Confirm;
use crate::declare::flags;
use crate::units::CorrectionPeriod;
use crate::wire::{PerAxis, Reserved};

/// Calibrates or deletes the correction of cogging, the torque ripple of a motor over one turn.
///
/// **The gimbal moves.** Prepare it first as described in the user manual. The board confirms the start, and the end
/// with data 255; one of the vendor's libraries waits for the latter. The duration depends on angles, speeds and
/// iterations; `CMD_COGGING_CALIB_INFO` appears to report the progress, in a layout that is not published.
///
/// The specification for firmware 2.6x names the command without its payload, which is taken from newer documents. One
/// of the vendor's libraries pads each axis to 16 bytes, 60 bytes in total; the others have 57 bytes, as here.
#[message(CMD_CALIB_COGGING, outgoing, size = 57, answer = Confirm)]
pub struct CalibCogging {
    /// Action to perform.
    pub action: CoggingAction,
    /// Axes to calibrate.
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
    /// Range of the motion.
    #[wire(unit = "deg", range = 20..=360)]
    pub angle: u16,
    /// Smoothing of the correction curve.
    #[wire(unit = "%", range = 0..=100)]
    pub smooth: u8,
    /// Speed of the motion, without a defined unit.
    pub speed: u8,
    /// Expected period of the correction curve.
    pub period: CorrectionPeriod,
    pub reserved: Reserved<9>,
}

/// Action on the cogging correction. Spec: `COGGING_ACTION`.
#[open_enum(u8)]
pub enum CoggingAction {
    /// Calibrates the correction.
    Calibrate = 1,
    /// Deletes the correction.
    Delete = 2,
}

flags! {
    /// Axes of a cogging calibration. Spec: `COGGING_AXIS`.
    pub struct CoggingAxes: u8 {
        /// Roll.
        const ROLL = 1 << 0;
        /// Pitch.
        const PITCH = 1 << 1;
        /// Yaw.
        const YAW = 1 << 2;
    }
}
