//! What is written piece by piece is what a tree of values and the formatting of numbers give.

use proptest::prelude::*;
use sbgc_proto::reflect::Visitor;
use sbgc_proto::{IncomingCommand, OutgoingCommand};

use super::*;

/// One field as JSON by way of a tree.
fn tree(leaf: &Leaf<'_>) -> Value {
    json!({
        "path": leaf.path.to_string(),
        "spec": leaf.field.spec,
        "offset": leaf.offset,
        "size": leaf.size,
        "type": leaf.type_name(),
        "raw": raw_json(leaf),
        "value": value_json(leaf),
        "unit": Some(leaf.unit()).filter(|unit| !unit.is_empty()),
        "label": leaf.label().map(|label| label.to_string()),
    })
}

/// The text of a scaled number by way of formatting.
fn formatted(leaf: &Leaf<'_>) -> Option<String> {
    let number = leaf.number.filter(|number| number.is_scaled() && leaf.label().is_none())?;
    let step = number.multiply / number.divide;
    let digits = (0..12).find(|&digits| step * 10_f64.powi(digits) >= 0.999).unwrap_or(12);
    Some(format!("{:.*}", usize::try_from(digits).unwrap(), leaf.value()?))
}

fn check(leaf: &Leaf<'_>) {
    let mut line = Line::default();
    write_json(leaf, &mut line);
    assert_eq!(line.into_text(), tree(leaf).to_string());
    if let Some(formatted) = formatted(leaf) {
        assert_eq!(number_text(leaf), formatted);
        let trimmed = if formatted.contains('.') {
            formatted.trim_end_matches('0').trim_end_matches('.')
        } else {
            &formatted
        };
        assert_eq!(value_text(leaf).split(' ').next(), Some(trimmed));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn fields_of_every_form_are_written_as_a_tree_would_be(bytes in prop::collection::vec(any::<u8>(), 255)) {
        let visitor: &mut dyn Visitor = &mut |leaf: &Leaf<'_>| check(leaf);
        for info in OutgoingCommand::ALL {
            if let Ok((message, _)) = OutgoingCommand::decode(info.id, &bytes[..*info.size.end()]) {
                message.walk(visitor);
            }
        }
        for info in IncomingCommand::ALL {
            if let Ok((message, _)) = IncomingCommand::decode(info.id, &bytes[..*info.size.end()]) {
                message.walk(visitor);
            }
        }
    }
}
