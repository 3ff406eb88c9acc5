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
use layout::Aspect::{self, After, Form, Names, Presence, Range, Scale, Size, Type, Unit};
use sbgc_proto::commands::{
    AdjVarsStateLegacy, AutoPid2LegacyRequest, CanDrvTelemetry, DebugVars3Masked, RealtimeDataCustom,
    RealtimeDataCustom2,
};
use sbgc_proto::reflect::{Describe, Shape};
use sbgc_proto::units::BoardVersion;
use sbgc_proto::{CommandId, Direction, IncomingCommand, Message, MessageInfo, OutgoingCommand};

/// Forms that are only other words for the bytes of another one: `(id, direction, form, form here)`.
const SAME: &[(u8, Direction, &str, &str)] =
    &[(104, Direction::Incoming, "newer", "full"), (105, Direction::Outgoing, "newer", "full")];

/// What differs on purpose: the message (empty for all that have the field), the field or the table of its values,
/// what of it, and why.
#[rustfmt::skip]
const ON_PURPOSE: &[(&str, &str, Aspect, &str)] = &[
    // Forms.
    ("CMD_CONFIRM incoming full", "", Form, "stands for all the forms of the next lines"),
    ("CMD_CONFIRM incoming no_data", "", Form, "the data of `Confirm` keeps its width"),
    ("CMD_CONFIRM incoming data_1u", "", Form, "the data of `Confirm` keeps its width"),
    ("CMD_CONFIRM incoming data_2u", "", Form, "the data of `Confirm` keeps its width"),
    ("CMD_CONFIRM incoming data_long", "", Form, "the data of `Confirm` keeps its width"),
    ("CMD_AHRS_HELPER incoming stream", "", Form, "sources disagree about its length; it is kept raw"),
    ("CMD_ERROR incoming legacy", "", Size, "one byte tells enough, should a board send only that"),
    ("CMD_ERROR incoming legacy", "ERROR_DATA", Presence, "the same"),
    ("CMD_AHRS_HELPER outgoing get_short", "MODE", Type, "one or two bytes are a byte and an optional one"),
    ("CMD_AHRS_HELPER outgoing get_short", "", After, "the same"),
    ("CMD_GET_ADJ_VARS_VAL outgoing full", "", Size, "the list may be empty"),
    ("CMD_GET_ADJ_VARS_VAL_F outgoing full", "", Size, "the list may be empty"),
    ("CMD_SET_ADJ_VARS_VAL outgoing full", "", Size, "the list may be empty"),
    ("CMD_SET_ADJ_VARS_VAL incoming full", "", Size, "the list may be empty"),
    ("CMD_SET_ADJ_VARS_VAL_F outgoing full", "", Size, "the list may be empty"),
    ("CMD_SET_ADJ_VARS_VAL_F incoming full", "", Size, "the list may be empty"),
    ("CMD_SAVE_PARAMS_3 outgoing extended", "", Size, "the list may be empty"),
    // Types that the facts give in words.
    ("CMD_EVENT incoming full", "PARAM1", Type, "they are a number"),
    // Scales that the facts give in words.
    ("", "API_VIRT_CH", Scale, "500 is full scale"),
    ("", "RC_DATA", Scale, "16384 is full scale"),
    ("", "RC_CHANNELS", Scale, "16384 is full scale"),
    ("", "FRAME_CAM_ANGLE_20", Scale, "as its name says"),
    ("CMD_WRITE_FILE outgoing delete", "PAGE_OFFSET", Scale, "as in the other form"),
    ("", "BOARD_VER", Scale, "two decimals"),
    ("", "BOOTLOADER_VER", Scale, "two decimals"),
    ("", "FIRMWARE_VER", Scale, "two decimals"),
    ("", "ANALOG_SRC_VALUE", Scale, "16384 is full scale"),
    ("", "LUT_SRC_VALUE", Scale, "16384 is full scale"),
    ("", "TRIGGER_RC_DATA", Scale, "16384 is full scale"),
    ("", "RC_VAL", Scale, "16384 is full scale"),
    // Units that the facts give in words.
    ("", "ANGLE", Unit, "the step of the long angle is not published"),
    ("", "CFG", Unit, "a time between packets"),
    ("", "FOLLOW_EXPO_RATE", Unit, "0 to 100"),
    ("CMD_READ_PARAMS_3 incoming full", "RC_EXPO_RATE", Unit, "0 to 100"),
    ("CMD_WRITE_PARAMS_3 outgoing full", "RC_EXPO_RATE", Unit, "0 to 100"),
    ("", "FOLLOW_ROLL_MIX_START", Unit, "an angle"),
    ("", "FOLLOW_ROLL_MIX_RANGE", Unit, "an angle"),
    ("", "FRAME_CAM_ANGLE_20", Unit, "an angle"),
    ("CMD_WRITE_FILE outgoing delete", "FILE_SIZE", Unit, "as in the other form"),
    ("CMD_WRITE_FILE outgoing delete", "PAGE_OFFSET", Unit, "as in the other form"),
    // Ranges.
    ("", "API_VIRT_CH", Range, "slightly beyond is allowed, and there are names"),
    ("", "NOTE_FREQ_HZ", Range, "beyond are pauses"),
    ("", "NOTE_LENGTH", Range, "0 is as good with standard sounds"),
    ("", "SIZE", Range, "a multiple of 64 that fits a payload"),
    ("", "DATA_LEN", Range, "none is nothing to ask for"),
    ("", "IMU_ANGLES_RAD", Range, "π itself is slightly beyond as a float"),
    ("CMD_RUN_SCRIPT outgoing full", "SLOT", Range, "newer firmware has ten slots"),
    ("", "DEBUG_VARS_NUM", Range, "the list may be empty"),
    ("", "DEVICE_NUM", Range, "the length of the list limits it"),
    ("", "NUM_PARAMS", Range, "the length of the list limits it"),
    // Names for what the facts give in words.
    ("", "VAR_ID", Names, "given in words"),
    ("", "DEBUG_VAR_TYPE", Names, "axes are a part, not flags"),
    ("", "API_VIRT_CH", Names, "given in words"),
    ("", "NOTE_FREQ_HZ", Names, "given in words"),
    ("", "ACC_CUR_AXIS", Names, "given in words"),
    ("", "SERVO_TIME", Names, "given in words"),
    ("", "DEVICE_ADDR", Names, "given in words"),
    ("", "PORT_AND_DIR", Names, "given in words"),
    ("", "TARGET", Names, "given in words"),
    ("", "CAN_DEVICE_TYPE", Names, "given in words"),
    ("", "FRAME_IMU_REF_SRC", Names, "given in words"),
    ("", "MAIN_IMU_REF_SRC", Names, "given in words"),
    ("", "EXT_MOTOR_STATE_FLAG", Names, "given in words"),
    ("", "ENCODER_CFG_EXT", Names, "given in words"),
    ("", "RC_MODE", Names, "given in words"),
    // Names that one type has for several fields.
    ("", "ANALOG_SRC_VALUE", Names, "those of `RcSignal`"),
    ("", "LUT_SRC_VALUE", Names, "those of `RcSignal`"),
    ("", "TRIGGER_RC_DATA", Names, "those of `RcSignal`"),
    ("", "RC_DATA", Names, "`RcSignal` knows the old value as well"),
    ("", "RC_CHANNELS", Names, "`RcSignal` knows the old value as well"),
    // Names that are left out or stand elsewhere.
    ("", "RC_MAP", Names, "`WideRcSource` leaves them to `RcSource`"),
    ("", "BOARD_VER", Names, "they stand beside the number, in `BoardVersion::NAMES`"),
    ("CMD_RESET outgoing extended", "NO_YES", Names, "newer firmware has flags there, the first of which is this"),
    ("", "PROFILE_FLAGS1", Names, "sources disagree about the bit, which has the other name"),
    ("", "EULER_ORDER", Names, "orders that were renamed have their first names; the flags are given in words"),
    ("", "CONTROL_MODE and CONTROL_FLAG", Names, "the bit has the name that it has in other modes"),
    ("CMD_AHRS_HELPER outgoing mode1u", "AHRS_HELPER_MODE", Names, "the form of one byte has no such bit"),
    ("CMD_AHRS_HELPER outgoing mode2u", "AHRS_HELPER_MODE", Names, "given in words"),
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
                    report.add(key, "", Form, &format!("is called {}, should be {}", info.spec, fact.name));
                }
                let size = fact.least()..=fact.most();
                if info.size != size {
                    report.add(key, "", Size, &format!("has {:?} bytes, should have {size:?}", info.size));
                }
                for difference in layout::differences(&facts, fact, &info.shape) {
                    report.add(key, &difference.field, difference.aspect, &difference.text);
                }
            }
            None => report.add(key, "", Form, "has no message"),
        }
    }
    for (key, info) in &declared {
        let raw = facts.unpublished.contains(&key.id) && layout::is_raw(&info.shape);
        if !facts.messages.contains_key(key) && !raw {
            report.add(key, "", Form, "is unknown to the facts");
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
    /// Which of the exceptions were needed.
    excused: BTreeSet<usize>,
}

impl Report {
    fn add(&mut self, key: &Key, field: &str, aspect: Aspect, what: &str) {
        let message = key.to_string();
        // An exception for the message itself comes before one for all.
        let excuses = |of: &str| {
            ON_PURPOSE
                .iter()
                .position(|(place, name, kind, _)| *place == of && *name == field && *kind == aspect)
        };
        match excuses(&message).or_else(|| excuses("")) {
            Some(index) => {
                self.excused.insert(index);
            }
            None => self.lines.entry(what.to_owned()).or_default().push(message),
        }
    }

    /// Adds what is excused without need.
    fn finish(&mut self) {
        for (index, (place, field, aspect, _)) in ON_PURPOSE.iter().enumerate() {
            if !self.excused.contains(&index) {
                let line = format!("is no difference any more: {place} {field} {aspect:?}");
                self.lines.insert(line, Vec::new());
            }
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
