//! The SimpleBGC32 serial protocol: framing and typed messages, for hosts and microcontrollers.
#![cfg_attr(not(any(feature = "std", test)), no_std)]

pub mod frame;
