//! `#[message]` and `#[record]`: the declared struct as the other modules see it, and what is written for it.

use proc_macro2::{Group, Ident, TokenStream, TokenTree};
use quote::{ToTokens, format_ident, quote};
use syn::{Error, ItemStruct, Lifetime, Result, Type, parse2};

use crate::attributes::{Arguments, FieldArguments, capitals};
use crate::{codec, documentation, reflection};

/// One declared field.
pub(crate) struct Field {
    pub(crate) name: Ident,
    pub(crate) ty: Type,
    pub(crate) spec: String,
    pub(crate) doc: String,
    pub(crate) arguments: FieldArguments,
    /// The `T` of `Option<T>`, or the type itself.
    pub(crate) inner: Type,
    pub(crate) is_option: bool,
    pub(crate) reserved: bool,
}

/// One declared struct.
pub(crate) struct Structure {
    pub(crate) name: Ident,
    pub(crate) lifetime: Option<Lifetime>,
    pub(crate) arguments: Arguments,
    pub(crate) fields: Vec<Field>,
    pub(crate) doc: String,
    /// Whether it is a tuple of one: the same bytes and fields under another command.
    pub(crate) transparent: bool,
}

impl Structure {
    /// `Name` or `Name<'a>`.
    pub(crate) fn ty(&self) -> TokenStream {
        let name = &self.name;
        match &self.lifetime {
            Some(lifetime) => quote!(#name<#lifetime>),
            None => quote!(#name),
        }
    }

    /// The struct's own lifetime as generics of an impl: empty where it has none.
    pub(crate) fn generics(&self) -> TokenStream {
        self.lifetime.as_ref().map_or_else(TokenStream::new, |lifetime| quote!(<#lifetime>))
    }

    /// The pattern that takes the struct apart into its fields' names.
    pub(crate) fn pattern(&self) -> TokenStream {
        let names = self.fields.iter().map(|field| &field.name);
        if self.transparent { quote!(Self(#(#names),*)) } else { quote!(Self { #(#names),* }) }
    }

    /// The expression that puts it together of what was read.
    pub(crate) fn construction(&self) -> TokenStream {
        let names = self.fields.iter().map(|field| &field.name);
        let values = self.fields.iter().map(held);
        if self.transparent { quote!(Self(#(#values),*)) } else { quote!(Self { #(#names: #values),* }) }
    }

    /// The type of what must be known besides the payload.
    pub(crate) fn context_type(&self) -> TokenStream {
        match &self.arguments.context {
            Some(context) => {
                let ty = &context.ty;
                quote!(#ty)
            }
            None => quote!(()),
        }
    }
}

pub(crate) fn expand_message(arguments: TokenStream, item: TokenStream) -> Result<TokenStream> {
    let arguments = Arguments::parse_message(arguments)?;
    let (item, structure) = read(arguments, item)?;
    let codec = codec::of_structure(&structure);
    let message = codec::of_message(&structure);
    let reflection = reflection::of_structure(&structure);
    Ok(quote!(#item #codec #message #reflection))
}

pub(crate) fn expand_record(arguments: TokenStream, item: TokenStream) -> Result<TokenStream> {
    let arguments = Arguments::parse_record(arguments)?;
    let (item, structure) = read(arguments, item)?;
    let codec = codec::of_structure(&structure);
    let reflection = reflection::of_structure(&structure);
    Ok(quote!(#item #codec #reflection))
}

fn read(arguments: Arguments, item: TokenStream) -> Result<(ItemStruct, Structure)> {
    let mut item: ItemStruct = parse2(item)?;
    if item.generics.type_params().next().is_some() {
        return Err(Error::new_spanned(&item.generics, "a message has no type parameters"));
    }
    let lifetime = item.generics.lifetimes().next().map(|parameter| parameter.lifetime.clone());
    let doc = documentation::summary(&item.attrs);
    let mut fields = Vec::new();
    let mut tail: Option<Ident> = None;
    let transparent = matches!(item.fields, syn::Fields::Unnamed(_));
    if transparent && item.fields.len() != 1 {
        return Err(Error::new_spanned(&item.fields, "several fields need names"));
    }
    for field in &mut item.fields {
        let name = field.ident.clone().unwrap_or_else(|| format_ident!("inner"));
        let doc = documentation::summary(&field.attrs);
        let field_arguments = FieldArguments::take(&mut field.attrs)?;
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
            field.attrs.push(syn::parse_quote!(#[doc = "Kept as it came; zero in a new message."]));
        }
        if !transparent {
            field.attrs.extend(documentation::of_field(&declared));
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

/// Whether the type's last name is `name`.
pub(crate) fn is_named(ty: &Type, name: &str) -> bool {
    matches!(ty, Type::Path(path) if path.path.segments.last().is_some_and(|segment| segment.ident == name))
}

fn option_of(ty: &Type) -> Option<Type> {
    argument_of(ty, "Option").cloned()
}

/// The `T` of `List<T, N>`.
pub(crate) fn element_of(ty: &Type) -> Option<&Type> {
    argument_of(ty, "List")
}

/// The first argument of a generic type of this name.
fn argument_of<'t>(ty: &'t Type, name: &str) -> Option<&'t Type> {
    let Type::Path(path) = ty else { return None };
    let segment = path.path.segments.last().filter(|segment| segment.ident == name)?;
    let syn::PathArguments::AngleBracketed(arguments) = &segment.arguments else { return None };
    match arguments.args.first()? {
        syn::GenericArgument::Type(inner) => Some(inner),
        _ => None,
    }
}

/// The name under which generated code keeps a field's value, out of reach of the names in user expressions.
pub(crate) fn held(field: &Field) -> Ident {
    format_ident!("held_{}", field.name)
}

/// `tokens` with every lifetime made `'static`, as constants want them.
pub(crate) fn with_static_lifetimes(tokens: TokenStream) -> TokenStream {
    let mut result = TokenStream::new();
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        match token {
            TokenTree::Group(group) => {
                let inner = with_static_lifetimes(group.stream());
                result.extend([TokenTree::Group(Group::new(group.delimiter(), inner))]);
            }
            TokenTree::Punct(punct) if punct.as_char() == '\'' && tokens.next().is_some() => {
                result.extend(quote!('static));
            }
            other => result.extend([other]),
        }
    }
    result
}
