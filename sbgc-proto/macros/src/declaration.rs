//! `#[message]` and `#[record]`: from the declaration to all that is written for it.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, format_ident, quote};
use syn::{Error, ItemStruct, Lifetime, Result, Type, parse2};

use crate::attributes::{Arguments, FIELD_KEYS, FieldArguments, capitals};
use crate::structure::{Field, Structure, argument_of, is_named};
use crate::{codec, documentation, offsets, reflection};

pub(crate) fn expand_message(arguments: TokenStream, item: TokenStream) -> Result<TokenStream> {
    let arguments = Arguments::parse_message(arguments)?;
    let (item, structure) = read(arguments, item)?;
    let codec = codec::of_structure(&structure);
    let message = codec::of_message(&structure);
    let reflection = reflection::of_structure(&structure);
    let offsets = offsets::test(&structure);
    Ok(quote!(#item #codec #message #reflection #offsets))
}

pub(crate) fn expand_record(arguments: TokenStream, item: TokenStream) -> Result<TokenStream> {
    let arguments = Arguments::parse_record(arguments)?;
    let (item, structure) = read(arguments, item)?;
    let codec = codec::of_structure(&structure);
    let reflection = reflection::of_structure(&structure);
    let offsets = offsets::test(&structure);
    Ok(quote!(#item #codec #reflection #offsets))
}

fn read(arguments: Arguments, item: TokenStream) -> Result<(ItemStruct, Structure)> {
    let mut item: ItemStruct = parse2(item)?;
    if item.generics.type_params().next().is_some() {
        return Err(Error::new_spanned(&item.generics, "a message has no type parameters"));
    }
    let lifetime = item.generics.lifetimes().next().map(|parameter| parameter.lifetime.clone());
    let doc = documentation::summary(&item.attrs);
    let mut fields: Vec<Field> = Vec::new();
    let mut tail: Option<Ident> = None;
    let transparent = matches!(item.fields, syn::Fields::Unnamed(_));
    if transparent && item.fields.len() != 1 {
        return Err(Error::new_spanned(&item.fields, "several fields need names"));
    }
    for field in &mut item.fields {
        let name = field.ident.clone().unwrap_or_else(|| format_ident!("inner"));
        let doc = documentation::summary(&field.attrs);
        let mut field_arguments = FieldArguments::take(&mut field.attrs, FIELD_KEYS)?;
        if let Some(flag) = &field_arguments.flag {
            let Some((flags, ty)) = flags_of(&arguments, &fields) else {
                return Err(Error::new_spanned(flag, "a field with `flag` needs `flags` or a `context`"));
            };
            let flag = quote!(#ty::#flag);
            field_arguments.when = Some(syn::parse_quote!(#flags.contains(#flag)));
        }
        let option = option_of(&field.ty);
        if field_arguments.when.is_some() && option.is_none() {
            return Err(Error::new_spanned(&field.ty, "a field with `when` is an `Option`"));
        }
        let is_tail = option.is_some() && field_arguments.when.is_none();
        if let (Some(first), false) = (&tail, is_tail) {
            let message =
                format!("`{first}` is an optional tail, so all that follows it must be optional too");
            return Err(Error::new_spanned(&field.ty, message));
        }
        if is_tail {
            tail = Some(name.clone());
        }
        let inner = option.clone().unwrap_or_else(|| field.ty.clone());
        let reserved = is_named(&inner, "Reserved");
        let declared = Field {
            spec: field_arguments.spec.clone().unwrap_or_else(|| capitals(&name.to_string())),
            doc,
            inner,
            is_option: option.is_some(),
            reserved,
            name,
            ty: field.ty.clone(),
            arguments: field_arguments,
        };
        if let Some(lifetime) = &lifetime {
            field.attrs.extend(borrowed(&declared.ty, lifetime));
        }
        if reserved && declared.doc.is_empty() {
            field.attrs.push(
                syn::parse_quote!(#[doc = "Reserved bytes, preserved as received; zero in a new message."]),
            );
        }
        if !transparent {
            let flags = flags_of(&arguments, &fields).map(|(_, ty)| ty);
            field.attrs.extend(documentation::of_field(&item.ident, &declared, flags.as_ref()));
        }
        fields.push(declared);
    }
    item.attrs.extend(documentation::of_message(&arguments));
    item.attrs.push(syn::parse_quote!(#[derive(Clone, Debug, Default, PartialEq, Eq)]));
    item.attrs.push(syn::parse_quote!(#[cfg_attr(feature = "defmt", derive(::defmt::Format))]));
    item.attrs.push(syn::parse_quote!(
        #[cfg_attr(feature = "serde", derive(::serde::Serialize, ::serde::Deserialize))]
    ));
    let structure = Structure { name: item.ident.clone(), lifetime, arguments, fields, doc, transparent };
    Ok((item, structure))
}

/// Name and type of the flags that choose fields: the field that the declaration names, or the context.
fn flags_of(arguments: &Arguments, fields: &[Field]) -> Option<(Ident, Type)> {
    match (&arguments.flags, &arguments.context) {
        (Some(flags), _) => {
            let field = fields.iter().find(|field| field.name == *flags)?;
            Some((field.name.clone(), field.ty.clone()))
        }
        (None, Some(context)) => Some((context.name.clone(), context.ty.clone())),
        (None, None) => None,
    }
}

/// What serde must be told of a field that borrows.
fn borrowed(ty: &Type, lifetime: &Lifetime) -> Option<syn::Attribute> {
    let text = ty.to_token_stream().to_string();
    if !text.contains(&lifetime.to_string()) {
        return None;
    }
    if matches!(ty, Type::Reference(_)) {
        Some(syn::parse_quote!(
            #[cfg_attr(feature = "serde", serde(borrow, with = "crate::serde_support::borrowed_bytes"))]
        ))
    } else {
        Some(syn::parse_quote!(#[cfg_attr(feature = "serde", serde(borrow))]))
    }
}

fn option_of(ty: &Type) -> Option<Type> {
    argument_of(ty, "Option").cloned()
}
