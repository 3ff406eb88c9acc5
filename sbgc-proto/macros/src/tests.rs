//! What is said of declarations that do not hold.

use proc_macro2::TokenStream;
use quote::quote;

use crate::{declaration, open_enum};

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
