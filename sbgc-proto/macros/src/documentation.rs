//! The lines that are added to the documentation of what is declared.

use std::fmt::Write as _;

use proc_macro2::Ident;
use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::{Attribute, Expr, ExprLit, Lit, LitStr, Token, Type, parse_quote};

use crate::attributes::{Arguments, Count};
use crate::offsets;
use crate::structure::Field;

/// The text of the doc comments among `attributes`, the first paragraph only.
pub(crate) fn summary(attributes: &[Attribute]) -> String {
    let mut text = String::new();
    for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("doc")) {
        if let syn::Meta::NameValue(meta) = &attribute.meta
            && let Some(line) = literal(&meta.value)
        {
            if line.trim().is_empty() && !text.is_empty() {
                break;
            }
            if !text.is_empty() {
                text.push(' ');
            }
            text.push_str(line.trim());
        }
    }
    without_links(&text)
}

/// The text of a string, or of several in `concat!`.
fn literal(text: &Expr) -> Option<String> {
    match text {
        Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) => Some(text.value()),
        Expr::Group(group) => literal(&group.expr),
        Expr::Macro(text) if text.mac.path.is_ident("concat") => {
            let parts = text.mac.parse_body_with(Punctuated::<LitStr, Token![,]>::parse_terminated).ok()?;
            Some(parts.iter().map(LitStr::value).collect())
        }
        _ => None,
    }
}

/// `text` with plain words for links to code: "[`Name`](path)" and "[`Name`]" become "Name".
fn without_links(text: &str) -> String {
    let mut result = String::new();
    let mut rest = text;
    while let Some((before, link)) = rest.split_once("[`") {
        result.push_str(before);
        let Some((name, after)) = link.split_once("`]") else {
            result.push_str("[`");
            rest = link;
            continue;
        };
        result.push_str(name);
        rest = match after.strip_prefix('(').and_then(|target| target.split_once(')')) {
            Some((_, after)) => after,
            None => after,
        };
    }
    result + rest
}

/// What a message's page says besides its own words.
pub(crate) fn of_message(arguments: &Arguments) -> Vec<Attribute> {
    let Some(command) = &arguments.command else { return Vec::new() };
    let direction =
        if arguments.outgoing { "outgoing (host to controller)" } else { "incoming (controller to host)" };
    let mut line = format!("Spec: `{command}`, {direction}");
    if arguments.form != "full" {
        let _ = write!(line, ", form `{}`", arguments.form);
    }
    if let Some(size) = &arguments.size {
        let _ = match (size.min, size.max) {
            (0, 0) => write!(line, ", no payload"),
            (1, 1) => write!(line, ", 1 byte"),
            (min, max) if min == max => write!(line, ", {min} bytes"),
            (min, max) => write!(line, ", {min} to {max} bytes"),
        };
    }
    if let Some(since) = &arguments.since {
        let _ = write!(line, ", firmware {}+", since.text);
    }
    line.push('.');
    if let Some(answer) = &arguments.answer {
        let name = answer.to_token_stream().to_string();
        let name = name.split([' ', '<']).next().unwrap_or_default().to_owned();
        let _ = write!(line, " Answered by [`{name}`]");
        let repeated: Vec<_> = arguments.echo.iter().map(|echo| format!("`{}`", echo.request)).collect();
        if !repeated.is_empty() {
            let _ = write!(line, ", which repeats {}", repeated.join(" and "));
        }
        line.push('.');
    }
    if arguments.slow {
        line.push_str(" The answer may take seconds.");
    }
    let alias = command.to_string();
    paragraph(&line).into_iter().chain([parse_quote!(#[doc(alias = #alias)])]).collect()
}

/// What a field's entry says besides its own words.
///
/// `flags` is the type of the flags that choose fields.
pub(crate) fn of_field(structure: &Ident, field: &Field, flags: Option<&Type>) -> Vec<Attribute> {
    let arguments = &field.arguments;
    if field.reserved {
        return Vec::new();
    }
    let mut facts = Vec::new();
    if !arguments.group {
        facts.push(format!("Spec: `{}`", field.spec));
    }
    if let Some(offset) = offsets::offset(structure, &field.name) {
        facts.push(format!("offset {offset}"));
    }
    if let Some(Count::Prefix(count)) = &arguments.count {
        facts.push(format!("counted by `{count}`"));
    }
    if let Some(unit) = &arguments.unit {
        facts.push(format!("in {unit}"));
    }
    if let Some((from, to)) = &arguments.range {
        let plain = |end: &syn::Expr| end.to_token_stream().to_string().replace("- ", "-");
        facts.push(format!("raw range {} to {}", plain(from), plain(to)));
    }
    if let Some(since) = &arguments.since {
        facts.push(format!("firmware {}+", since.text));
    }
    let mut line = facts.join(", ");
    if let Some(first) = line.get_mut(..1) {
        first.make_ascii_uppercase();
        line.push('.');
    }
    if let (Some(flag), Some(flags)) = (&arguments.flag, flags) {
        let (flag, flags) = (flag.to_token_stream(), flags.to_token_stream());
        let _ = write!(line, " Present if [`{flag}`]({flags}::{flag}) is set.");
    } else if let Some(when) = &arguments.when {
        let when = when.to_token_stream().to_string().replace(" . ", ".").replace(" :: ", "::");
        let _ =
            write!(line, " Present if `{}`.", when.replace(" (", "(").replace("( ", "(").replace(" )", ")"));
    } else if field.is_option {
        line.push_str(" Absent if the payload ends before it.");
    }
    if line.is_empty() {
        return Vec::new();
    }
    paragraph(line.trim_start()).into()
}

/// A paragraph of its own with this text.
pub(crate) fn paragraph(text: &str) -> [Attribute; 2] {
    [parse_quote!(#[doc = ""]), parse_quote!(#[doc = #text])]
}
