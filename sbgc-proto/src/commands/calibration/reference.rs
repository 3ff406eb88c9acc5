//! Calibration of the accelerometer against another one.

use sbgc_proto_macros::message;

use crate::commands::Confirm;
use crate::units::Acceleration;
use crate::wire::{PerXyz, Reserved};

/// Refines the calibration of the main accelerometer by the reading of a better one that sits on the frame.
///
/// Needs three encoders, by which the board turns the reference into the sensor's own coordinates. One axis of the
/// sensor must be within 20 degrees of gravity, and its calibration must be fair already. It refines the offsets of the
/// two axes that are level, and the scale of the one that is not, in about 0.5 s, with the gimbal standing still.
///
/// One `CMD_CONFIRM` comes if all conditions are met, before or after these 0.5 s, and nothing otherwise: wait clearly
/// longer than that and treat silence as failure.
///
/// For a gimbal that works between level and 90 degrees down: level it with `CMD_CONTROL` and send this (offsets of X
/// and Y), tilt it 90 degrees down and send it (offset of Z, scale of Y), level it and send it again (scale of Z).
#[message(CMD_CALIB_ACC_EXT_REF, outgoing, size = 20, since = "2.62b7", answer = Confirm, slow)]
pub struct CalibAccExtRef {
    /// The acceleration that the reference shows, in coordinates of the frame: X right, Y forward, Z down.
    pub acc_ref: PerXyz<Acceleration>,
    pub reserved: Reserved<14>,
}
