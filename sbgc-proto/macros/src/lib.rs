//! The attribute macros in which `sbgc-proto` declares the protocol: [`macro@message`], [`macro@record`],
//! [`macro@open_enum`] and [`macro@bit_fields`].
//!
//! They work only inside `sbgc-proto`: the code they write speaks of `crate::wire` and of that crate's features.
//! From one declaration follow the codec, the sizes (checked when compiling), reflection, serde and defmt, and the
//! part of the documentation that would otherwise be typed twice (spec names, units, ranges, versions).
//!
//! The written struct stays the struct that is used; only that of `bit_fields` becomes the number whose parts it
//! lists. What the macros write never indexes, unwraps or casts.

/// `quote!` for code with variables of its own: a field may have the name of any of them.
macro_rules! local {
    ($($tokens:tt)*) => {
        ::quote::quote_spanned!(::proc_macro2::Span::mixed_site() => $($tokens)*)
    };
}

mod attributes;
mod bit_fields;
mod codec;
mod declaration;
mod documentation;
mod offsets;
mod open_enum;
mod reflection;
mod structure;
#[cfg(test)]
mod tests;

use proc_macro::TokenStream;

/// Declares the payload of one message form.
///
/// ```text
/// #[message(CMD_BOARD_INFO, incoming, size = 18)]
/// #[message(CMD_CONTROL, outgoing, form = "legacy", size = 13, length = 13, answer = Confirm<'answer>)]
/// #[message(CMD_REALTIME_DATA_CUSTOM, incoming, size = 2..=255, context(flags: RealtimeDataCustomFlags))]
/// ```
///
/// | key | meaning |
/// | --- | --- |
/// | first word | the spec's name of the command |
/// | `outgoing`, `incoming` | direction, seen from the host |
/// | `size = N` or `A..=B` | payload bytes; checked against the sum of the fields |
/// | `form = "…"` | name of the form where an id has several; `full` when left out |
/// | `default` | after `form`: the one to build unless another is asked for; goes without saying where `form` is left out |
/// | `length = pattern` | payload lengths that choose this form |
/// | `answer = Type` | the message the board answers with |
/// | `echo = field` | what of the request the answer repeats in a field of the same name; several stand in brackets |
/// | `echo = rule(field => other)` | the same in a field of another name or not literally, see below |
/// | `acts` | it does more than ask; follows where the answer is `Confirm` or missing |
/// | `slow` | the answer may take seconds |
/// | `since = "…"` | first firmware |
/// | `context(name: Type)` | what must be known besides the payload to read it |
/// | `given = expression` | the context with which the answer is read; the request is `self` |
/// | `answer_len = expression` | payload bytes of the answer, where the request determines them; the request is `self` |
/// | `flags = field` | the field whose flags choose others; the context, if there is one, need not be named |
///
/// Echoes are checked when compiling: both fields exist, at fixed offsets and of one size. Rules are:
///
/// | rule | what the answer has |
/// | --- | --- |
/// | `same(a => b)` | the same bytes |
/// | `number(a => b)` | the same number in a width of its own |
/// | `profile(a)` | the same profile; any if the request names none but the current one |
/// | `flags(a)` | the same flags if the highest of them is set |
/// | `each(a => list.b)` | a list of as many elements, each of which begins with one of the request's |
/// | `one_of(a => b)` | the number of one of the bits |
/// | `from(a => list.b)` | a list whose first element begins with that number or a greater one |
///
/// Fields take `#[wire(…)]`:
///
/// | key | meaning |
/// | --- | --- |
/// | `spec = "…"` | the spec's name, where it is not the field's name in capitals |
/// | `group` | the spec has no name for what the field holds: it is left out of the documentation |
/// | `unit = "…"` | unit of a plain number whose scale is 1 |
/// | `range = A..=B` | allowed raw values |
/// | `since = "…"` | first firmware that uses the field |
/// | `when = expression` | the field, an `Option`, is on the wire only then; earlier fields are in scope by reference |
/// | `flag = NAME` | the field, an `Option`, is on the wire only with this flag |
/// | `context = expression` | handed to the field's own type, which declares a `context` |
/// | `counted_by = "…"` | a list that follows its own count byte, with the spec's name of that byte |
/// | `count = expression` | a list of so many elements |
/// | `at_most = expression` | a list of so many elements, or fewer where the payload ends earlier |
///
/// An `Option` without `when` is an optional tail: absent when the payload ends before it.
#[proc_macro_attribute]
pub fn message(arguments: TokenStream, item: TokenStream) -> TokenStream {
    declaration::expand_message(arguments.into(), item.into())
        .unwrap_or_else(syn::Error::into_compile_error)
        .into()
}

/// Declares a group of fields that stands inside messages. Takes `size` and `context` of [`macro@message`] and the
/// same field attributes.
#[proc_macro_attribute]
pub fn record(arguments: TokenStream, item: TokenStream) -> TokenStream {
    declaration::expand_record(arguments.into(), item.into())
        .unwrap_or_else(syn::Error::into_compile_error)
        .into()
}

/// Declares an enumeration of wire values that keeps the values it does not know.
///
/// The argument is the integer on the wire, and after it may stand the `prefix = "…"` of the spec's names. Each variant
/// has its value and, where it is not the prefix and the variant's name in capitals, `#[wire(spec = "…")]`. A last
/// variant `Unknown` with the raw value is added. Values may be added later, so the enumeration is not exhaustive.
#[proc_macro_attribute]
pub fn open_enum(arguments: TokenStream, item: TokenStream) -> TokenStream {
    open_enum::expand(arguments.into(), item.into()).unwrap_or_else(syn::Error::into_compile_error).into()
}

/// Declares a number that is made of several smaller ones. Bits that no part takes are kept.
///
/// ```text
/// #[bit_fields(u8)]
/// pub struct Name {
///     /// What it means.
///     #[wire(bits = 0..=4)]
///     pub channel: u8,
///     /// What it means.
///     #[wire(bits = 5..=6, spec = "TYPE", since = "2.68")]
///     pub kind: Kind,
///     /// If a value has a name as a whole.
///     #[wire(value = 0)]
///     pub NOTHING: Self,
/// }
/// ```
///
/// The argument is the integer on the wire, and the struct becomes one with it as field `0`. Each part, a `u8`, a `bool`
/// or an open enumeration of one byte, gets a reader of its name and a `with_` method, which turns a value too large
/// for the bits into the maximum that they hold; each named value becomes a constant.
#[proc_macro_attribute]
pub fn bit_fields(arguments: TokenStream, item: TokenStream) -> TokenStream {
    bit_fields::expand(arguments.into(), item.into()).unwrap_or_else(syn::Error::into_compile_error).into()
}
