//! What the board says to each command, one file a topic.
//!
//! A topic is a method of the [`Machine`] that takes the decoded command and returns what follows from it. Nothing here
//! knows of lines, versions or queues.

mod board;
mod calibration;
mod control;
mod parameters;
mod realtime;
mod streams;
mod variables;

use std::time::Duration;

use sbgc_proto::commands::{
    CalibAcc, CalibGyro, CalibMag, Confirm, ConfirmData, Error, ErrorCode, ErrorData, ExecuteMenuFlags,
    FailureCode, FsErrorCode, SetAdjVarsVal,
};
use sbgc_proto::frame::MAX_PAYLOAD;
use sbgc_proto::wire::ToWire;
use sbgc_proto::{CommandId, Message, OutgoingCommand};

pub(super) use calibration::Calibration;

use super::line::Received;
use super::machine::Machine;

/// A message from the board.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Packet {
    pub(super) id: CommandId,
    pub(super) payload: Vec<u8>,
}

impl Packet {
    pub(super) fn of<M: Message + ToWire>(message: &M) -> Result<Self, Refusal> {
        Self::with(message, ())
    }

    pub(super) fn confirmation(command: CommandId, data: ConfirmData) -> Result<Self, Refusal> {
        Self::of(&Confirm { cmd_id: command, data })
    }

    pub(super) fn with<M: Message + ToWire<C>, C>(message: &M, context: C) -> Result<Self, Refusal> {
        let mut buffer = [0; MAX_PAYLOAD];
        let payload = message.encode_with(context, &mut buffer).map_err(|_| Refusal::Parameters)?;
        Ok(Self { id: M::ID, payload: payload.to_vec() })
    }
}

/// What a command brings about outside the machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Reply {
    Send(Packet),
    /// The board resets after this time.
    Reset {
        after: Duration,
    },
}

/// Why a command is not carried out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refusal {
    Size,
    Parameters,
    Unknown,
    NotSupported,
    State,
    Failed,
}

impl Refusal {
    /// The error message. Commands that deal with files have error codes of their own.
    pub(super) fn replies(self, command: CommandId) -> Replies {
        let code = match (FailureCode::of(command, 0), self) {
            (FailureCode::Files(_), _) => FailureCode::Files(FsErrorCode::WrongParams),
            (_, Self::Size) => FailureCode::General(ErrorCode::CmdSize),
            (_, Self::Parameters) => FailureCode::General(ErrorCode::WrongParams),
            (_, Self::Unknown) => FailureCode::General(ErrorCode::UnknownCommand),
            (_, Self::State) => FailureCode::General(ErrorCode::WrongState),
            (_, Self::Failed) => FailureCode::General(ErrorCode::OperationFailed),
            (_, Self::NotSupported) => FailureCode::General(ErrorCode::NotSupported),
        };
        message(&Error { cmd_id: command, error_code: code, error_data: ErrorData::new(&[0; 4]) })
    }
}

pub(super) type Replies = Result<Vec<Reply>, Refusal>;

/// One message.
pub(super) fn message<M: Message + ToWire>(message: &M) -> Replies {
    send(Packet::of(message))
}

fn send(packet: Result<Packet, Refusal>) -> Replies {
    Ok(vec![Reply::Send(packet?)])
}

/// A confirmation.
pub(super) fn confirm(command: CommandId, data: ConfirmData) -> Replies {
    send(Packet::confirmation(command, data))
}

