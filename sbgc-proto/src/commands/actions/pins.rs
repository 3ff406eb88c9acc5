//! Pins and servo outputs.

use sbgc_proto_macros::{message, open_enum};

use crate::declare::flags;
use crate::units::ServoTime;
use crate::wire::List;

/// Drives a pin.
///
/// It is confirmed only if the pin has no other function and was really driven, so no answer is a normal result. For
/// the states that are inputs, newer firmware confirms with the pin's id and its level, -1 where that is not available.
#[message(CMD_TRIGGER_PIN, outgoing, size = 2)]
pub struct TriggerPin {
    /// Pin to switch.
    pub pin_id: TriggerPinId,
    /// Action to perform on it.
    pub state: TriggerPinState,
}

/// A pin that can be driven. Spec: `TRIGGER_PIN_ID`.
///
/// A pin that is used as an input is not driven. Those of CAN modules belong to newer firmware; they are known from one
/// source.
#[open_enum(u8)]
pub enum TriggerPinId {
    /// The input of the ROLL channel.
    RcInputRoll = 1,
    /// The input of the PITCH channel.
    RcInputPitch = 2,
    /// The input for the flight controller's ROLL.
    ExtFcInputRoll = 3,
    /// The input for the flight controller's PITCH.
    ExtFcInputPitch = 4,
    /// The input of the YAW channel.
    RcInputYaw = 5,
    /// AUX1.
    #[wire(spec = "PIN_AUX1")]
    Aux1 = 16,
    /// AUX2.
    #[wire(spec = "PIN_AUX2")]
    Aux2 = 17,
    /// AUX3.
    #[wire(spec = "PIN_AUX3")]
    Aux3 = 18,
    /// The buzzer.
    #[wire(spec = "PIN_BUZZER")]
    Buzzer = 32,
    /// The 3.3 V supply of the Spektrum connector; low switches it on.
    #[wire(spec = "PIN_SSAT_POWER")]
    SsatPower = 33,
    /// AUX1 of CAN driver 1.
    #[wire(spec = "CAN_DRV1_AUX1")]
    CanDrv1Aux1 = 64,
    /// AUX2 of CAN driver 1.
    #[wire(spec = "CAN_DRV1_AUX2")]
    CanDrv1Aux2 = 65,
    /// AUX3 of CAN driver 1.
    #[wire(spec = "CAN_DRV1_AUX3")]
    CanDrv1Aux3 = 66,
    /// AUX1 of CAN driver 2.
    #[wire(spec = "CAN_DRV2_AUX1")]
    CanDrv2Aux1 = 67,
    /// AUX2 of CAN driver 2.
    #[wire(spec = "CAN_DRV2_AUX2")]
    CanDrv2Aux2 = 68,
    /// AUX3 of CAN driver 2.
    #[wire(spec = "CAN_DRV2_AUX3")]
    CanDrv2Aux3 = 69,
    /// AUX1 of CAN driver 3.
    #[wire(spec = "CAN_DRV3_AUX1")]
    CanDrv3Aux1 = 70,
    /// AUX2 of CAN driver 3.
    #[wire(spec = "CAN_DRV3_AUX2")]
    CanDrv3Aux2 = 71,
    /// AUX3 of CAN driver 3.
    #[wire(spec = "CAN_DRV3_AUX3")]
    CanDrv3Aux3 = 72,
    /// AUX1 of CAN driver 4.
    #[wire(spec = "CAN_DRV4_AUX1")]
    CanDrv4Aux1 = 73,
    /// AUX2 of CAN driver 4.
    #[wire(spec = "CAN_DRV4_AUX2")]
    CanDrv4Aux2 = 74,
    /// AUX3 of CAN driver 4.
    #[wire(spec = "CAN_DRV4_AUX3")]
    CanDrv4Aux3 = 75,
    /// AUX1 of CAN driver 5.
    #[wire(spec = "CAN_DRV5_AUX1")]
    CanDrv5Aux1 = 76,
    /// AUX2 of CAN driver 5.
    #[wire(spec = "CAN_DRV5_AUX2")]
    CanDrv5Aux2 = 77,
    /// AUX3 of CAN driver 5.
    #[wire(spec = "CAN_DRV5_AUX3")]
    CanDrv5Aux3 = 78,
    /// AUX1 of CAN driver 6.
    #[wire(spec = "CAN_DRV6_AUX1")]
    CanDrv6Aux1 = 79,
    /// AUX2 of CAN driver 6.
    #[wire(spec = "CAN_DRV6_AUX2")]
    CanDrv6Aux2 = 80,
    /// AUX3 of CAN driver 6.
    #[wire(spec = "CAN_DRV6_AUX3")]
    CanDrv6Aux3 = 81,
    /// AUX1 of CAN driver 7.
    #[wire(spec = "CAN_DRV7_AUX1")]
    CanDrv7Aux1 = 82,
    /// AUX2 of CAN driver 7.
    #[wire(spec = "CAN_DRV7_AUX2")]
    CanDrv7Aux2 = 83,
    /// AUX3 of CAN driver 7.
    #[wire(spec = "CAN_DRV7_AUX3")]
    CanDrv7Aux3 = 84,
    /// AUX1 of the CAN IMU.
    #[wire(spec = "CAN_IMU_AUX1")]
    CanImuAux1 = 85,
    /// AUX2 of the CAN IMU.
    #[wire(spec = "CAN_IMU_AUX2")]
    CanImuAux2 = 86,
    /// AUX1 of the CAN IMU on the frame.
    #[wire(spec = "CAN_IMU_FRAME_AUX1")]
    CanImuFrameAux1 = 88,
    /// AUX2 of the CAN IMU on the frame.
    #[wire(spec = "CAN_IMU_FRAME_AUX2")]
    CanImuFrameAux2 = 89,
}

