//! The Bode test: an axis is driven by a test signal, and signal and response are sent back.
//!
//! The specification has only the names; the payloads are those of one package of the vendor's.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::{Axis, Confirm};
use crate::wire::{Float, List, Reserved};

/// Starts a Bode test on one axis.
///
/// **The gimbal moves.** It needs motors that are on and a board that has this function. `CMD_CONFIRM` comes first,
/// which old firmware may leave out, then [`BodeTestData`] periodically unsolicited, and
/// [`BodeTestStartStop`] at the end, after `samples_num` times 0.8 ms. How to stop a test early is not known.
#[message(CMD_BODE_TEST_START_STOP, outgoing, form = "start", default, size = 30, answer = Confirm)]
pub struct BodeTestStartStopRequest {
    /// Which axis.
    pub axis: Axis,
    /// Kind of the test signal.
    pub stimulus_type: BodeStimulusType,
    /// Strength of the test signal.
    #[wire(range = 1..=65535)]
    pub stimulus_gain: u16,
    /// Highest frequency, not below `start_freq`.
    #[wire(unit = "Hz")]
    pub end_freq: u16,
    /// Measured system.
    pub system: BodeTestSystem,
    /// Length of the test in samples of 0.8 ms, at least 1. The vendor's package takes no less than 5000, which is 4 s.
    #[wire(range = 1..=4_294_967_295_u32)]
    pub samples_num: u32,
    /// Kept for later, zero.
    #[wire(range = 0..=0)]
    pub mode: u8,
    /// Minimum frequency. The vendor's package uses 3 Hz by default.
    #[wire(unit = "Hz")]
    pub start_freq: u16,
    pub reserved: Reserved<16>,
}

/// A Bode test has ended.
#[message(CMD_BODE_TEST_START_STOP, incoming, form = "finished", default, size = 22)]
pub struct BodeTestStartStop {
    /// Number of samples. Some firmware reports the number of the last sample, which is one less.
    pub samples_count: u32,
    /// 0 for success; what others mean is not known.
    pub error_code: u16,
    /// Kept for later.
    pub mode: u8,
    pub reserved: Reserved<15>,
}

/// Samples of a Bode test that is running.
///
/// They come unsolicited. Samples are raw numbers between the minimum and the maximum value that the message
/// names; [`values`](Self::values) gives what they stand for.
#[message(CMD_BODE_TEST_DATA, incoming, size = 17..=97)]
pub struct BodeTestData {
    /// Number of samples before these, modulo 256.
    pub sample_counter: u8,
    /// Input for raw 0.
    pub input_min: Float,
    /// Output for raw 0.
    pub output_min: Float,
    /// Input for raw 65534.
    pub input_max: Float,
    /// Output for raw 65534.
    pub output_max: Float,
    /// The samples.
    #[wire(group)]
    pub samples: List<BodeSample, 20>,
}

impl BodeTestData {
    /// Input and output of each sample.
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
    /// All frequencies at once.
    WhiteNoise = 1,
    /// A sine whose frequency rises.
    SineSweep = 2,
    /// A sine whose frequency rises exponentially.
    ExponentialSineSweep = 3,
}

/// System measured by a Bode test. Spec: `BODE_TEST_SYSTEM`.
///
/// The numbers look like sets of bits; only these are known.
#[open_enum(u8)]
pub enum BodeTestSystem {
    /// The controller.
    Controller = 3,
    /// The plant with the notch filters, in open loop.
    PlantWithNotchesOpenLoop = 6,
    /// Controller and plant, in open loop.
    ControllerAndPlantOpenLoop = 7,
    /// The response of the whole system.
    OverallSystemResponse = 11,
    /// The plant, in open loop.
    PlantOpenLoop = 70,
    /// The plant with the notch filters, in closed loop.
    PlantWithNotchesClosedLoop = 134,
    /// Controller and plant, in closed loop.
    ControllerAndPlantClosedLoop = 135,
    /// The plant, in closed loop.
    PlantClosedLoop = 198,
}
