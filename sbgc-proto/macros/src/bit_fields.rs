//! `#[bit_fields]`: a number that is made of several smaller ones.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use syn::{Attribute, Error, Expr, ExprLit, ExprRange, ItemStruct, Lit, RangeLimits, Result, Type, parse2};

use crate::attributes::{FieldArguments, capitals};
use crate::documentation;

/// Some bits of the number.
struct Part {
    name: Ident,
    ty: Type,
    low: u32,
    width: u32,
    spec: String,
    doc: String,
    attributes: Vec<Attribute>,
}

impl Part {
    /// Its bits, within the number.
    const fn mask(&self) -> u64 {
        ((1 << self.width) - 1) << self.low
    }
}

/// A value that has a name as a whole.
struct Named {
    name: Ident,
    value: Expr,
    doc: String,
    attributes: Vec<Attribute>,
}

pub(crate) fn expand(arguments: TokenStream, item: TokenStream) -> Result<TokenStream> {
    let integer: Ident = parse2(arguments)?;
    let bits = match integer.to_string().as_str() {
        "u8" => 8,
        "u16" => 16,
        "u32" => 32,
        _ => return Err(Error::new(integer.span(), "expected `u8`, `u16` or `u32`")),
    };
    let mut item: ItemStruct = parse2(item)?;
    let (parts, named) = read(&mut item, bits)?;
    let (name, attributes, visibility) = (&item.ident, &item.attrs, &item.vis);
    let constants = named.iter().map(
        |Named { name, value, attributes, .. }| quote!(#(#attributes)* pub const #name: Self = Self(#value);),
    );
    let methods = parts.iter().map(|part| methods(part, &integer));
    let part_infos = parts.iter().map(|Part { ty, low, width, spec, doc, .. }| {
        quote! {
            crate::reflect::BitPart {
                name: #spec,
                low: #low,
                width: #width,
                labels: <#ty as crate::declare::BitLabels>::LABELS,
                doc: #doc,
            }
        }
    });
    let labels = named.iter().map(|Named { name, value, doc, .. }| {
        let name = name.to_string();
        quote!(crate::wire::Label { value: #value, name: #name, doc: #doc })
    });
    Ok(quote! {
        #(#attributes)*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        #[cfg_attr(feature = "defmt", derive(::defmt::Format))]
        #visibility struct #name(pub #integer);

        impl #name {
            #(#constants)*
            #(#methods)*
        }

        crate::declare::number_type!(
            #name: #integer, read |raw| #name(raw), raw |value| value.0,
            meaning crate::reflect::Meaning::Bits(&[#(#part_infos),*], &[#(#labels),*])
        );

        #[cfg(feature = "serde")]
        crate::serde_support::parts!(#name(#integer));
    })
}

/// The reader of a part, and what replaces it.
fn methods(part: &Part, integer: &Ident) -> TokenStream {
    let Part { name, ty, low, width, attributes, .. } = part;
    let with = format_ident!("with_{}", name);
    let mask = u32::MAX >> (32 - width);
    let doc = format!(
        "Returns a copy with [`{name}`](Self::{name}) replaced; a value too large for its bits becomes the maximum \
         they hold."
    );
    quote! {
        #(#attributes)*
        pub fn #name(self) -> #ty {
            <#ty as crate::declare::BitField>::from_bits((u32::from(self.0) >> #low) & #mask)
        }

        #[doc = #doc]
        #[must_use]
        pub fn #with(self, value: #ty) -> Self {
            let part = crate::declare::BitField::into_bits(value).min(#mask) << #low;
            let bits = (u32::from(self.0) & !(#mask << #low)) | part;
            // No bit of `bits` is beyond those of the integer.
            Self(#integer::try_from(bits).unwrap_or(#integer::MAX))
        }
    }
}

fn read(item: &mut ItemStruct, bits: u32) -> Result<(Vec<Part>, Vec<Named>)> {
    let (mut parts, mut named): (Vec<Part>, _) = (Vec::new(), Vec::new());
    let mut taken = 0_u64;
    for field in &mut item.fields {
        let Some(name) = field.ident.clone() else {
            return Err(Error::new_spanned(field, "parts need names"));
        };
        let doc = documentation::summary(&field.attrs);
        let arguments = FieldArguments::take(&mut field.attrs, &["spec", "since", "bits", "value"])?;
        let mut attributes = std::mem::take(&mut field.attrs);
        if let Some(value) = arguments.value {
            let line = format!("Spec: `{name}` = {}.", quote!(#value));
            attributes.extend(documentation::paragraph(&line));
            named.push(Named { name, value, doc, attributes });
            continue;
        }
        let Some(place) = &arguments.bits else {
            return Err(Error::new(name.span(), "say where it stands: `bits = A..=B` or `bits = A`"));
        };
        let (low, high) = ends(place)?;
        if low > high || high >= bits {
            return Err(Error::new_spanned(place, format!("the number has bits 0..={}", bits - 1)));
        }
        let spec = arguments.spec.unwrap_or_else(|| capitals(&name.to_string()));
        let words = if low == high { format!("bit {low}") } else { format!("bits {low} to {high}") };
        let since = arguments.since.map(|since| format!(", firmware {}+", since.text)).unwrap_or_default();
        attributes.extend(documentation::paragraph(&format!("Spec: `{spec}`, {words}{since}.")));
        let part = Part { name, ty: field.ty.clone(), low, width: high - low + 1, spec, doc, attributes };
        if taken & part.mask() != 0 {
            return Err(Error::new_spanned(place, "another part has some of these bits"));
        }
        taken |= part.mask();
        parts.push(part);
    }
    Ok((parts, named))
}

/// The lowest and the highest bit of `A..=B` or `A`.
fn ends(place: &Expr) -> Result<(u32, u32)> {
    match place {
        Expr::Range(ExprRange {
            start: Some(low), limits: RangeLimits::Closed(_), end: Some(high), ..
        }) => Ok((number(low)?, number(high)?)),
        single => number(single).map(|bit| (bit, bit)),
    }
}

fn number(text: &Expr) -> Result<u32> {
    match text {
        Expr::Lit(ExprLit { lit: Lit::Int(number), .. }) => number.base10_parse(),
        Expr::Group(group) => number(&group.expr),
        other => Err(Error::new_spanned(other, "the number of a bit is wanted here")),
    }
}
