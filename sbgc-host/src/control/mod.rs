//! Control with an owner: sessions that own the motion of a gimbal.
//!
//! A [`ControlSession`] keeps sending its newest [`Setpoint`] and has the board's own time-out armed meanwhile. However
//! it ends (dropped, cancelled, unwound by a panic, the whole process killed), the axes that it moved stop: either by
//! the session or by the board.
//!
//! Moves without an owner, which the board completes by itself, are
//! [`Gimbal::hand_over`](crate::Gimbal::hand_over) and [`Gimbal::move_to`](crate::Gimbal::move_to).

mod claim;
mod hand_over;
mod session;
mod setpoint;

pub(crate) use claim::Claim;
pub use hand_over::stop_commands;
pub use session::{ControlSession, SessionOptions};
pub use setpoint::{ExtendedTarget, Setpoint};
