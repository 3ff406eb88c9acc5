//! The facts as data.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use sbgc_proto::{CommandId, Direction};
use serde::Deserialize;

const FILES: [&str; 3] = [
    include_str!("../protocol/params.toml"),
    include_str!("../protocol/realtime.toml"),
    include_str!("../protocol/system.toml"),
];

/// Which form of which message.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Key {
    pub(crate) id: u8,
    pub(crate) incoming: bool,
    pub(crate) form: String,
}

impl Key {
    pub(crate) fn new(id: u8, direction: Direction, form: &str) -> Self {
        Key { id, incoming: direction == Direction::Incoming, form: form.to_owned() }
    }

    fn direction(&self) -> Direction {
        if self.incoming { Direction::Incoming } else { Direction::Outgoing }
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let direction = self.direction().as_str();
        write!(f, "{} {direction} {}", command(self.id, self.direction()), self.form)
    }
}

/// Name of a command.
pub(crate) fn command(id: u8, direction: Direction) -> String {
    CommandId::from_raw(id).spec_name(direction).map_or_else(|| id.to_string(), str::to_owned)
}

pub(crate) struct Facts {
    pub(crate) messages: BTreeMap<Key, Message>,
    /// Tables of values and of bits. A name may stand for several that complete each other.
    pub(crate) tables: Vec<Table>,
    pub(crate) structs: BTreeMap<String, Vec<Field>>,
    /// Commands whose payload is not published.
    pub(crate) unpublished: BTreeSet<u8>,
    /// Names and ids of all commands.
    pub(crate) commands: BTreeSet<(String, i64)>,
}

impl Facts {
    pub(crate) fn read() -> Self {
        let mut facts = Facts {
            messages: BTreeMap::new(),
            tables: Vec::new(),
            structs: BTreeMap::new(),
            unpublished: BTreeSet::new(),
            commands: BTreeSet::new(),
        };
        for text in FILES {
            let file: File = toml::from_str(text).expect("the facts are well-formed");
            for message in file.message {
                let key = Key {
                    id: message.id,
                    incoming: message.direction == "incoming",
                    form: message.form.clone(),
                };
                assert!(facts.messages.insert(key, message).is_none(), "each form stands once");
            }
            facts.tables.extend(file.values);
            facts.tables.extend(file.flags);
            facts
                .structs
                .extend(file.structs.into_iter().map(|structure| (structure.name, structure.fields)));
            facts.unpublished.extend(file.unpublished.iter().map(|command| command.id));
            facts.commands.extend(file.command.into_iter().map(|command| (command.name, command.id.into())));
        }
        facts
    }

    /// The names and raw values of all tables that are called `name`.
    pub(crate) fn labels(&self, name: &str) -> BTreeSet<(String, i64)> {
        let tables: Vec<_> = self.tables.iter().filter(|table| table.name == name).collect();
        assert!(!tables.is_empty(), "no table is called {name}");
        tables.iter().flat_map(|table| table.labels()).collect()
    }
}

#[derive(Deserialize)]
struct File {
    message: Vec<Message>,
    #[serde(rename = "enum")]
    values: Vec<Table>,
    flags: Vec<Table>,
    #[serde(default, rename = "struct")]
    structs: Vec<Structure>,
    #[serde(default)]
    unpublished: Vec<Command>,
    #[serde(default)]
    command: Vec<Command>,
}

#[derive(Deserialize)]
pub(crate) struct Message {
    id: u8,
    pub(crate) name: String,
    direction: String,
    form: String,
    size: Option<usize>,
    min_size: Option<usize>,
    max_size: Option<usize>,
    pub(crate) fields: Vec<Field>,
}

impl Message {
    pub(crate) fn least(&self) -> usize {
        self.size.or(self.min_size).expect("a message has a size")
    }

    pub(crate) fn most(&self) -> usize {
        self.size.or(self.max_size).expect("a message has a size")
    }
}

/// A field, or a group of fields.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Field {
    #[serde(default)]
    pub(crate) name: String,
    #[serde(default, rename = "type")]
    pub(crate) kind: String,
    pub(crate) count: Option<Count>,
    pub(crate) repeat: Option<Count>,
    pub(crate) offset: Option<usize>,
    pub(crate) present_if: Option<String>,
    #[serde(default)]
    pub(crate) optional: bool,
    pub(crate) scale: Option<f64>,
    #[serde(default)]
    pub(crate) unit: String,
    pub(crate) min: Option<f64>,
    pub(crate) max: Option<f64>,
    #[serde(rename = "enum")]
    pub(crate) values: Option<String>,
    pub(crate) flags: Option<String>,
    #[serde(rename = "struct")]
    pub(crate) structure: Option<String>,
    #[serde(default)]
    pub(crate) special: BTreeMap<String, i64>,
    #[serde(default)]
    pub(crate) fields: Vec<Field>,
}

/// How many there are.
#[derive(Clone, Debug, Deserialize)]
#[serde(from = "toml::Value")]
pub(crate) enum Count {
    Fixed(usize),
    /// As many as another field says, or as there are to the end of the payload.
    Told,
}

impl From<toml::Value> for Count {
    fn from(value: toml::Value) -> Self {
        match value.as_integer() {
            Some(count) => Count::Fixed(count.try_into().expect("a count is not negative")),
            None => Count::Told,
        }
    }
}

/// Names of values, or of bits.
#[derive(Deserialize)]
pub(crate) struct Table {
    pub(crate) name: String,
    #[serde(default)]
    values: BTreeMap<String, i64>,
    bits: Option<BTreeMap<String, i64>>,
    #[serde(default)]
    newer: BTreeMap<String, i64>,
    #[serde(default)]
    special: BTreeMap<String, i64>,
    #[serde(default)]
    errata: BTreeMap<String, i64>,
    #[serde(default)]
    shift: u32,
}

impl Table {
    /// The names, each with its value in the whole number.
    fn labels(&self) -> impl Iterator<Item = (String, i64)> {
        let of_bits = self.bits.is_some();
        let base = self.bits.as_ref().unwrap_or(&self.values);
        base.iter()
            .chain(&self.newer)
            .chain(&self.special)
            .chain(&self.errata)
            .map(move |(name, value)| (name.clone(), if of_bits { 1 << value } else { value << self.shift }))
    }
}

#[derive(Deserialize)]
struct Structure {
    name: String,
    fields: Vec<Field>,
}

#[derive(Deserialize)]
struct Command {
    id: u8,
    name: String,
}
