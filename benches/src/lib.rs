//! Benchmarks of the sbgc workspace.
