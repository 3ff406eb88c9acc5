//! What concerns the connection and the board as such: signatures, passwords, serial ports, and the commands whose
//! payload nobody has published.

mod debug_port;
mod protection;
mod serial;
#[cfg(test)]
mod tests;
mod unpublished;

pub use debug_port::*;
pub use protection::*;
pub use serial::*;
pub use unpublished::*;
