//! The configuration file, `$XDG_CONFIG_HOME/sbgc/config.toml`: options by their names.

use std::path::Path;
use std::{fs, io};

use toml::de::{DeTable, DeValue};

use crate::failure::Failure;
use crate::{places, text};

/// The entries of the file.
#[derive(Debug, Default)]
pub(crate) struct ConfigFile {
    path: String,
    entries: Vec<Entry>,
}

#[derive(Debug)]
struct Entry {
    key: String,
    value: String,
    line: usize,
}

impl ConfigFile {
    /// Reads the file where it is expected; one that does not exist is empty.
    pub(crate) fn read(keys: &[&str]) -> Result<Self, Failure> {
        let Some(path) = places::config().map(|directory| directory.join("config.toml")) else {
            return Ok(Self::default());
        };
        match fs::read(&path) {
            Ok(content) => Self::parse(&path, &content, keys).map_err(Failure::Usage),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Self::default()),
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => Ok(Self::default()),
            Err(source) => Err(Failure::File { place: path.display().to_string(), source }),
        }
    }

    fn parse(path: &Path, content: &[u8], keys: &[&str]) -> Result<Self, String> {
        let path = text::escape(&path.display().to_string()).into_owned();
        let line_of = |at: usize| content.iter().take(at).filter(|byte| **byte == b'\n').count() + 1;
        let content = str::from_utf8(content)
            .map_err(|error| format!("{path}:{}: not UTF-8 text", line_of(error.valid_up_to())))?;
        let table = DeTable::parse(content).map_err(|error| {
            let line = line_of(error.span().map_or(0, |span| span.start));
            format!("{path}:{line}: {}", error.message())
        })?;
        let mut entries = Vec::new();
        for (key, value) in table.get_ref() {
            let line = line_of(key.span().start);
            let name = key.get_ref();
            if !keys.contains(&name.as_ref()) {
                let unknown = text::unknown("key", name, keys.iter().copied());
                return Err(format!("{path}:{line}: {unknown}"));
            }
            let value = match value.get_ref() {
                DeValue::String(text) => text.to_string(),
                DeValue::Integer(number) => number.to_string(),
                DeValue::Float(number) => number.to_string(),
                DeValue::Boolean(value) => value.to_string(),
                _ => {
                    return Err(format!("{path}:{line}: {name}: expected a text, a number or true or false"));
                }
            };
            entries.push(Entry { key: name.to_string(), value, line });
        }
        Ok(Self { path, entries })
    }

    /// The value of a key, and where it stands.
    pub(crate) fn get(&self, key: &str) -> Option<(&str, String)> {
        let entry = self.entries.iter().find(|entry| entry.key == key)?;
        Some((&entry.value, format!("{}:{}", self.path, entry.line)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(content: &str) -> Result<ConfigFile, String> {
        ConfigFile::parse(Path::new("c.toml"), content.as_bytes(), &["port", "baud", "json"])
    }

    #[test]
    fn values_of_each_type() {
        let file = parse("# mine\nport = \"sim\"\nbaud = 57600\n\njson = true\n").unwrap();
        assert_eq!(file.get("port"), Some(("sim", String::from("c.toml:2"))));
        assert_eq!(file.get("baud"), Some(("57600", String::from("c.toml:3"))));
        assert_eq!(file.get("json"), Some(("true", String::from("c.toml:5"))));
        assert_eq!(file.get("parity"), None);
    }

    #[test]
    fn mistakes_name_file_line_and_nearest_key() {
        assert_eq!(
            parse("port = \"sim\"\nbuad = 5").unwrap_err(),
            "c.toml:2: unknown key \"buad\"; did you mean baud?"
        );
        assert!(parse("port = \"sim\"\n\n[x").unwrap_err().starts_with("c.toml:3: "));
        let binary = ConfigFile::parse(Path::new("c.toml"), b"# a\n\xFF = 1", &["port"]);
        assert_eq!(binary.unwrap_err(), "c.toml:2: not UTF-8 text");
        assert!(parse("port = [1]").unwrap_err().starts_with("c.toml:1: port: expected"));
    }
}
