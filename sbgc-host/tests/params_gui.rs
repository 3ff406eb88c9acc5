//! Files of the vendor's GUI: what they mean, what refuses them, and templates.
#![cfg(all(feature = "params", feature = "sim"))]

use std::collections::BTreeMap;

use sbgc_host::params::{Block, Blocks, Catalog, GuiFile, Include, Parameter};
use sbgc_host::proto::units::FirmwareVersion;
use serde_json::Value;

const EXAMPLE: &str = include_str!("gui/example.profile");
const NUMBERS: &str = include_str!("gui/example.json");
const FIRMWARE: FirmwareVersion = FirmwareVersion::new(2, 70, 0);

/// Blocks of a board that has other values, unknown and reserved ones included.
fn board(blocks: &[Block]) -> Blocks {
    let mut held = Blocks::default();
    for (index, block) in blocks.iter().enumerate() {
        let byte = |at: usize| u8::try_from((at * 29 + index * 7 + 3) % 251).unwrap();
        held.insert(*block, (0..block.size()).map(byte).collect());
    }
    held
}

fn catalogs() -> [Catalog; 2] {
    [Catalog::of_profile(FIRMWARE), Catalog::of_board(FIRMWARE)]
}

/// The parameter for a path of the facts, such as `CMD_READ_PARAMS_3.axis[0].P` or `….trigger_slot[2].ACTION[4]`.
fn parameter<'c>(catalogs: &'c [Catalog; 2], path: &str) -> &'c Parameter {
    let (message, field) = path.split_once('.').unwrap();
    let (group, name) = field.rsplit_once('.').map_or(("", field), |(group, name)| (group, name));
    let index = |text: &str| {
        text.split_once('[').map(|(_, rest)| rest.trim_end_matches(']').parse::<usize>().unwrap())
    };
    let spec = name.split('[').next().unwrap();
    let all: Vec<_> = catalogs
        .iter()
        .flat_map(Catalog::iter)
        .filter(|parameter| parameter.block.spec() == message && parameter.field.spec == spec)
        .collect();
    let groups = match group.split('[').next().unwrap() {
        "" => 1,
        "axis" => 3,
        "channel" => 2,
        "trigger_slot" => 10,
        "analog_slot" => 15,
        "step_signal" => 6,
        "rc_calib" => 5,
        other => panic!("{other}"),
    };
    let place = index(group).unwrap_or(0) * (all.len() / groups) + index(name).unwrap_or(0);
    all.get(place).unwrap_or_else(|| panic!("{path}: {} parameters", all.len()))
}

/// The raw numbers of the classes in the facts about the example: of the board and of the profile.
fn numbers(classes: &[&str], profile: usize) -> BTreeMap<String, i64> {
    let facts: Value = serde_json::from_str(NUMBERS).unwrap();
    let parts = [&facts["board"], &facts["profiles"][profile]];
    let of = |part: &Value, class: &str| part[class].as_object().cloned().unwrap_or_default();
    let all = parts.iter().flat_map(|part| classes.iter().flat_map(|class| of(part, class)));
    all.map(|(path, raw)| (path, raw.as_i64().unwrap_or_else(|| panic!("{raw}")))).collect()
}

/// Parameters of which the file has a part only, and the bits that it has.
fn mask(path: &str) -> i64 {
    if path.contains("RC_MODE") || path.contains("FILTERS_EN") { 0x0F } else { -1 }
}

fn raw(blocks: &[&Blocks], parameter: &Parameter) -> i64 {
    let bytes = blocks.iter().find_map(|blocks| blocks.bytes_of(parameter)).unwrap();
    parameter.raw(bytes).unwrap()
}

#[test]
fn the_example_gives_exactly_its_numbers_and_nothing_else() {
    let file = GuiFile::parse(EXAMPLE).unwrap();
    assert_eq!((file.firmware(), file.profile_count(), file.is_single()), (FIRMWARE, 2, false));
    let catalogs = catalogs();
    let (own, shared) = (board(&Block::OF_PROFILE), board(&Block::OF_BOARD));
    for profile in 0..2 {
        let applied = file.apply(profile, &own, &catalogs[0], &Include::ALL);
        assert!(applied.left_out.is_empty(), "{:?}", applied.left_out);
        let applied_shared = file.apply_shared(&shared, &catalogs[1], &Include::ALL);
        let (after, before) = ([&applied.blocks, &applied_shared.blocks], [&own, &shared]);
        let expected = numbers(&["sure", "likely"], profile);
        assert!(expected.len() > 350, "{}", expected.len());
        let mut named = Vec::new();
        for (path, number) in &expected {
            let parameter = parameter(&catalogs, path);
            let mask = mask(path);
            let (before, after) = (raw(&before, parameter), raw(&after, parameter));
            assert_eq!(after & mask, number & mask, "{path}");
            assert_eq!(after & !mask, before & !mask, "{path}: bits that the file does not have");
            named.push((parameter.block, parameter.offset..parameter.offset + parameter.size));
        }
        for (after, before) in after.iter().zip(before) {
            for (block, payload) in after.iter() {
                for (at, byte) in payload.iter().enumerate() {
                    if !named.iter().any(|(named, range)| *named == block && range.contains(&at)) {
                        assert_eq!(*byte, before.get(block).unwrap()[at], "{block} byte {at}");
                    }
                }
            }
        }
    }
}

