//! Output pins and servo outputs.

use sbgc_proto_macros::{message, open_enum};

use crate::declare::flags;
use crate::units::ServoTime;
use crate::wire::List;

/// Sets the state of a pin.
///
/// Confirmed only if the pin has no other function and was actually driven, so the absence of an answer is a normal
/// result. For input states, newer firmware confirms with the pin id and the level, or -1 if the level is not
/// available.
#[message(CMD_TRIGGER_PIN, outgoing, size = 2)]
pub struct TriggerPin {
    /// Pin to set.
    pub pin_id: TriggerPinId,
    /// State to set.
    pub state: TriggerPinState,
}

/// Pin of the board or of a CAN module. Spec: `TRIGGER_PIN_ID`.
///
/// A pin that is in use as an input is not driven. The pins of CAN modules are available in newer firmware and come
/// from a single source.
#[open_enum(u8)]
pub enum TriggerPinId {
    /// Input of the ROLL channel.
    RcInputRoll = 1,
    /// Input of the PITCH channel.
    RcInputPitch = 2,
    /// Input for the ROLL signal of a flight controller.
    ExtFcInputRoll = 3,
    /// Input for the PITCH signal of a flight controller.
    ExtFcInputPitch = 4,
    /// Input of the YAW channel.
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
    /// Buzzer.
    #[wire(spec = "PIN_BUZZER")]
    Buzzer = 32,
    /// 3.3 V supply of the Spektrum connector; a low level turns it on.
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

/// State of a pin. Spec: `TRIGGER_PIN_STATE`.
#[open_enum(u8)]
pub enum TriggerPinState {
    /// Output, driven to ground; up to 40 mA.
    Low = 0,
    /// Output, driven to 3.3 V; up to 40 mA.
    High = 1,
    /// Floating (high impedance).
    #[wire(since = "2.66")]
    Floating = 2,
    /// Input with a pull-up resistor to 3.3 V.
    #[wire(since = "2.74.3")]
    PulledUp = 3,
    /// Input with a pull-down resistor to ground.
    #[wire(since = "2.74.3")]
    PulledDown = 4,
}

/// Sets the pulse times of all servo outputs.
///
/// Not confirmed.
///
/// Not every board has eight outputs. Newer documents divide the same 16 bytes into four times (outputs `EXT_FC_ROLL`,
/// `EXT_FC_PITCH`, `RC_PITCH`, `AUX1`) and 8 reserved bytes: set the last four times to 0 or below for those boards.
#[message(CMD_SERVO_OUT, outgoing, size = 16)]
pub struct ServoOut {
    /// Pulse time of each output. It must be shorter than the period set by the parameter `SERVO_RATE`.
    ///
    /// Typical servos accept 500 to 2500 with 1500 as the center, at a period of 20000 or less. In duty cycle mode
    /// (firmware 2.70b8+), 1000 is 0 % and 2000 is 100 %.
    #[wire(range = -1..=20000)]
    pub servo_time: [ServoTime; 8],
}

/// Sets the pulse times of selected servo outputs, including those of CAN drivers.
///
/// Not confirmed.
///
/// One of the vendor's libraries fails to send the bits; this is the layout of the others. Bits without a name are
/// preserved.
#[message(CMD_SERVO_OUT_EXT, outgoing, size = 4..=40, since = "2.73.2")]
pub struct ServoOutExt {
    /// Outputs to set.
    pub servo_bits: ServoOutputs,
    /// Pulse time of each selected output, lowest bit first; see [`ServoOut`] for the values.
    #[wire(range = -1..=20000, count = servo_bits.count())]
    pub servo_time: List<ServoTime, 32>,
}

flags! {
    /// Servo outputs. Spec: `SERVO_OUT_EXT_BITS`.
    pub struct ServoOutputs: u32 {
        /// Pin `EXT_FC_ROLL`.
        const SERVO1 = 1 << 0;
        /// Pin `EXT_FC_PITCH`.
        const SERVO2 = 1 << 1;
        /// Pin `RC_PITCH`.
        const SERVO3 = 1 << 2;
        /// Pin `AUX1`.
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
    /// Number of selected outputs.
    pub const fn count(self) -> usize {
        // At most 32.
        self.bits().count_ones() as usize
    }
}
