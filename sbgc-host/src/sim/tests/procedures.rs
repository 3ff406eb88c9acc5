//! Calibrations and tunings.

use sbgc_proto::CommandId;
use sbgc_proto::Message;
use sbgc_proto::commands::{
    AutoPid2Action, AutoPid2Request, AutoPid2SimpleRequest, AutoPidFlags, AutoPidRequest, Axis,
    BodeStimulusType, BodeTestStartStop, BodeTestStartStopRequest, BodeTestSystem, CalibAcc, CalibAccExtRef,
    CalibAction, CalibBat, CalibCogging, CalibGyro, CalibInfo, CalibInfoRequest, CalibOrientCorr,
    CoggingAction, CoggingAxes, Confirm, Control, ImuCalibration, ImuType, MotorsOff, ParamsExt2,
    RealtimeData3, RealtimeData3Request, Reset,
};
use sbgc_proto::units::{Acceleration, ControlRate, Voltage};
use sbgc_proto::wire::PerXyz;

use super::{Bench, Got, ms};
use crate::sim::Config;

fn action(action: CalibAction) -> ImuCalibration {
    ImuCalibration { action, ..ImuCalibration::default() }
}

fn ids(got: &[Got]) -> Vec<u8> {
    got.iter().map(|got| got.id).collect()
}

fn outcome(got: &Got) -> (CommandId, u32) {
    let confirm = got.decoded::<Confirm>();
    (confirm.cmd_id, confirm.data.value())
}

#[test]
fn a_calibration_reports_its_progress() {
    let mut bench = Bench::new(Config::default());
    let progress = |bench: &mut Bench| {
        let request = CalibInfoRequest { imu_type: ImuType::Main, ..CalibInfoRequest::default() };
        bench.ask_one(&request).decoded::<CalibInfo>()
    };
    assert!(progress(&mut bench).acc_limits_info.is_empty());
    bench.ask_one(&CalibAcc(action(CalibAction::Regular)));
    bench.run(ms(2000));
    assert!((45..55).contains(&progress(&mut bench).progress));
    assert_eq!(outcome(&bench.run(ms(2100))[0]), (CommandId::CalibAcc, 0));
    let info = progress(&mut bench);
    assert_eq!((info.progress, info.acc_limits_info.bits(), info.acc_cur_axis.raw()), (0, 0b1_0000, 2));
}

#[test]
fn invalid_parameters_are_not_confirmed_and_some_actions_restart() {
    let mut bench = Bench::new(Config::default());
    assert_eq!(bench.ask_one(&CalibAcc(action(9.into()))).payload[..2], [65, 2]);
    let mut unknown = action(CalibAction::Regular);
    unknown.imu_idx = 7.into();
    assert_eq!(bench.ask_one(&CalibAcc(unknown)).payload[..2], [65, 2]);
    let got = bench.ask(&CalibGyro(action(CalibAction::ResetAllAndRestart)));
    assert_eq!(ids(&got), [67, Reset::ID.raw()]);
    bench.run(ms(1100));
    assert_eq!(bench.board.resets(), 1);
}

#[test]
fn the_gyroscope_has_to_be_still_and_control_cancels_it() {
    let mut bench = Bench::new(Config::default());
    let turn = Control::speeds([ControlRate::from_degrees_per_second(30.0); 3].into());
    bench.ask_one(&CalibGyro(action(CalibAction::Regular)));
    let got = bench.ask(&turn);
    assert_eq!(ids(&got), [67, 255], "{got:?}");
    bench.run(ms(500));
    // It turns now, so that another one fails at once.
    let got = [bench.ask(&CalibGyro(action(CalibAction::Regular))), bench.run(ms(100))].concat();
    assert_eq!(ids(&got), [67, 255], "{got:?}");
    assert_eq!(got[1].payload[..2], [103, 10]);
}

#[test]
fn the_orientation_ends_with_parameters_that_nobody_asked_for() {
    let mut bench = Bench::new(Config::default());
    assert_eq!(bench.ask_one(&CalibOrientCorr::default()).payload[..2], [91, 8], "the motors are on");
    bench.ask_one(&MotorsOff::default());
    assert_eq!(outcome(&bench.ask_one(&CalibOrientCorr::default())), (CommandId::CalibOrientCorr, 0));
    let block = bench.run(ms(3000)).remove(0).decoded::<ParamsExt2>();
    assert_ne!(block.imu_orientation_corr, ParamsExt2::default().imu_orientation_corr);
}

#[test]
fn an_external_reference_is_confirmed_only_if_it_fits() {
    let mut bench = Bench::new(Config::default());
    let reference = |x, z| CalibAccExtRef {
        acc_ref: PerXyz { x: Acceleration(x), y: Acceleration(0), z: Acceleration(z) },
        ..CalibAccExtRef::default()
    };
    for bad in [reference(0, 0), reference(512, 0), reference(0, -512), reference(0, 1024)] {
        bench.send(&bad);
        assert_eq!(bench.run(ms(1000)), [], "{bad:?}");
    }
    assert_eq!(bench.ask(&reference(10, 510)), []);
    let got = bench.run(ms(600));
    assert_eq!(outcome(&got[0]), (CommandId::CalibAccExtRef, 0));
}

