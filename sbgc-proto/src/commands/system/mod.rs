//! System functions: signatures, passwords and serial ports.

mod debug_port;
mod protection;
mod serial;
#[cfg(test)]
mod tests;

pub use debug_port::*;
pub use protection::*;
pub use serial::*;
