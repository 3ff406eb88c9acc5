//! Taking a document apart: syntax, names and ranges, all checked before anything is done with it.

use sbgc_proto::reflect::{AssignError, Input};
use toml_edit::{Document, Item, TableLike, Value};

use super::{FileError, FileProblem, ParameterFile, Section};
use crate::params::block::{Block, Profile};
use crate::params::catalog::Catalog;
use crate::params::parameter::{Parameter, ValueError, unhex};

/// The table of raw blocks beside the values.
pub(super) const RAW: &str = "raw";

/// What may stand at the top of a document.
const TOP: [&str; 4] = ["board_version", "firmware", "board", "profile"];

/// A value with the place where it stands.
struct Given<'d> {
    path: String,
    value: &'d Value,
    line: Option<usize>,
}

/// Finds lines from byte offsets.
#[derive(Clone, Copy)]
struct Text<'t>(&'t str);

impl Text<'_> {
    fn line(self, span: Option<std::ops::Range<usize>>) -> Option<usize> {
        let before = self.0.get(..span?.start)?;
        Some(before.matches('\n').count() + 1)
    }

    fn error(self, span: Option<std::ops::Range<usize>>, problem: FileProblem) -> FileError {
        FileError { line: self.line(span), problem: Box::new(problem) }
    }
}

impl ParameterFile {
    /// Reads a document and checks it: its syntax, the names and the ranges.
    ///
    /// ```
    /// use sbgc_host::params::ParameterFile;
    ///
    /// let file = ParameterFile::parse("firmware = \"2.73.5\"\n[profile.2]\nservo_rate = 50\n")?;
    /// assert_eq!(file.profiles().count(), 1);
    /// let error = ParameterFile::parse("[profile.2]\nservo_rate = 5000\n").unwrap_err();
    /// assert_eq!(error.to_string(), "line 2: servo_rate = 5000: out of range; expected 50 to 400 Hz");
    /// # Ok::<(), sbgc_host::params::FileError>(())
    /// ```
    ///
    /// # Errors
    /// If the text is not TOML, a name is not that of a parameter, or a value does not fit.
    pub fn parse(text: &str) -> Result<Self, FileError> {
        let document = Document::parse(text).map_err(|error| {
            Text(text).error(error.span(), FileProblem::Syntax(error.message().to_owned()))
        })?;
        let text = Text(text);
        let mut file = Self::default();
        for (name, item) in document.as_table() {
            match name {
                "board_version" => drop(text_in(text, name, item)?),
                "firmware" => {
                    let version = text_in(text, name, item)?.parse();
                    file.firmware =
                        Some(version.map_err(|_| form(text, name, item, "a version such as \"2.73.5\""))?);
                }
                "board" => {
                    let catalog = Catalog::newest_of_board();
                    file.shared = Some(section(text, name, item, &catalog, &Block::OF_BOARD)?);
                }
                "profile" => {
                    let catalog = Catalog::newest();
                    let tables =
                        item.as_table_like().ok_or_else(|| form(text, name, item, "tables 1 to 5"))?;
                    for (number, item) in tables.iter() {
                        let profile = number.parse().ok().and_then(Profile::from_number);
                        let profile = profile.ok_or_else(|| key(text, item, number, "a profile, 1 to 5"))?;
                        let section = section(text, number, item, &catalog, &Block::OF_PROFILE)?;
                        file.profiles.insert(profile, section);
                    }
                }
                _ => return Err(key(text, item, name, &TOP.join(", "))),
            }
        }
        if file.shared.is_none() && file.profiles.is_empty() {
            return Err(text.error(None, FileProblem::Empty));
        }
        Ok(file)
    }
}

fn key(text: Text<'_>, item: &Item, name: &str, expected: &str) -> FileError {
    text.error(item.span(), FileProblem::Key { name: name.to_owned(), expected: expected.to_owned() })
}

fn form(text: Text<'_>, path: &str, item: &Item, expected: &str) -> FileError {
    text.error(item.span(), FileProblem::Form { path: path.to_owned(), expected: expected.to_owned() })
}

fn text_in<'d>(text: Text<'_>, name: &str, item: &'d Item) -> Result<&'d str, FileError> {
    item.as_str().ok_or_else(|| form(text, name, item, "text in quotes"))
}

