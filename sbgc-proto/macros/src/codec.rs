//! Reading, writing and measuring what was declared.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use crate::attributes::Count;
use crate::structure::{Field, Structure, element_of, held, is_named, with_static_lifetimes};

/// `Layout`, `FromWire` and `ToWire`.
pub(crate) fn of_structure(structure: &Structure) -> TokenStream {
    let layout = layout(structure);
    let read = read(structure);
    let write = write(structure);
    quote!(#layout #read #write)
}

fn layout(structure: &Structure) -> TokenStream {
    let (ty, generics) = (structure.ty(), structure.generics());
    let lengths = structure.fields.iter().map(|field| {
        let inner = &field.inner;
        let prefix = usize::from(matches!(field.arguments.count, Some(Count::Prefix(_))));
        let minimum = if field.is_option {
            quote!(0)
        } else {
            quote!(#prefix + <#inner as crate::wire::Layout>::MIN_LEN)
        };
        (minimum, quote!(#prefix + <#inner as crate::wire::Layout>::MAX_LEN))
    });
    let (minima, maxima): (Vec<_>, Vec<_>) = lengths.unzip();
    let slots = if structure.transparent {
        let inner = structure.fields.iter().map(|field| &field.ty);
        quote!(#(<#inner as crate::wire::Layout>::SLOTS)*)
    } else {
        let slots = structure.fields.iter().enumerate().map(|(index, field)| {
            let (before_min, before_max) = (minima.iter().take(index), maxima.iter().take(index));
            slot(field, &quote!(0 #(+ #before_min)*), &quote!(0 #(+ #before_max)*))
        });
        quote!(&[#(#slots),*])
    };
    quote! {
        impl #generics crate::wire::Layout for #ty {
            const MIN_LEN: usize = 0 #(+ #minima)*;
            const MAX_LEN: usize = 0 #(+ #maxima)*;
            const SLOTS: &'static [crate::wire::Slot] = #slots;
        }
    }
}

/// The place of a field that stands after so many bytes.
fn slot(field: &Field, least: &TokenStream, most: &TokenStream) -> TokenStream {
    let name = field.name.to_string();
    let counted = matches!(field.arguments.count, Some(Count::Prefix(_)));
    let element = element_of(&field.inner);
    let elements = match element {
        Some(element) => quote!(::core::option::Option::Some(<#element as crate::wire::Layout>::SLOTS)),
        None => quote!(::core::option::Option::None),
    };
    // A list without a count reaches to the end.
    let size = if counted || element.is_none() {
        let measured = element.unwrap_or(&field.inner);
        let measure = quote!(<#measured as crate::wire::Layout>);
        quote!(crate::wire::fixed(#measure::MIN_LEN, #measure::MAX_LEN))
    } else {
        quote!(::core::option::Option::None)
    };
    quote! {
        crate::wire::Slot {
            name: #name,
            at: crate::wire::fixed(#least, #most),
            size: #size,
            counted: #counted,
            elements: #elements,
        }
    }
}

fn read(structure: &Structure) -> TokenStream {
    let (ty, context_type) = (structure.ty(), structure.context_type());
    let (generics, lifetime) = match &structure.lifetime {
        Some(lifetime) => (structure.generics(), quote!(#lifetime)),
        None => (quote!(<'wire>), quote!('wire)),
    };
    let context = bind_context(structure);
    let steps = structure.fields.iter().map(|field| {
        let (name, ty, held) = (&field.name, &field.ty, held(field));
        let value = read_field(field);
        local! {
            let (input, #held): (_, #ty) = #value?;
            let #name = &#held;
        }
    });
    let construction = structure.construction();
    let read_fixed = read_fixed(structure, &lifetime, &context_type);
    let whole = read_fixed.is_some().then(|| {
        local! {
            if <Self as crate::wire::Layout>::FIXED {
                return crate::wire::read_whole(input, context);
            }
        }
    });
    local! {
        impl #generics crate::wire::FromWire<#lifetime, #context_type> for #ty {
            #[allow(unused_variables, reason = "only conditions look back at earlier fields")]
            fn read(input: &#lifetime [u8], context: #context_type) -> crate::wire::Read<#lifetime, Self> {
                #whole
                #context
                #(#steps)*
                ::core::result::Result::Ok((input, #construction))
            }

            #read_fixed
        }
    }
}

/// How a struct is read that always has the same length: one check, then fields at fixed offsets.
fn read_fixed(
    structure: &Structure,
    lifetime: &TokenStream,
    context_type: &TokenStream,
) -> Option<TokenStream> {
    if structure.fields.iter().any(varies) {
        return None;
    }
    let context = bind_context(structure);
    let steps = structure.fields.iter().map(|field| {
        let (name, ty, held) = (&field.name, &field.ty, held(field));
        let context = context_of(field);
        local! {
            let #held: #ty = crate::wire::FromWire::read_fixed(input, #context)?;
            let input = input.get(<#ty as crate::wire::Layout>::MIN_LEN..)?;
            let #name = &#held;
        }
    });
    let construction = structure.construction();
    Some(local! {
        #[inline]
        #[allow(unused_variables, reason = "only conditions look back at earlier fields")]
        fn read_fixed(input: &#lifetime [u8], context: #context_type) -> ::core::option::Option<Self> {
            // With its length known, the compiler drops the checks of the fields.
            let input = input.get(..<Self as crate::wire::Layout>::MIN_LEN)?;
            #context
            #(#steps)*
            ::core::option::Option::Some(#construction)
        }
    })
}

fn read_field(field: &Field) -> TokenStream {
    let (spec, inner) = (&field.spec, &field.inner);
    let context = context_of(field);
    if let Some(when) = &field.arguments.when {
        return local!(crate::wire::read_when(#when, #spec, input, #context));
    }
    if field.is_option {
        return local!(crate::wire::read_tail(#spec, input, #context));
    }
    match &field.arguments.count {
        None => local!(crate::wire::read_field(#spec, input, #context)),
        Some(Count::Prefix(_)) => local!(<#inner>::read_counted(#spec, input, #context)),
        Some(Count::Exactly(count)) => {
            local!(<#inner>::read_exactly(#count, #spec, input, #context))
        }
        Some(Count::AtMost(count)) => local!(<#inner>::read_at_most(#count, #spec, input, #context)),
    }
}

fn write(structure: &Structure) -> TokenStream {
    let (ty, generics, context_type) = (structure.ty(), structure.generics(), structure.context_type());
    let context = bind_context(structure);
    let pattern = structure.pattern();
    let has_tail = structure.fields.iter().any(|field| field.is_option && field.arguments.when.is_none());
    let ended = has_tail.then(|| local!(let mut ended = None;));
    let steps = structure.fields.iter().map(write_field);
    let write_fixed = write_fixed(structure, &context_type);
    let whole = write_fixed.is_some().then(|| {
        local! {
            if <Self as crate::wire::Layout>::FIXED {
                return crate::wire::write_whole(self, context, out);
            }
        }
    });
    local! {
        impl #generics crate::wire::ToWire<#context_type> for #ty {
            #[allow(unused_variables, reason = "only conditions look at the context")]
            fn write(
                &self,
                context: #context_type,
                out: &mut crate::wire::Writer<'_>,
            ) -> ::core::result::Result<(), crate::EncodeError> {
                #whole
                #context
                let #pattern = self;
                #ended
                #(#steps)*
                ::core::result::Result::Ok(())
            }

            #write_fixed
        }
    }
}

/// How a struct is written that always has the same length: one check, then fields at fixed offsets.
fn write_fixed(structure: &Structure, context_type: &TokenStream) -> Option<TokenStream> {
    if structure.fields.iter().any(varies) {
        return None;
    }
    let context = bind_context(structure);
    let pattern = structure.pattern();
    let steps = structure.fields.iter().map(|field| {
        let (name, ty) = (&field.name, &field.ty);
        let context = context_of(field);
        local! {
            let (here, place) = place.split_at_mut_checked(<#ty as crate::wire::Layout>::MIN_LEN)?;
            crate::wire::ToWire::write_fixed(#name, #context, here)?;
        }
    });
    Some(local! {
        #[inline]
        #[allow(unused_variables, reason = "only conditions look at the context")]
        fn write_fixed(&self, context: #context_type, place: &mut [u8]) -> ::core::option::Option<()> {
            // With its length known, the compiler drops the checks of the fields.
            let place = place.get_mut(..<Self as crate::wire::Layout>::MIN_LEN)?;
            #context
            let #pattern = self;
            #(#steps)*
            ::core::option::Option::Some(())
        }
    })
}

/// Whether the declaration leaves the length of the field open.
fn varies(field: &Field) -> bool {
    field.is_option || field.arguments.count.is_some()
}

fn write_field(field: &Field) -> TokenStream {
    let (name, spec) = (&field.name, &field.spec);
    let context = context_of(field);
    if let Some(when) = &field.arguments.when {
        return local!(crate::wire::write_when(#when, #spec, #name.as_ref(), #context, out)?;);
    }
    if field.is_option {
        return local!(crate::wire::write_tail(&mut ended, #spec, #name.as_ref(), #context, out)?;);
    }
    match &field.arguments.count {
        None => local!(crate::wire::ToWire::write(#name, #context, out)?;),
        Some(Count::Prefix(_)) => local!(#name.write_counted(#spec, #context, out)?;),
        Some(Count::Exactly(count)) => local!(#name.write_exactly(#count, #spec, #context, out)?;),
        Some(Count::AtMost(count)) => local!(#name.write_at_most(#count, #spec, #context, out)?;),
    }
}

fn bind_context(structure: &Structure) -> Option<TokenStream> {
    let name = &structure.arguments.context.as_ref()?.name;
    Some(local!(let #name = &context;))
}

fn context_of(field: &Field) -> TokenStream {
    field.arguments.context.as_ref().map_or_else(|| quote!(()), |context| quote!(#context))
}

/// `Message`, `Request`, and the check of the declared size.
pub(crate) fn of_message(structure: &Structure) -> TokenStream {
    let (name, ty, generics) = (&structure.name, structure.ty(), structure.generics());
    let arguments = &structure.arguments;
    let (Some(command), Some(size)) = (&arguments.command, &arguments.size) else {
        return TokenStream::new();
    };
    let spec = command.to_string();
    let direction = if arguments.outgoing { quote!(Outgoing) } else { quote!(Incoming) };
    let form = &arguments.form;
    let since = match &arguments.since {
        Some(since) => quote!(::core::option::Option::Some(#since)),
        None => quote!(::core::option::Option::None),
    };
    let (min, max, is_default) = (size.min, size.max, arguments.is_default);
    let accepts = arguments.lengths.as_ref().map(|lengths| {
        quote!(
            fn accepts(length: usize) -> bool {
                ::core::matches!(length, #lengths)
            }
        )
    });
    let request = arguments.answer.as_ref().map(|answer| {
        let given = arguments.given.as_ref().map_or_else(|| quote!(()), |given| quote!(#given));
        let length = arguments.answer_len.as_ref().map(|length| {
            quote! {
                fn answer_len(&self) -> ::core::option::Option<usize> {
                    ::core::option::Option::Some(#length)
                }
            }
        });
        quote! {
            impl #generics crate::message::Request for #ty {
                type Answer<'answer> = #answer;

                fn decode_answer_prefix<'answer>(
                    &self,
                    payload: &'answer [u8],
                ) -> ::core::result::Result<(Self::Answer<'answer>, &'answer [u8]), crate::DecodeError> {
                    <#answer as crate::message::Message>::decode_with(payload, #given)
                }

                #length
            }
        }
    });
    let info = request_info(structure);
    let static_type = if structure.lifetime.is_some() { quote!(#name<'static>) } else { quote!(#name) };
    let complaint = format!("{name}: the fields do not add up to the declared size");
    let fixed = min == max;
    let doc = &structure.doc;
    quote! {
        impl #generics crate::message::Message for #ty {
            const ID: crate::CommandId = crate::CommandId::of_spec_name(#spec);
            const DIRECTION: crate::Direction = crate::Direction::#direction;
            const SPEC: &'static str = #spec;
            const FORM: &'static str = #form;
            const IS_DEFAULT: bool = #is_default;
            const SINCE: ::core::option::Option<crate::units::FirmwareVersion> = #since;
            const SUMMARY: &'static str = #doc;
            const SIZE: ::core::ops::RangeInclusive<usize> = #min..=#max;
            #accepts
            #info
        }
        #request
        const _: () = {
            let (least, most) = (
                <#static_type as crate::wire::Layout>::MIN_LEN,
                <#static_type as crate::wire::Layout>::MAX_LEN,
            );
            ::core::assert!(if #fixed { least == #min && most == #max } else { least <= #min && most >= #max }, #complaint);
        };
    }
}

/// What is declared of the exchange that a request begins.
fn request_info(structure: &Structure) -> Option<TokenStream> {
    let arguments = &structure.arguments;
    if !arguments.outgoing {
        return None;
    }
    let (acts, slow) = (arguments.acts, arguments.slow);
    let Some(answer) = &arguments.answer else {
        // What is not answered is not sent to learn something.
        return Some(quote! {
            const REQUEST: crate::RequestInfo =
                crate::RequestInfo::new(::core::option::Option::None, true, #slow, &[], |_| ::core::option::Option::None);
        });
    };
    let acts = acts || is_named(answer, "Confirm");
    let answer = with_static_lifetimes(answer.to_token_stream());
    let echoes = arguments.echo.iter().map(|echo| {
        let (rule, request, answer_field) = (&echo.rule, echo.request.to_string(), echo.answer.to_string());
        let element = echo.element.iter().map(ToString::to_string);
        quote! {
            crate::echo::Echo::#rule(
                crate::wire::Slot::find(<Self as crate::wire::Layout>::SLOTS, #request),
                crate::wire::Slot::find(<#answer as crate::wire::Layout>::SLOTS, #answer_field),
                #(#element)*
            )
        }
    });
    let measure = match &arguments.answer_len {
        Some(_) => quote!(|payload| {
            let request = <Self as crate::message::Message>::decode(payload).ok()?;
            crate::message::Request::answer_len(&request)
        }),
        None => quote!(|_| ::core::option::Option::None),
    };
    Some(quote! {
        const REQUEST: crate::RequestInfo = crate::RequestInfo::new(
            ::core::option::Option::Some(<#answer as crate::message::Message>::ID),
            #acts,
            #slow,
            &[#(#echoes),*],
            #measure,
        );
    })
}
