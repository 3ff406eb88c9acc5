//! Parameters by name against the simulated board.
#![cfg(all(feature = "params", feature = "sim"))]

mod support;

use std::collections::BTreeMap;

use sbgc_host::params::{
    Block, Catalog, NameError, Parameters, Plan, Profile, Setting, Value, VariableCommand, variables_called,
};
use sbgc_host::proto::CommandId;
use sbgc_host::proto::commands::BoardInfo;
use sbgc_host::proto::frame::Version;
use sbgc_host::proto::units::FirmwareVersion;
use sbgc_host::sim::{self, Config};
use sbgc_host::{Gimbal, Options, VersionChoice};

async fn board(config: Config) -> Parameters {
    let options = Options { version: VersionChoice::Only(Version::V2), ..Options::default() };
    let gimbal = Gimbal::spawn(sim::in_process(config), options);
    let info = gimbal.board_info().await.unwrap();
    Parameters::new(gimbal, info)
}

fn profile(number: u8) -> Profile {
    Profile::from_number(number).unwrap()
}

#[test]
fn every_value_reads_back_as_it_is_shown() {
    let patterns = [0_u8, 1, 2, 5, 0x7F, 0x80, 0x81, 0xFE, 0xFF];
    let (mut shown, mut refused) = (0, 0);
    for parameter in Catalog::newest().iter() {
        for pattern in patterns {
            let mut bytes = vec![pattern; parameter.size];
            if let Some(first) = bytes.first_mut() {
                *first = pattern.wrapping_mul(3);
            }
            let text = parameter.show(&bytes);
            match parameter.parse(&text) {
                Ok(again) => {
                    assert_eq!(again, bytes, "{}: {text}", parameter.path);
                    shown += 1;
                }
                // What newer firmware keeps beyond the documented range is shown and not taken.
                Err(error) => {
                    assert!(
                        error.to_string().contains("out of range"),
                        "{}: {text}: {error}",
                        parameter.path
                    );
                    refused += 1;
                }
            }
        }
    }
    assert!(shown > 2000 && refused < shown / 4, "{shown} shown, {refused} refused");
}

#[test]
fn names_mean_what_the_contract_says() {
    let catalog = Catalog::newest();
    let paths = |name: &str| -> Vec<String> {
        catalog.find(name).unwrap().iter().map(|parameter| parameter.path.clone()).collect()
    };
    assert_eq!(paths("rc_memory.yaw"), ["rc_memory.yaw"]);
    assert_eq!(paths("RC_MEMORY"), ["rc_memory.roll", "rc_memory.pitch", "rc_memory.yaw"]);
    assert_eq!(paths("rc_memory"), paths("RC_MEMORY"));
    assert_eq!(paths("motors.pitch.").len(), 6);
    assert_eq!(paths("motors.*.p"), ["motors.roll.p", "motors.pitch.p", "motors.yaw.p"]);
    assert_eq!(paths("pitch.rc_lpf"), ["rc.pitch.rc_lpf"]);
    assert_eq!(paths("NOTCH_FREQ").len(), 9);
    assert!(matches!(catalog.find("pitch"), Err(NameError::Ambiguous { .. })));
    assert!(
        matches!(catalog.one("rc_memory"), Err(NameError::Ambiguous { candidates, .. }) if candidates.len() == 3)
    );
    for nothing in ["", ".", "[", "*.nothing", "rc_memory.", "rc_mem"] {
        let found = catalog.find(nothing);
        assert!(found.is_err() || nothing == "rc_memory.", "{nothing:?}: {found:?}");
    }
    let NameError::Unknown { similar, .. } = catalog.find("rc_memroy.pitch").unwrap_err() else {
        panic!("it is not there")
    };
    assert_eq!(similar.first().map(String::as_str), Some("rc_memory.pitch"));
    // Each block has this one; the newest block's is meant.
    assert_eq!(catalog.one("profile_id").unwrap().block, Block::Ext3);
}

#[test]
fn a_catalog_has_what_its_firmware_has() {
    let has = |firmware, path| Catalog::of_profile(firmware).by_path(path).is_some();
    let (old, new) = (FirmwareVersion::new(2, 68, 0), FirmwareVersion::new(2, 73, 0));
    assert!(has(new, "follow_offset_ext.roll") && !has(old, "follow_offset_ext.roll"));
    assert!(has(old, "ext_imu_type") && !has(FirmwareVersion::new(2, 65, 0), "ext_imu_type"));
    assert!(Catalog::of_board(new).by_path("trigger_slots[9].trigger_action[4]").is_some());
    assert!(Catalog::of_profile(new).iter().all(|parameter| !parameter.field.reserved));
}