#[test]
fn what_asks_for_a_word_is_written_with_that_word_only() {
    let file = GuiFile::parse(EXAMPLE).unwrap();
    let catalogs = catalogs();
    let own = board(&Block::OF_PROFILE);
    let changed = |include: &[Include]| {
        let after = file.apply(0, &own, &catalogs[0], include).blocks;
        let differences = own.values(&catalogs[0]).differences(&after.values(&catalogs[0]), None);
        differences.into_iter().map(|difference| difference.path).collect::<Vec<_>>()
    };
    let has = |paths: &[String], path: &str| paths.iter().any(|changed| changed == path);
    let (sure, likely) = (changed(&[]), changed(&[Include::Likely]));
    let (unit, link) = (changed(&[Include::UnitSpecific]), changed(&[Include::Link]));
    let all = changed(&Include::ALL);
    for (path, expected) in [
        ("rc.roll.rc_min_angle", [true, true, true, true, true]),
        ("rc_map_yaw", [false, true, false, false, true]),
        ("motors.roll.poles", [false, false, true, false, true]),
        ("serial_speed", [false, false, false, true, true]),
        // Both likely and of one machine.
        ("imu_orientation_corr.x", [false, false, false, false, true]),
        // In two scales, or a byte that is not understood in full.
        ("acc_limiter.roll", [false; 5]),
        ("step_signals[0].step_signal_cfg", [false; 5]),
    ] {
        let found = [&sure, &likely, &unit, &link, &all].map(|paths| has(paths, path));
        assert_eq!(found, expected, "{path}");
    }
    assert_eq!(file.asks_for("imu_orientation_corr.x"), [Include::Likely, Include::UnitSpecific]);
    assert_eq!(file.asks_for("gyro_trust"), []);
    assert!(
        file.never_written().any(|held| held.starts_with("angleAccLimit3 (")),
        "{:?}",
        file.never_written().collect::<Vec<_>>()
    );
}

#[test]
fn gains_are_not_taken_across_their_change_of_scale() {
    let file = GuiFile::parse(EXAMPLE).unwrap();
    let own = board(&Block::OF_PROFILE);
    let left_out =
        |firmware: FirmwareVersion| file.apply(0, &own, &Catalog::of_profile(firmware), &[]).left_out;
    assert!(left_out(FirmwareVersion::new(2, 73, 0)).is_empty());
    let left = left_out(FirmwareVersion::new(2, 73, 1));
    assert_eq!(left.len(), 12, "{left:?}");
    assert!(left.contains(&String::from("motors.pitch.d")) && left.contains(&String::from("pid_gain.yaw")));
    let newer = GuiFile::parse(&EXAMPLE.replace("<firmwareVer>2700<", "<firmwareVer>2731<")).unwrap();
    assert_eq!(
        newer.apply(0, &own, &Catalog::of_profile(FirmwareVersion::new(2, 73, 5)), &[]).left_out.len(),
        12
    );
    assert!(newer.is_for(FirmwareVersion::new(2, 73, 5)) && !newer.is_for(FIRMWARE));
}

#[test]
fn older_firmware_has_follow_offsets_in_whole_steps() {
    let start = EXAMPLE.find("<followOffset>").unwrap();
    let end = EXAMPLE.find("</followOffset>").unwrap();
    let offsets = "<followOffset><float>-1.0</float><float>-1.0</float><float>10.0</float>";
    let text = format!("{}{offsets}{}", &EXAMPLE[..start], &EXAMPLE[end..]);
    let old = GuiFile::parse(&text.replace("<firmwareVer>2700<", "<firmwareVer>2630<")).unwrap();
    let catalog = Catalog::of_profile(FirmwareVersion::new(2, 63, 0));
    let own = board(&Block::OF_PROFILE);
    let after = old.apply(0, &own, &catalog, &[Include::Likely]).blocks;
    let values = ["roll", "pitch", "yaw"]
        .map(|axis| raw(&[&after], catalog.one(&format!("follow_offset.{axis}")).unwrap()));
    assert_eq!(values, [-1, -1, 10]);
}

