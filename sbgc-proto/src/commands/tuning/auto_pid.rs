//! Automatic PID tuning, first version.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::{AutoPidFlags, Confirm, ProfileId};
use crate::wire::{Float, PerAxis, Reserved};

/// Starts or stops automatic PID tuning, in firmware without the second version.
///
/// **The gimbal moves.** The board confirms the start. During the tuning, it reports the progress with [`AutoPid`] if
/// [`AutoPidFlags::SEND_GUI`] is set. At the end, it sends the parameters of the tuned profile, or of all profiles,
/// unsolicited (`CMD_READ_PARAMS_3` and the other blocks). The duration is not published. To stop, send the command
/// with all fields zero.
///
/// According to the specification, [`AutoPid2Request`](crate::commands::AutoPid2Request) replaces this command in
/// firmware 2.70; according to newer documents, in 2.73.
#[message(CMD_AUTO_PID, outgoing, size = 19, answer = Confirm)]
pub struct AutoPidRequest {
    /// Profile to tune, 1 to 5. The board activates the profile first and saves the result to it.
    pub profile_id: ProfileId,
    /// Axes to tune and progress options; without axes, the tuning stops.
    pub cfg_flags: AutoPidFlags,
    /// Goal of the tuning, from stability (0) to precise tracking (255).
    pub gain_vs_stability: u8,
    /// Weight of the camera: 1 for a light camera and strong motors, 255 for a heavy camera and weak motors, 0 to
    /// estimate it.
    pub momentum: u8,
    /// Action to perform.
    pub action: AutoPidAction,
    pub reserved: Reserved<14>,
}

/// Progress of automatic PID tuning, first version.
///
/// The vendor's libraries disagree on the layout; this is the one that most of them use, and it fits the
/// specification's table.
#[message(CMD_AUTO_PID, incoming, size = 57)]
pub struct AutoPid {
    /// Proportional gains.
    pub p: PerAxis<u8>,
    /// Integral gains.
    pub i: PerAxis<u8>,
    /// Derivative gains.
    pub d: PerAxis<u8>,
    /// Cut-off frequencies of the low-pass filters. The specification's table does not give their type.
    pub lpf_freq: PerAxis<u16>,
    /// Number of completed iterations.
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

/// Action of automatic PID tuning, first version. Spec: `AUTO_PID_ACTION`.
///
/// Only one value is published, without a name.
#[open_enum(u8)]
pub enum AutoPidAction {
    /// Starts tuning.
    Start = 0,
}
