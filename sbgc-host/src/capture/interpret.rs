//! What frames mean, with what was said before in mind.

use std::collections::VecDeque;
use std::sync::LazyLock;

use sbgc_proto::commands::{
    CanDrvTelemetry, CanDrvTelemetryFlags, DebugVarKind, DebugVars3, DebugVars3ExtendedRequest,
    DebugVars3Masked, DebugVars3Request, RealtimeDataCustom, RealtimeDataCustom2, RealtimeDataCustom2Request,
    RealtimeDataCustomFlags, RealtimeDataCustomRequest, StreamSource,
};
use sbgc_proto::reflect::{self, Visitor};
use sbgc_proto::{
    CommandId, DecodeError, Direction, Expected, IncomingCommand, Message, MessageInfo, OutgoingCommand,
    Request as _,
};

/// A message of either direction, read with its request where that is needed.
#[derive(Clone, Debug)]
#[allow(clippy::large_enum_variant, reason = "one is alive at a time")]
#[non_exhaustive]
pub enum AnyMessage<'a> {
    /// From the host.
    Outgoing(OutgoingCommand<'a>),
    /// From the board.
    Incoming(IncomingCommand<'a>),
    /// Real-time data, with the fields that a request or a stream selected.
    RealtimeDataCustom(RealtimeDataCustom),
    /// The second kind of real-time data, with the fields that a request or a stream selected.
    RealtimeDataCustom2(RealtimeDataCustom2),
    /// Telemetry of a motor driver, with the fields that its stream selected.
    CanDrvTelemetry(CanDrvTelemetry),
    /// Values of all debug variables, whose kinds are known from their description.
    DebugVars3(DebugVars3<'a>, Vec<DebugVarKind>),
    /// Values of the debug variables that a request selected, of these kinds.
    DebugVars3Masked(DebugVars3Masked<'a>, Vec<DebugVarKind>),
}

/// A message that was read, and the bytes that newer firmware has added to it.
#[derive(Clone, Debug)]
pub struct Interpreted<'a> {
    /// The message.
    pub message: AnyMessage<'a>,
    /// What follows the part that is known.
    pub rest: &'a [u8],
}

impl Interpreted<'_> {
    /// Which way it went.
    pub fn direction(&self) -> Direction {
        match self.message {
            AnyMessage::Outgoing(_) => Direction::Outgoing,
            _ => Direction::Incoming,
        }
    }

    /// The spec's name of the command, `None` for one that the protocol does not have.
    pub fn name(&self) -> Option<&'static str> {
        match &self.message {
            AnyMessage::Outgoing(message) => message.spec_name(),
            AnyMessage::Incoming(message) => message.spec_name(),
            AnyMessage::RealtimeDataCustom(_) => Some(RealtimeDataCustom::SPEC),
            AnyMessage::RealtimeDataCustom2(_) => Some(RealtimeDataCustom2::SPEC),
            AnyMessage::CanDrvTelemetry(_) => Some(CanDrvTelemetry::SPEC),
            AnyMessage::DebugVars3(..) | AnyMessage::DebugVars3Masked(..) => Some(DebugVars3::SPEC),
        }
    }

    /// The name of the form.
    pub fn form(&self) -> &'static str {
        match &self.message {
            AnyMessage::Outgoing(message) => message.form(),
            AnyMessage::Incoming(message) => message.form(),
            AnyMessage::RealtimeDataCustom(_) => RealtimeDataCustom::FORM,
            AnyMessage::RealtimeDataCustom2(_) => RealtimeDataCustom2::FORM,
            AnyMessage::CanDrvTelemetry(_) => CanDrvTelemetry::FORM,
            AnyMessage::DebugVars3(..) => DebugVars3::FORM,
            AnyMessage::DebugVars3Masked(..) => DebugVars3Masked::FORM,
        }
    }

    /// Visits the fields of the known part in wire order.
    pub fn walk(&self, visitor: &mut dyn Visitor) {
        match &self.message {
            AnyMessage::Outgoing(message) => drop(message.walk(visitor)),
            AnyMessage::Incoming(message) => drop(message.walk(visitor)),
            AnyMessage::RealtimeDataCustom(message) => drop(reflect::walk(message, visitor)),
            AnyMessage::RealtimeDataCustom2(message) => drop(reflect::walk(message, visitor)),
            AnyMessage::CanDrvTelemetry(message) => drop(reflect::walk(message, visitor)),
            // That the kinds fit was seen when it was read.
            AnyMessage::DebugVars3(message, kinds) => {
                let _ = message.walk_values(kinds.iter().copied(), visitor);
            }
            AnyMessage::DebugVars3Masked(message, kinds) => {
                let _ = message.walk_values(kinds.iter().copied(), visitor);
            }
        }
    }
}

