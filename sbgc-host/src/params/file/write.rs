//! Making a document, and bringing one up to date in which people left comments.

use std::fmt::Write as _;

use toml_edit::{DocumentMut, Item, TableLike, Value};

use super::read::RAW;
use crate::params::block::Profile;
use crate::params::catalog::Catalog;
use crate::params::parameter::{Parameter, Value as Held, hex};
use crate::params::set::{Blocks, Snapshot};

/// What a new document begins with.
const HEADER: &str = "\
# Parameters of a SimpleBGC32 board.
# A line that is missing leaves the parameter as it is; a value wins over the raw block.
";

/// What stands behind a value that is never written.
const STATE: &str = "set by the board, not restored";

impl Parameter {
    /// The value as it stands in a document.
    pub(super) fn written(&self, bytes: &[u8]) -> String {
        let quoted = |text: String| Value::from(text).to_string();
        if let Some(label) = self.name_that_reads_back(bytes) {
            return quoted(label);
        }
        match self.value(bytes) {
            Held::Text(text) => quoted(text),
            Held::Bytes(bytes) => quoted(hex(&bytes)),
            Held::Integer(number) => number.to_string(),
            Held::Number(_) => {
                let digits = self.digits(bytes);
                if digits.contains('.') { digits } else { digits + ".0" }
            }
        }
    }

    /// What a reader should know besides the value.
    fn remark(&self) -> &'static str {
        if self.is_state() { STATE } else { self.unit() }
    }
}

/// The document for these parameters.
pub(super) fn document(snapshot: &Snapshot) -> String {
    let mut text = String::from(HEADER);
    let (board, firmware) = (snapshot.board.number(), snapshot.firmware);
    let _ = writeln!(text, "\nboard_version = \"{board:.1}\"\nfirmware = \"{firmware}\"");
    if !snapshot.shared.is_empty() {
        section(&mut text, "board", &snapshot.shared, &Catalog::of_board(firmware));
    }
    for (profile, blocks) in &snapshot.profiles {
        section(&mut text, &table_of(*profile), blocks, &Catalog::of_profile(firmware));
    }
    text
}

fn table_of(profile: Profile) -> String {
    format!("profile.{}", profile.number())
}

fn section(text: &mut String, table: &str, blocks: &Blocks, catalog: &Catalog) {
    let _ = writeln!(text, "\n[{table}]");
    let mut block = None;
    for parameter in catalog.iter() {
        let Some(bytes) = blocks.bytes_of(parameter) else { continue };
        if block.replace(parameter.block) != Some(parameter.block) {
            let _ = writeln!(text, "# {}", parameter.block);
        }
        let key = if parameter.path.contains('[') {
            format!("{:?}", parameter.path)
        } else {
            parameter.path.clone()
        };
        let _ = write!(text, "{key} = {}", parameter.written(bytes));
        let _ = match parameter.remark() {
            "" => writeln!(text),
            remark => writeln!(text, "  # {remark}"),
        };
    }
    let _ = writeln!(text, "\n[{table}.{RAW}]");
    for (block, payload) in blocks.iter() {
        let _ = writeln!(text, "{block} = \"{}\"", hex(payload));
    }
}

/// `old` with the values of `snapshot`, comments and order kept; none where it is not such a document.
pub(super) fn updated(old: &str, snapshot: &Snapshot) -> Option<String> {
    super::ParameterFile::parse(old).ok()?.firmware?;
    let mut document: DocumentMut = old.parse().ok()?;
    let firmware = snapshot.firmware;
    replace(document.get_mut("firmware")?, &format!("\"{firmware}\""));
    if let Some(board) = document.get_mut("board_version") {
        replace(board, &format!("\"{:.1}\"", snapshot.board.number()));
    }
    if let Some(board) = document.get_mut("board") {
        update(board.as_table_like_mut()?, &snapshot.shared, &Catalog::of_board(firmware));
    }
    let tables = document.get_mut("profile")?.as_table_like_mut()?;
    let numbers: Vec<String> = tables.iter().map(|(number, _)| number.to_owned()).collect();
    let wanted: Vec<String> = snapshot.profiles.keys().map(|profile| profile.number().to_string()).collect();
    // Other profiles would be mixed with what is older than this.
    if numbers != wanted {
        return None;
    }
    for (profile, blocks) in &snapshot.profiles {
        let table = tables.get_mut(&profile.number().to_string())?.as_table_like_mut()?;
        update(table, blocks, &Catalog::of_profile(firmware));
    }
    Some(document.to_string())
}

fn update(table: &mut dyn TableLike, blocks: &Blocks, catalog: &Catalog) {
    for parameter in catalog.iter() {
        let Some(bytes) = blocks.bytes_of(parameter) else { continue };
        let written = parameter.written(bytes);
        match find(table, &parameter.path) {
            Some(item) => replace(item, &written),
            None => {
                if let Ok(value) = written.parse::<Value>() {
                    table.insert(&parameter.path, Item::Value(value));
                }
            }
        }
    }
    let Some(raw) = table.get_mut(RAW).and_then(Item::as_table_like_mut) else { return };
    for (block, payload) in blocks.iter() {
        let hex = format!("\"{}\"", hex(payload));
        match raw.get_mut(block.spec()) {
            Some(item) => replace(item, &hex),
            None => {
                if let Ok(value) = hex.parse::<Value>() {
                    raw.insert(block.spec(), Item::Value(value));
                }
            }
        }
    }
}

/// Puts a value in the place of another, with the space and the comment that were around it.
fn replace(item: &mut Item, written: &str) {
    let (Some(old), Ok(mut value)) = (item.as_value(), written.parse::<Value>()) else { return };
    *value.decor_mut() = old.decor().clone();
    *item = Item::Value(value);
}

/// The item with this path: under one key, or under one for each part.
fn find<'t>(table: &'t mut dyn TableLike, path: &str) -> Option<&'t mut Item> {
    if table.contains_key(path) {
        return table.get_mut(path);
    }
    let (first, rest) = path.split_once('.')?;
    find(table.get_mut(first)?.as_table_like_mut()?, rest)
}
