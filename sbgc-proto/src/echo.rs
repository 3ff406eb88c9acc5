//! Facts about requests: what answers them, what the answer repeats, and what they do.
//!
//! The facts stand in the declarations of the requests; here is the form in which programs find them.

use crate::CommandId;
use crate::wire::Slot;

/// Facts about the exchange that a command starts.
///
/// Available from [`Message::REQUEST`](crate::Message::REQUEST) for a type, and from [`RequestInfo::of_payload`] for
/// bytes.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct RequestInfo {
    /// Command id of the answer; `None` if there is none, or none is certain.
    pub answer: Option<CommandId>,
    /// Whether the command has an effect beyond the answer, so that sending it twice may act twice.
    pub acts: bool,
    /// Whether the answer may take seconds, because the board completes the work first.
    pub slow: bool,
    /// What the answer repeats of the request.
    pub(crate) echo: &'static [Echo],
    /// Payload bytes of the answer to a request with this payload, where the request determines them.
    pub(crate) answer_len: fn(&[u8]) -> Option<usize>,
}

impl RequestInfo {
    /// Of a message that nothing answers and that does nothing: those from the board.
    pub(crate) const NONE: Self = Self::new(None, false, false, &[], |_| None);

    /// A request that is answered by `answer`, which repeats `echo` and has the length `answer_len`.
    pub(crate) const fn new(
        answer: Option<CommandId>,
        acts: bool,
        slow: bool,
        echo: &'static [Echo],
        answer_len: fn(&[u8]) -> Option<usize>,
    ) -> Self {
        Self { answer, acts, slow, echo, answer_len }
    }
}

/// Something in a request that its answer repeats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Echo {
    rule: Rule,
    /// Where it stands in the request.
    request: u8,
    /// Where it stands in the answer.
    answer: u8,
    /// How many bytes, in lists of one element of the answer.
    size: u8,
}

/// How it is repeated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Rule {
    /// As it is.
    Same,
    /// As it is, in as many bytes as the answer happens to have.
    Number,
    /// A profile as it is; any other number means the current profile, and the answer holds that one's number.
    Profile,
    /// Flags as they are, if the highest of them is set.
    Flags,
    /// A counted list as it is; each number of the answer is followed by more data.
    Each,
    /// Of several bits the number of one.
    OneOf,
    /// At least one of several bits.
    AnyOf,
    /// A number from which on things are listed, so that the answer has it or a greater one.
    From,
}

/// The highest profile number that means just that profile.
const LAST_PROFILE: u8 = 4;

#[expect(clippy::panic, reason = "these end the compilation, not a program")]
impl Echo {
    const fn new(rule: Rule, request: Slot, answer: Slot) -> Self {
        assert!(
            matches!(rule, Rule::Number | Rule::Flags) || request.width() == answer.width(),
            "the field has another size in the answer"
        );
        Self { rule, request: request.offset(), answer: answer.offset(), size: request.width() }
    }

    /// The answer has the same bytes.
    pub(crate) const fn same(request: Slot, answer: Slot) -> Self {
        Self::new(Rule::Same, request, answer)
    }

    /// The answer has the same number in a width that is not known beforehand.
    pub(crate) const fn number(request: Slot, answer: Slot) -> Self {
        Self::new(Rule::Number, request, answer)
    }

    /// The answer has the profile, or the current one if that was requested.
    pub(crate) const fn profile(request: Slot, answer: Slot) -> Self {
        Self::new(Rule::Profile, request, answer)
    }

    /// The answer has the flags if the highest of them is set.
    pub(crate) const fn flags(request: Slot, answer: Slot) -> Self {
        Self::new(Rule::Flags, request, answer)
    }

    /// The answer has a list of as many elements, each of which begins with one of the request's.
    pub(crate) const fn each(request: Slot, answer: Slot, element: &str) -> Self {
        let Some(elements) = answer.elements else { panic!("the answer must have a list") };
        assert!(request.counted && answer.counted, "both must be lists with a count byte");
        let first = Slot::find(elements, element);
        assert!(first.offset() == 0 && first.width() == request.width(), "elements must begin with it");
        assert!(request.width() == 1, "only numbers of one byte are repeated one by one");
        Self { rule: Rule::Each, request: request.offset(), answer: answer.offset(), size: answer.width() }
    }

