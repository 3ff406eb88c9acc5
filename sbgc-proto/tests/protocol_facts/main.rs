//! Compares every declared message with the facts about the protocol in `protocol/*.toml`, in both directions: no
//! message, field, unit, range, value or flag is missing here, and none is here that the facts do not have.
//!
//! All differences are shown at once. What differs on purpose is listed in the constants, each with its reason; an
//! entry that has become needless is a difference too.

mod facts;
mod labels;
mod layout;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::RangeInclusive;

use facts::{Facts, Key};
use sbgc_proto::commands::{
    AdjVarsStateLegacy, AutoPid2LegacyRequest, CanDrvTelemetry, DebugVars3Masked, RealtimeDataCustom,
    RealtimeDataCustom2,
};
use sbgc_proto::reflect::{Describe, MessageInfo, Shape};
use sbgc_proto::units::BoardVersion;
use sbgc_proto::{CommandId, Direction, IncomingCommand, Message, OutgoingCommand};

/// Forms that are only other words for the bytes of another one: `(id, direction, form, form here)`.
const SAME: &[(u8, Direction, &str, &str)] =
    &[(104, Direction::Incoming, "newer", "full"), (105, Direction::Outgoing, "newer", "full")];

/// What differs on purpose, and why: a difference as it is shown, with its place or without.
#[rustfmt::skip]
const ON_PURPOSE: &[(&str, &str)] = &[
    // Forms.
    ("CMD_CONFIRM incoming full: is unknown to the facts", "stands for all the forms of the next lines"),
    ("CMD_CONFIRM incoming no_data: has no message", "the data of `Confirm` keeps its width"),
    ("CMD_CONFIRM incoming data_1u: has no message", "the data of `Confirm` keeps its width"),
    ("CMD_CONFIRM incoming data_2u: has no message", "the data of `Confirm` keeps its width"),
    ("CMD_CONFIRM incoming data_long: has no message", "the data of `Confirm` keeps its width"),
    ("CMD_AHRS_HELPER incoming stream: is unknown to the facts", "sources disagree about its length; it is kept raw"),
    ("CMD_ERROR incoming legacy: has 1..=5 bytes, should have 5..=5", "one byte tells enough, should a board send only that"),
    ("CMD_ERROR incoming legacy: ERROR_DATA should be there always", "the same"),
    ("CMD_AHRS_HELPER outgoing get_short: MODE is Number(\"u8\"), should be Rest", "one or two bytes are a byte and an optional one"),
    ("CMD_AHRS_HELPER outgoing get_short: what follows is not compared", "the same"),
    ("CMD_GET_ADJ_VARS_VAL outgoing full: has 1..=41 bytes, should have 2..=41", "the list may be empty"),
    ("CMD_GET_ADJ_VARS_VAL_F outgoing full: has 1..=41 bytes, should have 2..=41", "the list may be empty"),
    ("has 1..=201 bytes, should have 6..=201", "the list may be empty"),
    ("CMD_SAVE_PARAMS_3 outgoing extended: has 0..=255 bytes, should have 1..=255", "the list may be empty"),
    // Types that the facts give in words.
    ("CMD_EVENT incoming full: PARAM1 is Number(\"u16\"), should be Bytes(2)", "they are a number"),
    // Scales that the facts give in words.
    ("API_VIRT_CH has the scale 0.002, should have 1", "500 is full scale"),
    ("API_VIRT_CH has the scale 0.00006103515625, should have 1", "16384 is full scale"),
    ("RC_DATA has the scale 0.00006103515625, should have 1", "16384 is full scale"),
    ("RC_CHANNELS has the scale 0.00006103515625, should have 1", "16384 is full scale"),
    ("FRAME_CAM_ANGLE_20 has the scale 0.00034332275390625, should have 1", "as its name says"),
    ("CMD_WRITE_FILE outgoing delete: PAGE_OFFSET has the scale 64, should have 1", "as in the other form"),
    ("BOARD_VER has the scale 0.01, should have 1", "two decimals"),
    ("BOOTLOADER_VER has the scale 0.01, should have 1", "two decimals"),
    ("FIRMWARE_VER has the scale 0.01, should have 1", "two decimals"),
    ("ANALOG_SRC_VALUE has the scale 0.00006103515625, should have 1", "16384 is full scale"),
    ("LUT_SRC_VALUE has the scale 0.00006103515625, should have 1", "16384 is full scale"),
    ("TRIGGER_RC_DATA has the scale 0.00006103515625, should have 1", "16384 is full scale"),
    ("RC_VAL has the scale 0.00006103515625, should have 1", "16384 is full scale"),
    // Units that the facts give in words.
    ("ANGLE has the unit \"\", should have \"deg\"", "the step of the long angle is not published"),
    ("CFG has the unit \"ms\", should have \"\"", "a time between packets"),
    ("FOLLOW_EXPO_RATE has the unit \"%\", should have \"\"", "0 to 100"),
    ("CMD_READ_PARAMS_3 incoming full: RC_EXPO_RATE has the unit \"%\", should have \"\"", "0 to 100"),
    ("CMD_WRITE_PARAMS_3 outgoing full: RC_EXPO_RATE has the unit \"%\", should have \"\"", "0 to 100"),
    ("FOLLOW_ROLL_MIX_START has the unit \"deg\", should have \"\"", "an angle"),
    ("FOLLOW_ROLL_MIX_RANGE has the unit \"deg\", should have \"\"", "an angle"),
    ("FRAME_CAM_ANGLE_20 has the unit \"deg\", should have \"\"", "an angle"),
    ("CMD_WRITE_FILE outgoing delete: FILE_SIZE has the unit \"byte\", should have \"\"", "as in the other form"),
    ("CMD_WRITE_FILE outgoing delete: PAGE_OFFSET has the unit \"byte\", should have \"\"", "as in the other form"),
    // Ranges.
    ("API_VIRT_CH goes from -32768 to 32767, should from -500 to 500", "slightly beyond is allowed, and there are names"),
    ("API_VIRT_CH goes from -32768 to 32767, should from -16384 to 16384", "slightly beyond is allowed, and there are names"),
    ("NOTE_FREQ_HZ goes from 554 to 65535, should from 554 to 21000", "beyond are pauses"),
    ("NOTE_LENGTH goes from 0 to 255, should from 1 to 255", "0 is as good with standard sounds"),
    ("SIZE goes from 64 to 192, should from 0 to 65535", "a multiple of 64 that fits a payload"),
    ("DATA_LEN goes from 1 to 255, should from 0 to 255", "none is nothing to ask for"),
    ("IMU_ANGLES_RAD goes from -inf to inf, should from -3.14159265 to 3.14159265", "π itself is slightly beyond as a float"),
    ("CMD_RUN_SCRIPT outgoing full: SLOT goes from 0 to 9, should from 0 to 4", "newer firmware has ten slots"),
    ("DEBUG_VARS_NUM goes from 0 to 255, should from 1 to 255", "the list may be empty"),
    ("DEVICE_NUM goes from 0 to 255, should from 0 to 19", "the length of the list limits it"),
    ("NUM_PARAMS goes from 0 to 255, should from 1 to 40", "the length of the list limits it"),
    // Names for what the facts give in words.
    ("VAR_ID has, unlike the facts, MULTIPLIER = 128", "given in words"),
    ("DEBUG_VAR_TYPE has, unlike the facts, NONE = 0, VAR_FLAG_PITCH = 32, VAR_FLAG_ROLL = 16, VAR_FLAG_YAW = 48", "axes are a part, not flags"),
    ("API_VIRT_CH has, unlike the facts, UNDEFINED = -10000", "given in words"),
    ("NOTE_FREQ_HZ has, unlike the facts, RESTART = 21000", "given in words"),
    ("ACC_CUR_AXIS has, unlike the facts, X = 0, Y = 1, Z = 2", "given in words"),
    ("SERVO_TIME has, unlike the facts, FLOATING = -1, LOW = 0", "given in words"),
    ("DEVICE_ADDR has, unlike the facts, EXTERNAL = 0, INTERNAL = 1", "given in words"),
    ("PORT_AND_DIR has, unlike the facts, DIR = 128", "given in words"),
    ("TARGET has, unlike the facts, WAIT = 64", "given in words"),
    ("CAN_DEVICE_TYPE has, unlike the facts, HARDWARE_ID = 128", "given in words"),
    ("FRAME_IMU_REF_SRC has, unlike the facts, ENABLED = 128, INTERNAL_SENSOR = 64", "given in words"),
    ("MAIN_IMU_REF_SRC has, unlike the facts, ENABLED = 128, INTERNAL_SENSOR = 64", "given in words"),
    ("EXT_MOTOR_STATE_FLAG has, unlike the facts, OFF_BRAKE = 0, OFF_FLOATING = 2, OFF_SAFE_STOP = 3, ON = 1", "given in words"),
    ("ENCODER_CFG_EXT has, unlike the facts, 12 = 32, 16 = 64, 20 = 96, 24 = 128, NONE = 0", "given in words"),
    ("RC_MODE has, unlike the facts, INVERTED = 8", "given in words"),
    // Names that one type has for several fields.
    ("ANALOG_SRC_VALUE has, unlike the facts, UNDEFINED = -32768, UNDEFINED_OLD = -32767", "those of `RcSignal`"),
    ("LUT_SRC_VALUE has, unlike the facts, UNDEFINED = -32768, UNDEFINED_OLD = -32767", "those of `RcSignal`"),
    ("TRIGGER_RC_DATA has, unlike the facts, UNDEFINED = -32768, UNDEFINED_OLD = -32767", "those of `RcSignal`"),
    ("RC_DATA has, unlike the facts, UNDEFINED_OLD = -32767", "`RcSignal` knows the old value as well"),
    ("RC_CHANNELS has, unlike the facts, UNDEFINED_OLD = -32767", "`RcSignal` knows the old value as well"),
    ("API_VIRT_CH has, unlike the facts, UNDEFINED = -32768, UNDEFINED_OLD = -32767", "`RcSignal` knows the old value as well"),
    // Names that are left out or stand elsewhere.
    ("RC_MAP lacks ADC1 = 33, ADC2 = 34, ADC3 = 35, ADC4 = 36, EXT_FC_INPUT_PITCH = 4, EXT_FC_INPUT_ROLL = 3, NOT_ASSIGNED = 0, RC_INPUT_PITCH = 2, RC_INPUT_ROLL = 1, RC_INPUT_YAW = 5", "`WideRcSource` leaves them to `RcSource`"),
    ("BOARD_VER lacks CAN_MCU = 50, EXTENDED = 36, EXTENDED_LONG_GD32 = 27, OEM = 34, PRO = 41, REGULAR = 30, TINY = 31, TINY_REV_C_GD32 = 25", "they stand beside the number, in `BoardVersion::NAMES`"),
    ("CMD_RESET outgoing extended: NO_YES lacks NO = 0, YES = 1", "newer firmware has flags there, the first of which is this"),
    ("PROFILE_FLAGS1 lacks GIMBAL_LOCK_SMOOTH_TRANSITION = 16384", "sources disagree about the bit, which has the other name"),
    ("EULER_ORDER lacks PITCH_M_ROLL_YAW_M = 2, ROLL_PITCH_M_YAW_M = 3; has, unlike the facts, CONTROL_LOCAL_XYZ = 16, STABILIZATION_LOCAL_XYZ = 32", "orders that were renamed have their first names; the flags are given in words"),
    ("CONTROL_MODE and CONTROL_FLAG lacks CONTROL_FLAG_FORCE_RC_SPEED = 64", "the bit has the name that it has in other modes"),
    ("CMD_AHRS_HELPER outgoing mode1u: AHRS_HELPER_MODE lacks DISABLE_INTERNAL_CORRECTION = 1024", "the form of one byte has no such bit"),
    ("CMD_AHRS_HELPER outgoing mode2u: AHRS_HELPER_MODE has, unlike the facts, BELOW_OUTER_MOTOR = 512, ON_FRAME = 256, WITH_FRAME_IMU = 0", "given in words"),
];

