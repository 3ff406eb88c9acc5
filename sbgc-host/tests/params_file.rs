//! Parameters as TOML documents.
#![cfg(all(feature = "params", feature = "sim"))]

use sbgc_host::params::{Block, ParameterFile, Parameters, Profile, Snapshot};
use sbgc_host::proto::CommandId;
use sbgc_host::proto::units::FirmwareVersion;
use sbgc_host::sim::{self, Config};
use sbgc_host::{Gimbal, Options};

/// A board whose second block has bytes in every place, reserved ones included, some beyond their range.
fn config() -> Config {
    let payload = |block: Block| (0..block.size()).map(|at| u8::try_from(at * 37 % 251).unwrap()).collect();
    let stored = |block: Block| sim::StoredBlock { id: block.read_id(), profile: 1, payload: payload(block) };
    Config { parameters: Block::OF_PROFILE.map(stored).to_vec(), ..Config::default() }
}

async fn board(config: Config) -> Parameters {
    let gimbal = Gimbal::spawn(sim::in_process(config), Options::default());
    let info = gimbal.handshake().await.unwrap();
    Parameters::new(gimbal, info)
}

fn profile(number: u8) -> Profile {
    Profile::from_number(number).unwrap()
}

async fn snapshot(config: Config) -> Snapshot {
    board(config).await.snapshot(Profile::all()).await.unwrap()
}

