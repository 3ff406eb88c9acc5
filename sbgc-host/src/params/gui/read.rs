//! What the elements of a file mean, and every reason to refuse it.

use sbgc_proto::reflect::{Input, Meaning};
use sbgc_proto::units::FirmwareVersion;

use super::content::{at, bytes, form, holds_something, integer, leaf, matrix, shown};
use super::element::{Class, Element, Form, Leaf, Part, Scale};
use super::xml::{self, Node};
use super::{GuiError, GuiFile, GuiProblem, Number, Reading};
use crate::params::block::Profile;
use crate::params::catalog::Catalog;
use crate::params::parameter::{Parameter, ValueError};

/// Elements that stand in both parts: the part in use, the path.
const COPIES: [(Part, &str); 4] = [
    (Part::Board, "invert"),
    (Part::Board, "poles"),
    (Part::Profile, "outputMap"),
    (Part::Profile, "rcMemory"),
];

/// Reserved elements that get shorter as the GUI learns more.
const SHRINKING: [&str; 1] = ["reserved__ext3"];

/// Where offsets of follow mode were before they had a finer step.
const FINER_OFFSETS: FirmwareVersion = FirmwareVersion::new(2, 70, 0);

impl GuiFile {
    /// Reads a file and checks all of it.
    ///
    /// # Errors
    /// If anything in it is not as the GUI writes it, or a number does not fit its parameter.
    pub fn parse(text: &str) -> Result<Self, GuiError> {
        let root = xml::parse(text)?;
        if root.name != "saved-configuration" {
            return Err(at(&root, GuiProblem::Root(root.name.clone())));
        }
        once(&root.children)?;
        let missing = |name| GuiError { line: None, problem: Box::new(GuiProblem::Missing(name)) };
        let child = |name: &str| root.children.iter().find(|child| child.name == name);
        let version = child("firmwareVer").ok_or_else(|| missing("firmwareVer"))?;
        let firmware = integer(version)
            .and_then(|number| u16::try_from(number).ok())
            .map(FirmwareVersion)
            .ok_or_else(|| form(version, "the number of a version"))?;
        for name in ["appVer", "boardVer", "boardFeatures"] {
            if let Some(node) = child(name).filter(|node| integer(node).is_none()) {
                return Err(form(node, "a number"));
            }
        }
        let reader = Reader { firmware, own: Catalog::newest(), shared: Catalog::newest_of_board() };
        let mut board = match child("board-params") {
            Some(node) => reader.part(Part::Board, node)?,
            None => Reading::default(),
        };
        for node in &root.children {
            let known = [
                "board-params",
                "profile",
                "all-profiles",
                "firmwareVer",
                "appVer",
                "boardVer",
                "boardFeatures",
            ];
            if !known.contains(&node.name.as_str()) && holds_something(node) {
                board.held.push(shown(&node.name, node));
            }
        }
        let (nodes, single) = match (child("all-profiles"), child("profile")) {
            (Some(all), lone) => {
                if let Some(lone) = lone {
                    board.held.push(format!("{} (beside all-profiles)", lone.name));
                }
                let expected = || form(all, "1 to 5 elements <profile>");
                let profiles = all.children.iter().all(|child| child.name == "profile");
                let count = 1..=usize::from(Profile::COUNT);
                if !profiles || !count.contains(&all.children.len()) || !all.text.trim().is_empty() {
                    return Err(expected());
                }
                (all.children.iter().collect(), false)
            }
            (None, Some(profile)) => (vec![profile], true),
            (None, None) => return Err(missing("profile")),
        };
        let read = nodes.iter().map(|node| reader.part(Part::Profile, node));
        let mut profiles: Vec<Reading> = read.collect::<Result<_, _>>()?;
        let board_node = child("board-params");
        for (index, node) in nodes.iter().enumerate() {
            if let Some(profile) = profiles.get_mut(index) {
                settle_copies(board_node, node, &mut board, profile);
            }
        }
        Ok(Self { firmware, board, profiles, single })
    }
}

struct Reader {
    firmware: FirmwareVersion,
    own: Catalog,
    shared: Catalog,
}

impl Reader {
    fn part(&self, part: Part, node: &Node) -> Result<Reading, GuiError> {
        let mut reading = Reading::default();
        self.children(part, node, "", 0, &mut reading)?;
        Ok(reading)
    }

