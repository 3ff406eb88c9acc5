//! What elements hold: numbers, bytes, nothing.

use super::element::Leaf;
use super::xml::Node;
use super::{GuiError, GuiProblem};

/// The number in an element without children; 0 for text.
pub(super) fn leaf(node: &Node, kind: Leaf) -> Result<f64, GuiError> {
    let text = node.text.as_str();
    let number = match kind {
        #[allow(clippy::cast_precision_loss, reason = "what is too large to be exact is out of every range")]
        Leaf::Int => integer(node).map(|number| number as f64),
        // Java writes NaN and Infinity so, and nothing of the kind fits a parameter.
        Leaf::Float => text.parse::<f64>().ok(),
        Leaf::Boolean => match text {
            "true" => Some(1.0),
            "false" => Some(0.0),
            _ => None,
        },
        Leaf::Text => Some(0.0),
    };
    let expected = match kind {
        Leaf::Int => "a whole number",
        Leaf::Float => "a number",
        Leaf::Boolean => "true or false",
        Leaf::Text => "text",
    };
    number.filter(|_| node.children.is_empty()).ok_or_else(|| form(node, expected))
}

pub(super) fn integer(node: &Node) -> Option<i64> {
    let digits = node.text.strip_prefix('-').unwrap_or(&node.text);
    let plain =
        node.children.is_empty() && !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit());
    if plain { node.text.parse().ok() } else { None }
}

/// Base64 of so many bytes, in lines.
pub(super) fn bytes(node: &Node, count: usize) -> Result<(), GuiError> {
    let digits: Vec<u8> = node.text.bytes().filter(|byte| !byte.is_ascii_whitespace()).collect();
    let padding = digits.iter().rev().take_while(|digit| **digit == b'=').count();
    let valid = digits
        .iter()
        .take(digits.len() - padding)
        .all(|digit| digit.is_ascii_alphanumeric() || b"+/".contains(digit));
    let found = (digits.len() / 4 * 3).checked_sub(padding);
    if valid && digits.len().is_multiple_of(4) && found == Some(count) && node.children.is_empty() {
        Ok(())
    } else {
        Err(form(node, &format!("{count} bytes in base64")))
    }
}

pub(super) fn matrix(node: &Node, rows: usize, columns: usize) -> Result<(), GuiError> {
    let row = |row: &Node| {
        row.name == "int-array"
            && row.children.len() == columns
            && row.children.iter().all(|item| item.name == "int" && integer(item).is_some())
    };
    if node.children.len() == rows && node.children.iter().all(row) {
        Ok(())
    } else {
        Err(form(node, &format!("{rows} elements <int-array> of {columns} <int>")))
    }
}

/// Whether there is anything but 0, false, and nothing.
pub(super) fn holds_something(node: &Node) -> bool {
    let text = node.text.trim();
    let zero = text.is_empty()
        || text == "false"
        || text.parse::<f64>().is_ok_and(|number| number == 0.0)
        // Zero bytes in base64.
        || (text.len() >= 4 && text.bytes().all(|byte| byte == b'A' || byte == b'=' || byte.is_ascii_whitespace()));
    !zero || node.children.iter().any(holds_something)
}

/// An element with what it holds, in short.
pub(super) fn shown(path: &str, node: &Node) -> String {
    let mut values = Vec::new();
    collect(node, &mut values);
    let more = if values.len() > 8 { ", ..." } else { "" };
    values.truncate(8);
    format!("{path} ({}{more})", values.join(", "))
}

fn collect<'n>(node: &'n Node, values: &mut Vec<&'n str>) {
    let text = node.text.trim();
    if !text.is_empty() {
        values.push(text);
    }
    node.children.iter().for_each(|child| collect(child, values));
}

pub(super) fn at(node: &Node, problem: GuiProblem) -> GuiError {
    GuiError { line: Some(node.line), problem: Box::new(problem) }
}

pub(super) fn form(node: &Node, expected: &str) -> GuiError {
    at(node, GuiProblem::Form { element: node.name.clone(), expected: expected.to_owned() })
}
