//! Automatic PID tuning, second version.

use sbgc_proto_macros::{bit_fields, message, open_enum, record};

use crate::commands::Confirm;
use crate::declare::flags;
use crate::units::{GainMargin, TestAngle, TestFrequencyFrom, TestFrequencyTo};
use crate::wire::{PerAxis, Reserved};

/// Stops automatic PID tuning or reads its configuration.
///
/// This form is for all actions without a configuration. Confirmed once, immediately; an action that is not possible is
/// answered by `CMD_ERROR` with an [`AutoPid2Error`](crate::commands::AutoPid2Error) instead.
#[message(CMD_AUTO_PID2, outgoing, form = "simple", default, size = 11, length = 11, since = "2.70", answer = Confirm)]
pub struct AutoPid2SimpleRequest {
    /// Action to perform.
    pub action: AutoPid2Action,
    pub reserved: Reserved<10>,
}

/// Starts automatic PID tuning or saves its configuration.
///
/// **The gimbal moves.** The board immediately sends one `CMD_CONFIRM`, or `CMD_ERROR` with an
/// [`AutoPid2Error`](crate::commands::AutoPid2Error). At the end, it sends the parameters of the active profile
/// unsolicited (`CMD_READ_PARAMS_3` and the other blocks). The duration is not published.
///
/// Firmware 2.70 to 2.72 has another layout of the same length and with the same version byte,
/// [`AutoPid2LegacyRequest`]. Only the firmware version distinguishes them. According to the change log of one library,
/// the layout here applies from 2.73.1 on.
#[message(CMD_AUTO_PID2, outgoing, form = "newer", size = 73, since = "2.73", answer = Confirm)]
pub struct AutoPid2Request {
    /// Action to perform.
    pub action: AutoPid2Action,
    /// Options of the action.
    pub cmd_flags: AutoPid2CmdFlags,
    pub reserved: Reserved<8>,
    /// Version of the following configuration: 1.
    pub cfg_version: u8,
    /// Tuning settings of each axis.
    #[wire(group)]
    pub axes: PerAxis<AutoPid2Axis>,
    /// Tuning settings common to all axes.
    pub general_flags: AutoPid2GeneralFlags,
    pub reserved2: Reserved<1>,
    /// Minimum frequency of the test.
    pub test_freq_from: TestFrequencyFrom,
    /// Maximum frequency of the test. A comment in one library gives a unit of 1 Hz; two others use 2 Hz, as here.
    pub test_freq_to: TestFrequencyTo,
    /// Positions to tune at, of those in `multi_pos_angle`.
    pub multi_pos_flags: AutoPid2Positions,
    /// Angles of the positions.
    pub multi_pos_angle: [TestAngle; 4],
    pub reserved3: Reserved<12>,
}

/// Tuning settings and results of one axis, second version.
#[record(size = 13)]
#[derive(Copy)]
pub struct AutoPid2Axis {
    /// Tuning options of the axis.
    pub axis_flags: AutoPid2AxisFlags,
    /// Goal of the tuning, from stability (0) to performance (255).
    pub gain: u8,
    /// Strength of the test signal.
    pub stimulus_gain: u16,
    /// Frequency up to which the axis should perform well.
    #[wire(unit = "Hz")]
    pub effective_freq: u8,
    /// Problematic frequency.
    #[wire(unit = "Hz")]
    pub problem_freq: u8,
    /// Gain margin to keep at the problematic frequency.
    pub problem_margin: GainMargin,
    pub reserved: Reserved<6>,
}

/// Starts automatic PID tuning or saves its configuration, in firmware 2.70 to 2.72.
///
/// Length and version byte equal those of [`AutoPid2Request`], so [`OutgoingCommand`](crate::OutgoingCommand) decodes
/// these bytes as the latter, which does not change them when they are encoded again. If the firmware is known to be
/// older than 2.73, decode them with this type:
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
/// Otherwise like [`AutoPid2Request`]. The specification requires the configuration to start tuning only; libraries
/// send it with [`AutoPid2Action::Save`], too.
#[message(CMD_AUTO_PID2, outgoing, size = 73, length = 73, since = "2.70", answer = Confirm)]
pub struct AutoPid2LegacyRequest {
    /// Action to perform.
    pub action: AutoPid2Action,
    pub reserved: Reserved<10>,
    /// Version of the following configuration: 1.
    pub cfg_version: u8,
    /// Tuning settings of each axis.
    #[wire(group)]
    pub axes: PerAxis<AutoPid2LegacyAxis>,
    /// Tuning settings common to all axes.
    pub general_flags: AutoPid2GeneralFlags,
    /// Tuning at each start of the board.
    pub startup_cfg: AutoPid2StartupCfg,
    pub reserved2: Reserved<22>,
}

