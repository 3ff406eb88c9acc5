//! What the board does when it starts.

use sbgc_proto::commands::{
    BoardInfo, BoardInfoRequest, ExecuteMenu, GeneralFlags1, GeneralFlags2, HelperData, HelperDataFlags,
    MenuCommand, Params3, ParamsExt2, ProfileFlags1, ProfileId, ReadParams3, ReadParamsExt2, StateFlags1,
    WriteParams3, WriteParamsExt2,
};
use sbgc_proto::units::{Angle, FrameHeading};
use sbgc_proto::wire::PerAxis;

use super::{Bench, ms};
use crate::sim::Config;

fn change(bench: &mut Bench, change: impl FnOnce(&mut Params3)) {
    let mut block = bench.ask_one(&ReadParams3 { profile_id: ProfileId::Current }).decoded::<Params3>();
    change(&mut block);
    bench.ask(&WriteParams3(block));
}

/// Resets the board and waits until it answers.
fn restart(bench: &mut Bench) {
    bench.send_raw(114, &[]);
    bench.run(ms(400));
}

fn flags(bench: &mut Bench) -> StateFlags1 {
    bench.ask_one(&BoardInfoRequest {}).decoded::<BoardInfo>().state_flags1
}

fn angles(bench: &Bench) -> [f64; 3] {
    bench.board.motion().axes().map(|axis| axis.angle).into_array()
}

const SENSORS: StateFlags1 = StateFlags1::INIT_STEP1_DONE.union(StateFlags1::INIT_STEP2_DONE);
const DONE: StateFlags1 = SENSORS.union(StateFlags1::STARTUP_AUTO_ROUTINE_DONE);

#[test]
fn the_axes_take_the_angles_of_the_parameters_and_only_then_the_start_is_done() {
    let mut bench = Bench::new(Config::default());
    assert_eq!(flags(&mut bench), DONE, "nothing is to be done");
    let degrees = PerAxis { roll: 5.0, pitch: -30.0, yaw: 60.0 };
    change(&mut bench, |params| params.rc_memory = degrees.map(Angle::from_degrees));
    bench.run(ms(1000));
    assert_eq!(angles(&bench).map(f64::to_bits), [0; 3], "it acts with the next start");
    restart(&mut bench);
    assert_eq!(flags(&mut bench), SENSORS);
    bench.run(ms(3000));
    assert_eq!(flags(&mut bench), DONE);
    for (angle, wanted) in angles(&bench).into_iter().zip(degrees.into_array()) {
        assert!((angle - f64::from(wanted)).abs() < 0.05, "{angle} {wanted}");
    }
}

#[test]
fn a_board_that_keeps_its_position_or_leaves_the_motors_off_does_not_move() {
    for motors in [true, false] {
        let mut bench = Bench::new(Config::default());
        change(&mut bench, |params| {
            params.rc_memory.pitch = Angle::from_degrees(40.0);
            params.profile_flags1.set(ProfileFlags1::RC_KEEP_CUR_POS_ON_INIT, motors);
        });
        if !motors {
            let request = ReadParamsExt2 { profile_id: ProfileId::Current };
            let mut block = bench.ask_one(&request).decoded::<ParamsExt2>();
            block.general_flags2 |= GeneralFlags2::MOTORS_OFF_AT_STARTUP;
            bench.ask(&WriteParamsExt2(block));
        }
        restart(&mut bench);
        assert_eq!(flags(&mut bench), DONE);
        bench.run(ms(2000));
        assert_eq!(angles(&bench).map(f64::to_bits), [0; 3]);
    }
}

#[test]
fn yaw_is_centered_at_the_start_where_that_is_wanted() {
    let mut bench = Bench::new(Config::default());
    bench.board.turn_frame(PerAxis { yaw: 25.0, ..PerAxis::default() });
    change(&mut bench, |params| params.general_flags1 |= GeneralFlags1::CENTER_YAW_AT_STARTUP);
    restart(&mut bench);
    bench.run(ms(3000));
    assert!((angles(&bench)[2] - 25.0).abs() < 0.05);
}

#[test]
fn a_frame_upside_down_is_shown_and_remembered() {
    let mut bench = Bench::new(Config::default());
    bench.ask_one(&ExecuteMenu { cmd_id: MenuCommand::FrameUpsideDown });
    assert!(flags(&mut bench).contains(StateFlags1::IS_FRAME_INVERTED));
    restart(&mut bench);
    assert!(flags(&mut bench).contains(StateFlags1::IS_FRAME_INVERTED));
    bench.ask_one(&ExecuteMenu { cmd_id: MenuCommand::FrameUpsideDown });
    assert!(!flags(&mut bench).contains(StateFlags1::IS_FRAME_INVERTED));
}

#[test]
fn a_heading_that_becomes_known_later_does_not_turn_the_camera_back() {
    let mut bench = Bench::new(Config::default());
    let data = HelperData {
        flags: HelperDataFlags::default().with_use_frame_heading(true),
        frame_heading: FrameHeading::from_degrees(30.0),
        ..HelperData::default()
    };
    bench.ask(&data);
    bench.run(ms(2000));
    assert!((angles(&bench)[2] - 30.0).abs() < 0.1, "{:?}", angles(&bench));
}
