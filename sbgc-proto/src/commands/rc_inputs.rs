//! The signals of remote control inputs.

use sbgc_proto_macros::message;

use crate::commands::RcSource;
use crate::declare::flags;
use crate::units::RcSignal;
use crate::wire::List;

/// Requests the signals of some inputs.
#[message(CMD_READ_RC_INPUTS, outgoing, size = 3..=129, answer = RcInputs)]
pub struct ReadRcInputs {
    /// Options for reading the inputs.
    pub cfg_flags: RcInputsFlags,
    /// The inputs. At most 127 fit the answer; the vendor's libraries stop at 42.
    pub rc_src: List<RcSource, 127>,
}

/// Signals of the requested inputs.
#[message(CMD_READ_RC_INPUTS, incoming, size = 2..=254)]
pub struct RcInputs {
    /// The signals, in the order of the request.
    ///
    /// The specification gives -32767 for no signal, newer documents -32768; [`RcSignal::signal`] takes both for that.
    #[wire(range = -16384..=16384)]
    pub rc_val: List<RcSignal, 127>,
}

flags! {
    /// Options for reading inputs. Spec: `RC_INPUTS_CFG`.
    pub struct RcInputsFlags: u16 {
        /// Try to start an input that the controller has not used so far.
        const INIT_IF_UNUSED = 1 << 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Message;
    use crate::commands::RcSourceKind;

    /// Made by hand from the layout.
    #[test]
    fn inputs_are_answered_in_their_order() {
        let payload = [0x01, 0x80, 0x01, 0x22, 0x83];
        let request = ReadRcInputs::decode(&payload).unwrap();
        assert_eq!(
            request.cfg_flags,
            RcInputsFlags::INIT_IF_UNUSED | RcInputsFlags::from_bits_retain(0x8000)
        );
        assert_eq!(request.rc_src[..2], [RcSource::RC_INPUT_ROLL, RcSource::ADC2]);
        assert_eq!((request.rc_src[2].kind(), request.rc_src[2].channel()), (RcSourceKind::ApiVirt, 3));
        assert_eq!(request.encode(&mut [0; 255]), Ok(&payload[..]));
        assert!(ReadRcInputs::decode(&payload[..1]).is_err());

        let payload = [0x00, 0xC0, 0x01, 0x80, 0x00, 0x80];
        let inputs = RcInputs::decode(&payload).unwrap();
        let signals: Vec<_> = inputs.rc_val.iter().map(|value| value.signal()).collect();
        assert_eq!(signals, [Some(-1.0), None, None]);
        assert_eq!(inputs.encode(&mut [0; 255]), Ok(&payload[..]));
        assert_eq!(RcInputs::decode_prefix(&[1, 0, 2]).unwrap().1, [2]);
    }
}