#[test]
fn values_have_units_ranges_and_names() {
    let catalog = Catalog::newest();
    let set = |name: &str, text: &str| {
        let parameter = catalog.one(name).unwrap();
        parameter.parse(text).map(|bytes| (parameter.value(&bytes), parameter.show(&bytes)))
    };
    assert_eq!(set("servo_rate", "50").unwrap(), (Value::Number(50.0), "50 Hz".into()));
    assert_eq!(set("servo_rate", "0.05 kHz").unwrap().0, Value::Number(50.0));
    assert_eq!(set("rc_memory.yaw", "45deg").unwrap().1, "45 deg");
    assert_eq!(set("bat_comp_ref", "12.6V").unwrap().1, "12.6 V");
    assert_eq!(set("bat_comp_ref", "-12600 mV").unwrap().1, "-12.6 V");
    assert_eq!(set("timelapse_time", "2m").unwrap().0, Value::Integer(120));
    assert_eq!(set("motors.roll.p", "0x20").unwrap().0, Value::Integer(32));
    assert_eq!(
        set("ext_sens_params", "00 01 02 03 04 05 06 07 08 09 0a 0b 0c 0d 0e 0f").unwrap().1.len(),
        32
    );
    let error = |name: &str, text: &str| set(name, text).unwrap_err().to_string();
    assert_eq!(error("servo_rate", "1000"), "out of range; expected 50 to 400 Hz");
    assert!(
        error("servo_rate", "50deg").contains("expected a value in Hz"),
        "{}",
        error("servo_rate", "50deg")
    );
    assert!(error("motors.roll.p", "3 V").contains("without a unit"));
    assert!(error("servo_rate", "nan").contains("out of range"));
    assert!(error("follow_mode", "SIDEWAYS").contains("FOLLOW_MODE"), "{}", error("follow_mode", "SIDEWAYS"));
}

#[tokio::test(start_paused = true)]
async fn only_what_changes_is_written_and_reserved_bytes_stay() {
    let mut reserved = vec![0; Block::Ext2.size()];
    // MAV_RESERVED of both channels, which has no name.
    reserved[5..9].copy_from_slice(&[1, 2, 3, 4]);
    let stored = sim::StoredBlock { id: CommandId::ReadParamsExt2, profile: 1, payload: reserved };
    let parameters = board(Config { parameters: vec![stored], ..Config::default() }).await;
    let before = parameters.read(profile(2)).await.unwrap();

    let catalog = parameters.catalog();
    let mut after = before.clone();
    for (name, value) in [("auto_speed", "40"), ("jerk_slope.pitch", "200 ms")] {
        let parameter = catalog.one(name).unwrap();
        after.set(parameter, &parameter.parse(value).unwrap());
    }
    let mut plan = parameters.plan();
    plan.change(Some(profile(2)), &before, &after);
    assert_eq!(plan.steps().len(), 1);
    let paths: Vec<_> = plan.differences().into_iter().map(|difference| difference.path).collect();
    assert_eq!(paths, ["auto_speed", "jerk_slope.pitch"]);
    let ids: Vec<_> = plan.commands().iter().map(|command| command.id).collect();
    assert_eq!(ids, [CommandId::WriteParamsSet, CommandId::WriteParamsExt2, CommandId::WriteParamsSet]);

    let mut written = Vec::new();
    parameters.write(&plan, |step| written.push(step.place.block)).await.unwrap();
    assert_eq!(written, [Block::Ext2]);
    let read = parameters.read(profile(2)).await.unwrap();
    assert_eq!(read, after);
    assert_eq!(read.get(Block::Ext2).unwrap()[5..9], [1, 2, 3, 4]);
    // The other profiles are as they were.
    assert_ne!(parameters.read(profile(1)).await.unwrap().get(Block::Ext2), after.get(Block::Ext2));
}

#[tokio::test(start_paused = true)]
async fn firmware_without_the_bracket_gets_the_blocks_alone() {
    let parameters = board(Config { firmware: FirmwareVersion::new(2, 68, 0), ..Config::default() }).await;
    let before = parameters.read(profile(1)).await.unwrap();
    let catalog = parameters.catalog();
    let parameter = catalog.one("gyro_trust").unwrap();
    let mut after = before.clone();
    after.set(parameter, &parameter.parse("7").unwrap());
    let mut plan = parameters.plan();
    plan.change(Some(profile(1)), &before, &after);
    assert_eq!(plan.commands().len(), 1);
    parameters.write(&plan, |_| {}).await.unwrap();
    assert_eq!(parameters.read(profile(1)).await.unwrap(), after);
}

