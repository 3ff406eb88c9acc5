//! Fields by name: their description, their values, and setting them.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use crate::attributes::Count;
use crate::structure::{Field, Structure, with_static_lifetimes};

/// `Describe` and `Assign`, for builds with the feature `reflect`.
pub(crate) fn of_structure(structure: &Structure) -> TokenStream {
    if structure.transparent {
        return of_transparent(structure);
    }
    let (ty, generics) = (structure.ty(), structure.generics());
    let (assign_generics, lifetime) = match &structure.lifetime {
        Some(lifetime) => (structure.generics(), quote!(#lifetime)),
        None => (quote!(<'wire>), quote!('wire)),
    };
    let mut infos = Vec::new();
    let mut walks = Vec::new();
    let mut arms = Vec::new();
    for field in &structure.fields {
        let name = &field.name;
        let text = name.to_string();
        if let Some(Count::Prefix(count)) = &field.arguments.count {
            let index = infos.len();
            let count_name = count.to_lowercase();
            infos.push(count_info(&count_name, count));
            walks.push(local!(size += place.field(FIELDS, #index, size).walk(&#name.count(), visitor);));
            arms.push(local!(#count_name => #name.assign_count(path, value)));
        }
        let index = infos.len();
        infos.push(info(field));
        walks.push(local!(size += place.field(FIELDS, #index, size).walk(#name, visitor);));
        arms.push(local!(#text => crate::reflect::Assign::assign(#name, path, value, &FIELDS[#index])));
    }
    let pattern = structure.pattern();
    local! {
        #[cfg(feature = "reflect")]
        const _: () = {
            const FIELDS: &[crate::reflect::FieldInfo] = &[#(#infos),*];

            impl #generics crate::reflect::Describe for #ty {
                const SHAPE: crate::reflect::Shape = crate::reflect::Shape::Struct(FIELDS);

                #[allow(unused_mut, unused_variables, reason = "some messages have no fields")]
                fn walk(
                    &self,
                    place: &crate::reflect::Place<'_>,
                    visitor: &mut dyn crate::reflect::Visitor,
                ) -> usize {
                    let #pattern = self;
                    let mut size = 0;
                    #(#walks)*
                    size
                }
            }

            impl #assign_generics crate::reflect::Assign<#lifetime> for #ty {
                #[allow(unused_variables, reason = "some messages have no fields")]
                fn assign(
                    &mut self,
                    mut path: crate::reflect::Steps<'_>,
                    value: crate::reflect::Input<#lifetime>,
                    _field: &'static crate::reflect::FieldInfo,
                ) -> ::core::result::Result<(), crate::reflect::AssignError> {
                    let #pattern = self;
                    match path.next_name(FIELDS)? {
                        #(#arms,)*
                        _ => ::core::result::Result::Err(crate::reflect::AssignError::NoParts),
                    }
                }
            }
        };
    }
}

fn count_info(name: &str, spec: &str) -> TokenStream {
    quote! {
        crate::reflect::FieldInfo {
            doc: "Number of elements that follow.",
            ..crate::reflect::FieldInfo::new(#name, #spec, <u8 as crate::reflect::Describe>::SHAPE)
        }
    }
}

fn info(field: &Field) -> TokenStream {
    let (name, spec, doc) = (field.name.to_string(), &field.spec, &field.doc);
    let inner = with_static_lifetimes(field.inner.to_token_stream());
    let arguments = &field.arguments;
    let unit = arguments.unit.as_ref().map(|unit| quote!(unit: #unit,));
    let since = arguments.since.as_ref().map(|since| quote!(since: ::core::option::Option::Some(#since),));
    let range = arguments
        .range
        .as_ref()
        .map(|(from, to)| quote!(range: ::core::option::Option::Some((#from as f64, #to as f64)),));
    let presence = if let Some(when) = &arguments.when {
        let condition = quote!(#when).to_string();
        Some(quote!(presence: crate::reflect::Presence::When(#condition),))
    } else {
        field.is_option.then(|| quote!(presence: crate::reflect::Presence::Tail,))
    };
    let reserved = field.reserved.then(|| quote!(reserved: true,));
    quote! {
        crate::reflect::FieldInfo {
            doc: #doc,
            #unit #since #range #presence #reserved
            ..crate::reflect::FieldInfo::new(#name, #spec, <#inner as crate::reflect::Describe>::SHAPE)
        }
    }
}

/// The fields are those of the struct inside.
fn of_transparent(structure: &Structure) -> TokenStream {
    let (ty, generics) = (structure.ty(), structure.generics());
    let (assign_generics, lifetime) = match &structure.lifetime {
        Some(lifetime) => (structure.generics(), quote!(#lifetime)),
        None => (quote!(<'wire>), quote!('wire)),
    };
    let inner = structure.fields.iter().map(|field| &field.ty);
    local! {
        #[cfg(feature = "reflect")]
        const _: () = {
            impl #generics crate::reflect::Describe for #ty {
                const SHAPE: crate::reflect::Shape = #(<#inner as crate::reflect::Describe>::SHAPE)*;

                fn walk(
                    &self,
                    place: &crate::reflect::Place<'_>,
                    visitor: &mut dyn crate::reflect::Visitor,
                ) -> usize {
                    self.0.walk(place, visitor)
                }
            }

            impl #assign_generics crate::reflect::Assign<#lifetime> for #ty {
                fn assign(
                    &mut self,
                    path: crate::reflect::Steps<'_>,
                    value: crate::reflect::Input<#lifetime>,
                    field: &'static crate::reflect::FieldInfo,
                ) -> ::core::result::Result<(), crate::reflect::AssignError> {
                    self.0.assign(path, value, field)
                }
            }
        };
    }
}
