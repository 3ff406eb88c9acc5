//! The list of adjustable variables: parameters that can be changed at run time.

use crate::units::FirmwareVersion;

/// Type of an adjustable variable. On the wire, every value takes 4 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[expect(non_camel_case_types, reason = "they are the names of the types")]
#[allow(missing_docs, reason = "they are the names of the types")]
pub enum VariableType {
    u8,
    i8,
    u16,
    i16,
}

/// Facts about an adjustable variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct VariableFacts {
    /// Adjustable variable.
    pub variable: AdjustableVariable,
    /// The spec's name.
    pub name: &'static str,
    /// Type of the value.
    pub ty: VariableType,
    /// Minimum and maximum raw value, if the spec defines them.
    pub range: Option<(i32, i32)>,
    /// Maximum raw value in newer firmware, if it differs.
    pub newer_most: Option<i32>,
    /// Unit of the value; empty if it has none or the unit is unknown.
    pub unit: &'static str,
    /// Divisor: the value is the raw value divided by this.
    pub divide: u16,
    /// The first firmware that has it; `None` if that is unknown or the first of all.
    pub since: Option<FirmwareVersion>,
}

/// The first of what is there.
macro_rules! first {
    ($first:expr $(, $more:expr)?) => {
        $first
    };
}

macro_rules! variables {
    (
        $(#[doc = $enum_doc:tt])+
        pub enum $enum:ident;
        $(
            $(#[doc = $doc:tt])+
            $name:ident $spec:tt = $id:tt: $ty:ident
                $([$least:literal, $most:literal $(, newer $newer:literal)?])?
                $(in $unit:literal / $divide:literal)?
                $(since $since:tt)?;
        )*
    ) => {
        $(#[doc = $enum_doc])+
        #[sbgc_proto_macros::open_enum(u8)]
        pub enum $enum {
            $(
                $(#[doc = $doc])+
                #[wire(spec = $spec $(, since = $since)?)]
                $name = $id,
            )*
        }

        impl $enum {
            /// All known variables, ordered by number.
            pub const ALL: &'static [VariableFacts] = &[
                $(VariableFacts {
                    variable: Self::$name,
                    name: $spec,
                    ty: VariableType::$ty,
                    range: first!($(Some(($least, $most)),)? None),
                    newer_most: first!($($(Some($newer),)?)? None),
                    unit: first!($($unit,)? ""),
                    divide: first!($($divide,)? 1),
                    since: first!($(Some(FirmwareVersion::declared($since)),)? None),
                },)*
            ];
        }
    };
}

impl AdjustableVariable {
    /// Facts about the variable; `None` if it is unknown.
    ///
    /// ```
    /// use sbgc_proto::commands::AdjustableVariable;
    ///
    /// let facts = AdjustableVariable::from(37).facts().unwrap();
    /// assert_eq!(facts.name, "FRAME_HEADING_ANGLE");
    /// assert_eq!((facts.range, facts.unit, facts.divide), (Some((-1800, 1800)), "deg", 10));
    /// ```
    pub fn facts(self) -> Option<&'static VariableFacts> {
        Self::ALL.iter().find(|facts| facts.variable == self)
    }
}

variables! {
    /// Parameter that can be changed at run time.
    ///
    /// Names that contain a dot in the specification have an underscore here. Variables 65 and above exist in newer
    /// firmware only. The types of 66 and above are inferred from their ranges; their units are not published.
    pub enum AdjustableVariable;

    /// P term of the controller of ROLL.
    PRoll "P_ROLL" = 0: u8 [0, 255];
    /// P term of the controller of PITCH.
    PPitch "P_PITCH" = 1: u8 [0, 255];
    /// P term of the controller of YAW.
    PYaw "P_YAW" = 2: u8 [0, 255];
    /// I term of the controller of ROLL.
    IRoll "I_ROLL" = 3: u8 [0, 255];
    /// I term of the controller of PITCH.
    IPitch "I_PITCH" = 4: u8 [0, 255];
    /// I term of the controller of YAW.
    IYaw "I_YAW" = 5: u8 [0, 255];
    /// D term of the controller of ROLL.
    DRoll "D_ROLL" = 6: u8 [0, 255];
    /// D term of the controller of PITCH.
    DPitch "D_PITCH" = 7: u8 [0, 255];
    /// D term of the controller of YAW.
    DYaw "D_YAW" = 8: u8 [0, 255];
    /// Power of the motor of ROLL.
    PowerRoll "POWER_ROLL" = 9: u8 [0, 255];
    /// Power of the motor of PITCH.
    PowerPitch "POWER_PITCH" = 10: u8 [0, 255];
    /// Power of the motor of YAW.
    PowerYaw "POWER_YAW" = 11: u8 [0, 255];
    /// Acceleration limit of all axes.
    AccLimiter "ACC_LIMITER" = 12: i16 [0, 1275] in "deg/s^2" / 1;
    /// Follow speed of ROLL.
    FollowSpeedRoll "FOLLOW_SPEED_ROLL" = 13: u8 [0, 255];
    /// Follow speed of PITCH.
    FollowSpeedPitch "FOLLOW_SPEED_PITCH" = 14: u8 [0, 255];
    /// Follow speed of YAW.
    FollowSpeedYaw "FOLLOW_SPEED_YAW" = 15: u8 [0, 255];
    /// Low-pass filter of following, ROLL.
    FollowLpfRoll "FOLLOW_LPF_ROLL" = 16: u8 [0, 15];
    /// Low-pass filter of following, PITCH.
    FollowLpfPitch "FOLLOW_LPF_PITCH" = 17: u8 [0, 15];
    /// Low-pass filter of following, YAW.
    FollowLpfYaw "FOLLOW_LPF_YAW" = 18: u8 [0, 15];
    /// Speed of remote control, ROLL.
    RcSpeedRoll "RC_SPEED_ROLL" = 19: u8 [0, 255];
    /// Speed of remote control, PITCH.
    RcSpeedPitch "RC_SPEED_PITCH" = 20: u8 [0, 255];
    /// Speed of remote control, YAW.
    RcSpeedYaw "RC_SPEED_YAW" = 21: u8 [0, 255];
    /// Low-pass filter of remote control, ROLL.
    RcLpfRoll "RC_LPF_ROLL" = 22: u8 [0, 15, newer 255];
    /// Low-pass filter of remote control, PITCH.
    RcLpfPitch "RC_LPF_PITCH" = 23: u8 [0, 15, newer 255];
    /// Low-pass filter of remote control, YAW.
    RcLpfYaw "RC_LPF_YAW" = 24: u8 [0, 15, newer 255];
    /// Trim of remote control, ROLL.
    RcTrimRoll "RC_TRIM_ROLL" = 25: i8 [-127, 127];
    /// Trim of remote control, PITCH.
    RcTrimPitch "RC_TRIM_PITCH" = 26: i8 [-127, 127];
    /// Trim of remote control, YAW.
    RcTrimYaw "RC_TRIM_YAW" = 27: i8 [-127, 127];
    /// Dead band of remote control.
    RcDeadband "RC_DEADBAND" = 28: u8 [0, 255];
    /// Exponential rate of remote control.
    RcExpoRate "RC_EXPO_RATE" = 29: u8 [0, 100];
    /// Follow mode of PITCH and possibly ROLL: 0 off, 1 on.
    FollowPitch "FOLLOW_PITCH" = 30: u8 [0, 1];
    /// Axes in follow mode: 0 none; 1 YAW; 2 YAW, PITCH and possibly ROLL.
    FollowYawPitch "FOLLOW_YAW_PITCH" = 31: u8 [0, 2];
    /// Dead band of follow mode.
    FollowDeadband "FOLLOW_DEADBAND" = 32: u8 [0, 255];
    /// Exponential curve of follow mode.
    FollowExpoRate "FOLLOW_EXPO_RATE" = 33: u8 [0, 100];
    /// Tilt angle from which ROLL is mixed into follow mode.
    FollowRollMixStart "FOLLOW_ROLL_MIX_START" = 34: u8 [0, 90];
    /// Range of tilt angles over which the ROLL mix grows to its maximum.
    FollowRollMixRange "FOLLOW_ROLL_MIX_RANGE" = 35: u8 [0, 90];
    /// Trust in the gyroscope.
    GyroTrust "GYRO_TRUST" = 36: u8 [0, 255];
    /// Heading of the frame; 32767 turns the correction off.
    FrameHeadingAngle "FRAME_HEADING_ANGLE" = 37: i16 [-1800, 1800] in "deg" / 10;
    /// Correction of gyroscope drift about the vertical axis.
    GyroHeadingCorrection "GYRO_HEADING_CORRECTION" = 38: i16 [-20000, 20000] in "gyro units" / 1000;
    /// Limit of acceleration of ROLL.
    AccLimiterRoll "ACC_LIMITER_ROLL" = 39: i16 [0, 1275, newer 10000] in "deg/s^2" / 1;
    /// Limit of acceleration of PITCH.
    AccLimiterPitch "ACC_LIMITER_PITCH" = 40: i16 [0, 1275, newer 10000] in "deg/s^2" / 1;
    /// Limit of acceleration of YAW.
    AccLimiterYaw "ACC_LIMITER_YAW" = 41: i16 [0, 1275, newer 10000] in "deg/s^2" / 1;
    /// Gain of the controller of ROLL, as [`PidGain`](crate::units::PidGain) has it.
    PidGainRoll "PID_GAIN_ROLL" = 42: u8 [0, 255];
    /// Gain of the controller of PITCH, as [`PidGain`](crate::units::PidGain) has it.
    PidGainPitch "PID_GAIN_PITCH" = 43: u8 [0, 255];
    /// Gain of the controller of YAW, as [`PidGain`](crate::units::PidGain) has it.
    PidGainYaw "PID_GAIN_YAW" = 44: u8 [0, 255];
    /// Cut-off of the low-pass filter of ROLL.
    LpfFreqRoll "LPF_FREQ_ROLL" = 45: u16 [10, 400] in "Hz" / 1;
    /// Cut-off of the low-pass filter of PITCH.
    LpfFreqPitch "LPF_FREQ_PITCH" = 46: u16 [10, 400] in "Hz" / 1;
    /// Cut-off of the low-pass filter of YAW.
    LpfFreqYaw "LPF_FREQ_YAW" = 47: u16 [10, 400] in "Hz" / 1;
    /// Duration of a time-lapse motion.
    TimelapseTime "TIMELAPSE_TIME" = 48: u16 [1, 3600] in "s" / 1;
    /// Axes controlled by MavLink, as in [`MavControlMode`](crate::commands::MavControlMode).
    MavCtrlMode "MAV_CTRL_MODE" = 49: u8 [0, 2];
    /// Weight of an external reference in the heading correction.
    HCorrFactor "H_CORR_FACTOR" = 50: u8 [0, 255] since "2.68b7";
    /// Lower soft limit of ROLL, in firmware for encoders only.
    SwLimMinRoll "SW_LIM_MIN_ROLL" = 51: i16 [-3600, 3600] in "deg" / 1 since "2.68b8";
    /// Upper soft limit of ROLL, in firmware for encoders only.
    SwLimMaxRoll "SW_LIM_MAX_ROLL" = 52: i16 [-3600, 3600] in "deg" / 1 since "2.68b8";
    /// Lower soft limit of PITCH, in firmware for encoders only.
    SwLimMinPitch "SW_LIM_MIN_PITCH" = 53: i16 [-3600, 3600] in "deg" / 1 since "2.68b8";
    /// Upper soft limit of PITCH, in firmware for encoders only.
    SwLimMaxPitch "SW_LIM_MAX_PITCH" = 54: i16 [-3600, 3600] in "deg" / 1 since "2.68b8";
    /// Lower soft limit of YAW, in firmware for encoders only.
    SwLimMinYaw "SW_LIM_MIN_YAW" = 55: i16 [-3600, 3600] in "deg" / 1 since "2.68b8";
    /// Upper soft limit of YAW, in firmware for encoders only.
    SwLimMaxYaw "SW_LIM_MAX_YAW" = 56: i16 [-3600, 3600] in "deg" / 1 since "2.68b8";
    /// Range over which following of ROLL grows to its full speed.
    FollowRangeRoll "FOLLOW_RANGE_ROLL" = 57: u8 [0, 255] in "deg" / 1 since "2.68b9";
    /// Range over which following of PITCH grows to its full speed.
    FollowRangePitch "FOLLOW_RANGE_PITCH" = 58: u8 [0, 255] in "deg" / 1 since "2.68b9";
    /// Range over which following of YAW grows to its full speed.
    FollowRangeYaw "FOLLOW_RANGE_YAW" = 59: u8 [0, 255] in "deg" / 1 since "2.68b9";
    /// Goal of automatic PID tuning, from stability to precision.
    AutoPidTarget "AUTO_PID_TARGET" = 60: u8 [0, 255] since "2.68b9";
    /// Meaning of the ROLL control signal, as in [`RcMode`](crate::commands::RcMode).
    RcModeRoll "RC_MODE_ROLL" = 61: u8 since "2.69b3";
    /// Meaning of the PITCH control signal, as in [`RcMode`](crate::commands::RcMode).
    RcModePitch "RC_MODE_PITCH" = 62: u8 since "2.69b3";
    /// Meaning of the YAW control signal, as in [`RcMode`](crate::commands::RcMode).
    RcModeYaw "RC_MODE_YAW" = 63: u8 since "2.69b3";
    /// Order of Euler angles, as in [`EulerOrder`](crate::commands::EulerOrder).
    EulerOrder "EULER_ORDER" = 64: u8 since "2.69b3";
    /// Inner dead band of follow mode.
    FollowInDband "FOLLOW_IN_DBAND" = 65: u8 [0, 255] since "2.70b4";
    /// Least angle of remote control, ROLL.
    RcLimitMinRoll "RC_LIMIT_MIN_ROLL" = 66: i16 [-3600, 3600] since "2.72b0";
    /// Maximum angle of remote control, ROLL.
    RcLimitMaxRoll "RC_LIMIT_MAX_ROLL" = 67: i16 [-3600, 3600] since "2.72b0";
    /// Least angle of remote control, PITCH.
    RcLimitMinPitch "RC_LIMIT_MIN_PITCH" = 68: i16 [-3600, 3600] since "2.72b0";
    /// Maximum angle of remote control, PITCH.
    RcLimitMaxPitch "RC_LIMIT_MAX_PITCH" = 69: i16 [-3600, 3600] since "2.72b0";
    /// Least angle of remote control, YAW.
    RcLimitMinYaw "RC_LIMIT_MIN_YAW" = 70: i16 [-3600, 3600] since "2.72b0";
    /// Maximum angle of remote control, YAW.
    RcLimitMaxYaw "RC_LIMIT_MAX_YAW" = 71: i16 [-3600, 3600] since "2.72b0";
    /// Dead band of remote control, PITCH.
    RcDeadbandPitch "RC_DEADBAND_PITCH" = 72: u8 [0, 255] since "2.72b0";
    /// Dead band of remote control, YAW.
    RcDeadbandYaw "RC_DEADBAND_YAW" = 73: u8 [0, 255] since "2.72b0";
    /// Exponential rate of remote control, PITCH.
    RcExpoRatePitch "RC_EXPO_RATE_PITCH" = 74: u8 [0, 255] since "2.72b0";
    /// Exponential rate of remote control, YAW.
    RcExpoRateYaw "RC_EXPO_RATE_YAW" = 75: u8 [0, 255] since "2.72b0";
    /// Amplitude of the shake generator, ROLL.
    ShakeAmpRoll "SHAKE_AMP_ROLL" = 76: u8 [0, 255] since "2.73";
    /// Amplitude of the shake generator, TILT.
    ShakeAmpTilt "SHAKE_AMP_TILT" = 77: u8 [0, 255] since "2.73";
    /// Amplitude of the shake generator, PAN.
    ShakeAmpPan "SHAKE_AMP_PAN" = 78: u8 [0, 255] since "2.73";
    /// Base frequency of the shake generator.
    ShakeFreq "SHAKE_FREQ" = 79: u8 [0, 255] since "2.73";
    /// Frequency range of the shake generator.
    ShakeFreqRange "SHAKE_FREQ_RANGE" = 80: u8 [0, 100] since "2.73";
    /// Pause period of the shake generator.
    ShakePausePeriod "SHAKE_PAUSE_PERIOD" = 81: u16 [500, 5600] in "ms" / 1 since "2.73";
    /// Balance between shaking and pauses. The corresponding parameter has a maximum of 100.
    ShakePauseBalance "SHAKE_PAUSE_BALANCE" = 82: u8 [0, 255] since "2.73";
    /// Randomness of the shake generator's pauses.
    ShakePauseRandomness "SHAKE_PAUSE_RANDOMNESS" = 83: u8 [0, 100] since "2.73";
    /// Gain of the shake generator's resonance, ROLL.
    ShakeResonanceGainRoll "SHAKE_RESONANCE_GAIN_ROLL" = 84: u8 [0, 255] since "2.73";
    /// Gain of the shake generator's resonance, TILT.
    ShakeResonanceGainTilt "SHAKE_RESONANCE_GAIN_TILT" = 85: u8 [0, 255] since "2.73";
    /// Gain of the shake generator's resonance, PAN.
    ShakeResonanceGainPan "SHAKE_RESONANCE_GAIN_PAN" = 86: u8 [0, 255] since "2.73";
    /// Shift of the shake generator's frequencies, ROLL.
    ShakeFreqShiftRoll "SHAKE_FREQ_SHIFT_ROLL" = 87: i8 [-127, 127] since "2.73";
    /// Shift of the shake generator's frequencies, TILT.
    ShakeFreqShiftTilt "SHAKE_FREQ_SHIFT_TILT" = 88: i8 [-127, 127] since "2.73";
    /// Shift of the shake generator's frequencies, PAN.
    ShakeFreqShiftPan "SHAKE_FREQ_SHIFT_PAN" = 89: i8 [-127, 127] since "2.73";
    /// Master gain of the shake generator.
    ShakeMasterGain "SHAKE_MASTER_GAIN" = 90: u8 [0, 255] since "2.73";
    /// P term of the outer loop of ROLL.
    OuterPRoll "OUTER_P_ROLL" = 91: u8 [0, 255] since "2.73.7";
    /// P term of the outer loop of PITCH.
    OuterPPitch "OUTER_P_PITCH" = 92: u8 [0, 255] since "2.73.7";
    /// P term of the outer loop of YAW.
    OuterPYaw "OUTER_P_YAW" = 93: u8 [0, 255] since "2.73.7";
    /// Cut-off of the low-pass filter of the D term of ROLL.
    DLpfFreqRoll "D_LPF_FREQ_ROLL" = 94: u8 [0, 255] since "2.73.7";
    /// Cut-off of the low-pass filter of the D term of PITCH.
    DLpfFreqPitch "D_LPF_FREQ_PITCH" = 95: u8 [0, 255] since "2.73.7";
    /// Cut-off of the low-pass filter of the D term of YAW.
    DLpfFreqYaw "D_LPF_FREQ_YAW" = 96: u8 [0, 255] since "2.73.7";
    /// Correction of the IMU's angle of ROLL, presumably in 0.01 degrees.
    ImuAngleCorrRoll "IMU_ANGLE_CORR_ROLL" = 97: i16 [-1000, 1000] since "2.73.8";
    /// Correction of the IMU's angle of PITCH, presumably in 0.01 degrees.
    ImuAngleCorrPitch "IMU_ANGLE_CORR_PITCH" = 98: i16 [-1000, 1000] since "2.73.8";
    /// Width of the soft limits of ROLL, presumably in 0.1 degrees.
    SwLimWidthRoll "SW_LIM_WIDTH_ROLL" = 99: u8 [0, 255] since "2.73.8";
    /// Width of the soft limits of PITCH, presumably in 0.1 degrees.
    SwLimWidthPitch "SW_LIM_WIDTH_PITCH" = 100: u8 [0, 255] since "2.73.8";
    /// Width of the soft limits of YAW, presumably in 0.1 degrees.
    SwLimWidthYaw "SW_LIM_WIDTH_YAW" = 101: u8 [0, 255] since "2.73.8";
}
