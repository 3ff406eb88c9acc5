//! The `sbgc` command-line tool.
fn main() {}