#[tokio::test(start_paused = true)]
async fn a_document_holds_everything() {
    let snapshot = snapshot(config()).await;
    let text = ParameterFile::document(&snapshot);
    let file = ParameterFile::parse(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(file.firmware(), Some(snapshot.firmware));
    assert!(file.has_shared() && file.profiles().eq(Profile::all()));

    // Over a board with other values and other bytes without a name, it gives the same blocks.
    let other = board(Config::default()).await;
    let catalog = other.catalog();
    for (profile, blocks) in &snapshot.profiles {
        let applied = file.apply(*profile, &other.read(*profile).await.unwrap(), &catalog);
        assert!(applied.left_out.is_empty());
        // The board's own business is the board's.
        assert_eq!(applied.blocks.copied_from(blocks), applied.blocks);
    }
    let applied = file.apply_shared(&other.read_shared().await.unwrap(), &other.shared_catalog());
    assert_eq!(applied.blocks, snapshot.shared);
    // Each parameter has a line of its own.
    assert!(text.contains("\nservo_rate = ") && text.contains("\n\"profile_name[3]\" = "), "{text}");
    assert!(text.contains("\ncur_imu = ") && text.contains("# set by the board, not restored"), "{text}");
}

#[tokio::test(start_paused = true)]
async fn a_value_wins_and_a_missing_line_changes_nothing() {
    let mut snapshot = snapshot(config()).await;
    let kept = profile(2);
    snapshot.profiles.retain(|profile, _| *profile == kept);
    let text = ParameterFile::document(&snapshot);
    let before = &snapshot.profiles[&kept];
    let line = text.lines().find(|line| line.starts_with("gyro_trust = ")).unwrap();
    let parameters = board(Config::default()).await;
    let catalog = parameters.catalog();
    let trust = catalog.one("gyro_trust").unwrap();

    let edited = ParameterFile::parse(&text.replace(line, "gyro_trust = 99")).unwrap();
    let applied = edited.apply(kept, before, &catalog).blocks;
    assert_eq!(before.values(&catalog).differences(&applied.values(&catalog), None).len(), 1);
    assert_eq!(applied.bytes_of(trust), Some(&[99][..]));

    let shorter = ParameterFile::parse(&text.replace(line, "")).unwrap();
    let mut board = before.clone();
    board.set(trust, &[11]);
    assert_eq!(shorter.apply(kept, &board, &catalog).blocks, board);

    let small = ParameterFile::parse("firmware = \"2.73.5\"\n[profile.2]\ngyro_trust = 0x21\n").unwrap();
    let applied = small.apply(kept, before, &catalog).blocks;
    assert_eq!(applied.bytes_of(trust), Some(&[0x21][..]));
    assert_eq!(applied.get(Block::Ext), before.get(Block::Ext));
}

#[test]
fn values_and_paths_may_be_written_in_several_ways() {
    let forms = [
        "[profile.1]\nmotors.roll.p = 7\nmotors.roll.i = 8\next_fc_gain = [3, -4]\nrc_memory.yaw = \"-45 deg\"",
        "[profile.1]\n\"motors.roll.p\" = 7\n\"motors.roll.i\" = \"8\"\n\"ext_fc_gain[0]\" = 3\n\"ext_fc_gain[1]\" = -4.0\nrc_memory.yaw = -45",
        "[profile.1.motors]\nroll = { p = 7, i = 8 }\n[profile.1]\next_fc_gain = [3.0, -4]\nrc_memory = { yaw = -45.0 }",
        "[profile.1.raw]\n[profile.1.motors.roll]\np = 7\ni = 8\n[profile.1]\next_fc_gain = [3, -4]\nrc_memory.yaw = \"-0.7853981 rad\"",
    ];
    let read = |text: &&str| {
        let file = ParameterFile::parse(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let mut values: Vec<_> = file
            .values(profile(1))
            .iter()
            .map(|(parameter, bytes)| (parameter.path.clone(), bytes.to_vec()))
            .collect();
        values.sort();
        values
    };
    let first = read(&forms[0]);
    assert_eq!(first.len(), 5);
    assert_eq!(first[0], ("ext_fc_gain[0]".into(), vec![3]));
    assert!(forms.iter().all(|form| read(form) == first));
}

#[test]
fn what_is_wrong_is_said_with_its_line() {
    let wrong = [
        ("firmware = 3", "line 1: firmware: expected text in quotes"),
        ("firmware = \"new\"", "line 1: firmware: expected a version such as \"2.73.5\""),
        ("[profile.6]", "unknown key \"6\"; expected a profile, 1 to 5"),
        ("boards = 1", "line 1: unknown key \"boards\"; expected board_version, firmware, board, profile"),
        (
            "[profile.1]\n\nservo_rat = 50",
            "line 3: no parameter is called \"servo_rat\"; similar names: servo_rate",
        ),
        ("[profile.1]\nservo_rate = 5000", "line 2: servo_rate = 5000: out of range; expected 50 to 400 Hz"),
        ("[profile.1]\nservo_rate = \"50 deg\"", "line 2: servo_rate = \"50 deg\": expected a value in Hz"),
        ("[profile.1]\nservo_rate = nan", "line 2: servo_rate = nan: out of range"),
        ("[profile.1]\nfollow_mode = \"BACK\"", "line 2: follow_mode = \"BACK\": "),
        ("[profile.1]\nservo_rate = 50\nservo_rate = 60", "line 3: duplicate key"),
        ("[profile.1]\nrc_memory.yaw = 1\n\"rc_memory.yaw\" = 2", "line 3: rc_memory.yaw is given twice"),
        ("[profile.1\n", "line 1: "),
        ("[profile.1]\nservo_rate = 1979-05-27", "line 2: servo_rate"),
        (
            "[profile.1.raw]\nCMD_READ_PARAMS_3 = \"00\"",
            "line 2: CMD_READ_PARAMS_3: expected 134 bytes in hex",
        ),
        ("[profile.1.raw]\nCMD_READ_PARAMS_3 = \"xyz\"", "expected 134 bytes in hex"),
        (
            "[profile.1.raw]\nCMD_READ_PROFILE_NAMES = \"00\"",
            "unknown key \"CMD_READ_PROFILE_NAMES\"; expected CMD_READ_PARAMS_3",
        ),
        ("[board]\nservo_rate = 50", "line 2: no parameter is called \"servo_rate\""),
        ("profile = 3", "line 1: profile: expected tables 1 to 5"),
    ];
    for (text, expected) in wrong {
        let error = ParameterFile::parse(text).map(drop).unwrap_err().to_string();
        assert!(error.contains(expected), "{text:?}: {error:?}, expected {expected:?}");
    }
}

#[tokio::test(start_paused = true)]
async fn comments_stay_when_a_document_is_brought_up_to_date() {
    let mut old = snapshot(Config::default()).await;
    old.profiles.retain(|held, _| *held == profile(2));
    let mut new = snapshot(config()).await;
    new.profiles.retain(|held, _| *held == profile(2));
    let commented = ParameterFile::document(&old)
        .replace("[profile.2]", "# the heavy lens\n[profile.2]")
        .replace("\ngyro_trust = 120\n", "\n# higher drifts\ngyro_trust = 120  # was 100\n");
    let updated = ParameterFile::updated(&commented, &new).unwrap();
    for comment in ["# the heavy lens\n[profile.2]", "\n# higher drifts\ngyro_trust = ", "  # was 100\n"] {
        assert!(updated.contains(comment), "{comment:?}\n{updated}");
    }
    let (updated, fresh) = (
        ParameterFile::parse(&updated).unwrap(),
        ParameterFile::parse(&ParameterFile::document(&new)).unwrap(),
    );
    assert!(updated.values(profile(2)).differences(&fresh.values(profile(2)), None).is_empty());
    // Of other profiles, or no document at all: nothing to bring up to date.
    new.profiles.clear();
    assert!(ParameterFile::updated(&commented, &new).is_none());
    assert!(ParameterFile::updated("hello", &old).is_none());
}

#[tokio::test(start_paused = true)]
async fn what_the_firmware_lacks_is_left_out_and_named() {
    let new = ParameterFile::parse(&ParameterFile::document(&snapshot(config()).await)).unwrap();
    let old = board(Config { firmware: FirmwareVersion::new(2, 68, 0), ..Config::default() }).await;
    assert!(!new.is_for(old.info().firmware_ver) && new.is_for(FirmwareVersion::new(2, 73, 9)));
    let blocks = old.read(profile(2)).await.unwrap();
    let applied = new.apply(profile(2), &blocks, &old.catalog());
    assert!(applied.left_out.iter().any(|path| path == "follow_offset_ext.roll"), "{:?}", applied.left_out);
    // Bytes without a name mean something else there.
    let reserved = 1..22;
    let ext3 =
        |blocks: &sbgc_host::params::Blocks| blocks.get(Block::Ext3).unwrap()[reserved.clone()].to_vec();
    assert_eq!(ext3(&applied.blocks), ext3(&blocks));
    assert_eq!(Block::Ext3.read_id(), CommandId::ReadParamsExt3);
}
