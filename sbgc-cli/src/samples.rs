//! Samples as lines under each other, as JSON Lines, or as CSV.

use std::time::Duration;

use sbgc_host::capture::Interpreted;
use sbgc_proto::reflect::{Leaf, Raw};
use serde_json::{Map, Value};

use crate::failure::Failure;
use crate::output::Output;
use crate::table::{Cell, Table};
use crate::{fields, text};

/// The key that always comes first.
const TIME: &str = "timestamp_ms";

/// One field of a sample.
struct Entry {
    path: String,
    value: Value,
    /// The number on the wire of what is shown by name.
    raw: Option<i64>,
    cell: Cell,
}

/// Prints samples of one kind.
#[derive(Default)]
pub(crate) struct Printer {
    /// The keys to show, in this order; all when empty.
    fields: Vec<String>,
    csv: bool,
    table: Option<Table>,
    begun: bool,
}

impl Printer {
    /// Shows these fields, all when there are none.
    pub(crate) fn new(fields: Vec<String>, csv: bool) -> Self {
        Self { fields, csv, ..Self::default() }
    }

    /// Prints one sample. Where the message has no time of its own, `time` is shown, which counts from the start.
    pub(crate) fn print(
        &mut self,
        output: &mut Output,
        message: &Interpreted<'_>,
        time: Duration,
    ) -> Result<(), Failure> {
        let mut entries = Vec::new();
        message.walk(&mut |leaf: &Leaf<'_>| {
            if !leaf.field.reserved {
                entries.push(Entry::of(leaf));
            }
        });
        let position = entries.iter().position(|entry| entry.path == TIME);
        let first = match position {
            Some(position) => entries.remove(position),
            None => Entry::time(time),
        };
        entries.insert(0, first);
        let entries = self.choose(entries)?;
        if output.is_json() {
            let object: Map<_, _> = entries.into_iter().map(|entry| (entry.path, entry.value)).collect();
            output.object(&Value::Object(object))?;
        } else if self.csv {
            if !std::mem::replace(&mut self.begun, true) {
                let names: Vec<_> = entries.iter().map(|entry| quoted(&entry.path)).collect();
                output.line(names.join(","))?;
            }
            let values: Vec<_> = entries.iter().map(Entry::plain).collect();
            output.line(values.join(","))?;
        } else {
            let cells: Vec<_> = entries.into_iter().map(|entry| entry.cell).collect();
            let table = match &mut self.table {
                Some(table) => table,
                none => {
                    let new = Table::for_cells(&cells);
                    new.header().iter().try_for_each(|line| output.line(line))?;
                    none.insert(new)
                }
            };
            output.line(table.row(&cells))?;
        }
        output.flush()?;
        Ok(())
    }

    fn choose(&self, mut entries: Vec<Entry>) -> Result<Vec<Entry>, Failure> {
        if self.fields.is_empty() {
            return Ok(entries);
        }
        let mut chosen = vec![entries.remove(0)];
        for field in self.fields.iter().filter(|field| *field != TIME) {
            match entries.iter().position(|entry| entry.path == *field) {
                Some(position) => chosen.push(entries.remove(position)),
                None if chosen.iter().any(|entry| entry.path == *field) => {}
                None => {
                    let known = entries.iter().map(|entry| entry.path.as_str());
                    return Err(Failure::Usage(text::unknown("field", field, known)));
                }
            }
        }
        Ok(chosen)
    }
}

impl Entry {
    fn of(leaf: &Leaf<'_>) -> Self {
        let mut object = Map::new();
        fields::add_leaf(&mut object, leaf);
        let path = leaf.path.to_string();
        let value = object.remove(&path).unwrap_or(Value::Null);
        let raw = match leaf.raw {
            Raw::Number(raw) => Some(raw),
            _ => None,
        };
        Self { path, value, raw, cell: Cell::of_leaf(leaf) }
    }

    fn time(time: Duration) -> Self {
        let milliseconds = u64::try_from(time.as_millis()).unwrap_or(u64::MAX);
        Self {
            path: TIME.into(),
            value: milliseconds.into(),
            raw: None,
            cell: Cell::time(TIME, milliseconds),
        }
    }

    /// The value in CSV: numbers alone, also for what has names; nothing for NaN.
    fn plain(&self) -> String {
        match (&self.value, self.raw) {
            (Value::Number(number), _) => number.to_string(),
            (Value::String(_), Some(raw)) => raw.to_string(),
            (Value::String(text), None) => quoted(text),
            _ => String::new(),
        }
    }
}

/// Text as CSV has it.
fn quoted(text: &str) -> String {
    if text.contains(['"', ',', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
