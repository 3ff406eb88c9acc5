//! Visiting the fields of a value in wire order.

use core::fmt;

use super::{FieldInfo, Number, Shape};

/// Value whose fields can be visited.
pub trait Describe {
    /// Structure of the value.
    const SHAPE: Shape;

    /// Visits the leaves of the value and returns their total size in bytes.
    fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize;
}

/// Visits the leaves of `message` in wire order and returns their total size in bytes.
pub fn walk<T: Describe>(message: &T, visitor: &mut dyn Visitor) -> usize {
    message.walk(&Place::ROOT, visitor)
}

/// Visits the payload of a command that the protocol does not have, which is one field.
pub(crate) fn walk_payload(payload: &[u8], visitor: &mut dyn Visitor) -> usize {
    Place::ROOT.field(PAYLOAD, 0, 0).walk(&payload, visitor)
}

/// The only field of a command that the protocol does not have.
pub(super) const PAYLOAD: &[FieldInfo] = &[FieldInfo {
    doc: "All bytes of the payload.",
    ..FieldInfo::new("payload", "PAYLOAD", <&[u8] as Describe>::SHAPE)
}];

/// Receives each leaf of a message.
pub trait Visitor {
    /// Called for each number, text or block of bytes.
    fn leaf(&mut self, leaf: &Leaf<'_>);
}

impl<F: FnMut(&Leaf<'_>)> Visitor for F {
    fn leaf(&mut self, leaf: &Leaf<'_>) {
        self(leaf);
    }
}

/// Path of a value within its message. Displayed as `axes.roll.p` or `params[0].id`.
#[derive(Clone, Copy, Debug)]
pub struct Path<'p> {
    parent: Option<&'p Path<'p>>,
    step: Step,
}

#[derive(Clone, Copy, Debug)]
enum Step {
    Root,
    Name(&'static str),
    Index(usize),
}

impl Path<'_> {
    /// Writes the same text as [`Display`](fmt::Display), without the cost of formatting.
    ///
    /// # Errors
    /// If writing to `out` fails.
    pub fn write_to<W: fmt::Write + ?Sized>(&self, out: &mut W) -> fmt::Result {
        if let Some(parent) = self.parent {
            parent.write_to(out)?;
            if matches!((parent.step, self.step), (Step::Name(_) | Step::Index(_), Step::Name(_))) {
                out.write_char('.')?;
            }
        }
        match self.step {
            Step::Root => Ok(()),
            Step::Name(name) => out.write_str(name),
            Step::Index(index) => {
                out.write_char('[')?;
                write_number(index, out)?;
                out.write_char(']')
            }
        }
    }
}

fn write_number<W: fmt::Write + ?Sized>(number: usize, out: &mut W) -> fmt::Result {
    if number >= 10 {
        write_number(number / 10, out)?;
    }
    #[allow(clippy::cast_possible_truncation, reason = "a digit")]
    let digit = (number % 10) as u8;
    out.write_char(char::from(b'0' + digit))
}

impl fmt::Display for Path<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_to(f)
    }
}

/// Position of a walk: path, declared field, and offset in the payload.
#[derive(Clone, Copy, Debug)]
pub struct Place<'p> {
    path: Path<'p>,
    field: &'static FieldInfo,
    offset: usize,
}

impl Place<'static> {
    /// Position of a message as a whole.
    pub(crate) const ROOT: Self =
        Place { path: Path { parent: None, step: Step::Root }, field: &FieldInfo::UNNAMED, offset: 0 };
}

impl Place<'_> {
    /// Position of the field `fields[index]`, `offset` bytes further on.
    pub(crate) fn field(&self, fields: &'static [FieldInfo], index: usize, offset: usize) -> Place<'_> {
        let field = fields.get(index).unwrap_or(self.field);
        let path = Path { parent: Some(&self.path), step: Step::Name(field.name) };
        Place { path, field, offset: self.offset + offset }
    }

    /// Position of a named part of the same field.
    pub(crate) fn part(&self, name: &'static str, offset: usize) -> Place<'_> {
        let path = Path { parent: Some(&self.path), step: Step::Name(name) };
        Place { path, field: self.field, offset: self.offset + offset }
    }

    /// Position of an element of the same field.
    pub(crate) fn element(&self, index: usize, offset: usize) -> Place<'_> {
        let path = Path { parent: Some(&self.path), step: Step::Index(index) };
        Place { path, field: self.field, offset: self.offset + offset }
    }

    /// Visits `value` at this position.
    pub(crate) fn walk<T: Describe>(&self, value: &T, visitor: &mut dyn Visitor) -> usize {
        value.walk(self, visitor)
    }

    /// Passes a leaf of `size` bytes to the visitor.
    pub(crate) fn leaf(
        &self,
        size: usize,
        number: Option<&'static Number>,
        raw: Raw<'_>,
        visitor: &mut dyn Visitor,
    ) -> usize {
        visitor.leaf(&Leaf { path: &self.path, field: self.field, offset: self.offset, size, number, raw });
        size
    }
}

/// Raw value on the wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Raw<'r> {
    /// Number; for a float, its bits.
    Number(i64),
    /// Bytes.
    Bytes(&'r [u8]),
    /// Bytes of a text.
    Text(&'r [u8]),
}

/// Number, text or block of bytes in a message.
#[derive(Clone, Copy, Debug)]
pub struct Leaf<'l> {
    /// Path within the message.
    pub path: &'l Path<'l>,
    /// Declared field that it is or belongs to.
    pub field: &'static FieldInfo,
    /// Offset of its first byte in the payload.
    pub offset: usize,
    /// Number of bytes.
    pub size: usize,
    /// Description of the number; `None` for bytes and texts.
    pub number: Option<&'static Number>,
    /// Raw value on the wire.
    pub raw: Raw<'l>,
}

impl Leaf<'_> {
    /// Name of the wire type: `u8` to `f32`, `bytes` or `str`.
    pub fn type_name(&self) -> &'static str {
        match (self.number, self.raw) {
            (Some(number), _) => number.scalar.name(),
            (None, Raw::Text(_)) => "str",
            (None, _) => "bytes",
        }
    }

    /// Physical value of a number.
    pub fn value(&self) -> Option<f64> {
        match self.raw {
            Raw::Number(raw) => self.number.map(|number| number.value(raw)),
            _ => None,
        }
    }

    /// Unit of the value; empty if it has none.
    pub fn unit(&self) -> &'static str {
        self.number.map(|number| number.unit).filter(|unit| !unit.is_empty()).unwrap_or(self.field.unit)
    }

    /// Names of the value: of an enumeration, of flags or of a special value.
    pub fn label(&self) -> Option<impl fmt::Display + use<>> {
        match self.raw {
            Raw::Number(raw) => self.number.and_then(|number| number.label(raw)),
            _ => None,
        }
    }
}

/// Visits the elements of an array or list.
pub(crate) fn walk_elements<T: Describe>(
    elements: &[T],
    place: &Place<'_>,
    visitor: &mut dyn Visitor,
) -> usize {
    let mut size = 0;
    for (index, element) in elements.iter().enumerate() {
        size += place.element(index, size).walk(element, visitor);
    }
    size
}

/// What is absent has no leaves.
impl<T: Describe> Describe for Option<T> {
    const SHAPE: Shape = T::SHAPE;

    fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
        self.as_ref().map_or(0, |value| value.walk(place, visitor))
    }
}
