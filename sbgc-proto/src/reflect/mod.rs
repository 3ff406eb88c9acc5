//! Fields by name (feature `reflect`): what a message's fields are, what they hold, and setting them by path.
//!
//! All of it follows from the declaration of the message. [`Describe::SHAPE`] is the description as constant data;
//! [`Describe::walk`] visits the fields of a value in wire order; [`Assign::assign`] sets one from text or numbers,
//! checked against its range.
//!
//! A path names a field from the outside in: `rc_memory.yaw`, `axes.pitch.p`, `params[0].id`. The spec's names are
//! understood too, in capitals or not.
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
mod number;
mod shape;
mod walk;

pub use assign::{Assign, AssignError, Input, Steps, set};
pub use number::{BitPart, Meaning, Number, NumberType, Scalar};
pub use shape::{FieldInfo, MessageInfo, Presence, Shape};
pub use walk::{Describe, Leaf, Path, Place, Raw, Visitor, walk};

pub(crate) use number::reflect_number;
pub(crate) use walk::walk_elements;
