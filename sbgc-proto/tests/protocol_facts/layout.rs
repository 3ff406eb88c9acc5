//! Messages as sequences of leaves, and where two sequences differ.

use sbgc_proto::reflect::{FieldInfo, Meaning, Number, Presence, Shape};

use crate::facts::{Count, Facts, Field, Message};
use crate::labels;

/// A leaf, or where a list starts or ends.
struct Token<T> {
    name: String,
    what: What,
    /// Whether it is in every payload.
    always: bool,
    about: T,
}

#[derive(Clone, Debug, PartialEq)]
enum What {
    Number(&'static str),
    Bytes(usize),
    /// What is left of the payload.
    Rest,
    Text,
    ListStart,
    ListEnd,
}

impl What {
    /// How many bytes, where that is fixed.
    fn size(&self) -> Option<usize> {
        match self {
            What::Number("u8" | "i8") => Some(1),
            What::Number("u16" | "i16") => Some(2),
            What::Number("u24") => Some(3),
            What::Number(_) => Some(4),
            What::Bytes(size) => Some(*size),
            What::Rest | What::Text | What::ListStart | What::ListEnd => None,
        }
    }
}

/// Whether a message is nothing but bytes.
pub(crate) fn is_raw(shape: &Shape) -> bool {
    matches!(&of_message(shape)[..], [token] if token.what == What::Rest)
}

/// What of a message or field differs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Aspect {
    /// The message or form as such.
    Form,
    /// Number of payload bytes.
    Size,
    /// Place in the payload.
    Place,
    /// Name of the field, or whether there is one.
    Field,
    /// Type on the wire.
    Type,
    /// Whether it is always there.
    Presence,
    /// Allowed raw values.
    Range,
    /// Unit.
    Unit,
    /// Scale.
    Scale,
    /// Names of values and bits.
    Names,
    /// All that follows a field of another size.
    After,
}

/// A difference between a declaration and the facts.
pub(crate) struct Difference {
    /// The field, or the table of its values.
    pub(crate) field: String,
    pub(crate) aspect: Aspect,
    /// As it is shown.
    pub(crate) text: String,
}

impl Difference {
    pub(crate) fn new(field: &str, aspect: Aspect, text: &str) -> Self {
        Difference { field: field.to_owned(), aspect, text: format!("{field} {text}") }
    }
}

/// Where a declaration is not as the facts have it.
pub(crate) fn differences(facts: &Facts, fact: &Message, shape: &Shape) -> Vec<Difference> {
    let mut expected = Vec::new();
    of_facts(facts, &fact.fields, true, &mut expected);
    let declared = of_message(shape);
    let mut differences = Vec::new();
    let (mut expected, mut declared) = (&expected[..], &declared[..]);
    // How far both have come, as long as that is fixed.
    let mut at = Some(0);
    loop {
        let (Some(fact), Some(field)) = (expected.first(), declared.first()) else {
            let missing = |fact: &Token<Field>| {
                Difference::new(&fact.name, Aspect::Field, "and what follows is missing")
            };
            differences.extend(expected.first().map(missing));
            let surplus = |field: &Declared| Difference::new(&field.name, Aspect::Field, "is one too many");
            differences.extend(declared.first().map(surplus));
            return differences;
        };
        if let (Some(at), Some(offset)) = (at, fact.about.offset)
            && at != offset
        {
            let text = format!("is at {at}, should be at {offset}");
            differences.push(Difference::new(&field.name, Aspect::Place, &text));
        }
        // Newer firmware has put reserved bytes to use.
        if let What::Bytes(size) = fact.what
            && fact.name.contains("RESERVED")
            && let Some(count) = division(declared, size)
        {
            at = at.map(|at| at + size);
            (expected, declared) = (&expected[1..], &declared[count..]);
            continue;
        }
        // Groups have no name of their own.
        let is_list = matches!(fact.what, What::ListStart | What::ListEnd);
        if fact.name != field.name && !is_list {
            let text = format!("should be {}", fact.name);
            differences.push(Difference::new(&field.name, Aspect::Field, &text));
        }
        if fact.what != field.what {
            let text = format!("is {:?}, should be {:?}", field.what, fact.what);
            differences.push(Difference::new(&field.name, Aspect::Type, &text));
            if fact.what.size() != field.what.size() {
                differences.push(Difference::new("", Aspect::After, "what follows is not compared"));
                return differences;
            }
        }
        if fact.always != field.always {
            let when = if fact.always { "always" } else { "sometimes" };
            let text = format!("should be there {when}");
            differences.push(Difference::new(&field.name, Aspect::Presence, &text));
        }
        if let Some(About { number, unit, range }) = &field.about {
            // Where all values have names, these are compared.
            if !matches!(number.meaning, Meaning::Enum(_) | Meaning::Flags(_) | Meaning::Bits(..)) {
                let limits = number.scalar.limits();
                let should = (fact.about.min.unwrap_or(limits.0), fact.about.max.unwrap_or(limits.1));
                let (least, most) = range.unwrap_or(limits);
                if (least, most) != should {
                    let (from, to) = should;
                    let what = format!("goes from {least} to {most}, should from {from} to {to}");
                    differences.push(Difference::new(&field.name, Aspect::Range, &what));
                }
            }
            // The facts have no word for a signal's share of its range.
            let unit = unit.strip_prefix("of full scale").unwrap_or(unit);
            if unit != fact.about.unit {
                let should = &fact.about.unit;
                let text = format!("has the unit {unit:?}, should have {should:?}");
                differences.push(Difference::new(&field.name, Aspect::Unit, &text));
            }
            let scale = fact.about.scale.unwrap_or(1.0);
            let declared = number.multiply / number.divide;
            if (declared - scale).abs() > scale.abs() * 1e-6 {
                let text = format!("has the scale {declared}, should have {scale}");
                differences.push(Difference::new(&field.name, Aspect::Scale, &text));
            }
            differences.extend(labels::difference(facts, &fact.about, number));
        }
        let size = field.what.size().filter(|_| field.always);
        at = at.zip(size).map(|(at, size)| at + size);
        (expected, declared) = (&expected[1..], &declared[1..]);
    }
}