#[test]
fn messages_are_as_the_facts_say() {
    let facts = Facts::read();
    let all = OutgoingCommand::ALL.iter().chain(IncomingCommand::ALL).map(Declared::of_info);
    let besides = [
        // The list of all messages has these as raw bytes behind a fixed head.
        Declared::of::<CanDrvTelemetry>(),
        Declared::of::<RealtimeDataCustom>(),
        Declared::of::<RealtimeDataCustom2>(),
        Declared::of::<DebugVars3Masked<'_>>(),
        // Only the version of the firmware tells these from the forms in that list.
        Declared::of::<AdjVarsStateLegacy>(),
        Declared::of::<AutoPid2LegacyRequest>(),
    ];
    let declared: BTreeMap<Key, Declared> = all.chain(besides).collect();
    let mut report = Report::default();

    for (key, fact) in &facts.messages {
        match declared.get(key).or_else(|| declared.get(&same(key)?)) {
            Some(info) => {
                if info.spec != fact.name {
                    report.add(key, &format!("is called {}, should be {}", info.spec, fact.name));
                }
                let size = fact.least()..=fact.most();
                if info.size != size {
                    report.add(key, &format!("has {:?} bytes, should have {size:?}", info.size));
                }
                for what in layout::differences(&facts, fact, &info.shape) {
                    report.add(key, &what);
                }
            }
            None => report.add(key, "has no message"),
        }
    }
    for (key, info) in &declared {
        let raw = facts.unpublished.contains(&key.id) && layout::is_raw(&info.shape);
        if !facts.messages.contains_key(key) && !raw {
            report.add(key, "is unknown to the facts");
        }
    }
    for id in facts.unpublished.iter().filter(|id| !declared.keys().any(|key| key.id == **id)) {
        report.lines.insert(format!("command {id} has no message"), Vec::new());
    }
    report.finish();
    assert!(report.lines.is_empty(), "{report}");
}

