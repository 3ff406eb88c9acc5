//! Parameters that act, adjustable variables, profiles and sets of them.

use sbgc_proto::commands::{
    AdjVarsCfg, AdjVarsVal, AdjustableVariable as Var, AnalogSlot, ApiVirtChHighRes, BoardEvent, BoardInfo3,
    BoardInfo3Request, Confirm, ExecuteMenu, GeneralFlags1, GeneralFlags2, GetAdjVarsVal, MenuCommand,
    Params3, ParamsExt2, ProfileId, ProfileSet, ProfileSetAction, ProfileSetSlot, RcSource, ReadParams3,
    ReadParamsExt2, Reset, ResetRequest, SaveParams3, SaveParams3Extended, SetAdjVarsVal, TriggerSlot,
    UseDefaults, VariableTarget, VariableValue, WriteAdjVarsCfg, WriteParams3, WriteParamsExt2,
    WriteParamsSet, WriteParamsSetAction,
};
use sbgc_proto::units::RcSignal;
use sbgc_proto::{CommandId, Message};

use super::{Bench, Got, ms};
use crate::sim::Config;

fn params(bench: &mut Bench, profile: ProfileId) -> Params3 {
    bench.ask_one(&ReadParams3 { profile_id: profile }).decoded()
}

fn ext2(bench: &mut Bench, profile: ProfileId) -> ParamsExt2 {
    bench.ask_one(&ReadParamsExt2 { profile_id: profile }).decoded()
}

fn set(bench: &mut Bench, variable: Var, value: i32) {
    let value = VariableValue { param_id: variable, param_value: value };
    let got = bench.ask_one(&SetAdjVarsVal(AdjVarsVal { params: [value].into_iter().collect() }));
    assert_eq!(got.decoded::<Confirm>().cmd_id, CommandId::SetAdjVarsVal);
}

fn get(bench: &mut Bench, variable: Var) -> i32 {
    let got = bench.ask_one(&GetAdjVarsVal { param_id: [variable].into_iter().collect() });
    got.decoded::<AdjVarsVal>().params[0].param_value
}

fn menu(bench: &mut Bench, command: MenuCommand) {
    bench.ask(&ExecuteMenu { cmd_id: command });
}

fn reset(bench: &mut Bench) {
    bench.send(&ResetRequest {});
    bench.run(ms(500));
}

fn confirmed(got: &[Got]) -> bool {
    got.iter().any(|got| got.id == Confirm::ID.raw())
}

#[test]
fn variables_start_from_the_profile_and_are_saved_into_it_alone() {
    let mut bench = Bench::new(Config::default());
    assert_eq!(
        get(&mut bench, Var::PRoll),
        i32::from(params(&mut bench, ProfileId::Current).motors.roll.p.0)
    );
    set(&mut bench, Var::PRoll, 99);
    set(&mut bench, Var::RcSpeedYaw, 200);
    // A change of profile loses what is not saved.
    menu(&mut bench, MenuCommand::Profile2);
    assert_eq!(get(&mut bench, Var::PRoll), 31);
    menu(&mut bench, MenuCommand::Profile1);
    assert_eq!(get(&mut bench, Var::PRoll), 30);

    set(&mut bench, Var::PRoll, 99);
    set(&mut bench, Var::RcSpeedYaw, 200);
    let only = SaveParams3Extended { adj_var_id: [Var::RcSpeedYaw].into_iter().collect() };
    bench.ask_one(&only);
    let saved = params(&mut bench, ProfileId::Profile1);
    assert_eq!((saved.motors.roll.p.0, saved.rc.yaw.rc_speed), (30, 200));
    bench.ask_one(&SaveParams3 {});
    assert_eq!(params(&mut bench, ProfileId::Profile1).motors.roll.p.0, 99);
    assert_eq!(params(&mut bench, ProfileId::Profile2).motors.roll.p.0, 31);
    reset(&mut bench);
    assert_eq!((get(&mut bench, Var::PRoll), get(&mut bench, Var::RcSpeedYaw)), (99, 200));
}

