//! Async driver for SimpleBGC32 boards.
