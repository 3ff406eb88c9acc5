//! Description of a message as constant data.

use core::ops::RangeInclusive;

use crate::reflect::{Describe, Shape};
use crate::units::FirmwareVersion;
use crate::{CommandId, Direction, Message};

/// Description of a message.
#[derive(Clone, Debug)]
pub struct MessageInfo {
    /// Name of its type in [`commands`](crate::commands).
    pub type_name: &'static str,
    /// Command id.
    pub id: CommandId,
    /// Direction, seen from the host.
    pub direction: Direction,
    /// Spec name of the command.
    pub spec: &'static str,
    /// Name of the form; `full` if it is the only one.
    pub form: &'static str,
    /// Whether it is the default form; there is exactly one for each command and direction.
    pub is_default: bool,
    /// First firmware that supports the message; `None` if that is unknown or the first of all.
    pub since: Option<FirmwareVersion>,
    /// Summary in one sentence.
    pub summary: &'static str,
    /// Payload length in bytes.
    pub size: RangeInclusive<usize>,
    /// Whether a payload of this length has this form.
    pub accepts: fn(usize) -> bool,
    /// Structure of the payload.
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
