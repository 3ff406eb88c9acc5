//! The table of elements, read from `elements.txt`.

use std::sync::LazyLock;

/// All elements below `board-params` and below `profile`, in the order of the file.
pub(super) static ELEMENTS: LazyLock<Vec<Element>> = LazyLock::new(|| {
    let lines = include_str!("elements.txt").lines().filter(|line| !line.starts_with('#'));
    lines.filter_map(Element::of_line).collect()
});

/// Where an element stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Board,
    Profile,
}

/// What an element holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Int,
    Float,
    Boolean,
    Text,
    /// Base64.
    Bytes(usize),
    /// So many children that are called as the kind of number.
    Items(Leaf, usize),
    /// So many `int-array` with so many `int`.
    Matrix(usize, usize),
    /// So many objects with this tag.
    List(&'static str, usize),
    /// Objects of which nothing is known.
    Unknown,
    Object,
}

/// What an item of an array is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Leaf {
    Int,
    Float,
    Boolean,
    Text,
}

impl Leaf {
    fn of(name: &str) -> Option<Self> {
        Some(match name {
            "int" => Leaf::Int,
            "float" => Leaf::Float,
            "boolean" => Leaf::Boolean,
            "string" => Leaf::Text,
            _ => return None,
        })
    }

    /// The tag of an item.
    pub(super) const fn tag(self) -> &'static str {
        match self {
            Leaf::Int => "int",
            Leaf::Float => "float",
            Leaf::Boolean => "boolean",
            Leaf::Text => "string",
        }
    }
}

/// What may be done with an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    Sure,
    Likely,
    Never,
    Copy,
    Holds,
}

/// What one raw count is in the file.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Scale {
    One,
    Settled(f64),
    /// One of these, the most probable first.
    Open(Vec<f64>),
}

/// One element.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) part: Part,
    /// Its path as written, tags of lists included.
    pub(super) path: &'static str,
    pub(super) form: Form,
    pub(super) class: Class,
    pub(super) unit_specific: bool,
    pub(super) cuts_link: bool,
    pub(super) scale: Scale,
    /// Lowest bit and number of bits, where it is a part of the parameter.
    pub(super) bits: Option<(u32, u32)>,
    /// The parameter of each item, `{s}` standing for the item of the list around it.
    targets: Vec<String>,
}

impl Element {
    fn of_line(line: &'static str) -> Option<Self> {
        let mut words = line.split_whitespace();
        let part = match words.next()? {
            "board" => Part::Board,
            "profile" => Part::Profile,
            _ => return None,
        };
        let (path, form) = (words.next()?, form(words.next()?)?);
        let class = match words.next()? {
            "sure" => Class::Sure,
            "likely" => Class::Likely,
            "never" => Class::Never,
            "copy" => Class::Copy,
            "holds" => Class::Holds,
            _ => return None,
        };
        let marks = words.next()?;
        let scale = match words.next()? {
            "-" => Scale::One,
            text => match text.strip_prefix('?') {
                Some(list) => Scale::Open(list.split(',').filter_map(|number| number.parse().ok()).collect()),
                None => Scale::Settled(text.parse().ok()?),
            },
        };
        let bits = words
            .next()?
            .split_once('+')
            .and_then(|(low, width)| Some((low.parse().ok()?, width.parse().ok()?)));
        let count = if let Form::Items(_, count) = form { count } else { 1 };
        let targets = match words.next()? {
            "-" => Vec::new(),
            list if list.contains(',') => list.split(',').map(str::to_owned).collect(),
            one => (0..count).map(|item| expand(one, item)).collect(),
        };
        let (unit_specific, cuts_link) = (marks.contains("unit-specific"), marks.contains("link"));
        Some(Self { part, path, form, class, unit_specific, cuts_link, scale, bits, targets })
    }

    /// The parameter of an item; of the element itself for the first.
    pub(super) fn target(&self, slot: usize, item: usize) -> Option<String> {
        Some(self.targets.get(item)?.replace("{s}", &slot.to_string()))
    }

    /// Whether its number may be written at all.
    pub(super) fn is_settled(&self) -> bool {
        matches!(self.class, Class::Sure | Class::Likely)
    }

    /// Whether it holds elements whose numbers may be written.
    pub(super) fn has_settled_parts(&self) -> bool {
        let inside = |path: &str| path.strip_prefix(self.path).is_some_and(|rest| rest.starts_with('/'));
        ELEMENTS
            .iter()
            .any(|element| element.part == self.part && element.is_settled() && inside(element.path))
    }

    /// The element of a part with this path.
    pub(super) fn find(part: Part, path: &str) -> Option<&'static Element> {
        ELEMENTS.iter().find(|element| element.part == part && element.path == path)
    }
}

fn expand(target: &str, item: usize) -> String {
    let axis = ["roll", "pitch", "yaw"].get(item).copied().unwrap_or_default();
    target.replace("{axis}", axis).replace("{i}", &item.to_string())
}

