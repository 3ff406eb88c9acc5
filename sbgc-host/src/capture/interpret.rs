//! What frames mean, with what was said before in mind.

use std::collections::VecDeque;
use std::sync::LazyLock;

use sbgc_proto::commands::{
    CanDrvTelemetry, CanDrvTelemetryFlags, DebugVarKind, DebugVars3, DebugVars3ExtendedRequest,
    DebugVars3Masked, RealtimeDataCustom, RealtimeDataCustom2, RealtimeDataCustom2Flags,
    RealtimeDataCustomFlags, StreamSource,
};
use sbgc_proto::reflect::{self, Visitor};
use sbgc_proto::wire::FromWire;
use sbgc_proto::{CommandId, DecodeError, Direction, IncomingCommand, Message, MessageInfo, OutgoingCommand};

/// A message with all that is known of it.
#[derive(Clone, Debug)]
#[allow(clippy::large_enum_variant, reason = "one is alive at a time")]
pub enum Meaning<'a> {
    /// From the host.
    Outgoing(OutgoingCommand<'a>),
    /// From the board.
    Incoming(IncomingCommand<'a>),
    /// Real-time data of which a request told what it is.
    RealtimeDataCustom(RealtimeDataCustom),
    /// The second kind of real-time data of which a request told what it is.
    RealtimeDataCustom2(RealtimeDataCustom2),
    /// Telemetry of which the registration of the stream told what it is.
    CanDrvTelemetry(CanDrvTelemetry),
    /// Values of debug variables whose kinds are known from their description.
    DebugVars3(DebugVars3<'a>, Vec<DebugVarKind>),
    /// Values of the debug variables that a request chose, of these kinds.
    DebugVars3Masked(DebugVars3Masked<'a>, Vec<DebugVarKind>),
}

/// A message that was read, and the bytes that newer firmware has added to it.
#[derive(Clone, Debug)]
pub struct Interpreted<'a> {
    /// The message.
    pub meaning: Meaning<'a>,
    /// What follows the part that is known.
    pub rest: &'a [u8],
}

impl Interpreted<'_> {
    /// Which way it went.
    pub fn direction(&self) -> Direction {
        match self.meaning {
            Meaning::Outgoing(_) => Direction::Outgoing,
            _ => Direction::Incoming,
        }
    }

    /// The spec's name of the command, `None` for one that the protocol does not have.
    pub fn name(&self) -> Option<&'static str> {
        match &self.meaning {
            Meaning::Outgoing(message) => message.spec_name(),
            Meaning::Incoming(message) => message.spec_name(),
            Meaning::RealtimeDataCustom(_) => Some(RealtimeDataCustom::SPEC),
            Meaning::RealtimeDataCustom2(_) => Some(RealtimeDataCustom2::SPEC),
            Meaning::CanDrvTelemetry(_) => Some(CanDrvTelemetry::SPEC),
            Meaning::DebugVars3(..) | Meaning::DebugVars3Masked(..) => Some(DebugVars3::SPEC),
        }
    }

    /// The name of the form.
    pub fn form(&self) -> &'static str {
        match &self.meaning {
            Meaning::Outgoing(message) => message.form(),
            Meaning::Incoming(message) => message.form(),
            Meaning::RealtimeDataCustom(_) => RealtimeDataCustom::FORM,
            Meaning::RealtimeDataCustom2(_) => RealtimeDataCustom2::FORM,
            Meaning::CanDrvTelemetry(_) => CanDrvTelemetry::FORM,
            Meaning::DebugVars3(..) => DebugVars3::FORM,
            Meaning::DebugVars3Masked(..) => DebugVars3Masked::FORM,
        }
    }

    /// Visits the fields of the known part in wire order.
    pub fn walk(&self, visitor: &mut dyn Visitor) {
        match &self.meaning {
            Meaning::Outgoing(message) => drop(message.walk(visitor)),
            Meaning::Incoming(message) => drop(message.walk(visitor)),
            Meaning::RealtimeDataCustom(message) => drop(reflect::walk(message, visitor)),
            Meaning::RealtimeDataCustom2(message) => drop(reflect::walk(message, visitor)),
            Meaning::CanDrvTelemetry(message) => drop(reflect::walk(message, visitor)),
            // That the kinds fit was seen when it was read.
            Meaning::DebugVars3(message, kinds) => drop(message.walk_values(kinds.iter().copied(), visitor)),
            Meaning::DebugVars3Masked(message, kinds) => {
                // That the kinds fit was seen when it was read.
                let _ = message.walk_values(kinds.iter().copied(), visitor);
            }
        }
    }
}