impl Machine {
    /// Carries out a command and says what follows from it.
    pub(super) fn answer(&mut self, now: Duration, received: &Received) -> Replies {
        let id = CommandId::from(received.id);
        let (command, rest) = OutgoingCommand::decode(id, &received.payload).map_err(|_| Refusal::Size)?;
        if !rest.is_empty() {
            return Err(Refusal::Size);
        }
        match command {
            OutgoingCommand::BoardInfoRequest(_) | OutgoingCommand::BoardInfoExtendedRequest(_) => {
                self.board_info()
            }
            OutgoingCommand::BoardInfo3Request(_) => self.board_info_3(),
            OutgoingCommand::ReadParams3(request) => self.read_block(id, request.profile_id),
            OutgoingCommand::ReadParamsExt(request) => self.read_block(id, request.profile_id),
            OutgoingCommand::WriteParams3(_) => {
                self.write_block(id, CommandId::ReadParams3, &received.payload)
            }
            OutgoingCommand::WriteParamsExt(_) => {
                self.write_block(id, CommandId::ReadParamsExt, &received.payload)
            }
            OutgoingCommand::ReadParamsExt2(request) => self.read_block(id, request.profile_id),
            OutgoingCommand::ReadParamsExt3(request) => self.read_block(id, request.profile_id),
            OutgoingCommand::WriteParamsExt2(_) => {
                self.write_block(id, CommandId::ReadParamsExt2, &received.payload)
            }
            OutgoingCommand::WriteParamsExt3(_) => {
                self.write_block(id, CommandId::ReadParamsExt3, &received.payload)
            }
            OutgoingCommand::ReadProfileNames(_) => send(self.parameters.names()),
            OutgoingCommand::WriteProfileNames(names) => self.write_names(names),
            OutgoingCommand::UseDefaults(request) => self.use_defaults(request.profile_id),
            OutgoingCommand::CalibAccSimple(_)
            | OutgoingCommand::CalibGyroSimple(_)
            | OutgoingCommand::CalibMagSimple(_) => self.calibrate(now, id, None),
            OutgoingCommand::CalibAcc(CalibAcc(request))
            | OutgoingCommand::CalibGyro(CalibGyro(request))
            | OutgoingCommand::CalibMag(CalibMag(request)) => self.calibrate(now, id, Some(&request)),
            OutgoingCommand::EepromReadRequest(request) => self.read_eeprom(&request),
            OutgoingCommand::EepromWrite(write) => self.write_eeprom(&write),
            OutgoingCommand::ControlLegacy(command) => self.control_legacy(now, &command),
            OutgoingCommand::Control(command) => self.control(now, &command),
            OutgoingCommand::ControlConfig(config) => self.control_config(now, &config),
            OutgoingCommand::MotorsOn(_) => self.motors(id, true),
            OutgoingCommand::MotorsOffSimple(_) | OutgoingCommand::MotorsOff(_) => self.motors(id, false),
            OutgoingCommand::ExecuteMenu(menu) => self.menu(menu.cmd_id, ExecuteMenuFlags::CONFIRM),
            OutgoingCommand::ExecuteMenuExtended(menu) => self.menu(menu.cmd_id, menu.flags),
            OutgoingCommand::ResetRequest(_) => Self::reset_request(None),
            OutgoingCommand::ResetExtendedRequest(request) => Self::reset_request(Some(&request)),
            OutgoingCommand::GetAngles(_) => self.angles(),
            OutgoingCommand::GetAnglesExt(_) => self.angles_ext(),
            OutgoingCommand::RealtimeDataRequest(_) | OutgoingCommand::RealtimeData3Request(_) => {
                send(self.realtime_3())
            }
            OutgoingCommand::RealtimeData4Request(_) => send(self.realtime_4()),
            OutgoingCommand::RealtimeDataCustomRequest(request) => {
                send(self.realtime_custom(now, request.flags))
            }
            OutgoingCommand::DataStreamInterval(request) => self.stream(now, received.version, &request),
            OutgoingCommand::SetAdjVarsVal(SetAdjVarsVal(values)) => self.set_variables(&values),
            OutgoingCommand::GetAdjVarsVal(request) => self.variables(&request.param_id),
            OutgoingCommand::SaveParams3(_) => self.save_variables(None),
            OutgoingCommand::SaveParams3Extended(request) => self.save_variables(Some(&request.adj_var_id)),
            OutgoingCommand::DebugVarsInfo3Request(_) => self.debug_variables_info(0),
            OutgoingCommand::DebugVarsInfo3ExtendedRequest(request) => {
                self.debug_variables_info(request.start_idx)
            }
            OutgoingCommand::DebugVars3Request(_) => self.debug_variables(None),
            OutgoingCommand::DebugVars3ExtendedRequest(request) => self.debug_variables(Some(&request)),
            // These are never answered; that they have no effect is not seen.
            OutgoingCommand::HelperDataLegacy(_)
            | OutgoingCommand::HelperData(_)
            | OutgoingCommand::ApiVirtChControl(_)
            | OutgoingCommand::ApiVirtChHighRes(_)
            | OutgoingCommand::BeepSound(_)
            | OutgoingCommand::ServoOut(_) => Ok(Vec::new()),
            OutgoingCommand::Unknown { .. } => Err(Refusal::Unknown),
            _ => Err(Refusal::NotSupported),
        }
    }
}
