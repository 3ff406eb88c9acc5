//! The names of values and bits.

use std::collections::BTreeSet;

use sbgc_proto::reflect::{Meaning, Number};

use crate::facts::{Facts, Field};
use crate::layout::{Aspect, Difference};

type Labels = BTreeSet<(String, i64)>;

/// Where the names of a number's values and bits are not those of the facts.
pub(crate) fn difference(facts: &Facts, fact: &Field, number: &Number) -> Option<Difference> {
    let tables: Vec<_> = fact.values.iter().chain(&fact.flags).map(String::as_str).collect();
    let mut expected: Labels = tables.iter().flat_map(|table| facts.labels(table)).collect();
    expected.extend(fact.special.iter().map(|(name, value)| (name.clone(), *value)));

    let mut declared = Labels::new();
    let mut known = expected.clone();
    for (labels, shift) in groups(number) {
        let in_place = shifted(&labels, shift);
        // A part may have the names of a whole table that the field does not mention, or those of commands; a bit the
        // name that some table has for it.
        let mut tables = facts.tables.iter().map(|table| facts.labels(&table.name));
        let of_table = tables.any(|table| {
            table == labels || table == in_place || (labels.len() == 1 && table.is_superset(&in_place))
        });
        if of_table || facts.commands.is_superset(&labels) {
            known.extend(in_place.iter().cloned());
        }
        declared.extend(in_place);
    }
    let lacks = shown("lacks", expected.difference(&declared));
    let has = shown("has, unlike the facts,", declared.difference(&known));
    let both: Vec<_> = lacks.into_iter().chain(has).collect();
    let place = if tables.is_empty() { fact.name.clone() } else { tables.join(" and ") };
    (!both.is_empty()).then(|| Difference::new(&place, Aspect::Names, &both.join("; ")))
}

fn shown<'l>(what: &str, labels: impl Iterator<Item = &'l (String, i64)>) -> Option<String> {
    let shown: Vec<_> = labels.map(|(name, value)| format!("{name} = {value}")).collect();
    (!shown.is_empty()).then(|| format!("{what} {}", shown.join(", ")))
}

/// The names within a number, each group with the lowest bit of its part.
fn groups(number: &Number) -> Vec<(Labels, u32)> {
    let labels = |labels: &[sbgc_proto::wire::Label]| {
        labels.iter().map(|label| (label.name.to_owned(), label.value)).collect::<Labels>()
    };
    match number.meaning {
        Meaning::Plain | Meaning::Shown { .. } => Vec::new(),
        Meaning::Enum(names) | Meaning::Flags(names) | Meaning::Special(names) => vec![(labels(names), 0)],
        Meaning::Bits(parts, names) => parts
            .iter()
            .map(|part| match (part.width, part.labels) {
                (1, []) => (Labels::from([(part.name.to_owned(), 1)]), part.low),
                (_, names) => (labels(names), part.low),
            })
            .chain([(labels(names), 0)])
            .collect(),
    }
}

fn shifted(labels: &Labels, shift: u32) -> Labels {
    labels.iter().map(|(name, value)| (name.clone(), value << shift)).collect()
}