    /// The elements in `node`, whose path is `parent`, in the list item `slot`.
    fn children(
        &self,
        part: Part,
        node: &Node,
        parent: &str,
        slot: usize,
        reading: &mut Reading,
    ) -> Result<(), GuiError> {
        if !node.text.trim().is_empty() {
            return Err(form(node, "elements, not text"));
        }
        let path = |child: &Node| {
            if parent.is_empty() { child.name.clone() } else { format!("{parent}/{}", child.name) }
        };
        let known = |child: &Node| Element::find(part, &path(child));
        once(&node.children.iter().filter(|child| known(child).is_some()).cloned().collect::<Vec<_>>())?;
        for child in &node.children {
            match known(child) {
                Some(element) => self.element(element, child, slot, reading)?,
                None if holds_something(child) => reading.held.push(shown(&path(child), child)),
                None => {}
            }
        }
        Ok(())
    }

    fn element(
        &self,
        element: &'static Element,
        node: &Node,
        slot: usize,
        reading: &mut Reading,
    ) -> Result<(), GuiError> {
        match element.form {
            Form::Object => return self.children(element.part, node, element.path, slot, reading),
            Form::List(tag, count) => {
                let all = node.children.iter().all(|child| child.name == tag);
                // Of what is never written, a list may also be empty.
                let fits = node.children.len() == count
                    || (node.children.is_empty() && !element.has_settled_parts());
                if !all || !fits || !node.text.trim().is_empty() {
                    return Err(form(node, &format!("{count} elements <{tag}>")));
                }
                let parent = format!("{}/{tag}", element.path);
                return node.children.iter().enumerate().try_for_each(|(slot, child)| {
                    self.children(element.part, child, &parent, slot, reading)
                });
            }
            Form::Unknown => {}
            Form::Text => leaf(node, Leaf::Text).map(drop)?,
            Form::Bytes(count) => bytes(node, count)?,
            Form::Matrix(rows, columns) => matrix(node, rows, columns)?,
            Form::Int => self.numbers(element, std::slice::from_ref(node), Leaf::Int, slot, reading)?,
            Form::Float => self.numbers(element, std::slice::from_ref(node), Leaf::Float, slot, reading)?,
            Form::Boolean => {
                self.numbers(element, std::slice::from_ref(node), Leaf::Boolean, slot, reading)?;
            }
            Form::Items(kind, count) => {
                let all = node.children.iter().all(|child| child.name == kind.tag());
                let found = node.children.len();
                let fits = found == count || (SHRINKING.contains(&element.path) && found < count);
                if !all || !fits || !node.text.trim().is_empty() {
                    return Err(form(node, &format!("{count} elements <{}>", kind.tag())));
                }
                self.numbers(element, &node.children, kind, slot, reading)?;
            }
        }
        if element.class == Class::Never && holds_something(node) {
            reading.held.push(shown(element.path, node));
        }
        Ok(())
    }

    /// The numbers of an element, each checked.
    fn numbers(
        &self,
        element: &'static Element,
        nodes: &[Node],
        kind: Leaf,
        slot: usize,
        reading: &mut Reading,
    ) -> Result<(), GuiError> {
        for (item, node) in nodes.iter().enumerate() {
            let number = leaf(node, kind)?;
            let Some(target) = element.target(slot, item) else { continue };
            // Before offsets had a finer step, whole numbers of the other field stood here.
            let coarse = element.path == "followOffset" && self.firmware < FINER_OFFSETS;
            let target = if coarse { target.replace("follow_offset_ext", "follow_offset") } else { target };
            let parameter = self.own.by_path(&target).or_else(|| self.shared.by_path(&target));
            let Some(parameter) = parameter else { continue };
            let wrong = |problem: String| {
                let (element, value) = (element.path.to_owned(), node.text.trim().to_owned());
                at(node, GuiProblem::Number { element, value, problem })
            };
            let scales: &[f64] = match &element.scale {
                Scale::One => &[1.0],
                Scale::Settled(_) if coarse => &[1.0],
                Scale::Settled(scale) => &[*scale],
                Scale::Open(scales) => scales,
            };
            let exact = kind != Leaf::Float;
            let fits: Vec<_> =
                scales.iter().map(|scale| fit(element, parameter, number, *scale, exact)).collect();
            match (&element.scale, fits.first()) {
                (Scale::Open(_), _) if fits.iter().all(Result::is_err) => {
                    return Err(wrong(String::from("fits its parameter in no scale")));
                }
                (_, Some(Ok(raw))) if element.is_settled() => reading.numbers.push(Number {
                    element,
                    parameter: parameter.clone(),
                    raw: *raw,
                    content: node.content.clone(),
                }),
                (Scale::Open(_), Some(Err(_))) if element.is_settled() => {
                    reading.held.push(shown(element.path, node));
                }
                (_, Some(Err(problem))) if element.is_settled() => return Err(wrong(problem.to_string())),
                _ => {}
            }
        }
        Ok(())
    }
}

