//! The macros in which numbers with a meaning are declared: quantities, enumerations, flag sets, numbers of several
//! parts.

mod bits;
mod number;

#[cfg(feature = "reflect")]
pub(crate) use bits::BitLabels;
pub(crate) use bits::{BitField, first_doc, flags, spec_name};
pub(crate) use number::number_type;