/// The form whose bytes `key` has, too.
fn same(key: &Key) -> Option<Key> {
    let (id, direction, _, here) =
        SAME.iter().find(|(id, direction, form, _)| *key == Key::new(*id, *direction, form))?;
    Some(Key::new(*id, *direction, here))
}

/// What a message is declared to be.
struct Declared {
    spec: &'static str,
    size: RangeInclusive<usize>,
    shape: Shape,
}

impl Declared {
    fn of<M: Message + Describe>() -> (Key, Self) {
        let key = Key::new(M::ID.raw(), M::DIRECTION, M::FORM);
        (key, Declared { spec: M::SPEC, size: M::SIZE, shape: M::SHAPE })
    }

    fn of_info(info: &MessageInfo) -> (Key, Self) {
        let key = Key::new(info.id.raw(), info.direction, info.form);
        (key, Declared { spec: info.spec, size: info.size.clone(), shape: info.shape })
    }
}

/// Differences, each with the places where it is.
#[derive(Default)]
struct Report {
    lines: BTreeMap<String, Vec<String>>,
    excused: BTreeSet<&'static str>,
}

impl Report {
    fn add(&mut self, key: &Key, what: &str) {
        let line = format!("{key}: {what}");
        match ON_PURPOSE.iter().find(|(text, _)| *text == line || *text == what) {
            Some((text, _)) => {
                self.excused.insert(text);
            }
            None => self.lines.entry(what.to_owned()).or_default().push(key.to_string()),
        }
    }