/// How many tokens take exactly `size` bytes.
fn division<T>(tokens: &[Token<T>], size: usize) -> Option<usize> {
    let mut left = size;
    for (index, token) in tokens.iter().enumerate() {
        left = left.checked_sub(token.what.size()?)?;
        if left == 0 {
            return Some(index + 1);
        }
    }
    None
}

fn of_facts(facts: &Facts, fields: &[Field], always: bool, tokens: &mut Vec<Token<Field>>) {
    for field in fields {
        let always = always && field.present_if.is_none() && !field.optional;
        let token =
            |what, about: &Field| Token { name: field.name.clone(), what, always, about: about.clone() };
        let mut first = true;
        let mut element = |tokens: &mut Vec<_>| {
            let start = tokens.len();
            if let Some(inner) = field.structure.as_ref().and_then(|name| facts.structs.get(name)) {
                of_facts(facts, inner, always, tokens);
            } else if field.fields.is_empty() {
                tokens.push(token(what(&field.kind), field));
            } else {
                of_facts(facts, &field.fields, always, tokens);
            }
            // Offsets are those of the first repetition, and within a struct count from its start.
            if !first || field.structure.is_some() {
                tokens[start..].iter_mut().for_each(|token| token.about.offset = None);
            }
            first = false;
        };
        match field.count.as_ref().or(field.repeat.as_ref()) {
            None => element(tokens),
            Some(Count::Fixed(count)) => (0..*count).for_each(|_| element(tokens)),
            Some(Count::Told) => {
                tokens.push(token(What::ListStart, &Field { offset: None, ..field.clone() }));
                element(tokens);
                tokens.push(token(What::ListEnd, &Field { offset: None, ..field.clone() }));
            }
        }
    }
}

fn what(kind: &str) -> What {
    match kind {
        "1u" => What::Number("u8"),
        "1s" => What::Number("i8"),
        "2u" => What::Number("u16"),
        "2s" => What::Number("i16"),
        "3u" => What::Number("u24"),
        "4u" => What::Number("u32"),
        "4s" => What::Number("i32"),
        "4f" => What::Number("f32"),
        "rest" => What::Rest,
        "string" => What::Text,
        _ => What::Bytes(kind.strip_suffix('b').and_then(|size| size.parse().ok()).expect("a known type")),
    }
}

/// A number with what its field says about it.
struct About {
    number: Number,
    unit: &'static str,
    range: Option<(f64, f64)>,
}

impl About {
    fn new(number: Number, field: &FieldInfo) -> Self {
        let unit = if number.unit.is_empty() { field.unit } else { number.unit };
        About { number, unit, range: field.range }
    }
}

/// The whole message.
const UNNAMED: FieldInfo = FieldInfo {
    name: "",
    spec: "",
    doc: "",
    unit: "",
    range: None,
    since: None,
    presence: Presence::Always,
    reserved: false,
    shape: Shape::Struct(&[]),
};

type Declared = Token<Option<About>>;

fn of_message(shape: &Shape) -> Vec<Declared> {
    let mut tokens = Vec::new();
    of_shape(shape, &FieldInfo { shape: *shape, ..UNNAMED }, true, &mut tokens);
    tokens
}

fn of_shape(shape: &Shape, field: &FieldInfo, always: bool, tokens: &mut Vec<Declared>) {
    let token = |what, about| Token { name: field.spec.to_owned(), what, always, about };
    match shape {
        Shape::Number(number) => {
            tokens.push(token(What::Number(number.scalar.name()), Some(About::new(*number, field))));
        }
        Shape::Bytes { least, most } if least == most => tokens.push(token(What::Bytes(*most), None)),
        Shape::Bytes { .. } => tokens.push(token(What::Rest, None)),
        // A text behind its length byte may be as long as that can say.
        Shape::Text { most: 255 } => tokens.push(token(What::Text, None)),
        Shape::Text { most } => tokens.push(token(What::Bytes(*most), None)),
        Shape::Struct(fields) => fields.iter().for_each(|field| of_field(field, always, tokens)),
        Shape::Group { names, element } => {
            names.iter().for_each(|_| of_shape(element, field, always, tokens));
        }
        Shape::Array { count, element } => {
            (0..*count).for_each(|_| of_shape(element, field, always, tokens));
        }
        Shape::List { element, .. } => {
            tokens.push(token(What::ListStart, None));
            of_shape(element, field, always, tokens);
            tokens.push(token(What::ListEnd, None));
        }
    }
}

fn of_field(field: &FieldInfo, always: bool, tokens: &mut Vec<Declared>) {
    of_shape(&field.shape, field, always && field.presence == Presence::Always, tokens);
}