#[tokio::test(start_paused = true)]
async fn what_the_board_sets_by_itself_is_never_written() {
    let parameters = board(Config::default()).await;
    let before = parameters.read(profile(1)).await.unwrap();
    let mut after = before.clone();
    for name in ["cur_profile_id", "profile_id", "cur_imu"] {
        after.set(parameters.catalog().one(name).unwrap(), &[2]);
    }
    assert_eq!(after, before);
}

#[tokio::test(start_paused = true)]
async fn profiles_have_names_are_copied_and_switched() {
    let parameters = board(Config::default()).await;
    assert_eq!(parameters.active().await.unwrap(), profile(1));
    parameters.activate(profile(4)).await.unwrap();
    assert_eq!(parameters.active().await.unwrap(), profile(4));

    let plan = parameters.plan_name(profile(3), "Pan & tilt ü").await.unwrap();
    assert_eq!(plan.differences()[0].path, "profile_name[2]");
    parameters.write(&plan, |_| {}).await.unwrap();
    assert_eq!(parameters.names().await.unwrap()[2], "Pan & tilt ü");
    let long = parameters.plan_name(profile(3), &"x".repeat(49)).await;
    assert!(long.unwrap_err().to_string().contains("at most 48 bytes, got 49"));

    let plan = parameters.plan_copy(profile(1), profile(4)).await.unwrap();
    parameters.write(&plan, |_| {}).await.unwrap();
    assert!(parameters.plan_copy(profile(1), profile(4)).await.unwrap().is_empty());
    assert_eq!(parameters.active().await.unwrap(), profile(4), "copying does not switch");

    parameters.reset(profile(4)).await.unwrap();
    assert!(!parameters.plan_copy(profile(1), profile(4)).await.unwrap().is_empty());
}

#[tokio::test(start_paused = true)]
async fn a_board_that_holds_something_else_is_put_back() {
    let (gimbal, far) = support::gimbal();
    let board = tokio::spawn(stubborn(far));
    let info = BoardInfo { firmware_ver: FirmwareVersion(2600), ..BoardInfo::default() };
    let parameters = Parameters::new(gimbal.clone(), info);
    let before = parameters.read(profile(1)).await.unwrap();
    let catalog = parameters.catalog();
    let parameter = catalog.one("gyro_trust").unwrap();
    let mut after = before.clone();
    after.set(parameter, &[77]);
    let mut plan: Plan = parameters.plan();
    plan.change(Some(profile(1)), &before, &after);
    let error = parameters.write(&plan, |_| {}).await.unwrap_err();
    assert_eq!(
        error.to_string(),
        "the board did not take gyro_trust of profile 1 (wrote 77, read 100); the previous values were restored"
    );
    assert_eq!(parameters.read(profile(1)).await.unwrap(), before);
    drop((gimbal, parameters));
    board.await.unwrap();
}

/// A board whose trust in its gyroscope never goes below 100, and that knows one block.
async fn stubborn(mut board: support::Board) {
    const GYRO_TRUST: usize = 46;
    const UNKNOWN_COMMAND: u8 = 6;
    let mut block = vec![0; Block::Params3.size()];
    block[GYRO_TRUST] = 100;
    while let Some(frame) = board.try_next().await {
        match CommandId::from_raw(frame.id) {
            CommandId::ReadParams3 => board.send(frame.id, &block).await,
            CommandId::WriteParams3 => {
                block = frame.payload;
                block[GYRO_TRUST] = block[GYRO_TRUST].max(100);
                board.confirm(frame.id).await;
            }
            _ => board.send(CommandId::Error.raw(), &[frame.id, UNKNOWN_COMMAND]).await,
        }
    }
}

/// Blocks of a board that takes so many writes and is gone then.
async fn fragile(
    mut board: support::Board,
    mut blocks: BTreeMap<u8, Vec<u8>>,
    writes: usize,
) -> BTreeMap<u8, Vec<u8>> {
    let mut left = writes;
    while let Some(frame) = board.try_next().await {
        let id = CommandId::from_raw(frame.id);
        let written = Block::OF_PROFILE.into_iter().find(|block| block.write_id() == id);
        match (written, blocks.get(&frame.id)) {
            (Some(_), _) if left == 0 => break,
            (Some(block), _) => {
                left -= 1;
                blocks.insert(block.read_id().raw(), frame.payload.clone());
                board.confirm(frame.id).await;
            }
            (None, Some(payload)) => board.send(frame.id, payload).await,
            (None, None) => board.confirm(frame.id).await,
        }
    }
    blocks
}