fn form(text: &'static str) -> Option<Form> {
    if let Some((list, tag)) = text.split_once(':') {
        let count = list.strip_prefix("list[")?.strip_suffix(']')?;
        return Some(Form::List(tag, count.parse().ok()?));
    }
    Some(match text {
        "int" => Form::Int,
        "float" => Form::Float,
        "boolean" => Form::Boolean,
        "string" => Form::Text,
        "list" => Form::Unknown,
        "object" => Form::Object,
        _ => {
            let (leaf, counts) = text.strip_suffix(']')?.split_once('[')?;
            match (leaf, counts.split_once("][")) {
                ("bytes", None) => Form::Bytes(counts.parse().ok()?),
                (_, None) => Form::Items(Leaf::of(leaf)?, counts.parse().ok()?),
                (_, Some((rows, columns))) => Form::Matrix(rows.parse().ok()?, columns.parse().ok()?),
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::catalog::Catalog;

    /// The published facts, of which `elements.txt` is an extract.
    const FACTS: &str = include_str!("../../../tests/gui/elements.toml");

    #[test]
    fn the_table_is_what_the_facts_say() {
        let facts: toml::Table = FACTS.parse().unwrap();
        let facts: Vec<&toml::Value> = facts["element"].as_array().unwrap().iter().collect();
        let text =
            |fact: &toml::Value, key: &str| fact.get(key).and_then(toml::Value::as_str).map(str::to_owned);
        let catalogs = [Catalog::newest(), Catalog::newest_of_board()];
        let mut checked = 0;
        for fact in &facts {
            let part = match text(fact, "where").unwrap().as_str() {
                "board" => Part::Board,
                "profile" => Part::Profile,
                _ => continue,
            };
            let path = text(fact, "element").unwrap();
            let element = Element::find(part, &path).unwrap_or_else(|| panic!("{path} is missing"));
            let class = match (text(fact, "role").as_deref(), text(fact, "import").as_deref()) {
                (Some("structure"), _) => Class::Holds,
                (Some("copy"), _) => Class::Copy,
                (_, Some("never")) => Class::Never,
                // Its byte has parts that are not settled.
                _ if path.ends_with("/menu__button") => Class::Never,
                _ if text(fact, "confidence").unwrap() == "sure" => Class::Sure,
                _ => Class::Likely,
            };
            assert_eq!(element.class, class, "{path}");
            let marked = |key: &str| fact.get(key).and_then(toml::Value::as_bool).unwrap_or(false);
            assert_eq!(
                (element.unit_specific, element.cuts_link),
                (marked("unit_specific"), marked("cuts_link")),
                "{path}"
            );
            if class == Class::Sure && text(fact, "import").as_deref() == Some("ask") {
                assert!(element.unit_specific || element.cuts_link, "{path} has to be asked for");
            }
            let number = |value: &toml::Value| {
                value
                    .as_float()
                    .or(value.as_integer().map(|number| f64::from(i32::try_from(number).unwrap())))
            };
            let scale = match (fact.get("readings"), fact.get("file_per_raw")) {
                (Some(readings), _) => {
                    Scale::Open(readings.as_array().unwrap().iter().filter_map(number).collect())
                }
                (None, Some(scale)) => Scale::Settled(number(scale).unwrap()),
                (None, None) => Scale::One,
            };
            assert_eq!(element.scale, scale, "{path}");
            let bits = |key: &str| u32::try_from(fact.get(key).unwrap().as_integer().unwrap()).unwrap();
            let expected =
                (text(fact, "convert").as_deref() == Some("bits")).then(|| (bits("shift"), bits("width")));
            assert_eq!(element.bits, expected, "{path}");

            let to: Vec<String> = match fact.get("to") {
                None => Vec::new(),
                Some(toml::Value::Array(all)) => {
                    all.iter().map(|to| to.as_str().unwrap().to_owned()).collect()
                }
                Some(one) => vec![one.as_str().unwrap().to_owned(); element.targets.len()],
            };
            assert_eq!(element.targets.len(), to.len(), "{path}");
            let mut last = None;
            for (item, to) in to.iter().enumerate() {
                let target = element.target(0, item).unwrap();
                let parameter = catalogs
                    .iter()
                    .find_map(|catalog| catalog.by_path(&target))
                    .unwrap_or_else(|| panic!("{target}"));
                let (message, field) = to.split_once('.').unwrap();
                let field = field.rsplit('.').next().unwrap().split('[').next().unwrap();
                assert_eq!(
                    (parameter.block.spec(), parameter.field.spec.rsplit('.').next().unwrap()),
                    (message, field),
                    "{path}"
                );
                assert!(
                    last.replace(parameter.offset).is_none_or(|last| last < parameter.offset),
                    "{path}: {target}"
                );
                checked += 1;
            }
        }
        assert_eq!(
            ELEMENTS.len(),
            facts.iter().filter(|fact| text(fact, "where").unwrap() != "file").count()
        );
        assert!(checked > 300, "{checked}");
    }
}