#[test]
fn cogging_ends_with_255() {
    let mut bench = Bench::new(Config::default());
    let mut request = CalibCogging {
        action: CoggingAction::Calibrate,
        axis_to_calibrate: CoggingAxes::PITCH,
        iterations_num: 2,
        ..CalibCogging::default()
    };
    assert_eq!(bench.ask_one(&request).payload[..2], [93, 2], "an angle of 0 is none");
    request.axes.pitch.angle = 40;
    assert_eq!(outcome(&bench.ask_one(&request)), (CommandId::CalibCogging, 0));
    assert_eq!(outcome(&bench.run(ms(11_000))[0]), (CommandId::CalibCogging, 255));
}

#[test]
fn the_voltage_is_what_was_measured() {
    let mut bench = Bench::new(Config::default());
    bench.ask_one(&CalibBat { actual_voltage: Voltage(1500) });
    let shown = bench.ask_one(&RealtimeData3Request {}).decoded::<RealtimeData3>().bat_level;
    assert!(shown.0.abs_diff(1500) < 10, "{shown:?}");
    assert_eq!(bench.ask_one(&CalibBat { actual_voltage: Voltage(1) }).payload[..2], [66, 2]);
}

#[test]
fn tuning_sends_its_progress_and_then_the_parameters() {
    let mut bench = Bench::new(Config::default());
    let request = AutoPidRequest {
        profile_id: 1.into(),
        cfg_flags: AutoPidFlags::PITCH | AutoPidFlags::SEND_GUI,
        ..AutoPidRequest::default()
    };
    assert_eq!(outcome(&bench.ask_one(&request)), (CommandId::AutoPid, 0));
    let got = ids(&bench.run(ms(9000)));
    assert_eq!(got[..15], [35; 15]);
    assert_eq!(got[15..], [21, 33, 62, 104]);
    // A stopped one changes nothing.
    bench.ask_one(&request);
    assert_eq!(outcome(&bench.ask_one(&AutoPidRequest::default())), (CommandId::AutoPid, 0));
    assert_eq!(bench.run(ms(9000)), []);
}

#[test]
fn the_second_tuning_has_error_codes_of_its_own() {
    let mut bench = Bench::new(Config::default());
    let simple = |action| AutoPid2SimpleRequest { action, ..AutoPid2SimpleRequest::default() };
    let full = |action| AutoPid2Request { action, cfg_version: 1, ..AutoPid2Request::default() };
    let code = |got: Got| (got.id, got.payload[1]);
    assert_eq!(code(bench.ask_one(&simple(AutoPid2Action::Read))), (255, 1));
    assert_eq!(code(bench.ask_one(&simple(9.into()))), (255, 4));
    assert_eq!(code(bench.ask_one(&simple(AutoPid2Action::Start))), (255, 5));
    bench.send_raw(108, &[6]);
    assert_eq!(code(bench.run(ms(8)).remove(0)), (255, 5));
    bench.ask_one(&MotorsOff::default());
    assert_eq!(code(bench.ask_one(&full(AutoPid2Action::Start))), (255, 2));
    bench.ask_one(&sbgc_proto::commands::MotorsOn {});
    assert_eq!(bench.ask_one(&full(AutoPid2Action::Save)).id, 67);
    let read = bench.ask(&simple(AutoPid2Action::Read));
    assert_eq!((ids(&read), read[1].payload.len()), (vec![67, 108], 73));
    assert_eq!(bench.ask_one(&full(AutoPid2Action::StartSave)).id, 67);
    assert_eq!(ids(&bench.run(ms(9000))), [21, 33, 62, 104]);
}

#[test]
fn a_bode_test_sends_all_samples_and_its_end() {
    let mut bench = Bench::new(Config::default());
    let request = BodeTestStartStopRequest {
        axis: Axis::Pitch,
        stimulus_type: BodeStimulusType::WhiteNoise,
        stimulus_gain: 100,
        system: BodeTestSystem::PlantOpenLoop,
        samples_num: 50,
        ..BodeTestStartStopRequest::default()
    };
    assert_eq!(outcome(&bench.ask_one(&request)), (CommandId::BodeTestStartStop, 0));
    let mut got = bench.run(ms(200));
    let end = got.pop().unwrap().decoded::<BodeTestStartStop>();
    assert_eq!((end.samples_count, end.error_code), (50, 0));
    assert_eq!(got.iter().map(|got| (got.payload.len() - 17) / 4).collect::<Vec<_>>(), [20, 20, 10]);
}