/// Gives frames their meaning, and remembers the requests that later answers need.
#[derive(Clone, Debug, Default)]
pub struct Interpreter {
    fallback: Option<RealtimeDataCustomRequest>,
    /// Newest first.
    asked: VecDeque<(Expected, Asked)>,
    variables: Vec<DebugVarKind>,
    /// The variable with which the description that was asked for last begins.
    described_from: usize,
}

/// A request, or a stream, whose answers cannot be read without it.
#[derive(Clone, Debug, PartialEq)]
enum Asked {
    RealtimeDataCustom(RealtimeDataCustomRequest),
    RealtimeDataCustom2(RealtimeDataCustom2Request),
    CanDrvTelemetry(CanDrvTelemetryFlags),
    DebugVars3(DebugVars3Request),
    DebugVars3Masked(DebugVars3ExtendedRequest),
}

/// More different requests than a board has data streams are not alive at once.
const MEMORY: usize = 16;

impl Interpreter {
    /// Takes `custom_flags` for real-time data of which no request was seen.
    pub fn new(custom_flags: Option<u32>) -> Self {
        let flags = custom_flags.map(RealtimeDataCustomFlags::from_bits_retain);
        let fallback = flags.map(|flags| RealtimeDataCustomRequest { flags, ..Default::default() });
        Interpreter { fallback, ..Self::default() }
    }

    /// The direction that [`interpret`](Self::interpret) takes where none is known: the one that id and length fit.
    pub fn likely_direction(id: u8, length: usize) -> Direction {
        likely_direction(CommandId::from_raw(id), length)
    }

