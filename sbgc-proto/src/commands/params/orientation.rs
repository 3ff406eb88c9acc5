//! Types of the orientation settings: mounting of sensors, and order of axes.

use sbgc_proto_macros::{bit_fields, open_enum};

/// Sensor axis and its direction. Spec: `AXIS_ORIENTATION`.
#[open_enum(i8)]
pub enum AxisOrientation {
    /// Positive X.
    X = 1,
    /// Positive Y.
    Y = 2,
    /// Positive Z.
    Z = 3,
    /// Negative X.
    #[wire(spec = "NEG_X")]
    NegativeX = -1,
    /// Negative Y.
    #[wire(spec = "NEG_Y")]
    NegativeY = -2,
    /// Negative Z.
    #[wire(spec = "NEG_Z")]
    NegativeZ = -3,
}

/// Mounting position of the frame IMU. Spec: `FRAME_IMU_POS`.
#[open_enum(u8, prefix = "FRAME_IMU_")]
pub enum FrameImuPosition {
    /// No frame IMU.
    Disabled = 0,
    /// Below the YAW motor, turning with YAW.
    BelowYaw = 1,
    /// Above the YAW motor, fixed to the frame.
    AboveYaw = 2,
    /// Below the YAW motor, and used as the signal source of the YAW controller.
    BelowYawPidSource = 3,
}

/// Order of the hardware axes, starting from the camera. Spec: `ORDER_OF_AXES`.
#[open_enum(u8)]
pub enum OrderOfAxes {
    /// PITCH, ROLL, YAW.
    PitchRollYaw = 0,
    /// YAW, ROLL, PITCH.
    YawRollPitch = 1,
    /// ROLL, YAW, PITCH. Special firmware builds only.
    RollYawPitch = 2,
    /// ROLL, PITCH, YAW.
    RollPitchYaw = 3,
}

/// Convention of Euler angles, and the coordinates used for control.
#[bit_fields(u8)]
pub struct EulerConvention {
    /// Order of rotations.
    #[wire(bits = 0..=3, spec = "EULER_ORDER")]
    pub order: EulerOrder,
    /// Whether control rotates about the axes of the camera. Newer firmware.
    #[wire(bits = 4, spec = "CONTROL_LOCAL_XYZ")]
    pub local_control: bool,
    /// Whether stabilization and control rotate about the axes of the camera.
    #[wire(bits = 5, spec = "STABILIZATION_LOCAL_XYZ", since = "2.74")]
    pub local_stabilization: bool,
}

/// Order of rotations of Euler angles. Spec: `EULER_ORDER`.
///
/// A motor axis means that the rotation is about the axis of that motor, wherever it points. Control commands use the
/// same orders plus 1, because 0 has another meaning there: see
/// [`ControlEulerOrder`](crate::commands::ControlEulerOrder).
///
/// The specification's table of parameters calls 2 and 3 `LOCAL_ROLL` and `ROLL_LOCAL`, for two-axis systems, and lists
/// 5. Its list of adjustable variables and newer documents have motor axes and do not list 5.
#[open_enum(u8)]
pub enum EulerOrder {
    /// PITCH, ROLL, YAW.
    PitchRollYaw = 0,
    /// ROLL, PITCH, YAW.
    RollPitchYaw = 1,
    /// PITCH motor, ROLL, YAW motor. In old firmware, local ROLL for two-axis systems.
    #[wire(spec = "LOCAL_ROLL")]
    PitchMotorRollYawMotor = 2,
    /// ROLL, PITCH motor, YAW motor. In old firmware, ROLL local for two-axis systems.
    #[wire(spec = "ROLL_LOCAL")]
    RollPitchMotorYawMotor = 3,
    /// YAW, ROLL, PITCH.
    YawRollPitch = 4,
    /// YAW, PITCH, ROLL. Not listed for newer firmware.
    YawPitchRoll = 5,
}
