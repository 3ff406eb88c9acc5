//! What may be said in `#[message(…)]`, `#[record(…)]` and `#[wire(…)]`, parsed, with an error at the place of
//! whatever is not understood.

use proc_macro2::{Ident, Span, TokenStream};
use quote::ToTokens;
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Attribute, Error, Expr, LitInt, LitStr, Pat, RangeLimits, Result, Token, Type, parenthesized};

/// Payload bytes as declared: both ends inclusive.
pub(crate) struct Size {
    pub(crate) min: usize,
    pub(crate) max: usize,
}

impl Parse for Size {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let min: LitInt = input.parse()?;
        let max = if input.peek(Token![..=]) {
            input.parse::<Token![..=]>()?;
            input.parse::<LitInt>()?.base10_parse()?
        } else {
            min.base10_parse()?
        };
        let size = Size { min: min.base10_parse()?, max };
        if size.max > 255 || size.min > size.max {
            return Err(Error::new(min.span(), "a payload has 0..=255 bytes, the smaller number first"));
        }
        Ok(size)
    }
}

/// A firmware version, as text and as the number that the board reports.
pub(crate) struct Since {
    pub(crate) text: String,
    pub(crate) raw: u16,
}

impl Parse for Since {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let text: LitStr = input.parse()?;
        let value = text.value();
        let raw = raw_version(&value).ok_or_else(|| {
            Error::new(text.span(), "expected a version such as \"2.68\", \"2.68b7\" or \"2.73.4\"")
        })?;
        Ok(Since { text: value, raw })
    }
}

