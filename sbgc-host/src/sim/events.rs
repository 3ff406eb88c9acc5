//! What happens on the board that hosts can have reported, each once.

use sbgc_proto::commands::{BoardEvent, EventId, EventTypes};

/// An event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Happened {
    pub(super) id: EventId,
    pub(super) what: EventTypes,
    pub(super) param: u16,
}

impl Happened {
    pub(super) fn new(id: EventId, what: EventTypes, param: u16) -> Self {
        Self { id, what, param }
    }

    pub(super) fn message(self) -> BoardEvent<'static> {
        BoardEvent { event_id: self.id, event_type: self.what, param1: self.param, extra: &[] }
    }

    /// Whether somebody who asked for this event and these types gets it.
    pub(super) fn concerns(self, id: EventId, types: EventTypes) -> bool {
        self.id == id && types.intersects(self.what)
    }
}
