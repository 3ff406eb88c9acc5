//! Remote control: sources, what is mixed into them, and what they trigger.

use sbgc_proto::commands::{
    ApiVirtChHighRes, ExecuteMenu, ExtraButton, FcMix, FcMixTarget, InterruptConfig, MenuCommand, Params3,
    ParamsExt2, ParamsExt3, ProfileId, RcInputs, RcSource, ReadParams3, ReadParamsExt2, ReadParamsExt3,
    ReadRcInputs, RealtimeData3, RealtimeData3Request, StepCount, StepSignal, StepSignalConfig,
    StepSignalMode, TriggerPin, TriggerPinId, TriggerPinState, WriteParams3, WriteParamsExt2,
    WriteParamsExt3,
};
use sbgc_proto::units::RcSignal;

use super::{Bench, ms};
use crate::sim::Config;

fn change(bench: &mut Bench, change: impl FnOnce(&mut Params3)) {
    let mut block = bench.ask_one(&ReadParams3 { profile_id: ProfileId::Current }).decoded::<Params3>();
    change(&mut block);
    bench.ask(&WriteParams3(block));
}

fn change_2(bench: &mut Bench, change: impl FnOnce(&mut ParamsExt2)) {
    let mut block = bench.ask_one(&ReadParamsExt2 { profile_id: ProfileId::Current }).decoded::<ParamsExt2>();
    change(&mut block);
    bench.ask(&WriteParamsExt2(block));
}

/// Virtual channels 1 and 2.
fn channels(bench: &mut Bench, first: f32, second: f32) {
    let api_virt_ch = [first, second].map(RcSignal::from_fraction).into_iter().collect();
    assert_eq!(bench.ask(&ApiVirtChHighRes { api_virt_ch }), []);
    bench.run(ms(16));
}

fn signal(bench: &mut Bench, source: u8) -> RcSignal {
    let request =
        ReadRcInputs { rc_src: [RcSource(source)].into_iter().collect(), ..ReadRcInputs::default() };
    bench.ask_one(&request).decoded::<RcInputs>().rc_val[0]
}

fn profile(bench: &mut Bench) -> u8 {
    bench.ask_one(&RealtimeData3Request {}).decoded::<RealtimeData3>().cur_profile.raw()
}

fn angle(bench: &Bench, axis: usize) -> f64 {
    bench.board.motion().axes().into_array()[axis].angle
}

#[test]
fn the_command_channel_has_three_levels_with_an_action_each() {
    let mut bench = Bench::new(Config::default());
    change(&mut bench, |params| {
        params.rc_map_cmd = RcSource(129);
        params.rc_cmd_low = MenuCommand::Profile2;
        params.rc_cmd_mid = MenuCommand::Profile3;
        params.rc_cmd_high = MenuCommand::Profile4;
    });
    // The profile that follows has its own channel: the same one in all of them.
    for profile in 1..=3 {
        let request = ReadParams3 { profile_id: ProfileId::Current };
        let mut block = bench.ask_one(&request).decoded::<Params3>();
        block.profile_id = ProfileId::from(profile);
        bench.ask(&WriteParams3(block));
    }
    for (level, expected) in [(0.0, 2), (0.9, 3), (-0.9, 1), (0.1, 2)] {
        channels(&mut bench, level, 0.0);
        assert_eq!(profile(&mut bench), expected, "{level}");
    }
    // An action is run once, when the level is reached.
    bench.ask_one(&ExecuteMenu { cmd_id: MenuCommand::Profile4 });
    channels(&mut bench, 0.2, 0.0);
    assert_eq!(profile(&mut bench), 3);
}

#[test]
fn the_signal_of_a_flight_controller_is_mixed_in() {
    for (rate, expected) in [(0, 45.0), (63, -18.0), (21, 24.0)] {
        let mut bench = Bench::new(Config::default());
        change(&mut bench, |params| {
            params.rc_map_pitch = RcSource(129);
            params.rc_map_fc_roll = RcSource(130);
            params.rc_mix_fc_roll = FcMix::default().with_rate(rate).with_target(FcMixTarget::Pitch);
        });
        channels(&mut bench, 0.5, -0.2);
        bench.run(ms(3000));
        assert!((angle(&bench, 1) - expected).abs() < 0.1, "{rate}: {}", angle(&bench, 1));
        assert!(angle(&bench, 0).abs() < 0.1, "it is mixed into one axis alone");
    }
}

