//! Finding good parameters of control: automatic tuning of the PID loops, and tests that measure the response.

mod auto_pid;
mod auto_pid2;
mod bode;
#[cfg(test)]
mod tests;

pub use auto_pid::*;
pub use auto_pid2::*;
pub use bode::*;