/// Gives frames their meaning, and remembers the requests that later answers need.
#[derive(Clone, Debug, Default)]
pub struct Interpreter {
    fallback: Option<RealtimeDataCustomFlags>,
    custom: Requests<RealtimeDataCustomFlags>,
    custom2: Requests<RealtimeDataCustom2Flags>,
    telemetry: Requests<CanDrvTelemetryFlags>,
    variables: Vec<DebugVarKind>,
    /// The choice of debug variables that was asked for last; `None` for all of them.
    chosen: Option<DebugVars3ExtendedRequest>,
    /// The variable with which the description that was asked for last begins.
    described_from: usize,
}

impl Interpreter {
    /// Takes `custom_flags` for real-time data of which no request was seen.
    pub fn new(custom_flags: Option<u32>) -> Self {
        let fallback = custom_flags.map(RealtimeDataCustomFlags::from_bits_retain);
        Interpreter { fallback, ..Self::default() }
    }

    /// The direction that [`interpret`](Self::interpret) takes where none is known: the one that id and length fit.
    pub fn likely_direction(id: u8, length: usize) -> Direction {
        likely_direction(CommandId::from_raw(id), length)
    }

    /// Reads a payload. Without a direction, the one that its id and length fit is taken; where both fit, outgoing.
    ///
    /// # Errors
    /// When the payload is not one of the command's.
    pub fn interpret<'a>(
        &mut self,
        direction: Option<Direction>,
        id: u8,
        payload: &'a [u8],
    ) -> Result<Interpreted<'a>, DecodeError> {
        let id = CommandId::from_raw(id);
        match direction.unwrap_or_else(|| likely_direction(id, payload.len())) {
            Direction::Outgoing => {
                let (message, rest) = OutgoingCommand::decode(id, payload)?;
                self.remember(&message);
                Ok(Interpreted { meaning: Meaning::Outgoing(message), rest })
            }
            Direction::Incoming => {
                let (message, rest) = IncomingCommand::decode(id, payload)?;
                if let IncomingCommand::DebugVarsInfo3(info) = &message {
                    self.variables.truncate(self.described_from);
                    self.variables.extend(info.vars.iter().map(|variable| variable.var_type));
                }
                match self.explain(&message, payload)? {
                    Some((meaning, rest)) => Ok(Interpreted { meaning, rest }),
                    None => Ok(Interpreted { meaning: Meaning::Incoming(message), rest }),
                }
            }
        }
    }

    fn remember(&mut self, message: &OutgoingCommand<'_>) {
        match message {
            OutgoingCommand::RealtimeDataCustomRequest(request) => self.custom.add(request.flags),
            OutgoingCommand::RealtimeDataCustom2Request(request) => self.custom2.add(request.flags),
            OutgoingCommand::DebugVars3Request(_) => self.chosen = None,
            OutgoingCommand::DebugVars3ExtendedRequest(request) => self.chosen = Some(request.clone()),
            OutgoingCommand::DebugVarsInfo3Request(_) => self.described_from = 0,
            OutgoingCommand::DebugVarsInfo3ExtendedRequest(request) => {
                self.described_from = request.start_idx.into();
            }
            OutgoingCommand::DataStreamInterval(stream) => match stream.source() {
                Some(StreamSource::RealtimeDataCustom(flags)) => self.custom.add(flags),
                Some(StreamSource::RealtimeDataCustom2(flags)) => self.custom2.add(flags),
                Some(StreamSource::CanDrvTelemetry { flags, .. }) => self.telemetry.add(flags),
                _ => {}
            },
            _ => {}
        }
    }

    /// The values of the variables that were chosen, where `message` begins with the choice.
    fn chosen_variables<'a>(&self, message: &DebugVars3<'a>) -> Option<Meaning<'a>> {
        let request = self.chosen.as_ref()?;
        let masked = message.masked(request.selected_mask.len()).ok()?;
        if masked.selected_mask != request.selected_mask {
            return None;
        }
        let kinds = request.variables().map(|variable| self.variables.get(variable).copied());
        let kinds: Vec<_> = kinds.collect::<Option<_>>()?;
        let is_whole = is_whole(&DebugVars3 { var_value: masked.var_value }, &kinds);
        is_whole.then_some(Meaning::DebugVars3Masked(masked, kinds))
    }

    /// The message as its request tells to read it, where one was seen.
    fn explain<'a>(
        &self,
        message: &IncomingCommand<'a>,
        payload: &'a [u8],
    ) -> Result<Option<(Meaning<'a>, &'a [u8])>, DecodeError> {
        Ok(match message {
            IncomingCommand::RealtimeDataCustomView(_) => match self.custom.decode(payload) {
                Some((data, rest)) => Some((Meaning::RealtimeDataCustom(data), rest)),
                None => match self.fallback.or(self.custom.newest()) {
                    Some(flags) => {
                        let (data, rest) = RealtimeDataCustom::decode_with(payload, flags)?;
                        Some((Meaning::RealtimeDataCustom(data), rest))
                    }
                    None => None,
                },
            },
            IncomingCommand::RealtimeDataCustom2View(_) => {
                self.custom2.decode(payload).map(|(data, rest)| (Meaning::RealtimeDataCustom2(data), rest))
            }
            IncomingCommand::CanDrvTelemetryView(_) => {
                self.telemetry.decode(payload).map(|(data, rest)| (Meaning::CanDrvTelemetry(data), rest))
            }
            IncomingCommand::DebugVars3(values) if !self.variables.is_empty() => {
                let masked = self.chosen_variables(values);
                let meaning = masked.or_else(|| {
                    let kinds = self.variables.clone();
                    is_whole(values, &kinds).then_some(Meaning::DebugVars3(*values, kinds))
                });
                meaning.map(|meaning| (meaning, &[][..]))
            }
            _ => None,
        })
    }
}

