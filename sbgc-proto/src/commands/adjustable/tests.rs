//! Messages of adjustable variables byte by byte.

use super::*;
use crate::commands::*;
use crate::units::{FirmwareVersion, RcSignal};
use crate::wire::{FromWire, ToWire};
use crate::{DecodeError, Message};

fn whole<'p, M: Message + FromWire<'p> + ToWire>(payload: &'p [u8]) -> M {
    let (message, rest) = M::decode_prefix(payload).unwrap();
    assert!(rest.is_empty());
    assert_eq!(message.encode(&mut [0; 255]), Ok(payload));
    message
}

fn pairs(values: &AdjVarsVal) -> Vec<(AdjustableVariable, i32)> {
    values.params.iter().map(|value| (value.param_id, value.param_value)).collect()
}

#[test]
fn values_are_set_by_number() {
    use AdjustableVariable::{PidGainPitch, PidGainRoll, PidGainYaw, RcSpeedPitch, RcSpeedRoll, RcSpeedYaw};
    // From the vendor's published example commands.
    let speed = [3, 0x13, 0x64, 0, 0, 0, 0x14, 0x64, 0, 0, 0, 0x15, 0x64, 0, 0, 0];
    let set: SetAdjVarsVal = whole(&speed);
    assert_eq!(pairs(&set.0), [(RcSpeedRoll, 100), (RcSpeedPitch, 100), (RcSpeedYaw, 100)]);
    let gain = [3, 0x2A, 0x46, 0, 0, 0, 0x2B, 0x46, 0, 0, 0, 0x2C, 0x46, 0, 0, 0];
    let values: AdjVarsVal = whole(&gain);
    assert_eq!(pairs(&values), [(PidGainRoll, 70), (PidGainPitch, 70), (PidGainYaw, 70)]);

    // Made by hand from the layout.
    let get: GetAdjVarsVal = whole(&[2, 0x13, 0xF0]);
    assert_eq!(&get.param_id[..], [RcSpeedRoll, AdjustableVariable::Unknown(0xF0)]);
    let nan: SetAdjVarsValF = whole(&[1, 9, 1, 0, 0xC0, 0x7F]);
    assert_eq!(nan.0.params[0].param_value.bits(), 0x7FC0_0001);
    assert_eq!(whole::<GetAdjVarsValF>(&[1, 9]).param_id[0], AdjustableVariable::PowerRoll);
    assert!(matches!(AdjVarsVal::decode(&speed[..15]), Err(DecodeError::Truncated { .. })));
}

#[test]
fn most_values_fill_201_bytes() {
    let mut payload = [0; 201];
    payload[0] = 40;
    assert_eq!(whole::<SetAdjVarsVal>(&payload).0.params.len(), 40);
    assert!(AdjVarsValF::decode(&[41; 206]).is_err());
}

#[test]
fn slots_are_10_and_15() {
    let payload: [u8; 128] = core::array::from_fn(|index| u8::try_from(index + 100).unwrap());
    let config: AdjVarsCfg = whole(&payload);
    assert_eq!(config.trigger_slots[1].trigger_src_ch, RcSource(106));
    assert_eq!(config.trigger_slots[9].trigger_action[4], MenuCommand::Unknown(159));
    let analog =
        AnalogSlot { analog_src_ch: RcSource(160), var_id: VariableTarget(161), min_val: 162, max_val: 163 };
    assert_eq!(config.analog_slots[0], analog);
    assert_eq!(analog.var_id.variable(), AdjustableVariable::FollowExpoRate);
    assert!(analog.var_id.multiplies());
    assert_eq!(config.reserved.0[7], 227);
    assert_eq!(whole::<WriteAdjVarsCfg>(&payload).0, config);
    assert_eq!(
        AdjVarsCfg::decode(&payload[1..]),
        Err(DecodeError::TooShort { command: "CMD_READ_ADJ_VARS_CFG", needed: 128, got: 127 })
    );
}