/// The number of the wire for a number of the file.
fn fit(element: &Element, parameter: &Parameter, number: f64, scale: f64, exact: bool) -> Result<i64, Unfit> {
    let count = number / scale;
    if !count.is_finite() || (exact && (count - count.round()).abs() > 1e-6) {
        return Err(Unfit::NotAMultiple(scale));
    }
    // Java has no unsigned numbers of 32 bits.
    let wraps = parameter.type_name() == "u32" && count < 0.0 && count >= f64::from(i32::MIN);
    let count = if wraps { count + 4_294_967_296.0 } else { count };
    if count.abs() > 4_294_967_295.0 {
        return Err(Unfit::TooLarge);
    }
    #[allow(clippy::cast_possible_truncation, reason = "checked just before")]
    let raw = count.round() as i64;
    let meaning = parameter.number.map_or(Meaning::Plain, |number| number.meaning);
    if let Some((low, width)) = element.bits {
        if !(0..1 << width).contains(&raw) {
            return Err(Unfit::TooLarge);
        }
        if let Meaning::Bits(parts, _) = meaning
            && let Some(part) = parts.iter().find(|part| part.low == low)
            && !part.labels.is_empty()
            && !part.labels.iter().any(|label| label.value == raw)
        {
            return Err(Unfit::NoSuchValue);
        }
        return Ok(raw);
    }
    parameter.wire(Input::Raw(raw)).map_err(Unfit::Value)?;
    if let Meaning::Enum(labels) = meaning {
        // Lists that have no 0 leave that for "none", unless they count in both directions.
        let none = raw == 0 && labels.iter().all(|label| label.value > 0);
        if !none && !labels.iter().any(|label| label.value == raw) {
            return Err(Unfit::NoSuchValue);
        }
    }
    Ok(raw)
}

/// Why a number is none of a parameter.
#[derive(Debug, thiserror::Error)]
enum Unfit {
    #[error("expected a multiple of {0}")]
    NotAMultiple(f64),
    #[error("out of range")]
    TooLarge,
    #[error("the parameter has no such value")]
    NoSuchValue,
    #[error(transparent)]
    Value(ValueError),
}

/// Where an unused copy holds something else than the element in use, neither is understood.
fn settle_copies(board_node: Option<&Node>, profile_node: &Node, board: &mut Reading, profile: &mut Reading) {
    for (in_use, path) in COPIES {
        let find = |node: &Node| node.children.iter().find(|child| child.name == path).cloned();
        let (on_board, in_profile) = (board_node.and_then(find), find(profile_node));
        let (used, copy, reading) = match in_use {
            Part::Board => (on_board, in_profile, &mut *board),
            Part::Profile => (in_profile, on_board, &mut *profile),
        };
        let Some(copy) = copy.filter(holds_something) else { continue };
        let values =
            |node: &Node| node.children.iter().map(|child| child.text.trim().to_owned()).collect::<Vec<_>>();
        if used.as_ref().is_some_and(|used| values(used) == values(&copy)) {
            continue;
        }
        reading.numbers.retain(|number| number.element.path != path);
        let shown = format!("{}, which board-params and profile disagree about", shown(path, &copy));
        if !reading.held.contains(&shown) {
            reading.held.push(shown);
        }
    }
}

/// Elements that stand only once each.
fn once(nodes: &[Node]) -> Result<(), GuiError> {
    for (index, node) in nodes.iter().enumerate() {
        if nodes.iter().take(index).any(|before| before.name == node.name) {
            return Err(at(node, GuiProblem::Twice(node.name.clone())));
        }
    }
    Ok(())
}
