//! Control with an owner: sessions that own the motion of a gimbal.
//!
//! A [`ControlSession`] keeps sending its newest [`Setpoint`] and has the board's own time-out armed meanwhile. However
//! it ends (dropped, cancelled, unwound by a panic, the whole process killed), the axes that it moved stop: either by
//! the session or by the board.
//!
//! Moves without an owner, which the board completes by itself, are
//! [`Gimbal::move_to`](crate::Gimbal::move_to) and [`Gimbal::confirm`](crate::Gimbal::confirm).

mod claim;
mod session;
mod setpoint;

pub(crate) use claim::Claim;
pub use session::{ControlSession, SessionOptions};
pub use setpoint::{ExtendedTarget, Setpoint};