fn section(
    text: Text<'_>,
    name: &str,
    item: &Item,
    catalog: &Catalog,
    blocks: &[Block],
) -> Result<Section, FileError> {
    let table = item.as_table_like().ok_or_else(|| form(text, name, item, "a table"))?;
    let mut section = Section::default();
    if let Some(item) = table.get(RAW) {
        let raw = item.as_table_like().ok_or_else(|| form(text, RAW, item, "a table"))?;
        for (spec, item) in raw.iter() {
            let block = Block::by_spec(spec).filter(|block| blocks.contains(block));
            let block = block.ok_or_else(|| {
                let specs: Vec<_> = blocks.iter().map(|block| block.spec()).collect();
                key(text, item, spec, &specs.join(", "))
            })?;
            let bytes = unhex(text_in(text, spec, item)?).filter(|bytes| bytes.len() >= block.size());
            let expected = format!("{} bytes in hex", block.size());
            section.raw.insert(block, bytes.ok_or_else(|| form(text, spec, item, &expected))?);
        }
    }
    let mut given = Vec::new();
    flatten(text, table, "", &mut given)?;
    for Given { path, value, line } in given {
        let at_line = |problem| FileError { line, problem: Box::new(problem) };
        let parameter = catalog.by_path(&path).ok_or_else(|| at_line(catalog.unknown(&path).into()))?;
        if section.values.iter().any(|(held, _)| held.path == path) {
            return Err(at_line(FileProblem::Twice(path)));
        }
        let raw = section.raw.get(&parameter.block).and_then(|raw| parameter.of(raw));
        let bytes = bytes_of(parameter, value, raw).map_err(|source| {
            let value = value.to_string().trim().to_owned();
            at_line(FileProblem::Value { path, value, source })
        })?;
        section.values.push((parameter.clone(), bytes));
    }
    Ok(section)
}

/// All values below a table with their paths; raw blocks left out.
fn flatten<'d>(
    text: Text<'_>,
    table: &'d dyn TableLike,
    parent: &str,
    given: &mut Vec<Given<'d>>,
) -> Result<(), FileError> {
    for (name, item) in table.iter() {
        let path = if parent.is_empty() { name.to_owned() } else { format!("{parent}.{name}") };
        if path == RAW {
            continue;
        }
        match item {
            Item::Value(value) => flatten_value(text, value, path, given)?,
            Item::Table(table) => flatten(text, table, &path, given)?,
            _ => return Err(form(text, &path, item, "a value or a table")),
        }
    }
    Ok(())
}

fn flatten_value<'d>(
    text: Text<'_>,
    value: &'d Value,
    path: String,
    given: &mut Vec<Given<'d>>,
) -> Result<(), FileError> {
    match value {
        Value::InlineTable(table) => flatten(text, table, &path, given),
        Value::Array(array) => array
            .iter()
            .enumerate()
            .try_for_each(|(index, value)| flatten_value(text, value, format!("{path}[{index}]"), given)),
        value => {
            given.push(Given { path, value, line: text.line(value.span()) });
            Ok(())
        }
    }
}

/// The bytes for a value. A value outside of the documented range is accepted if the raw block holds the same.
fn bytes_of(parameter: &Parameter, value: &Value, raw: Option<&[u8]>) -> Result<Vec<u8>, ValueError> {
    let bytes = match value {
        Value::String(text) => parameter.parse(text.value()),
        #[allow(clippy::cast_precision_loss, reason = "what is too large to be exact is out of every range")]
        Value::Integer(number) => parameter.wire(Input::Value(*number.value() as f64)),
        Value::Float(number) => parameter.wire(Input::Value(*number.value())),
        Value::Boolean(value) => parameter.wire(Input::Raw(i64::from(*value.value()))),
        other => parameter.parse(&other.to_string()),
    };
    match (bytes, raw) {
        (Err(ValueError::Assign(AssignError::OutOfRange { .. })), Some(raw))
            if parameter.written(raw) == written(value) =>
        {
            Ok(raw.to_vec())
        }
        (bytes, _) => bytes,
    }
}

/// A value as it is written, without the space around it.
fn written(value: &Value) -> String {
    value.to_string().trim().to_owned()
}