/// Tuning settings and results of one axis, second version. Firmware 2.70 to 2.72.
#[record(size = 12)]
#[derive(Copy)]
pub struct AutoPid2LegacyAxis {
    /// Tuning options of the axis.
    pub axis_flags: AutoPid2AxisFlags,
    /// Goal of the tuning, from stability (0) to performance (255).
    pub gain: u8,
    /// Strength of the test signal.
    pub stimulus: u8,
    /// Frequency up to which the axis should perform well.
    #[wire(unit = "Hz")]
    pub effective_freq: u8,
    /// Problematic frequency.
    #[wire(unit = "Hz")]
    pub problem_freq: u8,
    /// Gain margin to keep at the problematic frequency.
    pub problem_margin: GainMargin,
    pub reserved: Reserved<6>,
}

/// Configuration of automatic PID tuning, presumably the answer to [`AutoPid2Action::Read`].
///
/// The layout is not published, so the bytes are kept raw.
#[message(CMD_AUTO_PID2, incoming, form = "undocumented", default, size = 0..=255)]
pub struct AutoPid2<'a> {
    /// Payload bytes.
    pub data: &'a [u8],
}

/// Action of automatic PID tuning, second version. Spec: `AUTO_PID2_ACTION`.
#[open_enum(u8, prefix = "ACTION_")]
pub enum AutoPid2Action {
    /// Starts tuning with this configuration, without saving it.
    Start = 1,
    /// Saves this configuration in EEPROM and starts tuning.
    StartSave = 2,
    /// Saves this configuration in EEPROM.
    Save = 3,
    /// Stops tuning.
    Stop = 5,
    /// Reads the configuration from EEPROM.
    Read = 6,
}

/// Tuning at each start of the board, in firmware 2.70 to 2.72. Spec: `AUTO_PID2_STARTUP_CFG`.
///
/// Firmware 2.73+ uses [`AutoPid2GeneralFlags`] instead.
#[open_enum(u8)]
pub enum AutoPid2StartupCfg {
    /// No tuning.
    Disabled = 0,
    /// Tunes the gain only.
    TuneGainOnly = 1,
    /// Tunes all values.
    TuneAll = 2,
}

/// Tuning options of an axis. Spec: `AUTO_PID2_AXIS_FLAGS`.
#[bit_fields(u8)]
pub struct AutoPid2AxisFlags {
    /// Whether the axis is tuned.
    #[wire(bits = 0)]
    pub enabled: bool,
    /// Whether the low-pass filter of the axis is tuned, too.
    #[wire(bits = 1)]
    pub tune_lpf: bool,
    /// Number of notch filters to tune.
    #[wire(bits = 2..=3)]
    pub notch_num: u8,
}

flags! {
    /// Tuning options common to all axes. Spec: `AUTO_PID2_GENERAL_FLAGS`.
    pub struct AutoPid2GeneralFlags: u16 {
        /// Starts from the current values.
        const START_FROM_CURRENT = 1 << 0;
        /// Saves the result to all profiles.
        const SAVE_TO_ALL_PROFILES = 1 << 1;
        /// Tunes the gain only.
        const TUNE_GAIN_ONLY = 1 << 2;
        /// Saves the result automatically.
        const AUTO_SAVE = 1 << 4;
        /// Tunes all values at each start of the board. Firmware 2.73+.
        const RUN_AT_START_TUNE_ALL = 1 << 14;
        /// Tunes the gain at each start of the board. Firmware 2.73+.
        const RUN_AT_START_TUNE_GAIN = 1 << 15;
    }
}

flags! {
    /// Options of the action. Spec: `AUTO_PID2_CMD_FLAGS`. Firmware 2.73+.
    pub struct AutoPid2CmdFlags: u16 {
        /// Sends the parameters at the end of the tuning.
        const SEND_PARAMS_ON_FINISH = 1 << 0;
    }
}

flags! {
    /// Positions to tune at. Spec: `AUTO_PID2_MULTI_POS_FLAGS`. Firmware 2.73+.
    pub struct AutoPid2Positions: u8 {
        /// Position 1.
        const POS1 = 1 << 0;
        /// Position 2.
        const POS2 = 1 << 1;
        /// Position 3.
        const POS3 = 1 << 2;
        /// Position 4.
        const POS4 = 1 << 3;
    }
}