    /// Reads a payload. Without a direction, the one that its id and length fit is taken; where both fit, outgoing.
    ///
    /// # Errors
    /// If the payload is not one of the command's.
    pub fn interpret<'a>(
        &mut self,
        direction: Option<Direction>,
        id: u8,
        payload: &'a [u8],
    ) -> Result<Interpreted<'a>, DecodeError> {
        let id = CommandId::from_raw(id);
        let (message, rest) = match direction.unwrap_or_else(|| likely_direction(id, payload.len())) {
            Direction::Outgoing => {
                let (message, rest) = OutgoingCommand::decode(id, payload)?;
                self.remember(&message);
                (AnyMessage::Outgoing(message), rest)
            }
            Direction::Incoming => match self.answer(id, payload)? {
                Some(answer) => answer,
                None => {
                    let (message, rest) = IncomingCommand::decode(id, payload)?;
                    if let IncomingCommand::DebugVarsInfo3(info) = &message {
                        self.variables.truncate(self.described_from);
                        self.variables.extend(info.vars.iter().map(|variable| variable.var_type));
                    }
                    (AnyMessage::Incoming(message), rest)
                }
            },
        };
        Ok(Interpreted { message, rest })
    }

    fn remember(&mut self, message: &OutgoingCommand<'_>) {
        let (expected, asked) = match message {
            OutgoingCommand::RealtimeDataCustomRequest(request) => {
                (Expected::of(request), Asked::RealtimeDataCustom(*request))
            }
            OutgoingCommand::RealtimeDataCustom2Request(request) => {
                (Expected::of(request), Asked::RealtimeDataCustom2(*request))
            }
            OutgoingCommand::DebugVars3Request(request) => {
                (Expected::of(request), Asked::DebugVars3(*request))
            }
            OutgoingCommand::DebugVars3ExtendedRequest(request) => {
                (Expected::of(request), Asked::DebugVars3Masked(request.clone()))
            }
            OutgoingCommand::DebugVarsInfo3Request(_) => {
                self.described_from = 0;
                return;
            }
            OutgoingCommand::DebugVarsInfo3ExtendedRequest(request) => {
                self.described_from = request.start_idx.into();
                return;
            }
            OutgoingCommand::DataStreamInterval(stream) => {
                let Some(source) = stream.source() else { return };
                let asked = match source {
                    StreamSource::RealtimeDataCustom(flags) => {
                        Asked::RealtimeDataCustom(RealtimeDataCustomRequest { flags, ..Default::default() })
                    }
                    StreamSource::RealtimeDataCustom2(flags) => {
                        Asked::RealtimeDataCustom2(RealtimeDataCustom2Request { flags, ..Default::default() })
                    }
                    StreamSource::CanDrvTelemetry { flags, .. } => Asked::CanDrvTelemetry(flags),
                    _ => return,
                };
                (Expected::of_stream(source), asked)
            }
            _ => return,
        };
        self.asked.retain(|(_, known)| *known != asked);
        self.asked.push_front((expected, asked));
        self.asked.truncate(MEMORY);
    }

    /// The payload as the request tells to read it, where one was seen: the newest whose answer has this length, else
    /// the newest whose answer it may be.
    fn answer<'a>(
        &self,
        id: CommandId,
        payload: &'a [u8],
    ) -> Result<Option<(AnyMessage<'a>, &'a [u8])>, DecodeError> {
        if let Some((_, asked)) = self.asked.iter().find(|(expected, _)| expected.fits(id, payload)) {
            return self.read(asked, payload);
        }
        if let Some(request) = self.fallback.filter(|_| id == CommandId::RealtimeDataCustom) {
            return self.read(&Asked::RealtimeDataCustom(request), payload);
        }
        match self.asked.iter().find(|(expected, _)| expected.matches(id, payload)) {
            Some((_, asked)) => self.read(asked, payload),
            None if id == CommandId::DebugVars3 => self.read(&Asked::DebugVars3(DebugVars3Request), payload),
            None => Ok(None),
        }
    }

    /// The answer to this request; `None` if the kinds of debug variables are not known.
    fn read<'a>(
        &self,
        asked: &Asked,
        payload: &'a [u8],
    ) -> Result<Option<(AnyMessage<'a>, &'a [u8])>, DecodeError> {
        let (message, rest) = match asked {
            Asked::RealtimeDataCustom(request) => {
                let (data, rest) = request.decode_answer_prefix(payload)?;
                (AnyMessage::RealtimeDataCustom(data), rest)
            }
            Asked::RealtimeDataCustom2(request) => {
                let (data, rest) = request.decode_answer_prefix(payload)?;
                (AnyMessage::RealtimeDataCustom2(data), rest)
            }
            Asked::CanDrvTelemetry(flags) => {
                let (data, rest) = CanDrvTelemetry::decode_with(payload, *flags)?;
                (AnyMessage::CanDrvTelemetry(data), rest)
            }
            Asked::DebugVars3(request) => {
                let (values, rest) = request.decode_answer_prefix(payload)?;
                let kinds = self.variables.clone();
                if kinds.is_empty() || !is_whole(&values, &kinds) {
                    return Ok(None);
                }
                (AnyMessage::DebugVars3(values, kinds), rest)
            }
            Asked::DebugVars3Masked(request) => {
                let (answer, rest) = request.decode_answer_prefix(payload)?;
                let kinds = request.variables().map(|variable| self.variables.get(variable).copied());
                match kinds.collect::<Option<Vec<_>>>() {
                    Some(kinds) if is_whole(&DebugVars3 { var_value: answer.var_value }, &kinds) => {
                        (AnyMessage::DebugVars3Masked(answer, kinds), rest)
                    }
                    _ => return Ok(None),
                }
            }
        };
        Ok(Some((message, rest)))
    }
}

/// Whether the values of variables of these kinds fill the message.
fn is_whole(values: &DebugVars3<'_>, kinds: &[DebugVarKind]) -> bool {
    let mut read = values.values(kinds.iter().copied());
    read.by_ref().all(|value| value.is_ok()) && read.rest().is_empty()
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
