//! Reflection (feature `reflect`): list, read and set the fields of messages by name.
//!
//! Everything follows from the declaration of a message. [`Describe::SHAPE`] is its description as constant data.
//! [`Describe::walk`] visits the fields of a value in wire order. [`set`] sets a field from text or a number, checked
//! against the documented range; [`force`] accepts everything that the wire can hold. The displayed value of a field
//! sets it to the same value again.
//!
//! A path names a field from the outside in: `rc_memory.yaw`, `axes.pitch.p`, `params[0].id`. Spec names are accepted,
//! too, in upper or lower case.
//!
//! ```
//! use sbgc_proto::commands::Control;
//! use sbgc_proto::reflect::{self, Input};
//!
//! let mut control = Control::default();
//! reflect::set(&mut control, "axes.pitch.angle", Input::Text("45"))?;
//! assert_eq!(control.axes.pitch.angle.degrees(), 45.0);
//! # Ok::<(), sbgc_proto::reflect::AssignError>(())
//! ```

mod assign;
mod bytes;
mod number;
mod parse;
mod shape;
mod walk;
mod wire_types;

pub use assign::{Assign, AssignError, Input, Steps, force, set};
pub use bytes::{Plain, Quoted, hex_bytes, text_bytes};
pub use number::{BitPart, Meaning, Number, NumberType, Scalar};
pub use shape::{FieldInfo, Presence, Shape};
pub use walk::{Describe, Leaf, Path, Place, Raw, Visitor, walk};

pub(crate) use assign::assign_payload;
use walk::walk_elements;
pub(crate) use walk::walk_payload;
pub(crate) use wire_types::reflect_number;