    /// Adds what is excused without need.
    fn finish(&mut self) {
        for (text, _) in ON_PURPOSE.iter().filter(|(text, _)| !self.excused.contains(text)) {
            self.lines.insert(format!("is no difference any more: {text}"), Vec::new());
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} differences:", self.lines.len())?;
        let mut lines: Vec<_> = self.lines.iter().map(|(what, places)| (places, what)).collect();
        lines.sort();
        lines.iter().try_for_each(|(places, what)| match &places[..] {
            [] => writeln!(f, "- {what}"),
            [place] => writeln!(f, "- {place}: {what}"),
            [place, more @ ..] => writeln!(f, "- {place} and {} more: {what}", more.len()),
        })
    }
}

#[test]
fn commands_have_the_names_of_the_facts() {
    for (name, id) in Facts::read().commands {
        let command = CommandId::from_raw(u8::try_from(id).unwrap());
        let names = [Direction::Outgoing, Direction::Incoming].map(|direction| command.spec_name(direction));
        assert!(names.contains(&Some(name.as_str())), "{id}: {names:?} instead of {name}");
    }
}

#[test]
fn boards_have_the_names_of_the_facts() {
    let names = BoardVersion::NAMES.iter().map(|label| (label.name.to_owned(), label.value));
    assert_eq!(names.collect::<BTreeSet<_>>(), Facts::read().labels("BOARD_VER"));
}
