//! XML as the GUI writes it: elements and text, nothing else.

use std::ops::Range;

use quick_xml::Reader;
use quick_xml::events::Event;

use super::{GuiError, GuiProblem};

/// How deep elements may stand in each other; the GUI goes to six.
const DEPTH: usize = 32;

/// An element.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) name: String,
    /// The text directly in it.
    pub(super) text: String,
    /// The bytes between its tags.
    pub(super) content: Range<usize>,
    pub(super) children: Vec<Node>,
    /// The line of its first tag.
    pub(super) line: usize,
}

/// Counts lines up to a place that only grows.
struct Lines<'t> {
    text: &'t str,
    at: usize,
    line: usize,
}

impl Lines<'_> {
    fn line(&mut self, at: usize) -> usize {
        let passed = self.text.get(self.at..at).unwrap_or_default();
        self.line += passed.matches('\n').count();
        self.at = self.at.max(at);
        self.line
    }
}

/// The root element of a document.
pub(super) fn parse(text: &str) -> Result<Node, GuiError> {
    let mut reader = Reader::from_str(text);
    let mut lines = Lines { text, at: 0, line: 1 };
    // What is open, the innermost last.
    let mut open: Vec<Node> = Vec::new();
    let mut root: Option<Node> = None;
    loop {
        let before = place(reader.buffer_position());
        let event = reader.read_event();
        let line = lines.line(before);
        let wrong = |problem| GuiError { line: Some(line), problem: Box::new(problem) };
        let after = place(reader.buffer_position());
        let event = event.map_err(|error| wrong(GuiProblem::Xml(error.to_string())))?;
        match event {
            Event::Start(tag) | Event::Empty(tag) if root.is_some() && open.is_empty() => {
                let name = tag.name().as_ref().to_owned();
                return Err(wrong(GuiProblem::Xml(format!("<{name}> stands after the end"))));
            }
            Event::Start(ref tag) | Event::Empty(ref tag) => {
                let name = tag.name().as_ref().to_owned();
                if tag.attributes().next().is_some() {
                    return Err(wrong(GuiProblem::Attribute(name)));
                }
                if name == "null" {
                    return Err(wrong(GuiProblem::Null));
                }
                if open.len() >= DEPTH {
                    return Err(wrong(GuiProblem::Xml(String::from(
                        "elements stand too deep in each other",
                    ))));
                }
                let node =
                    Node { name, text: String::new(), content: after..after, children: Vec::new(), line };
                if matches!(event, Event::Empty(_)) {
                    close(node, &mut open, &mut root);
                } else {
                    open.push(node);
                }
            }
            Event::End(_) => {
                if let Some(mut node) = open.pop() {
                    node.content.end = before;
                    close(node, &mut open, &mut root);
                }
            }
            Event::Text(text) => match open.last_mut() {
                Some(node) => node.text.push_str(&text),
                None if text.trim_matches(['\u{FEFF}', ' ', '\n', '\r', '\t']).is_empty() => {}
                None => return Err(wrong(GuiProblem::Xml(String::from("text outside of the elements")))),
            },
            Event::CData(data) => {
                if let Some(node) = open.last_mut() {
                    node.text.push_str(&data);
                }
            }
            // Only text of which nothing is read has any.
            Event::GeneralRef(reference) => {
                if let Some(node) = open.last_mut() {
                    node.text.push('&');
                    node.text.push_str(&reference);
                    node.text.push(';');
                }
            }
            Event::DocType(_) => return Err(wrong(GuiProblem::DocumentType)),
            Event::Comment(_) | Event::Decl(_) | Event::PI(_) => {}
            Event::Eof if open.is_empty() => {
                return root.ok_or_else(|| wrong(GuiProblem::Xml(String::from("there is no element"))));
            }
            Event::Eof => {
                let name = open.last().map(|node| node.name.clone()).unwrap_or_default();
                return Err(wrong(GuiProblem::Xml(format!("<{name}> is not closed"))));
            }
        }
    }
}

fn place(position: u64) -> usize {
    usize::try_from(position).unwrap_or(usize::MAX)
}

fn close(node: Node, open: &mut [Node], root: &mut Option<Node>) {
    match open.last_mut() {
        Some(parent) => parent.children.push(node),
        None => *root = Some(node),
    }
}
