//! The declared struct as all other modules see it.

use proc_macro2::{Group, Ident, TokenStream, TokenTree};
use quote::{format_ident, quote};
use syn::{Lifetime, Type};

use crate::attributes::{Arguments, FieldArguments};

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

/// Whether the type's last name is `name`.
pub(crate) fn is_named(ty: &Type, name: &str) -> bool {
    matches!(ty, Type::Path(path) if path.path.segments.last().is_some_and(|segment| segment.ident == name))
}

/// The `T` of `List<T, N>` and `Packed<T, N>`.
pub(crate) fn element_of(ty: &Type) -> Option<&Type> {
    argument_of(ty, "List").or_else(|| argument_of(ty, "Packed"))
}

/// The first argument of a generic type of this name.
pub(crate) fn argument_of<'t>(ty: &'t Type, name: &str) -> Option<&'t Type> {
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
