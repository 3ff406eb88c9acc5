//! Calibrations and tuning as runs: what they need, their progress, and how they end.
//!
//! A [`CalibrationRun`] owns the motion while it lasts, so no control command disturbs it. Before it starts, it checks
//! whether the motors are on or off as they have to be; what a person has to prepare is in
//! [`Calibration::preparation`]. How a run is seen to end differs: a second confirmation, parameters that come unasked,
//! or the mode that real-time data reports; what the protocol leaves open is not relied upon.

mod kind;
mod run;
mod tune;

pub use kind::{Calibration, ReferenceAcceleration};
pub use run::{CalibrationRun, CalibrationState, Step};
pub use tune::{BodeTest, Tuning};
