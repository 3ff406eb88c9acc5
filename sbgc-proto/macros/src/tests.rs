//! What is said of declarations that do not hold.

use proc_macro2::TokenStream;
use quote::quote;

use crate::{bit_fields, declaration, open_enum};

fn message(arguments: TokenStream, item: TokenStream) -> String {
    match declaration::expand_message(arguments, item) {
        Ok(_) => String::from("fine"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn mistakes_in_the_arguments_are_named() {
    let item = || {
        quote!(
            pub struct Name {
                /** What. */
                pub field: u8,
            }
        )
    };
    for (arguments, expected) in [
        (quote!(CMD_X, outgoing, size = 1), "fine"),
        (quote!(CMD_X, outgoing), "say how long the payload is: `size = N` or `size = A..=B`"),
        (quote!(CMD_X, size = 1), "say either `outgoing` or `incoming`"),
        (quote!(CMD_X, outgoing, incoming, size = 1), "say either `outgoing` or `incoming`"),
        (quote!(CMD_X, outgoing, size = 256), "a payload has 0..=255 bytes, the smaller number first"),
        (quote!(CMD_X, outgoing, size = 3..=2), "a payload has 0..=255 bytes, the smaller number first"),
        (quote!(CMD_X, outgoing, size = 1, colour = "red"), "`colour` means nothing here"),
    ] {
        assert_eq!(message(arguments.clone(), item()), expected, "{arguments}");
    }
}

#[test]
fn mistakes_in_the_fields_are_named() {
    let arguments = || quote!(CMD_X, outgoing, size = 1..=9);
    for (fields, expected) in [
        (quote!({ pub a: Option<u8>, pub b: Option<u8> }), "fine"),
        (
            quote!({ pub a: Option<u8>, pub b: u8 }),
            "`a` is an optional tail, so all that follows it must be optional too",
        ),
        (quote!({ #[wire(when = true)] pub a: u8 }), "a field with `when` is an `Option`"),
        (quote!({ #[wire(colour = "red")] pub a: u8 }), "`colour` means nothing here"),
        (quote!({ #[wire(unit = 5)] pub a: u8 }), "a string is wanted here"),
        (quote!({ #[wire(range = 0..9)] pub a: u8 }), "a range `A..=B` of raw values is wanted here"),
    ] {
        assert_eq!(message(arguments(), quote!(pub struct Name #fields)), expected, "{fields}");
    }
    assert_eq!(
        message(
            arguments(),
            quote!(
                pub struct Name(pub A, pub B);
            )
        ),
        "several fields need names"
    );
    assert_eq!(
        message(
            arguments(),
            quote!(
                pub struct Name<T> {
                    pub a: T,
                }
            )
        ),
        "a message has no type parameters"
    );
}

#[test]
fn values_of_enumerations_are_written_down() {
    let error = open_enum::expand(
        quote!(u8),
        quote!(
            pub enum Name {
                One,
            }
        ),
    );
    assert_eq!(error.expect_err("no value").to_string(), "each variant needs its value: `Name = 1`");
}

#[test]
fn the_spec_names_follow_from_the_names() {
    use crate::attributes::capitals;

    for (name, spec) in [
        ("bat_threshold_alarm", "BAT_THRESHOLD_ALARM"),
        ("BatThresholdAlarm", "BAT_THRESHOLD_ALARM"),
        ("servo1_out", "SERVO1_OUT"),
        ("Profile1", "PROFILE_1"),
        ("r#type", "TYPE"),
    ] {
        assert_eq!(capitals(name), spec);
    }
}

#[test]
fn mistakes_in_the_parts_of_a_number_are_named() {
    for (integer, fields, expected) in [
        (quote!(u8), quote!({ #[wire(bits = 0..=3)] pub a: u8, #[wire(bits = 4)] pub b: bool }), "fine"),
        (quote!(u8), quote!({ #[wire(value = 0)] pub A: Self }), "fine"),
        (quote!(i8), quote!({}), "expected `u8`, `u16` or `u32`"),
        (quote!(u8), quote!({ pub a: u8 }), "say where it stands: `bits = A..=B` or `bits = A`"),
        (quote!(u8), quote!({ #[wire(bits = 4..=8)] pub a: u8 }), "the number has bits 0..=7"),
        (quote!(u8), quote!({ #[wire(bits = 3..=2)] pub a: u8 }), "the number has bits 0..=7"),
        (quote!(u8), quote!({ #[wire(bits = LOW)] pub a: u8 }), "the number of a bit is wanted here"),
        (
            quote!(u16),
            quote!({ #[wire(bits = 0..=8)] pub a: u8, #[wire(bits = 8)] pub b: bool }),
            "another part has some of these bits",
        ),
        (quote!(u8), quote!({ #[wire(bits = 0, unit = "mA")] pub a: bool }), "`unit` means nothing here"),
    ] {
        let said = match bit_fields::expand(integer, quote!(pub struct Name #fields)) {
            Ok(_) => String::from("fine"),
            Err(error) => error.to_string(),
        };
        assert_eq!(said, expected, "{fields}");
    }
}