#[test]
fn length_tells_requests_of_state_apart() {
    assert!(AdjVarsStateLegacyRequest::accepts(2) && !AdjVarsStateLegacyRequest::accepts(7));
    assert!(AdjVarsStateRequest::accepts(7) && !AdjVarsStateRequest::accepts(2));
    let legacy = AdjVarsStateLegacyRequest { trigger_slot: 9, analog_slot: 14 };
    assert_eq!(whole::<AdjVarsStateLegacyRequest>(&[9, 14]), legacy);
    let request: AdjVarsStateRequest = whole(&[9, 33, 1, 25, 0x81, 0, 66]);
    assert_eq!(request.analog_src_id.source(), RcSource::ADC1);
    assert_eq!(request.analog_src_id, WideRcSource(0x0121));
    assert_eq!(request.lut_src_id, RcSource::API_VIRT_CH.with_channel(1).into());
    assert_eq!(request.lut_var_id, AdjustableVariable::RcLimitMinRoll);
}

#[test]
fn states_of_both_forms_are_15_bytes() {
    let payload = [0x00, 0xC0, 7, 0x00, 0x80, 0, 0, 0xC8, 0x42, 0x00, 0x40, 1, 2, 3, 4];
    let state: AdjVarsState = whole(&payload);
    assert_eq!(state.trigger_rc_data, RcSignal(-16384));
    assert_eq!(state.trigger_action, MenuCommand::Reset);
    assert_eq!(state.analog_src_value, RcSignal::UNDEFINED);
    assert_eq!(state.analog_var_value, 100.0.into());
    assert_eq!(state.lut_src_value, RcSignal(16384));
    assert_eq!(state.lut_var_value.bits(), 0x0403_0201);

    let legacy: AdjVarsStateLegacy = whole(&payload);
    assert_eq!(legacy.analog_rc_data, -32768);
    assert_eq!(legacy.analog_value, 0x42C8_0000);
    assert_eq!(legacy.reserved.0, [0x00, 0x40, 1, 2, 3, 4]);
}

#[test]
fn a_page_of_variables_ends_with_the_payload() {
    let payload = [
        102, 36, 4, b'G', b'Y', b'R', b'O', 0, 0, 255, 0, 50, 0, 0, 0, 200, 0, 0, 0x80, 0xFF, 0x7F, 0xFF,
        0xFF, 0xFF, 0xFF,
    ];
    let page: AdjVarsInfo<'_> = whole(&payload);
    assert_eq!(page.total_number, 102);
    assert_eq!(page.vars.len(), 2);
    let (first, second) = (page.vars.get(0).unwrap(), page.vars.get(1).unwrap());
    assert_eq!(first.var_id, AdjustableVariable::GyroTrust);
    assert_eq!(first.name.as_str(), Ok("GYRO"));
    assert_eq!((first.range_max, first.value), (255, 50));
    assert_eq!((second.range_min, second.range_max, second.value), (-32768, 32767, -1));
    assert_eq!(AdjVarsInfo::decode_prefix(&payload[..20]).unwrap().1, &payload[15..20]);

    assert_eq!(whole::<AdjVarsInfoRequest>(&[]).start_id, None);
    assert_eq!(whole::<AdjVarsInfoRequest>(&[36]).start_id, Some(AdjustableVariable::GyroTrust));
}

#[test]
fn all_or_some_variables_are_saved() {
    assert!(SaveParams3::accepts(0) && !SaveParams3::accepts(1));
    assert!(SaveParams3Extended::accepts(1) && !SaveParams3Extended::accepts(0));
    whole::<SaveParams3>(&[]);
    assert_eq!(whole::<SaveParams3Extended>(&[7; 255]).adj_var_id.len(), 255);
}

#[test]
fn facts_of_variables_are_in_order() {
    assert_eq!(AdjustableVariable::ALL.len(), 102);
    for (id, facts) in (0_u8..).zip(AdjustableVariable::ALL) {
        assert_eq!(facts.variable.raw(), id);
        assert!(facts.range.is_none_or(|(least, most)| least < most));
    }
    let lpf = AdjustableVariable::RcLpfRoll.facts().unwrap();
    assert_eq!((lpf.ty, lpf.range, lpf.newer_most), (VariableType::u8, Some((0, 15)), Some(255)));
    assert_eq!(AdjustableVariable::RcModeRoll.facts().unwrap().range, None);
    assert_eq!(AdjustableVariable::HCorrFactor.facts().unwrap().since, Some(FirmwareVersion::new(2, 68, 7)));
    assert_eq!(AdjustableVariable::Unknown(102).facts(), None);
}
