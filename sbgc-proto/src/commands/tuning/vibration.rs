//! The vibration test, whose payloads are not published.
//!
//! Nor is it known which way its commands go, so each is here in both directions.

use sbgc_proto_macros::message;

/// By its name, starts or stops a vibration test; its payload is not published.
#[message(CMD_VIBRATION_TEST_START_STOP, outgoing, size = 0..=255)]
pub struct VibrationTestStartStopRequest<'a> {
    /// The payload.
    pub data: &'a [u8],
}

/// By its name, tells that a vibration test has started or stopped; its payload is not published.
#[message(CMD_VIBRATION_TEST_START_STOP, incoming, size = 0..=255)]
pub struct VibrationTestStartStop<'a> {
    /// The payload.
    pub data: &'a [u8],
}

/// Concerns the samples of a vibration test; its payload is not published.
#[message(CMD_VIBRATION_TEST_DATA, outgoing, size = 0..=255)]
pub struct VibrationTestDataRequest<'a> {
    /// The payload.
    pub data: &'a [u8],
}

/// By its name, samples of a vibration test; its payload is not published.
#[message(CMD_VIBRATION_TEST_DATA, incoming, size = 0..=255)]
pub struct VibrationTestData<'a> {
    /// The payload.
    pub data: &'a [u8],
}