#[test]
fn analog_slots_drive_variables_and_trigger_slots_run_actions() {
    let mut bench = Bench::new(Config::default());
    let source = RcSource(129);
    let mut slots = AdjVarsCfg::default();
    let var_id = VariableTarget::default().with_variable(Var::PYaw);
    slots.analog_slots[0] = AnalogSlot { analog_src_ch: source, var_id, min_val: 0, max_val: 255 };
    slots.trigger_slots[3] = TriggerSlot {
        trigger_src_ch: source,
        trigger_action: [
            MenuCommand::Profile1,
            MenuCommand::No,
            MenuCommand::No,
            MenuCommand::No,
            MenuCommand::Profile4,
        ],
    };
    bench.ask_one(&WriteAdjVarsCfg(slots));
    let channel = |bench: &mut Bench, fraction: f32| {
        let api_virt_ch = [RcSignal::from_fraction(fraction)].into_iter().collect();
        assert_eq!(bench.ask(&ApiVirtChHighRes { api_virt_ch }), []);
    };
    channel(&mut bench, 0.0);
    assert_eq!(get(&mut bench, Var::PYaw), 128);
    channel(&mut bench, 1.0);
    bench.run(ms(16));
    assert_eq!(params(&mut bench, ProfileId::Profile1).cur_profile_id, ProfileId::Profile4);
    assert_eq!(get(&mut bench, Var::PYaw), 255);
}

#[test]
fn profile_sets_keep_all_profiles_and_an_empty_one_cannot_be_loaded() {
    let mut bench = Bench::new(Config::default());
    let order = |slot, action| ProfileSet { slot, action, ..ProfileSet::default() };
    let refused = bench.ask_one(&order(ProfileSetSlot::Slot2, ProfileSetAction::Load));
    assert_eq!(refused.payload[..2], [95, 10]);
    bench.ask_one(&order(ProfileSetSlot::Slot2, ProfileSetAction::Save));
    bench.ask_one(&order(ProfileSetSlot::Backup, ProfileSetAction::Save));
    let info = |bench: &mut Bench| bench.ask_one(&BoardInfo3Request {}).decoded::<BoardInfo3>();
    let before = info(&mut bench);
    assert_eq!((before.profile_set_slots.bits(), before.profile_set_cur), (0b10_0010, 1));

    let mut changed = params(&mut bench, ProfileId::Profile3);
    changed.motors.pitch.p.0 = 111;
    bench.ask_one(&WriteParams3(changed));
    assert!(confirmed(&bench.ask(&order(ProfileSetSlot::Slot2, ProfileSetAction::Load))));
    assert_eq!(params(&mut bench, ProfileId::Profile3).motors.pitch.p.0, 37);
    assert_eq!(info(&mut bench).profile_set_cur, 2);
    bench.ask_one(&order(ProfileSetSlot::Slot2, ProfileSetAction::Clear));
    assert_eq!(info(&mut bench).profile_set_slots.bits(), 0b10_0000);
    assert_eq!(bench.ask_one(&order(7.into(), ProfileSetAction::Save)).payload[..2], [95, 2]);
}

#[test]
fn the_last_profile_is_remembered_if_the_parameters_say_so() {
    let mut bench = Bench::new(Config::default());
    for (remember, expected) in [(true, ProfileId::Profile5), (false, ProfileId::Profile1)] {
        let mut block = params(&mut bench, ProfileId::Current);
        block.general_flags1.set(GeneralFlags1::REMEMBER_LAST_USED_PROFILE, remember);
        bench.ask_one(&WriteParams3(block));
        menu(&mut bench, MenuCommand::Profile5);
        reset(&mut bench);
        assert_eq!(params(&mut bench, ProfileId::Current).cur_profile_id, expected, "{remember}");
    }
}

