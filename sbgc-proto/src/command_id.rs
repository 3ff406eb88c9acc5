//! The ids of all commands, with the spec's names.

use sbgc_proto_macros::open_enum;

use crate::command_table::with_commands;
use crate::text::equal;

/// Direction of a message, seen from the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum Direction {
    /// Host to controller.
    Outgoing,
    /// Controller to host.
    Incoming,
}

impl Direction {
    /// `outgoing` or `incoming`.
    pub const fn as_str(self) -> &'static str {
        match self {
            Direction::Outgoing => "outgoing",
            Direction::Incoming => "incoming",
        }
    }
}

macro_rules! declare_ids {
    ($(
        $(#[doc = $doc:tt])+
        $variant:ident = $id:tt $(as $spec:tt)?, outgoing $outgoing:tt, incoming $incoming:tt;
    )*) => {
        /// The id of a command. Most mean the same in both directions; 67 does not.
        #[open_enum(u8, prefix = "CMD_")]
        pub enum CommandId {
            $(
                $(#[doc = $doc])+
                $(#[wire(spec = $spec)])?
                $variant = $id,
            )*
        }
    };
}

with_commands!(declare_ids);

impl CommandId {
    /// Incoming: a command was accepted, or what it started is done. Outgoing the same number is `CMD_CONTROL`.
    ///
    /// Spec: `CMD_CONFIRM` = 67.
    pub const CONFIRM: CommandId = CommandId::Control;

    /// Spec name, for example `CMD_BOARD_INFO`; `None` for an unknown id.
    pub fn spec_name(self, direction: Direction) -> Option<&'static str> {
        if self == Self::CONFIRM && direction == Direction::Incoming {
            return Some("CMD_CONFIRM");
        }
        let label = Self::LABELS.iter().find(|label| label.value == i64::from(self.raw()))?;
        Some(label.name)
    }

    /// The id that the spec calls `name`. For constants: a name that the spec does not have does not compile.
    #[expect(clippy::panic, reason = "it ends the compilation, not a program")]
    pub(crate) const fn of_spec_name(name: &str) -> Self {
        if equal(name, "CMD_CONFIRM") {
            return Self::CONFIRM;
        }
        let mut labels = Self::LABELS;
        while let Some((label, rest)) = labels.split_first() {
            if equal(label.name, name) {
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "made from an u8"
                )]
                return Self::from_raw(label.value as u8);
            }
            labels = rest;
        }
        panic!("the spec has no command of this name")
    }
}

impl core::fmt::Display for CommandId {
    /// The spec's name of the outgoing command, or the number.
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.spec_name(Direction::Outgoing) {
            Some(name) => f.write_str(name),
            None => write!(f, "command {}", self.raw()),
        }
    }
}