/// State to give to a pin. Spec: `TRIGGER_PIN_STATE`.
#[open_enum(u8)]
pub enum TriggerPinState {
    /// Drives it to ground, up to 40 mA.
    Low = 0,
    /// Drives it to 3.3 V, up to 40 mA.
    High = 1,
    /// Lets it float.
    #[wire(since = "2.66")]
    Floating = 2,
    /// Makes it an input with a resistor to 3.3 V.
    #[wire(since = "2.74.3")]
    PulledUp = 3,
    /// Makes it an input with a resistor to ground.
    #[wire(since = "2.74.3")]
    PulledDown = 4,
}

/// Puts pulses on the servo outputs.
///
/// Not confirmed.
///
/// Not every board has eight outputs. Newer documents have four times (outputs `EXT_FC_ROLL`, `EXT_FC_PITCH`,
/// `RC_PITCH`, `AUX1`) and 8 reserved bytes in the same 16: leave the last four at 0 or below for those boards.
#[message(CMD_SERVO_OUT, outgoing, size = 16)]
pub struct ServoOut {
    /// Pulse time of each output, which must be shorter than the period that the parameter `SERVO_RATE` sets.
    ///
    /// Usual servos take 500 to 2500, 1500 in the middle, at a period of 20000 or less. Firmware 2.70b8+:, in the
    /// mode of duty cycles, 1000 is 0 % and 2000 is 100 %.
    #[wire(range = -1..=20000)]
    pub servo_time: [ServoTime; 8],
}

/// Puts pulses on chosen servo outputs, those of CAN drivers too.
///
/// Not confirmed.
///
/// One of the vendor's libraries forgets to send the bits; this is the layout of the others. More outputs than the
/// named ones are kept as they come.
#[message(CMD_SERVO_OUT_EXT, outgoing, size = 4..=40, since = "2.73.2")]
pub struct ServoOutExt {
    /// Outputs to set.
    pub servo_bits: ServoOutputs,
    /// Pulse time of each of them, lowest bit first; as in [`ServoOut`].
    #[wire(range = -1..=20000, count = servo_bits.count())]
    pub servo_time: List<ServoTime, 32>,
}

flags! {
    /// Servo outputs. Spec: `SERVO_OUT_EXT_BITS`.
    pub struct ServoOutputs: u32 {
        /// The pin `EXT_FC_ROLL`.
        const SERVO1 = 1 << 0;
        /// The pin `EXT_FC_PITCH`.
        const SERVO2 = 1 << 1;
        /// The pin `RC_PITCH`.
        const SERVO3 = 1 << 2;
        /// The pin `AUX1`.
        const SERVO4 = 1 << 3;
        /// Output 1 of CAN driver 1.
        const CAN_DRV1_SERVO1 = 1 << 4;
        /// Output 2 of CAN driver 1.
        const CAN_DRV1_SERVO2 = 1 << 5;
        /// Output 1 of CAN driver 2.
        const CAN_DRV2_SERVO1 = 1 << 6;
        /// Output 2 of CAN driver 2.
        const CAN_DRV2_SERVO2 = 1 << 7;
        /// Output 1 of CAN driver 3.
        const CAN_DRV3_SERVO1 = 1 << 8;
        /// Output 2 of CAN driver 3.
        const CAN_DRV3_SERVO2 = 1 << 9;
        /// Output 1 of CAN driver 4.
        const CAN_DRV4_SERVO1 = 1 << 10;
        /// Output 2 of CAN driver 4.
        const CAN_DRV4_SERVO2 = 1 << 11;
        /// Output 1 of CAN driver 5.
        const CAN_DRV5_SERVO1 = 1 << 12;
        /// Output 2 of CAN driver 5.
        const CAN_DRV5_SERVO2 = 1 << 13;
        /// Output 1 of CAN driver 6.
        const CAN_DRV6_SERVO1 = 1 << 14;
        /// Output 2 of CAN driver 6.
        const CAN_DRV6_SERVO2 = 1 << 15;
        /// Output 1 of CAN driver 7.
        const CAN_DRV7_SERVO1 = 1 << 16;
        /// Output 2 of CAN driver 7.
        const CAN_DRV7_SERVO2 = 1 << 17;
    }
}

impl ServoOutputs {
    /// Number of outputs.
    pub const fn count(self) -> usize {
        // At most 32.
        self.bits().count_ones() as usize
    }
}