    /// The answer has the number of one of the bits.
    pub(crate) const fn one_of(request: Slot, answer: Slot) -> Self {
        Self::new(Rule::OneOf, request, answer)
    }

    /// The answer has at least one of the bits.
    pub(crate) const fn any_of(request: Slot, answer: Slot) -> Self {
        Self::new(Rule::AnyOf, request, answer)
    }

    /// The answer has a list whose first element begins with that number or a greater one.
    pub(crate) const fn from(request: Slot, answer: Slot, element: &str) -> Self {
        let Some(elements) = answer.elements else { panic!("the answer must have a list") };
        assert!(Slot::find(elements, element).offset() == 0 && request.width() == 1);
        Self { rule: Rule::From, request: request.offset(), answer: answer.offset(), size: 1 }
    }
}

impl Echo {
    /// Whether an answer with this payload repeats what the request has. Bytes that either lacks count as repeated:
    /// boards report some errors by short answers.
    pub(crate) fn admits(self, request: &[u8], answer: &[u8]) -> bool {
        let (request, answer) = (from(request, self.request), from(answer, self.answer));
        let size = usize::from(self.size);
        let same = || request.iter().zip(answer).take(size).all(|(one, other)| one == other);
        match self.rule {
            Rule::Same | Rule::Number => same(),
            Rule::Profile => !names_profile(request) || same(),
            Rule::Flags => !has_highest(request, size) || same(),
            Rule::Each => match (request, answer) {
                ([count, request @ ..], [other, answer @ ..]) => {
                    let there = answer.iter().step_by(size.max(1)).take(usize::from(*count));
                    count == other && request.iter().zip(there).all(|(one, other)| one == other)
                }
                _ => true,
            },
            Rule::OneOf => match (request, answer) {
                ([bits, ..], [number, ..]) => bits.checked_shr(u32::from(*number)).unwrap_or(0) & 1 != 0,
                _ => true,
            },
            Rule::AnyOf => match (request, answer) {
                ([bits, ..], [others, ..]) => bits & others != 0,
                _ => true,
            },
            Rule::From => match (request, answer) {
                ([first, ..], [number, ..]) => number >= first,
                _ => true,
            },
        }
    }

    /// Whether the answer has the flags that select its fields, and so says itself what it consists of.
    pub(crate) fn names_fields(self, request: &[u8]) -> bool {
        self.rule == Rule::Flags && has_highest(from(request, self.request), usize::from(self.size))
    }

    /// Whether no answer could repeat both requests.
    pub(crate) fn excludes(self, one: &[u8], other: &[u8]) -> bool {
        let (one, other) = (from(one, self.request), from(other, self.request));
        let size = usize::from(self.size);
        let differ = |size| one.iter().zip(other).take(size).any(|(one, other)| one != other);
        match self.rule {
            Rule::Same => differ(size),
            Rule::Profile => names_profile(one) && names_profile(other) && differ(size),
            Rule::Flags => has_highest(one, size) && has_highest(other, size) && differ(size),
            Rule::Each => differ(one.first().map_or(0, |&count| usize::from(count) + 1)),
            Rule::OneOf | Rule::AnyOf => {
                matches!((one, other), ([one, ..], [other, ..]) if one & other == 0)
            }
            // Nothing says how many bytes the answer has, or where its list ends.
            Rule::Number | Rule::From => false,
        }
    }
}

fn from(payload: &[u8], at: u8) -> &[u8] {
    payload.get(usize::from(at)..).unwrap_or_default()
}

fn names_profile(field: &[u8]) -> bool {
    field.first().is_some_and(|&profile| profile <= LAST_PROFILE)
}

fn has_highest(field: &[u8], size: usize) -> bool {
    size.checked_sub(1).and_then(|last| field.get(last)).is_some_and(|byte| byte & 0x80 != 0)
}
