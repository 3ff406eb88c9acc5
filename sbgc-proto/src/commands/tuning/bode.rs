//! Bode test: the board drives an axis with a test signal and reports signal and response.
//!
//! The specification defines only the names; the payloads are taken from a software package of the vendor.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::{Axis, Confirm};
use crate::wire::{Float, List, Reserved};

/// Starts a Bode test on one axis.
///
/// **The gimbal moves.** Requires [`BoardFeatures::BODE_TEST`](crate::commands::BoardFeatures::BODE_TEST) and motors
/// that are on. The board confirms the start, which old firmware may omit, then sends [`BodeTestData`] periodically and
/// [`BodeTestStartStop`] at the end, after `samples_num` times 0.8 ms. How to stop a test early is unknown.
#[message(CMD_BODE_TEST_START_STOP, outgoing, form = "start", default, size = 30, answer = Confirm)]
pub struct BodeTestStartStopRequest {
    /// Axis to test.
    pub axis: Axis,
    /// Kind of test signal.
    pub stimulus_type: BodeStimulusType,
    /// Strength of the test signal.
    #[wire(range = 1..=65535)]
    pub stimulus_gain: u16,
    /// Maximum frequency, not below `start_freq`.
    #[wire(unit = "Hz")]
    pub end_freq: u16,
    /// Measured system.
    pub system: BodeTestSystem,
    /// Length of the test in samples of 0.8 ms, at least 1. The vendor's software accepts 5000 (4 s) and more.
    #[wire(range = 1..=4_294_967_295_u32)]
    pub samples_num: u32,
    /// Reserved for future use; must be 0.
    #[wire(range = 0..=0)]
    pub mode: u8,
    /// Minimum frequency. The vendor's software uses 3 Hz by default.
    #[wire(unit = "Hz")]
    pub start_freq: u16,
    pub reserved: Reserved<16>,
}

/// End of a Bode test.
#[message(CMD_BODE_TEST_START_STOP, incoming, form = "finished", default, size = 22)]
pub struct BodeTestStartStop {
    /// Number of samples. Some firmware reports the index of the last sample instead, which is one less.
    pub samples_count: u32,
    /// Error code: 0 for success; the meaning of other values is unknown.
    pub error_code: u16,
    /// Reserved for future use.
    pub mode: u8,
    pub reserved: Reserved<15>,
}

/// Samples of a running Bode test.
///
/// Sent unsolicited. Samples are raw numbers, scaled between the minimum and the maximum value in the message;
/// [`values`](Self::values) converts them.
#[message(CMD_BODE_TEST_DATA, incoming, size = 17..=97)]
pub struct BodeTestData {
    /// Number of preceding samples, modulo 256.
    pub sample_counter: u8,
    /// Input value of raw 0.
    pub input_min: Float,
    /// Output value of raw 0.
    pub output_min: Float,
    /// Input value of raw 65534.
    pub input_max: Float,
    /// Output value of raw 65534.
    pub output_max: Float,
    /// Samples.
    #[wire(group)]
    pub samples: List<BodeSample, 20>,
}

impl BodeTestData {
    /// Input and output value of each sample.
    pub fn values(&self) -> impl Iterator<Item = (f32, f32)> + '_ {
        let value =
            |raw: u16, min: Float, max: Float| f32::from(raw) * (max.get() - min.get()) / 65534.0 + min.get();
        self.samples.iter().map(move |sample| {
            (
                value(sample.input, self.input_min, self.input_max),
                value(sample.output, self.output_min, self.output_max),
            )
        })
    }
}

/// One sample of a Bode test, raw.
#[record(size = 4)]
#[derive(Copy)]
pub struct BodeSample {
    /// Input sample.
    pub input: u16,
    /// Output sample.
    pub output: u16,
}

/// Kind of test signal. Spec: `BODE_STIMULUS_TYPE`.
#[open_enum(u8)]
pub enum BodeStimulusType {
    /// White noise: all frequencies at once.
    WhiteNoise = 1,
    /// Sine with rising frequency.
    SineSweep = 2,
    /// Sine with exponentially rising frequency.
    ExponentialSineSweep = 3,
}

/// System measured by a Bode test. Spec: `BODE_TEST_SYSTEM`.
///
/// The numbers appear to be sets of bits; only these are published.
#[open_enum(u8)]
pub enum BodeTestSystem {
    /// Controller.
    Controller = 3,
    /// Plant with notch filters, open loop.
    PlantWithNotchesOpenLoop = 6,
    /// Controller and plant, open loop.
    ControllerAndPlantOpenLoop = 7,
    /// Response of the whole system.
    OverallSystemResponse = 11,
    /// Plant, open loop.
    PlantOpenLoop = 70,
    /// Plant with notch filters, closed loop.
    PlantWithNotchesClosedLoop = 134,
    /// Controller and plant, closed loop.
    ControllerAndPlantClosedLoop = 135,
    /// Plant, closed loop.
    PlantClosedLoop = 198,
}
