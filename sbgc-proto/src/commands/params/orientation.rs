//! Values of orientation: how sensors are mounted, in which order axes turn.

use sbgc_proto_macros::{bit_fields, open_enum};

/// An axis of a sensor with its sign. Spec: `AXIS_ORIENTATION`.
#[open_enum(i8)]
pub enum AxisOrientation {
    /// X.
    X = 1,
    /// Y.
    Y = 2,
    /// Z.
    Z = 3,
    /// Opposite to X.
    #[wire(spec = "NEG_X")]
    NegativeX = -1,
    /// Opposite to Y.
    #[wire(spec = "NEG_Y")]
    NegativeY = -2,
    /// Opposite to Z.
    #[wire(spec = "NEG_Z")]
    NegativeZ = -3,
}

/// Mounting position of the frame IMU. Spec: `FRAME_IMU_POS`.
#[open_enum(u8, prefix = "FRAME_IMU_")]
pub enum FrameImuPosition {
    /// There is none.
    Disabled = 0,
    /// Below the YAW motor: it turns with YAW.
    BelowYaw = 1,
    /// Above the YAW motor: it stays with the frame.
    AboveYaw = 2,
    /// Below the YAW motor, and the controller of YAW takes its signal from it.
    BelowYawPidSource = 3,
}

/// Order of the hardware axes, counted from the camera. Spec: `ORDER_OF_AXES`.
#[open_enum(u8)]
pub enum OrderOfAxes {
    /// PITCH, ROLL, YAW.
    PitchRollYaw = 0,
    /// YAW, ROLL, PITCH.
    YawRollPitch = 1,
    /// ROLL, YAW, PITCH. In special builds of the firmware only.
    RollYawPitch = 2,
    /// ROLL, PITCH, YAW.
    RollPitchYaw = 3,
}

/// In which Euler angles attitudes are expressed, and what goes by them.
#[bit_fields(u8)]
pub struct EulerConvention {
    /// The order of rotations.
    #[wire(bits = 0..=3, spec = "EULER_ORDER")]
    pub order: EulerOrder,
    /// Whether control goes about the camera's own axes. Newer firmware.
    #[wire(bits = 4, spec = "CONTROL_LOCAL_XYZ")]
    pub local_control: bool,
    /// Whether stabilization and control go about the camera's own axes.
    #[wire(bits = 5, spec = "STABILIZATION_LOCAL_XYZ", since = "2.74")]
    pub local_stabilization: bool,
}

/// The order of rotations of Euler angles. Spec: `EULER_ORDER`.
///
/// Where an axis is called a motor's, the rotation is about the axis of that motor wherever it points. The control
/// commands have the same orders plus 1, for 0 means something else there: see
/// [`ControlEulerOrder`](crate::commands::ControlEulerOrder).
///
/// The specification's table of parameters calls 2 and 3 `LOCAL_ROLL` and `ROLL_LOCAL`, for systems of two axes, and
/// lists 5. Its list of adjustable variables and newer documents have the motor axes, and no 5.
#[open_enum(u8)]
pub enum EulerOrder {
    /// PITCH, ROLL, YAW.
    PitchRollYaw = 0,
    /// ROLL, PITCH, YAW.
    RollPitchYaw = 1,
    /// PITCH of the motor, ROLL, YAW of the motor; in old firmware local ROLL, for systems of two axes.
    #[wire(spec = "LOCAL_ROLL")]
    PitchMotorRollYawMotor = 2,
    /// ROLL, PITCH of the motor, YAW of the motor; in old firmware ROLL and local, for systems of two axes.
    #[wire(spec = "ROLL_LOCAL")]
    RollPitchMotorYawMotor = 3,
    /// YAW, ROLL, PITCH.
    YawRollPitch = 4,
    /// YAW, PITCH, ROLL. Newer firmware does not list it.
    YawPitchRoll = 5,
}