#[test]
fn the_motors_stay_off_at_the_start_if_the_parameters_say_so() {
    let mut bench = Bench::new(Config::default());
    let mut block = ext2(&mut bench, ProfileId::Current);
    block.general_flags2 |= GeneralFlags2::MOTORS_OFF_AT_STARTUP;
    bench.ask_one(&WriteParamsExt2(block));
    assert!(bench.board.motion().motors_on());
    reset(&mut bench);
    assert!(!bench.board.motion().motors_on());
}

#[test]
fn writes_that_need_a_restart_announce_it_and_a_series_restarts_once() {
    let mut bench = Bench::new(Config::default());
    let mut block = params(&mut bench, ProfileId::Current);
    block.pwm_freq = sbgc_proto::commands::PwmFrequency::UltraHigh;
    let got = bench.ask(&WriteParams3(block.clone()));
    assert_eq!(got.iter().map(|got| got.id).collect::<Vec<_>>(), [67, Reset::ID.raw()]);
    bench.run(ms(980));
    assert_eq!(bench.board.resets(), 0);
    bench.run(ms(400));
    assert_eq!(bench.board.resets(), 1);

    bench.ask_one(&WriteParamsSet { action: WriteParamsSetAction::Start });
    for frequency in [0, 1] {
        block.pwm_freq = frequency.into();
        assert_eq!(bench.ask(&WriteParams3(block.clone())).len(), 1);
    }
    bench.run(ms(2000));
    assert_eq!(bench.board.resets(), 1);
    assert_eq!(bench.ask(&WriteParamsSet { action: WriteParamsSetAction::Finish }).len(), 2);
    bench.run(ms(2000));
    assert_eq!(bench.board.resets(), 2);
}

#[test]
fn defaults_come_back_for_a_profile_for_the_active_one_and_for_all() {
    let mut bench = Bench::new(Config::default());
    let change = |bench: &mut Bench, profile: u8| {
        let mut block = params(bench, profile.into());
        block.gyro_trust = 7;
        bench.ask_one(&WriteParams3(block));
    };
    let trust = |bench: &mut Bench, profile: u8| params(bench, profile.into()).gyro_trust;
    for profile in 0..5 {
        change(&mut bench, profile);
    }
    bench.ask_one(&UseDefaults { profile_id: ProfileId::Profile4 });
    assert_eq!([trust(&mut bench, 3), trust(&mut bench, 0)], [120, 7]);
    bench.ask_one(&UseDefaults { profile_id: ProfileId::ResetCurrent });
    assert_eq!([trust(&mut bench, 0), trust(&mut bench, 1)], [120, 7]);
    bench.ask_one(&UseDefaults { profile_id: ProfileId::EraseEeprom });
    bench.run(ms(500));
    assert_eq!([trust(&mut bench, 1), trust(&mut bench, 4)], [120, 120]);
    assert_eq!(bench.ask_one(&UseDefaults { profile_id: 9.into() }).payload[..2], [70, 2]);
}

#[test]
fn events_are_told_once_to_those_who_asked() {
    use sbgc_proto::commands::{DataStreamInterval, EventId, EventTypes, MotorsOff, StreamSource};
    use sbgc_proto::units::StreamInterval;
    let mut bench = Bench::new(Config::default());
    let source = StreamSource::Event { event_id: EventId::MotorState, event_type: EventTypes::OFF };
    bench.ask_one(&DataStreamInterval::new(source, StreamInterval(1)));
    let got = [bench.ask(&MotorsOff::default()), bench.run(ms(100))].concat();
    let events: Vec<_> = got.iter().filter(|got| got.id == BoardEvent::ID.raw()).collect();
    assert_eq!(events.len(), 1, "{got:?}");
    assert_eq!(events[0].payload, [2, 1, 0, 0]);
    bench.ask(&sbgc_proto::commands::MotorsOn {});
    assert_eq!(bench.run(ms(100)), [], "only its going off was asked for");
}
