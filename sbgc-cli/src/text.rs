//! Text for terminals: escaping, names that resemble each other, lines of a given width.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::io;

use serde::Serialize as _;

/// Text that came from a board or a file, without anything that a terminal would obey.
///
/// Control characters and those that change the direction of writing become escapes as in Rust.
pub(crate) fn escape(text: &str) -> Cow<'_, str> {
    if !text.contains(is_obeyed) {
        return Cow::Borrowed(text);
    }
    let mut escaped = String::with_capacity(text.len() + 8);
    for character in text.chars() {
        if is_obeyed(character) {
            let _ = write!(escaped, "{}", character.escape_default());
        } else {
            escaped.push(character);
        }
    }
    Cow::Owned(escaped)
}

/// Like [`escape`], but lines stay lines.
pub(crate) fn escape_lines(text: &str) -> String {
    let lines: Vec<_> = text.split('\n').map(escape).collect();
    lines.join("\n")
}

/// Whether a terminal does something else than to show it.
pub(crate) fn is_obeyed(character: char) -> bool {
    character.is_control()
        || matches!(character, '\u{200E}' | '\u{200F}' | '\u{2028}'..='\u{202E}' | '\u{2066}'..='\u{2069}')
}

/// Compact JSON in which nothing is left that a terminal would obey.
pub(crate) struct ForTerminals;

impl serde_json::ser::Formatter for ForTerminals {
    fn write_string_fragment<W: ?Sized + io::Write>(
        &mut self,
        writer: &mut W,
        fragment: &str,
    ) -> io::Result<()> {
        if fragment.is_ascii() && !fragment.contains('\u{7F}') {
            return writer.write_all(fragment.as_bytes());
        }
        for character in fragment.chars() {
            if is_obeyed(character) {
                // All of these are below U+10000.
                write!(writer, "\\u{:04x}", u32::from(character))?;
            } else {
                write!(writer, "{character}")?;
            }
        }
        Ok(())
    }
}

/// JSON on one line, without anything that a terminal would obey.
pub(crate) fn json(value: &serde_json::Value) -> String {
    let mut bytes = Vec::new();
    // A vector takes everything.
    let _ = value.serialize(&mut serde_json::Serializer::with_formatter(&mut bytes, ForTerminals));
    String::from_utf8(bytes).unwrap_or_default()
}

/// The names that resemble `name` most, best first, at most three.
pub(crate) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let name = plain(name);
    let mut scored: Vec<(f64, &str)> =
        known.into_iter().map(|known| (likeness(&name, &plain(known)), known)).collect();
    scored.sort_by(|one, other| other.0.total_cmp(&one.0).then_with(|| one.1.cmp(other.1)));
    scored.dedup_by_key(|scored| scored.1);
    let best = scored.first().map_or(0.0, |scored| scored.0);
    scored.into_iter().take(3).filter(|scored| scored.0 >= best * 0.85).map(|scored| scored.1).collect()
}

/// What to say of a name that is none of the known: `unknown parameter "rol"; did you mean roll or role?`
pub(crate) fn unknown<'a>(what: &str, name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let name_text = escape(name);
    match join(&nearest(name, known), "or") {
        names if names.is_empty() => format!("unknown {what} \"{name_text}\""),
        names => format!("unknown {what} \"{name_text}\"; did you mean {names}?"),
    }
}

/// A list in words: `a, b or c`.
pub(crate) fn join(names: &[&str], word: &str) -> String {
    match names {
        [] => String::new(),
        [name] => (*name).to_owned(),
        [names @ .., last] => format!("{} {word} {last}", names.join(", ")),
    }
}

/// Case and the usual separators do not make names differ.
fn plain(name: &str) -> String {
    name.trim().to_ascii_lowercase().replace(['-', ' '], "_")
}

fn likeness(name: &str, known: &str) -> f64 {
    let whole = strsim::normalized_damerau_levenshtein(name, known);
    // What is typed is often the end of a path, or a part of a long name.
    let end = known.rsplit('.').next().unwrap_or(known);
    let end = strsim::normalized_damerau_levenshtein(name, end) * 0.95;
    let part = if name.len() >= 3 && known.contains(name) { 0.8 } else { 0.0 };
    whole.max(end).max(part).max(strsim::jaro_winkler(name, known) * 0.8)
}

/// Columns of the terminal, or what COLUMNS says, or 100; at most 120.
pub(crate) fn width() -> usize {
    let terminal = terminal_size::terminal_size().map(|(width, _)| usize::from(width.0));
    let variable = || std::env::var("COLUMNS").ok()?.parse().ok();
    terminal.filter(|&width| width > 0).or_else(variable).unwrap_or(100).clamp(20, 120)
}

/// Breaks text into lines of at most `width` columns, at spaces.
pub(crate) fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > width {
            lines.push(std::mem::take(&mut line));
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    lines.push(line);
    lines
}

/// Breaks a value with several names into lines of at most `width` columns, behind `|` and at spaces.
pub(crate) fn wrap_names(value: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for part in value.split_inclusive(['|', ' ']) {
        match lines.last_mut() {
            Some(line) if line.chars().count() + part.trim_end().chars().count() <= width => {
                line.push_str(part);
            }
            _ => lines.push(part.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_escaped() {
        assert_eq!(escape("plain ünïcode ✓"), "plain ünïcode ✓");
        assert_eq!(escape("\u{1B}[2J\u{9B}1m\u{7F}\r"), "\\u{1b}[2J\\u{9b}1m\\u{7f}\\r");
        assert_eq!(escape("a\u{202E}b"), "a\\u{202e}b");
        assert_eq!(escape_lines("a\nb\u{7}"), "a\nb\\u{7}");
    }

    #[test]
    fn resembling_names_are_found() {
        let names = ["motors.pitch.power", "motors.roll.power", "rc_memory", "servo_rate"];
        assert_eq!(nearest("rc_memroy", names), ["rc_memory"]);
        assert_eq!(nearest("RC-MEMORY", names), ["rc_memory"]);
        assert_eq!(nearest("motors.pich.power", names)[0], "motors.pitch.power");
        assert_eq!(nearest("powr", names), ["motors.pitch.power", "motors.roll.power"]);
        assert_eq!(
            unknown("field", "servo_rat", names),
            "unknown field \"servo_rat\"; did you mean servo_rate?"
        );
        assert_eq!(unknown("field", "x\u{1B}", []), "unknown field \"x\\u{1b}\"");
    }

    #[test]
    fn lines_are_broken_at_spaces() {
        assert_eq!(wrap("one two three", 7), ["one two", "three"]);
        assert_eq!(wrap("unbreakable", 3), ["unbreakable"]);
        assert_eq!(wrap_names("7 (ONE|TWO|THREE)", 10), ["7 (ONE|", "TWO|THREE)"]);
        assert_eq!(wrap_names("7", 1), ["7"]);
    }

    #[test]
    fn json_holds_nothing_that_a_terminal_obeys() {
        let value = serde_json::json!({"name": "a\u{1B}b\u{9B}c\u{7F}d\u{202E}é"});
        let text = json(&value);
        assert_eq!(text, "{\"name\":\"a\\u001bb\\u009bc\\u007fd\\u202eé\"}");
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap(), value);
    }
}