impl ToTokens for Since {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        let raw = self.raw;
        tokens.extend(quote::quote!(crate::units::FirmwareVersion(#raw)));
    }
}

/// 2687 for "2.68b7", 2734 for "2.73.4".
fn raw_version(text: &str) -> Option<u16> {
    let (major, rest) = text.split_once('.')?;
    let (minor, last) = rest.split_once(['b', '.']).unwrap_or((rest, "0"));
    let (major, minor, last): (u16, u16, u16) =
        (major.parse().ok()?, minor.parse().ok()?, last.parse().ok()?);
    (major < 60 && minor < 100 && last < 10).then_some(major * 1000 + minor * 10 + last)
}

/// `context(name: Type)`.
pub(crate) struct Context {
    pub(crate) name: Ident,
    pub(crate) ty: Type,
}

/// One of the things that an answer repeats: `rule(request_field => answer_field.element)`.
pub(crate) struct Echo {
    pub(crate) rule: Ident,
    pub(crate) request: Ident,
    pub(crate) answer: Ident,
    /// The field of the answer's list elements.
    pub(crate) element: Option<Ident>,
}

impl Parse for Echo {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let first: Ident = input.parse()?;
        if !input.peek(syn::token::Paren) {
            let rule = Ident::new("same", first.span());
            return Ok(Echo { rule, answer: first.clone(), request: first, element: None });
        }
        let rules = ["same", "number", "profile", "flags", "each", "one_of", "from"];
        if !rules.contains(&first.to_string().as_str()) {
            return Err(Error::new(first.span(), format!("an echo is one of {}", rules.join(", "))));
        }
        let inner;
        parenthesized!(inner in input);
        let request: Ident = inner.parse()?;
        let (mut answer, mut element) = (request.clone(), None);
        if inner.peek(Token![=>]) {
            inner.parse::<Token![=>]>()?;
            answer = inner.parse()?;
            if inner.peek(Token![.]) {
                inner.parse::<Token![.]>()?;
                element = Some(inner.parse()?);
            }
        }
        if ["each", "from"].iter().any(|rule| first == rule) != element.is_some() {
            return Err(Error::new(
                first.span(),
                "`each` and `from` name a field of elements: `id => list.id`",
            ));
        }
        Ok(Echo { rule: first, request, answer, element })
    }
}

/// One echo, or several in brackets.
fn echoes(input: ParseStream<'_>) -> Result<Vec<Echo>> {
    input.parse::<Token![=]>()?;
    if !input.peek(syn::token::Bracket) {
        return Ok(vec![input.parse()?]);
    }
    let inner;
    syn::bracketed!(inner in input);
    Ok(Punctuated::<Echo, Token![,]>::parse_terminated(&inner)?.into_iter().collect())
}

/// The arguments of `#[message]` and `#[record]`; the command is there for messages only.
#[expect(clippy::struct_excessive_bools, reason = "each is a word of its own in the declaration")]
pub(crate) struct Arguments {
    pub(crate) command: Option<Ident>,
    pub(crate) outgoing: bool,
    pub(crate) size: Option<Size>,
    pub(crate) form: String,
    pub(crate) is_default: bool,
    pub(crate) lengths: Option<Pat>,
    pub(crate) answer: Option<Type>,
    pub(crate) echo: Vec<Echo>,
    pub(crate) acts: bool,
    pub(crate) slow: bool,
    pub(crate) since: Option<Since>,
    pub(crate) context: Option<Context>,
    /// The field whose flags choose others, where it is not the context.
    pub(crate) flags: Option<Ident>,
    /// What the answer is read with.
    pub(crate) given: Option<Expr>,
    /// How long the answer is.
    pub(crate) answer_len: Option<Expr>,
}

impl Arguments {
    pub(crate) fn parse_message(tokens: TokenStream) -> Result<Self> {
        let arguments =
            syn::parse::Parser::parse2(|input: ParseStream<'_>| Self::parse(input, true), tokens)?;
        if arguments.size.is_none() {
            return Err(Error::new(
                Span::call_site(),
                "say how long the payload is: `size = N` or `size = A..=B`",
            ));
        }
        Ok(arguments)
    }

    pub(crate) fn parse_record(tokens: TokenStream) -> Result<Self> {
        syn::parse::Parser::parse2(|input: ParseStream<'_>| Self::parse(input, false), tokens)
    }

    fn parse(input: ParseStream<'_>, is_message: bool) -> Result<Self> {
        let mut arguments = Arguments {
            command: None,
            outgoing: false,
            size: None,
            form: String::from("full"),
            is_default: true,
            lengths: None,
            answer: None,
            echo: Vec::new(),
            acts: false,
            slow: false,
            since: None,
            context: None,
            flags: None,
            given: None,
            answer_len: None,
        };
        let mut directions = 0;
        if is_message {
            arguments.command = Some(input.parse()?);
            if !input.is_empty() {
                input.parse::<Token![,]>()?;
            }
        }
        while !input.is_empty() {
            let key: Ident = input.parse()?;
            match key.to_string().as_str() {
                "outgoing" if is_message => {
                    directions += 1;
                    arguments.outgoing = true;
                }
                "incoming" if is_message => directions += 1,
                "size" => arguments.size = Some(value(input)?),
                "form" if is_message => {
                    arguments.form = value::<LitStr>(input)?.value();
                    arguments.is_default = false;
                }
                "default" if is_message => arguments.is_default = true,
                "length" if is_message => {
                    input.parse::<Token![=]>()?;
                    arguments.lengths = Some(Pat::parse_multi(input)?);
                }
                "answer" if is_message => arguments.answer = Some(value(input)?),
                "echo" if is_message => arguments.echo = echoes(input)?,
                "given" if is_message => arguments.given = Some(value(input)?),
                "answer_len" if is_message => arguments.answer_len = Some(value(input)?),
                "flags" => arguments.flags = Some(value(input)?),
                "acts" if is_message => arguments.acts = true,
                "slow" if is_message => arguments.slow = true,
                "since" => arguments.since = Some(value(input)?),
                "context" => {
                    let inner;
                    parenthesized!(inner in input);
                    let name = inner.parse()?;
                    inner.parse::<Token![:]>()?;
                    arguments.context = Some(Context { name, ty: inner.parse()? });
                }
                other => return Err(Error::new(key.span(), format!("`{other}` means nothing here"))),
            }
            if !input.is_empty() {
                input.parse::<Token![,]>()?;
            }
        }
        if is_message && directions != 1 {
            return Err(Error::new(Span::call_site(), "say either `outgoing` or `incoming`"));
        }
        let asks = !arguments.echo.is_empty() || arguments.answer.is_some();
        if !arguments.outgoing && (asks || arguments.acts || arguments.slow) {
            return Err(Error::new(Span::call_site(), "only requests have an answer and do something"));
        }
        let about_answer =
            !arguments.echo.is_empty() || arguments.given.is_some() || arguments.answer_len.is_some();
        if arguments.answer.is_none() && about_answer {
            return Err(Error::new(Span::call_site(), "say with `answer` what is answered"));
        }
        Ok(arguments)
    }
}

fn value<T: Parse>(input: ParseStream<'_>) -> Result<T> {
    input.parse::<Token![=]>()?;
    input.parse()
}

/// How many elements a list has.
pub(crate) enum Count {
    /// A count byte in front, with the spec's name of it.
    Prefix(String),
    /// As many as the expression says.
    Exactly(Expr),
    /// As many as the expression says, or fewer where the payload ends.
    AtMost(Expr),
}

/// The arguments of a field's, variant's or part's `#[wire(…)]`.
#[derive(Default)]
pub(crate) struct FieldArguments {
    pub(crate) spec: Option<String>,
    /// Whether the name is none of the spec's, which has no name for the group.
    pub(crate) group: bool,
    pub(crate) unit: Option<String>,
    pub(crate) range: Option<(Expr, Expr)>,
    pub(crate) since: Option<Since>,
    pub(crate) when: Option<Expr>,
    /// The flag with which the field is present.
    pub(crate) flag: Option<Expr>,
    pub(crate) context: Option<Expr>,
    pub(crate) count: Option<Count>,
    /// The bits of a part.
    pub(crate) bits: Option<Expr>,
    /// The number that has the name.
    pub(crate) value: Option<Expr>,
}

/// The keys of fields of messages and records.
pub(crate) const FIELD_KEYS: &[&str] =
    &["spec", "group", "unit", "since", "range", "when", "flag", "context", "counted_by", "count", "at_most"];

impl FieldArguments {
    /// Takes the `#[wire]` attributes, which may have these keys, out of `attributes`.
    pub(crate) fn take(attributes: &mut Vec<Attribute>, keys: &[&str]) -> Result<Self> {
        let mut arguments = Self::default();
        for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("wire")) {
            for entry in attribute.parse_args_with(Punctuated::<Entry, Token![,]>::parse_terminated)? {
                if keys.iter().all(|key| entry.key != key) {
                    let message = format!("`{}` means nothing here", entry.key);
                    return Err(Error::new(entry.key.span(), message));
                }
                arguments.set(entry)?;
            }
        }
        attributes.retain(|attribute| !attribute.path().is_ident("wire"));
        Ok(arguments)
    }

    fn set(&mut self, Entry { key, value }: Entry) -> Result<()> {
        match key.to_string().as_str() {
            "spec" => self.spec = Some(string(value)?),
            "group" => self.group = true,
            "unit" => self.unit = Some(string(value)?),
            "since" => self.since = Some(syn::parse2(quote::quote!(#value))?),
            "range" => self.range = Some(range(value)?),
            "when" => self.when = Some(value),
            "flag" => self.flag = Some(value),
            "context" => self.context = Some(value),
            "counted_by" => self.count = Some(Count::Prefix(string(value)?)),
            "count" => self.count = Some(Count::Exactly(value)),
            "at_most" => self.count = Some(Count::AtMost(value)),
            "bits" => self.bits = Some(value),
            "value" => self.value = Some(value),
            other => return Err(Error::new(key.span(), format!("`{other}` means nothing here"))),
        }
        Ok(())
    }
}

struct Entry {
    key: Ident,
    value: Expr,
}

impl Parse for Entry {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let key: Ident = input.parse()?;
        if key == "group" {
            return Ok(Entry { key, value: syn::parse_quote!(true) });
        }
        input.parse::<Token![=]>()?;
        Ok(Entry { key, value: input.parse()? })
    }
}

fn string(value: Expr) -> Result<String> {
    match value {
        Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) => Ok(text.value()),
        other => Err(Error::new_spanned(other, "a string is wanted here")),
    }
}

fn range(value: Expr) -> Result<(Expr, Expr)> {
    match value {
        Expr::Range(syn::ExprRange {
            start: Some(start),
            limits: RangeLimits::Closed(_),
            end: Some(end),
            ..
        }) => Ok((*start, *end)),
        other => Err(Error::new_spanned(other, "a range `A..=B` of raw values is wanted here")),
    }
}

/// `BatThresholdAlarm` and `bat_threshold_alarm` both become `BAT_THRESHOLD_ALARM`.
pub(crate) fn capitals(name: &str) -> String {
    let mut result = String::new();
    let mut previous = '_';
    for letter in name.trim_start_matches("r#").chars() {
        let starts_word = (letter.is_ascii_uppercase() && !previous.is_ascii_uppercase())
            || (letter.is_ascii_digit()
                && previous.is_ascii_lowercase()
                && name.contains(char::is_uppercase));
        if starts_word && previous != '_' {
            result.push('_');
        }
        result.push(letter.to_ascii_uppercase());
        previous = letter;
    }
    result
}
