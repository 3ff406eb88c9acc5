//! The description of a message as constant data.

use core::ops::RangeInclusive;

use crate::reflect::{Describe, Shape};
use crate::units::FirmwareVersion;
use crate::{CommandId, Direction, Message};

/// One declared message.
#[derive(Clone, Debug)]
pub struct MessageInfo {
    /// The name of its type in [`commands`](crate::commands).
    pub type_name: &'static str,
    /// Command id.
    pub id: CommandId,
    /// Direction, seen from the host.
    pub direction: Direction,
    /// Spec name of the command.
    pub spec: &'static str,
    /// Name of the form; `full` if it is the only one.
    pub form: &'static str,
    /// Whether it is the form to build unless another is asked for; there is one for each command and direction.
    pub is_default: bool,
    /// The first firmware that knows it; `None` if that is unknown or the first of all.
    pub since: Option<FirmwareVersion>,
    /// Summary in one sentence.
    pub summary: &'static str,
    /// Payload length in bytes.
    pub size: RangeInclusive<usize>,
    /// Whether a payload of so many bytes has this form.
    pub accepts: fn(usize) -> bool,
    /// Its fields.
    pub shape: Shape,
}

impl MessageInfo {
    /// The description of `M`, the type called `type_name`.
    pub(crate) const fn of<M: Message + Describe>(type_name: &'static str) -> Self {
        MessageInfo {
            type_name,
            id: M::ID,
            direction: M::DIRECTION,
            spec: M::SPEC,
            form: M::FORM,
            is_default: M::IS_DEFAULT,
            since: M::SINCE,
            summary: M::SUMMARY,
            size: M::SIZE,
            accepts: M::accepts,
            shape: M::SHAPE,
        }
    }
}
