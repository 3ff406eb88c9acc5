//! Automatic tuning of the PID loops, second version.

use sbgc_proto_macros::{bit_fields, message, open_enum, record};

use crate::commands::Confirm;
use crate::declare::flags;
use crate::units::{GainMargin, TestAngle, TestFrequencyFrom, TestFrequencyTo};
use crate::wire::{PerAxis, Reserved};

/// Stops automatic tuning or reads its configuration.
///
/// The form for all actions that need no configuration. Confirmed once, at once; an action that is not possible brings
/// `CMD_ERROR` with an [`AutoPid2Error`](crate::commands::AutoPid2Error) in place of the confirmation.
#[message(CMD_AUTO_PID2, outgoing, form = "simple", default, size = 11, length = 11, since = "2.70", answer = Confirm)]
pub struct AutoPid2SimpleRequest {
    /// Action to perform.
    pub action: AutoPid2Action,
    pub reserved: Reserved<10>,
}

/// Starts automatic tuning or saves its configuration.
///
/// **The gimbal moves.** One `CMD_CONFIRM` comes at once, or `CMD_ERROR` with an
/// [`AutoPid2Error`](crate::commands::AutoPid2Error). When it is done the board sends the parameters of the current
/// profile unsolicited (`CMD_READ_PARAMS_3` and the other blocks). How long it takes is not published.
///
/// Firmware 2.70 to 2.72 has another layout of the same length and with the same version byte,
/// [`AutoPid2LegacyRequest`]. Only the firmware version distinguishes them. One library's change log has
/// this one from 2.73.1 on.
#[message(CMD_AUTO_PID2, outgoing, form = "newer", size = 73, since = "2.73", answer = Confirm)]
pub struct AutoPid2Request {
    /// Action to perform.
    pub action: AutoPid2Action,
    /// Additional options.
    pub cmd_flags: AutoPid2CmdFlags,
    pub reserved: Reserved<8>,
    /// Version of the configuration that follows: 1.
    pub cfg_version: u8,
    /// Tuning settings of each axis.
    #[wire(group)]
    pub axes: PerAxis<AutoPid2Axis>,
    /// Tuning settings common to all axes.
    pub general_flags: AutoPid2GeneralFlags,
    pub reserved2: Reserved<1>,
    /// Lowest frequency of the test.
    pub test_freq_from: TestFrequencyFrom,
    /// Highest frequency of the test. One library's remark has steps of 1 Hz; two others have 2 Hz, as here.
    pub test_freq_to: TestFrequencyTo,
    /// Positions, of those below, at which to tune.
    pub multi_pos_flags: AutoPid2Positions,
    /// Angles of the positions to tune at.
    pub multi_pos_angle: [TestAngle; 4],
    pub reserved3: Reserved<12>,
}

/// Tuning settings and results of one axis, second version.
#[record(size = 13)]
#[derive(Copy)]
pub struct AutoPid2Axis {
    /// Whether and what to tune.
    pub axis_flags: AutoPid2AxisFlags,
    /// 0 for stability, 255 for performance.
    pub gain: u8,
    /// Strength of the test signal.
    pub stimulus_gain: u16,
    /// Frequency up to which the axis is to work well.
    #[wire(unit = "Hz")]
    pub effective_freq: u8,
    /// Frequency that makes problems.
    #[wire(unit = "Hz")]
    pub problem_freq: u8,
    /// Margin to keep at that frequency.
    pub problem_margin: GainMargin,
    pub reserved: Reserved<6>,
}

/// Starts automatic tuning or saves its configuration, in firmware 2.70 to 2.72.
///
/// Its length and version byte are those of [`AutoPid2Request`], so [`OutgoingCommand`](crate::OutgoingCommand) takes
/// these bytes for that one; decoded and encoded again they are still the same. Whoever knows that the firmware is
/// older than 2.73 decodes them with this type:
///
/// ```
/// use sbgc_proto::Message;
/// use sbgc_proto::commands::{AutoPid2LegacyRequest, AutoPid2StartupCfg};
///
/// let mut payload = [0; 73];
/// payload[50] = 1;
/// let message = AutoPid2LegacyRequest::decode(&payload)?;
/// assert_eq!(message.startup_cfg, AutoPid2StartupCfg::TuneGainOnly);
/// # Ok::<(), sbgc_proto::DecodeError>(())
/// ```
///
/// Otherwise like that one. The specification requires the configuration for starting only; libraries send it with
/// [`AutoPid2Action::Save`] too.
#[message(CMD_AUTO_PID2, outgoing, size = 73, length = 73, since = "2.70", answer = Confirm)]
pub struct AutoPid2LegacyRequest {
    /// Action to perform.
    pub action: AutoPid2Action,
    pub reserved: Reserved<10>,
    /// Version of the configuration that follows: 1.
    pub cfg_version: u8,
    /// Tuning settings of each axis.
    #[wire(group)]
    pub axes: PerAxis<AutoPid2LegacyAxis>,
    /// Tuning settings common to all axes.
    pub general_flags: AutoPid2GeneralFlags,
    /// Whether to tune each time the board starts.
    pub startup_cfg: AutoPid2StartupCfg,
    pub reserved2: Reserved<22>,
}