/// Whether the values of variables of these kinds fill the message.
fn is_whole(values: &DebugVars3<'_>, kinds: &[DebugVarKind]) -> bool {
    let mut read = values.values(kinds.iter().copied());
    read.by_ref().all(|value| value.is_ok()) && read.rest().is_empty()
}

/// What was asked for, newest first.
#[derive(Clone, Debug)]
struct Requests<F>(VecDeque<F>);

/// More different requests than a board has data streams are not alive at once.
const MEMORY: usize = 16;

impl<F: Copy + PartialEq> Requests<F> {
    fn add(&mut self, flags: F) {
        self.0.retain(|known| *known != flags);
        self.0.push_front(flags);
        self.0.truncate(MEMORY);
    }

    fn newest(&self) -> Option<F> {
        self.0.front().copied()
    }

    /// The payload as the newest request wants it whose answer is as long.
    fn decode<'a, M: Message + FromWire<'a, F>>(&self, payload: &'a [u8]) -> Option<(M, &'a [u8])> {
        let readings = self.0.iter().filter_map(|flags| M::decode_with(payload, *flags).ok());
        readings.into_iter().find(|(_, rest)| rest.is_empty())
    }
}

impl<F> Default for Requests<F> {
    fn default() -> Self {
        Requests(VecDeque::new())
    }
}

/// The direction whose narrowest form the length fits.
pub(super) fn likely_direction(id: CommandId, length: usize) -> Direction {
    let narrowest = |forms: &[&'static MessageInfo]| {
        // A form that the length does not fit is better than none.
        forms
            .iter()
            .map(|info| {
                let fits = info.size.contains(&length) && (info.accepts)(length);
                if fits { info.size.end() - info.size.start() } else { 1000 }
            })
            .min()
            .unwrap_or(usize::MAX)
    };
    let Some(forms) = FORMS.get(usize::from(id.raw())) else { return Direction::Outgoing };
    if narrowest(&forms.incoming) < narrowest(&forms.outgoing) {
        Direction::Incoming
    } else {
        Direction::Outgoing
    }
}

/// The forms of one command.
#[derive(Default)]
struct Forms {
    incoming: Vec<&'static MessageInfo>,
    outgoing: Vec<&'static MessageInfo>,
}

/// The forms of all commands by id, so that none has to be searched for.
static FORMS: LazyLock<Vec<Forms>> = LazyLock::new(|| {
    let of = |all: &'static [MessageInfo], id: u8| all.iter().filter(|info| info.id.raw() == id).collect();
    let forms = |id| Forms { incoming: of(IncomingCommand::ALL, id), outgoing: of(OutgoingCommand::ALL, id) };
    (0..=u8::MAX).map(forms).collect()
});