#[test]
fn the_menu_swaps_the_sources_of_two_axes() {
    let mut bench = Bench::new(Config::default());
    change(&mut bench, |params| {
        params.rc_map_pitch = RcSource(129);
        params.rc_map_roll = RcSource(130);
    });
    channels(&mut bench, 0.2, 0.0);
    bench.run(ms(2000));
    assert!((angle(&bench, 1) - 18.0).abs() < 0.1 && angle(&bench, 0).abs() < 0.1);
    bench.ask_one(&ExecuteMenu { cmd_id: MenuCommand::SwapPitchRoll });
    bench.run(ms(2000));
    assert!((angle(&bench, 0) - 18.0).abs() < 0.1 && angle(&bench, 1).abs() < 0.1);
    bench.ask_one(&ExecuteMenu { cmd_id: MenuCommand::SwapPitchRoll });
    bench.run(ms(2000));
    assert!((angle(&bench, 1) - 18.0).abs() < 0.1 && angle(&bench, 0).abs() < 0.1);
}

fn steps(mode: StepSignalMode, at_zero: bool) -> StepSignal {
    let config = StepSignalConfig::default().with_steps(StepCount::Steps3).with_mode(mode);
    StepSignal { step_signal_src: RcSource(129), step_signal_cfg: config.with_starts_at_zero(at_zero) }
}

#[test]
fn step_signals_count_the_changes_of_their_source() {
    let (low, middle, high) = (RcSignal(-16384), RcSignal(0), RcSignal(16384));
    let cases = [
        (StepSignalMode::High, false, [0.0, 0.9, 0.0, 0.9, 0.9], [low, middle, middle, high, high]),
        (StepSignalMode::High, false, [0.9, -0.9, 0.9, 0.0, 0.9], [middle, middle, high, high, low]),
        (StepSignalMode::Low, true, [-0.9, 0.0, 0.9, -0.9, -0.9], [high, high, high, low, low]),
        (StepSignalMode::LowHigh, true, [0.9, 0.0, 0.9, -0.9, 0.0], [high, high, high, middle, middle]),
    ];
    for (mode, at_zero, levels, values) in cases {
        let mut bench = Bench::new(Config::default());
        change_2(&mut bench, |params| params.step_signals[1] = steps(mode, at_zero));
        for (level, value) in levels.into_iter().zip(values) {
            channels(&mut bench, level, 0.0);
            assert_eq!(signal(&mut bench, 162), value, "{mode:?} {level}");
        }
        assert_eq!(signal(&mut bench, 161), RcSignal::UNDEFINED_OLD, "it has no source");
    }
}

#[test]
fn a_step_signal_moves_an_axis() {
    let mut bench = Bench::new(Config::default());
    change(&mut bench, |params| params.rc_map_pitch = RcSource(161));
    change_2(&mut bench, |params| params.step_signals[0] = steps(StepSignalMode::LowHigh, true));
    bench.run(ms(16));
    channels(&mut bench, 0.9, 0.0);
    bench.run(ms(4000));
    assert!((angle(&bench, 1) - 90.0).abs() < 0.1, "{}", angle(&bench, 1));
}

#[test]
fn pins_with_another_function_are_not_driven() {
    let mut bench = Bench::new(Config::default());
    let free = |bench: &mut Bench, pin_id| {
        !bench.ask(&TriggerPin { pin_id, state: TriggerPinState::High }).is_empty()
    };
    let (aux1, aux2, aux3) = (TriggerPinId::Aux1, TriggerPinId::Aux2, TriggerPinId::Aux3);
    assert!([aux1, aux2, aux3].into_iter().all(|pin| free(&mut bench, pin)));
    change_2(&mut bench, |params| params.interrupt_cfg = InterruptConfig::default().with_pin(aux1));
    let request = ReadParamsExt3 { profile_id: ProfileId::Current };
    let mut block = bench.ask_one(&request).decoded::<ParamsExt3>();
    block.ext_buzzer_pin = aux2.raw();
    block.extra_btn_cfg[4] = ExtraButton::default().with_pin(aux3);
    bench.ask(&WriteParamsExt3(block));
    assert!(![aux1, aux2, aux3].into_iter().any(|pin| free(&mut bench, pin)));
}

#[test]
fn servo_outputs_put_out_virtual_channels() {
    let mut bench = Bench::new(Config::default());
    change(&mut bench, |params| {
        params.servo1_out = 2;
        params.rc_map_fc_roll = RcSource::NOT_ASSIGNED;
    });
    channels(&mut bench, 0.0, 0.5);
    assert_eq!((bench.board.servo(0), bench.board.servo(1)), (Some(1750), None));
    let trigger = TriggerPin { pin_id: TriggerPinId::ExtFcInputRoll, state: TriggerPinState::Low };
    assert_eq!(bench.ask(&trigger), [], "its pin is in use");
}
