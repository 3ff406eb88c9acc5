//! `#[open_enum]`: an enumeration that keeps what it does not know.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use syn::parse::{Parse, ParseStream};
use syn::{Error, Expr, ItemEnum, LitStr, Result, Token, parse_quote, parse2};

use crate::attributes::{FieldArguments, capitals};
use crate::documentation;

/// `u8` or `u8, prefix = "CMD_"`.
struct Arguments {
    integer: Ident,
    /// What stands before the variants' names in the spec.
    prefix: String,
}

impl Parse for Arguments {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let integer = input.parse()?;
        let mut prefix = String::new();
        if !input.is_empty() {
            input.parse::<Token![,]>()?;
            let key: Ident = input.parse()?;
            if key != "prefix" {
                return Err(Error::new(key.span(), format!("`{key}` means nothing here")));
            }
            input.parse::<Token![=]>()?;
            prefix = input.parse::<LitStr>()?.value();
        }
        Ok(Arguments { integer, prefix })
    }
}

struct Variant {
    name: Ident,
    value: Expr,
    spec: String,
    doc: String,
}

pub(crate) fn expand(arguments: TokenStream, item: TokenStream) -> Result<TokenStream> {
    let Arguments { integer, prefix } = parse2(arguments)?;
    let mut item: ItemEnum = parse2(item)?;
    let variants = variants(&mut item, &prefix)?;
    item.attrs.push(parse_quote!(#[non_exhaustive]));
    item.variants.push(parse_quote! {
        /// Value that is not in this list. `From` never creates it for a listed value.
        Unknown(#integer)
    });
    item.attrs.push(parse_quote!(#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]));
    item.attrs.push(parse_quote!(#[cfg_attr(feature = "defmt", derive(::defmt::Format))]));
    let name = &item.ident;
    let names: Vec<_> = variants.iter().map(|variant| &variant.name).collect();
    let values: Vec<_> = variants.iter().map(|variant| &variant.value).collect();
    let labels = variants.iter().map(|Variant { value, spec, doc, .. }| {
        quote!(crate::wire::Label { value: #value, name: #spec, doc: #doc })
    });
    // What is one byte can be a part of a larger number.
    let part = (integer == "u8").then(|| {
        quote! {
            impl crate::declare::BitField for #name {
                fn from_bits(bits: u32) -> Self {
                    Self::from_raw(<u8 as crate::declare::BitField>::from_bits(bits))
                }

                fn into_bits(self) -> u32 {
                    u32::from(self.raw())
                }
            }

            #[cfg(feature = "reflect")]
            impl crate::declare::BitLabels for #name {
                const LABELS: &'static [crate::wire::Label] = Self::LABELS;
            }
        }
    });
    let tests = format_ident!("every_{}", capitals(&name.to_string()).to_lowercase());
    Ok(quote! {
        #item

        impl #name {
            /// Known values with their spec names.
            pub const LABELS: &'static [crate::wire::Label] = &[#(#labels),*];

            /// Creates the value from a raw number.
            pub const fn from_raw(raw: #integer) -> Self {
                match raw {
                    #(#values => Self::#names,)*
                    other => Self::Unknown(other),
                }
            }

            /// Raw number on the wire.
            pub const fn raw(self) -> #integer {
                match self {
                    #(Self::#names => #values,)*
                    Self::Unknown(raw) => raw,
                }
            }
        }

        impl ::core::convert::From<#integer> for #name {
            fn from(raw: #integer) -> Self {
                Self::from_raw(raw)
            }
        }

        impl ::core::convert::From<#name> for #integer {
            fn from(value: #name) -> Self {
                value.raw()
            }
        }

        impl ::core::default::Default for #name {
            /// Returns the value of raw number 0.
            fn default() -> Self {
                Self::from_raw(0)
            }
        }

        crate::declare::number_type!(
            #name: #integer, read |raw| #name::from_raw(raw), raw |value| value.raw(),
            meaning crate::reflect::Meaning::Enum(Self::LABELS), labelled
        );

        #part

        #[cfg(test)]
        mod #tests {
            use super::#name;

            #[test]
            fn value_is_kept() {
                for raw in #integer::MIN..=#integer::MAX {
                    let value = #name::from(raw);
                    assert_eq!(#integer::from(value), raw);
                    let is_known = #name::LABELS.iter().any(|label| label.value == i64::from(raw));
                    assert_eq!(is_known, value != #name::Unknown(raw), "{value:?}");
                }
            }
        }
    })
}

fn variants(item: &mut ItemEnum, prefix: &str) -> Result<Vec<Variant>> {
    let mut variants = Vec::new();
    for variant in &mut item.variants {
        let Some((_, value)) = variant.discriminant.take() else {
            return Err(Error::new_spanned(&variant.ident, "each variant needs its value: `Name = 1`"));
        };
        let doc = documentation::summary(&variant.attrs);
        let arguments = FieldArguments::take(&mut variant.attrs, &["spec", "since"])?;
        let spec =
            arguments.spec.unwrap_or_else(|| format!("{prefix}{}", capitals(&variant.ident.to_string())));
        let since = arguments.since.map(|since| format!(", firmware {}+", since.text)).unwrap_or_default();
        let line = format!("Spec: `{spec}` = {}{since}.", quote!(#value).to_string().replace("- ", "-"));
        variant.attrs.extend(documentation::paragraph(&line));
        variants.push(Variant { name: variant.ident.clone(), value, spec, doc });
    }
    Ok(variants)
}
