//! The attribute macros in which `sbgc-proto` declares the protocol: [`macro@message`], [`macro@record`] and
//! [`macro@open_enum`].
//!
//! They work only inside `sbgc-proto`: the code they write speaks of `crate::wire` and of that crate's features.
//! From one declaration follow the codec, the sizes (checked when compiling), reflection, serde and defmt, and the
//! part of the documentation that would otherwise be typed twice (spec names, units, ranges, versions).
//!
//! The written struct stays the struct that is used. The macros add attributes and trait implementations, nothing
//! else; what they write never indexes, unwraps or casts.

/// `quote!` for code with variables of its own: a field may have the name of any of them.
macro_rules! local {
    ($($tokens:tt)*) => {
        ::quote::quote_spanned!(::proc_macro2::Span::mixed_site() => $($tokens)*)
    };
}

mod attributes;
mod codec;
mod declaration;
mod documentation;
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
