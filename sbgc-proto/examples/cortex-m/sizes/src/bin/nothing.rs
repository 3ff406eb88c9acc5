//! The program that does nothing: what the start-up code takes, which the others are compared with.
#![no_std]
#![no_main]

use sizes::{receive, send};

#[cortex_m_rt::entry]
fn main() -> ! {
    loop {
        send(receive());
    }
}
