//! Automatic tuning of the PID loops, first version.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::{AutoPidFlags, Confirm, ProfileId};
use crate::wire::{Float, PerAxis, Reserved};

/// Starts or stops automatic tuning, in firmware that does not have the second version yet.
///
/// **The gimbal moves.** One `CMD_CONFIRM` comes at the start. While it runs, [`AutoPid`] tells the progress if
/// [`AutoPidFlags::SEND_GUI`] is set. When it is done the board sends the parameters of the profile that was tuned, or
/// of all profiles, unsolicited (`CMD_READ_PARAMS_3` and the other blocks). How long it takes is not published.
/// A command of zeros stops it.
///
/// By the specification it is replaced by [`AutoPid2Request`](crate::commands::AutoPid2Request) in firmware 2.70; newer
/// documents say 2.73.
#[message(CMD_AUTO_PID, outgoing, size = 19, answer = Confirm)]
pub struct AutoPidRequest {
    /// The profile to tune, the first to the fifth. The board goes to it before and saves the result there.
    pub profile_id: ProfileId,
    /// Axes to tune and progress options. No axis stops the tuning.
    pub cfg_flags: AutoPidFlags,
    /// 0 for stability, 255 for precise tracking.
    pub gain_vs_stability: u8,
    /// 0 to find it out, 1 for a light camera and strong motors, 255 for a heavy camera and weak motors.
    pub momentum: u8,
    /// Action to perform.
    pub action: AutoPidAction,
    pub reserved: Reserved<14>,
}

/// Progress of automatic tuning, first version.
///
/// The vendor's libraries divide it differently; this is the reading of most of them, which also fits the
/// specification's table.
#[message(CMD_AUTO_PID, incoming, size = 57)]
pub struct AutoPid {
    /// Proportional gains.
    pub p: PerAxis<u8>,
    /// Integral gains.
    pub i: PerAxis<u8>,
    /// Derivative gains.
    pub d: PerAxis<u8>,
    /// Cut-off frequencies of the low-pass filters. The specification's table has lost their type.
    pub lpf_freq: PerAxis<u16>,
    /// Number of iterations so far.
    pub iteration_cnt: u16,
    /// Tracking error of each axis.
    #[wire(group)]
    pub axes: PerAxis<AutoPidError>,
    pub reserved: Reserved<10>,
}

/// Tracking error of one axis during tuning.
#[record(size = 10)]
#[derive(Copy)]
pub struct AutoPidError {
    /// Difference between the desired and the actual response.
    pub tracking_error: Float,
    pub reserved: Reserved<6>,
}

/// Action of automatic tuning, first version. Spec: `AUTO_PID_ACTION`.
///
/// Only one value is known, and the specification gives it no name.
#[open_enum(u8)]
pub enum AutoPidAction {
    /// Tune.
    Start = 0,
}