/// Tuning settings and results of one axis, second version. Firmware 2.70 to 2.72.
#[record(size = 12)]
#[derive(Copy)]
pub struct AutoPid2LegacyAxis {
    /// Whether and what to tune.
    pub axis_flags: AutoPid2AxisFlags,
    /// 0 for stability, 255 for performance.
    pub gain: u8,
    /// Strength of the test signal.
    pub stimulus: u8,
    /// Frequency up to which the axis is to work well.
    #[wire(unit = "Hz")]
    pub effective_freq: u8,
    /// Frequency that makes problems.
    #[wire(unit = "Hz")]
    pub problem_freq: u8,
    /// Margin to keep at that frequency.
    pub problem_margin: GainMargin,
    pub reserved: Reserved<6>,
}

/// Configuration of automatic tuning, presumably the answer to [`AutoPid2Action::Read`].
///
/// The layout is not published, so these bytes stay as they came.
#[message(CMD_AUTO_PID2, incoming, form = "undocumented", default, size = 0..=255)]
pub struct AutoPid2<'a> {
    /// Payload bytes.
    pub data: &'a [u8],
}

/// Action of automatic tuning, second version. Spec: `AUTO_PID2_ACTION`.
#[open_enum(u8, prefix = "ACTION_")]
pub enum AutoPid2Action {
    /// Tune, with this configuration but without saving it.
    Start = 1,
    /// Save this configuration in EEPROM and tune.
    StartSave = 2,
    /// Save this configuration in EEPROM.
    Save = 3,
    /// Stop tuning.
    Stop = 5,
    /// Read the configuration from EEPROM.
    Read = 6,
}

/// Whether to tune each time the board starts, in firmware 2.70 to 2.72. Spec: `AUTO_PID2_STARTUP_CFG`.
///
/// Firmware 2.73+ uses [`AutoPid2GeneralFlags`] instead.
#[open_enum(u8)]
pub enum AutoPid2StartupCfg {
    /// Do not.
    Disabled = 0,
    /// Tune the gain.
    TuneGainOnly = 1,
    /// Tune everything.
    TuneAll = 2,
}

/// Whether and what to tune on an axis. Spec: `AUTO_PID2_AXIS_FLAGS`.
#[bit_fields(u8)]
pub struct AutoPid2AxisFlags {
    /// The axis is tuned.
    #[wire(bits = 0)]
    pub enabled: bool,
    /// Its low-pass filter is tuned too.
    #[wire(bits = 1)]
    pub tune_lpf: bool,
    /// Number of notch filters to tune.
    #[wire(bits = 2..=3)]
    pub notch_num: u8,
}

flags! {
    /// Tuning options common to all axes. Spec: `AUTO_PID2_GENERAL_FLAGS`.
    pub struct AutoPid2GeneralFlags: u16 {
        /// Start from the present values.
        const START_FROM_CURRENT = 1 << 0;
        /// Save the result to all profiles.
        const SAVE_TO_ALL_PROFILES = 1 << 1;
        /// Tune the gain only.
        const TUNE_GAIN_ONLY = 1 << 2;
        /// Save the result automatically.
        const AUTO_SAVE = 1 << 4;
        /// Tune everything each time the board starts. Firmware 2.73+.
        const RUN_AT_START_TUNE_ALL = 1 << 14;
        /// Tune the gain each time the board starts. Firmware 2.73+.
        const RUN_AT_START_TUNE_GAIN = 1 << 15;
    }
}

flags! {
    /// Options of the action. Spec: `AUTO_PID2_CMD_FLAGS`. Firmware 2.73+.
    pub struct AutoPid2CmdFlags: u16 {
        /// Send the parameters when the tuning is done.
        const SEND_PARAMS_ON_FINISH = 1 << 0;
    }
}

flags! {
    /// Positions to tune at, firmware 2.73+. Spec: `AUTO_PID2_MULTI_POS_FLAGS`.
    pub struct AutoPid2Positions: u8 {
        /// The first.
        const POS1 = 1 << 0;
        /// The second.
        const POS2 = 1 << 1;
        /// The third.
        const POS3 = 1 << 2;
        /// The fourth.
        const POS4 = 1 << 3;
    }
}
