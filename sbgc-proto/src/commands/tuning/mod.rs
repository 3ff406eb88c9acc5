//! Tuning of the control loops: automatic PID tuning and Bode tests.

mod auto_pid;
mod auto_pid2;
mod bode;
#[cfg(test)]
mod tests;

pub use auto_pid::*;
pub use auto_pid2::*;
pub use bode::*;