#[test]
fn every_reason_refuses_the_whole_file() {
    let with = |from: &str, to: &str| {
        assert!(EXAMPLE.contains(from), "{from}");
        EXAMPLE.replacen(from, to, 1)
    };
    let doubled =
        |element: &str| with(&format!("<{element}>"), &format!("<{element}>1</{element}><{element}>"));
    let second_profile =
        with("</all-profiles>", "</all-profiles><all-profiles><profile></profile></all-profiles>");
    let six = with("</all-profiles>", &format!("{}</all-profiles>", "<profile></profile>".repeat(4)));
    let no_profile = {
        let (start, end) =
            (EXAMPLE.find("<all-profiles>").unwrap(), EXAMPLE.find("</all-profiles>").unwrap());
        format!("{}{}", &EXAMPLE[..start], &EXAMPLE[end + "</all-profiles>".len()..])
    };
    for (text, expected) in [
        (EXAMPLE[..EXAMPLE.len() / 2].to_owned(), "not XML"),
        (with("</axisTop>", "</axisTip>"), "not XML"),
        (with("</saved-configuration>", "</saved-configuration><more></more>"), "stands after the end"),
        (String::new(), "there is no element"),
        (
            with("<saved-configuration>", "<!DOCTYPE x [<!ENTITY a \"b\">]><saved-configuration>"),
            "document type",
        ),
        (EXAMPLE.replace("saved-configuration", "saved"), "the root is <saved>"),
        (with("<firmwareVer>2700</firmwareVer>", ""), "<firmwareVer> is missing"),
        (with("<firmwareVer>2700<", "<firmwareVer>new<"), "<firmwareVer>: expected the number of a version"),
        (no_profile, "<profile> is missing"),
        (six, "expected 1 to 5 elements <profile>"),
        (second_profile, "<all-profiles> stands twice"),
        (with("<gyroSens>", "<gyroSens class=\"int\">"), "<gyroSens> has an attribute"),
        (with("<poles>", "<poles reference=\"../invert\">"), "<poles> has an attribute"),
        (with("<gyroSens>58</gyroSens>", "<gyroSens><null/></gyroSens>"), "<null/>"),
        (with("<gyroSens>58</gyroSens>", "<gyroSens/>"), "<gyroSens>: expected a whole number"),
        (doubled("gyroSens"), "<gyroSens> stands twice"),
        (with("<gyroSens>58<", "<gyroSens>5.8<"), "<gyroSens>: expected a whole number"),
        (with("<gyroSens>58<", "<gyroSens>many<"), "<gyroSens>: expected a whole number"),
        (with("<poles>", "<poles>\n<int>3</int>"), "<poles>: expected 3 elements <int>"),
        (
            with("<invert>\n      <boolean>false</boolean>", "<invert>\n      <int>0</int>"),
            "<invert>: expected 3 elements <boolean>",
        ),
        (with("<boolean>false</boolean>", "<boolean>no</boolean>"), "<boolean>: expected true or false"),
        (
            with("<adj-var-trigger-cfg>", "<other>").replacen("</adj-var-trigger-cfg>", "</other>", 1),
            "10 elements <adj-var-trigger-cfg>",
        ),
        (with("<gyroSens>58<", "<gyroSens>256<"), "<gyroSens> 256: out of range"),
        (with("<gyroSens>58<", "<gyroSens>-1<"), "<gyroSens> -1: out of range"),
        (with("<axisTop>-2<", "<axisTop>7<"), "<axisTop> 7: the parameter has no such value"),
        (
            with("<gyroDeadband>75<", "<gyroDeadband>30000<"),
            "<gyroDeadband> 30000: fits its parameter in no scale",
        ),
    ] {
        let error = GuiFile::parse(&text).map(drop).unwrap_err().to_string();
        assert!(error.contains(expected), "expected {expected:?}, got {error:?}");
    }
    // Rates are in steps of 10 Hz, parts of bytes have few values, flags of MavLink are a byte.
    for (element, value, expected) in
        [("servoRate", "55", "expected a multiple of 10"), ("servoRate", "1000", "out of range")]
    {
        let start = EXAMPLE.find(&format!("<{element}>")).unwrap() + element.len() + 2;
        let end = start + EXAMPLE[start..].find('<').unwrap();
        let error = GuiFile::parse(&format!("{}{value}{}", &EXAMPLE[..start], &EXAMPLE[end..])).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
    for (list, expected) in [
        ("mavlink__flags", "out of range"),
        ("rcMode", "out of range"),
        ("d__lpfFreq", "expected a multiple of 10"),
    ] {
        let start = EXAMPLE.find(&format!("<{list}>")).unwrap();
        let start = start + EXAMPLE[start..].find("<int>").unwrap() + "<int>".len();
        let end = start + EXAMPLE[start..].find('<').unwrap();
        let error = GuiFile::parse(&format!("{}301{}", &EXAMPLE[..start], &EXAMPLE[end..])).unwrap_err();
        assert!(error.to_string().contains(expected), "{list}: {error}");
    }
}

#[test]
fn what_is_not_written_is_named() {
    let text = EXAMPLE
        .replacen("<gyroSens>", "<newThing>7</newThing><emptyThing>0</emptyThing><gyroSens>", 1)
        .replacen("<appVer>", "<laterPart><a>1</a></laterPart><appVer>", 1);
    let file = GuiFile::parse(&text).unwrap();
    let named: Vec<_> = file.never_written().collect();
    assert!(named.contains(&"newThing (7)") && named.contains(&"laterPart (1)"), "{named:?}");
    assert!(!named.iter().any(|held| held.starts_with("emptyThing")), "{named:?}");

    // A copy that disagrees makes both doubtful.
    let start = EXAMPLE.find("<all-profiles>").unwrap();
    let at = start + EXAMPLE[start..].find("<poles>").unwrap() + "<poles>".len();
    let end = at + EXAMPLE[at..].find("</poles>").unwrap();
    let text = format!("{}<int>9</int><int>9</int><int>9</int>{}", &EXAMPLE[..at], &EXAMPLE[end..]);
    let file = GuiFile::parse(&text).unwrap();
    assert!(
        file.never_written()
            .any(|held| held.contains("poles (9, 9, 9), which board-params and profile disagree about"))
    );
    let own = board(&Block::OF_PROFILE);
    let catalog = Catalog::of_profile(FIRMWARE);
    let poles = catalog.one("motors.roll.poles").unwrap();
    let after = file.apply(0, &own, &catalog, &Include::ALL).blocks;
    assert_eq!(after.bytes_of(poles), own.bytes_of(poles));
}

#[test]
fn flags_of_32_bits_may_be_negative() {
    let start = EXAMPLE.find("<general__flags3>").unwrap() + "<general__flags3>".len();
    let end = start + EXAMPLE[start..].find('<').unwrap();
    let file = GuiFile::parse(&format!("{}-2147483647{}", &EXAMPLE[..start], &EXAMPLE[end..])).unwrap();
    let (own, catalog) = (board(&Block::OF_PROFILE), Catalog::of_profile(FIRMWARE));
    let after = file.apply(0, &own, &catalog, &Include::ALL).blocks;
    assert_eq!(raw(&[&after], catalog.one("general_flags3").unwrap()), 0x8000_0001);
}

#[test]
fn a_template_takes_the_values_and_keeps_every_other_byte() {
    let file = GuiFile::parse(EXAMPLE).unwrap();
    let catalogs = catalogs();
    let (own, shared) = (board(&Block::OF_PROFILE), board(&Block::OF_BOARD));
    let profiles: Vec<_> =
        (0..2).map(|at| file.apply(at, &own, &catalogs[0], &Include::ALL).blocks).collect();
    let after_shared = file.apply_shared(&shared, &catalogs[1], &Include::ALL).blocks;
    // The board has the values of the file, so nothing changes.
    let filled = file.fill(EXAMPLE, &profiles, &after_shared, FIRMWARE);
    for (line, (new, old)) in filled.text.lines().zip(EXAMPLE.lines()).enumerate() {
        assert_eq!(new, old, "line {line}");
    }
    assert_eq!(filled.text, EXAMPLE);
    // The board's bits that the file has no element for.
    assert!(filled.unsaid.iter().any(|path| path == "rc.pitch.rc_mode"), "{:?}", filled.unsaid);
    assert!(filled.unsaid.iter().any(|path| path.starts_with("step_signals")), "{:?}", filled.unsaid);

    let parameter = catalogs[0].one("servo_rate").unwrap();
    let mut other = profiles.clone();
    other[1].set(parameter, &parameter.parse("250 Hz").unwrap());
    let filled = file.fill(EXAMPLE, &other, &after_shared, FIRMWARE).text;
    let changed: Vec<_> = filled.lines().zip(EXAMPLE.lines()).filter(|(new, old)| new != old).collect();
    assert_eq!(changed.len(), 1);
    assert_eq!(changed[0].0.trim(), "<servoRate>250</servoRate>");
    // Gains of a board that has them in another scale stay as the template has them.
    let filled = file.fill(EXAMPLE, &profiles, &after_shared, FirmwareVersion::new(2, 73, 5));
    assert!(filled.unsaid.iter().any(|path| path == "motors.roll.p"), "{:?}", filled.unsaid);
}
