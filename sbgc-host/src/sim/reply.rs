//! What follows from a command: messages, resets, or a refusal.

use std::time::Duration;

use sbgc_proto::commands::{
    AutoPid2Error, Confirm, ConfirmData, Error, ErrorCode, ErrorData, FailureCode, FsErrorCode,
};
use sbgc_proto::frame::MAX_PAYLOAD;
use sbgc_proto::wire::ToWire;
use sbgc_proto::{CommandId, Message};

/// The data of confirmations that have nothing to add.
pub(super) const DONE: ConfirmData = ConfirmData::U8(0);

/// How long before a reset of its own the board announces it.
pub(super) const RESET_NOTICE: Duration = Duration::from_secs(1);

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
    /// The board enters its bootloader after this time.
    Boot {
        after: Duration,
    },
    /// Two ports carry raw bytes to each other from now on.
    Bridge {
        ports: [u8; 2],
    },
}

/// Why a command is not carried out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refusal {
    /// Nothing is answered: the payload has a size that the command does not have, or the text says silence.
    Silent,
    Parameters,
    Unknown,
    NotSupported,
    State,
    Failed,
    /// A failure of automatic tuning.
    Tuning(AutoPid2Error),
}

impl Refusal {
    /// The error message. Commands that deal with the EEPROM have error codes of their own.
    pub(super) fn replies(self, command: CommandId) -> Replies {
        let general = |code| match FailureCode::from_raw(command, 0) {
            FailureCode::Files(_) => FailureCode::Files(FsErrorCode::WrongParams),
            _ => FailureCode::General(code),
        };
        let error_code = match self {
            Self::Silent => return Ok(Vec::new()),
            Self::Parameters => general(ErrorCode::WrongParams),
            Self::Unknown => general(ErrorCode::UnknownCommand),
            Self::State => general(ErrorCode::WrongState),
            Self::Failed => general(ErrorCode::OperationFailed),
            Self::NotSupported => FailureCode::General(ErrorCode::NotSupported),
            Self::Tuning(code) => FailureCode::AutoPid2(code),
        };
        message(&Error { cmd_id: command, error_code, error_data: ErrorData::new(&[0; 4]) })
    }
}

pub(super) type Replies = Result<Vec<Reply>, Refusal>;

/// No answer, as the text has it for many commands.
#[allow(clippy::unnecessary_wraps, reason = "it stands where other answers do")]
pub(super) fn silence() -> Replies {
    Ok(Vec::new())
}

/// One message.
pub(super) fn message<M: Message + ToWire>(message: &M) -> Replies {
    send(Packet::of(message))
}

pub(super) fn send(packet: Result<Packet, Refusal>) -> Replies {
    Ok(vec![Reply::Send(packet?)])
}

/// A confirmation.
pub(super) fn confirm(command: CommandId, data: ConfirmData) -> Replies {
    send(Packet::confirmation(command, data))
}

/// The confirmation of a command that was carried out.
pub(super) fn done(command: CommandId) -> Replies {
    confirm(command, DONE)
}