#[tokio::test(start_paused = true)]
async fn an_interrupted_write_says_what_was_written_and_the_next_completes_it() {
    let info = BoardInfo { firmware_ver: FirmwareVersion::new(2, 73, 5), ..BoardInfo::default() };
    let mut held: BTreeMap<u8, Vec<u8>> =
        Block::OF_PROFILE.into_iter().map(|block| (block.read_id().raw(), vec![0; block.size()])).collect();
    let mut plan_sizes = Vec::new();
    // The first run takes one write, the second all that are left.
    for writes in [1, 9] {
        let (gimbal, far) = support::gimbal();
        let board = tokio::spawn(fragile(far, held, writes));
        let parameters = Parameters::new(gimbal.clone(), info.clone());
        let before = parameters.read(profile(1)).await.unwrap();
        let mut after = before.clone();
        for (name, value) in
            [("gyro_trust", "9"), ("beeper_volume", "9"), ("auto_speed", "9"), ("motor_startup_delay", "9")]
        {
            let parameter = parameters.catalog().one(name).unwrap().clone();
            after.set(&parameter, &parameter.parse(value).unwrap());
        }
        let mut plan = parameters.plan();
        plan.change(Some(profile(1)), &before, &after);
        plan_sizes.push(plan.steps().len());
        let outcome = parameters.write(&plan, |_| {}).await;
        if writes == 1 {
            let text = outcome.unwrap_err().to_string();
            for part in [
                "written: CMD_READ_PARAMS_3 of profile 1; not written: CMD_READ_PARAMS_EXT of profile 1, ",
                "run the same command again to complete it",
            ] {
                assert!(text.contains(part), "{part:?} is not in {text:?}");
            }
        } else {
            outcome.unwrap();
        }
        drop((gimbal, parameters));
        held = board.await.unwrap();
    }
    assert_eq!(plan_sizes, [4, 3]);
}

#[tokio::test(start_paused = true)]
async fn variables_are_read_and_set_in_both_forms() {
    for (firmware, floats) in
        [(FirmwareVersion::new(2, 68, 0), false), (FirmwareVersion::new(2, 73, 5), true)]
    {
        let parameters = board(Config { firmware, ..Config::default() }).await;
        let all = parameters.variables().await.unwrap();
        assert!(all.len() >= 50, "{firmware}: {}", all.len());
        let called = |name: &str| variables_called(&all, name).unwrap().first().copied().cloned().unwrap();
        let heading = called("frame-heading.angle");
        assert_eq!((heading.unit, heading.range), ("deg", Some((-180.0, 180.0))));
        assert_eq!(called("37"), heading);
        let error = heading.parse("200 deg").unwrap_err().to_string();
        assert_eq!(error, "FRAME_HEADING_ANGLE = 200 deg: out of range; expected -180 to 180 deg");
        assert!(heading.parse("3 V").unwrap_err().to_string().contains("expected a value in deg"));
        assert!(heading.parse("north").unwrap_err().to_string().contains("expected a number"));
        assert!(variables_called(&all, "P_ROL").unwrap_err().to_string().contains("P_ROLL"));

        let settings = [heading.parse("-12.5deg").unwrap(), called("P_ROLL").parse("33").unwrap()];
        parameters.set_variables(&settings).await.unwrap();
        let ids = settings.map(|setting| setting.id);
        let values: Vec<f64> =
            parameters.variable_values(&ids).await.unwrap().iter().map(|held| held.value).collect();
        assert_eq!(values, [-12.5, 33.0]);

        // A raw number with a fraction needs the form with floats.
        let fraction = [Setting { id: ids[1], raw: 33.5 }];
        let commands = parameters.variable_commands(&fraction).unwrap();
        assert_eq!(matches!(commands.as_slice(), [VariableCommand::Floats(_)]), floats, "{firmware}");
        parameters.save_variables(&[]).await.unwrap();
        // Firmware 2.68 before beta 9 saves all or nothing.
        assert_eq!(parameters.save_variables(&ids).await.is_ok(), floats, "{firmware}");
    }
}
