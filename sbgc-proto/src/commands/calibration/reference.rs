//! Calibration of the accelerometer against an external reference.

use sbgc_proto_macros::message;

use crate::commands::Confirm;
use crate::units::Acceleration;
use crate::wire::{PerXyz, Reserved};

/// Refines the calibration of the main accelerometer with readings of a better accelerometer mounted on the frame.
///
/// Requires three encoders, which the board uses to transform the reference into the coordinates of the sensor. One
/// axis of the sensor must be within 20 degrees of gravity, and the sensor must already be roughly calibrated. The
/// command refines the offsets of the two horizontal axes and the scale of the vertical one. It takes about 0.5 s,
/// during which the gimbal must stand still.
///
/// The board sends one `CMD_CONFIRM` if all conditions are met, before or after these 0.5 s, and nothing otherwise.
/// Wait clearly longer than that, and treat a missing confirmation as a failure.
///
/// For a gimbal that works between level and 90 degrees down: level it with `CMD_CONTROL` and send this command
/// (offsets of X and Y); tilt it 90 degrees down and send it again (offset of Z, scale of Y); level it and send it once
/// more (scale of Z).
#[message(CMD_CALIB_ACC_EXT_REF, outgoing, size = 20, since = "2.62b7", answer = Confirm, slow)]
pub struct CalibAccExtRef {
    /// Reference acceleration in coordinates of the frame: X right, Y forward, Z down.
    pub acc_ref: PerXyz<Acceleration>,
    pub reserved: Reserved<14>,
}
