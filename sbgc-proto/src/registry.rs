//! All messages of each direction in one enumeration: [`OutgoingCommand`] and [`IncomingCommand`].
//!
//! Here a command's id and the length of its payload find its type. One line a message; all else is said where the
//! message is declared. Programs that want few messages match on the id themselves and leave these enumerations, and
//! what they cost, alone.

#[allow(clippy::wildcard_imports, reason = "the list below names them all")]
use crate::commands::*;
use crate::frame::{self, Frame, Version};
use crate::message::{Message, write_payload};
use crate::wire::{ToWire, Writer};
use crate::{CommandId, DecodeError, Direction, EncodeError, RequestInfo};

macro_rules! commands {
    ($(
        $(#[doc = $doc:literal])+
        pub enum $enum:ident<'a>: $direction:ident {
            $($variant:ident($ty:ident $(<$lifetime:lifetime>)?),)*
        }
    )*) => { $(
        $(#[doc = $doc])+
        #[derive(Clone, Debug, PartialEq, Eq)]
        #[cfg_attr(feature = "defmt", derive(defmt::Format))]
        #[cfg_attr(feature = "serde", derive(serde::Serialize))]
        #[allow(clippy::large_enum_variant, reason = "there is no allocator to put the large ones elsewhere")]
        #[non_exhaustive]
        pub enum $enum<'a> {
            $(
                #[doc = concat!("[`", stringify!($ty), "`](crate::commands::", stringify!($ty), ").")]
                $variant($ty $(<$lifetime>)?),
            )*
            /// An id that the protocol does not have in this direction.
            Unknown {
                /// The id.
                id: CommandId,
                /// The payload as it came.
                payload: &'a [u8],
            },
        }

        impl<'a> $enum<'a> {
            /// Which way all of these go.
            pub const DIRECTION: Direction = Direction::$direction;

            /// Reads the payload of command `id`, and returns what newer firmware has added after the known part.
            ///
            /// # Errors
            /// When the payload is too short, or none of the forms of the command has its length.
            pub fn decode(id: CommandId, payload: &'a [u8]) -> Result<(Self, &'a [u8]), DecodeError> {
                let raw = id.raw();
                $(
                    if raw == const { <$ty as Message>::ID.raw() } && <$ty>::accepts(payload.len()) {
                        let (message, rest) = <$ty>::decode_prefix(payload)?;
                        return Ok((Self::$variant(message), rest));
                    }
                )*
                match id.spec_name(Self::DIRECTION) {
                    Some(command) if $(raw == <$ty as Message>::ID.raw())||* => {
                        Err(DecodeError::NoSuchForm { command, got: payload.len() })
                    }
                    _ => Ok((Self::Unknown { id, payload }, &[])),
                }
            }

            /// What is declared of the command with this id and payload; `None` where the protocol has none such.
            #[allow(dead_code, reason = "messages from the board request nothing")]
            pub(crate) fn request_info(id: CommandId, payload: &[u8]) -> Option<RequestInfo> {
                type Row = (u8, fn(usize) -> bool, RequestInfo);
                static ROWS: &[Row] =
                    &[$((<$ty as Message>::ID.raw(), <$ty as Message>::accepts, <$ty as Message>::REQUEST)),*];
                let row = ROWS.iter().find(|(row, accepts, _)| *row == id.raw() && accepts(payload.len()));
                row.map(|(_, _, info)| *info)
            }

            /// Reads the payload of a frame.
            ///
            /// # Errors
            /// When the payload is too short, or none of the forms of the command has its length.
            pub fn of_frame(frame: &Frame<'a>) -> Result<(Self, &'a [u8]), DecodeError> {
                Self::decode(CommandId::from_raw(frame.id), frame.payload)
            }

            /// The command's id.
            pub fn id(&self) -> CommandId {
                match self {
                    $(Self::$variant(_) => <$ty as Message>::ID,)*
                    Self::Unknown { id, .. } => *id,
                }
            }

            /// The spec's name of the command, `None` for one that the protocol does not have.
            pub fn spec_name(&self) -> Option<&'static str> {
                match self {
                    $(Self::$variant(_) => Some(<$ty as Message>::SPEC),)*
                    Self::Unknown { id, .. } => id.spec_name(Self::DIRECTION),
                }
            }

            /// The name of the message's form; `unknown` for a command that the protocol does not have.
            pub fn form(&self) -> &'static str {
                match self {
                    $(Self::$variant(_) => <$ty as Message>::FORM,)*
                    Self::Unknown { .. } => "unknown",
                }
            }

            /// Writes the payload to the front of `out` and returns it.
            ///
            /// # Errors
            /// When it does not fit, or the message contradicts itself.
            pub fn encode<'o>(&self, out: &'o mut [u8]) -> Result<&'o [u8], EncodeError> {
                let length = write_payload(self, (), out)?;
                Ok(out.get(..length).unwrap_or_default())
            }

            /// Writes the whole frame to the front of `out` and returns it.
            ///
            /// # Errors
            /// When it does not fit, or the message contradicts itself.
            pub fn encode_frame<'o>(&self, version: Version, out: &'o mut [u8]) -> Result<&'o [u8], EncodeError> {
                frame::encode_with(version, self.id().raw(), out, |payload| write_payload(self, (), payload))
            }
        }

        impl ToWire for $enum<'_> {
            fn write(&self, (): (), out: &mut Writer<'_>) -> Result<(), EncodeError> {
                match self {
                    $(Self::$variant(message) => message.write((), out),)*
                    Self::Unknown { payload, .. } => out.put(payload),
                }
            }
        }

        $(
            impl<'a> From<$ty $(<$lifetime>)?> for $enum<'a> {
                fn from(message: $ty $(<$lifetime>)?) -> Self {
                    Self::$variant(message)
                }
            }
        )*

        #[cfg(all(test, feature = "serde"))]
        impl $enum<'_> {
            /// Takes every message through text and through bytes.
            fn through_serde() {
                $(
                    for payload in tests::payloads() {
                        let Ok((message, _)) = <$ty>::decode_prefix(&payload) else { continue };
                        tests::through_bytes!(message, $ty);
                        tests::through_text!(message, $ty $(, $lifetime)?);
                    }
                )*
            }
        }

        #[cfg(feature = "reflect")]
        impl<'a> $enum<'a> {
            /// All messages of this direction, in the order in which their forms are tried.
            pub const ALL: &'static [crate::reflect::MessageInfo] = {
                // A static has one place in memory, a constant would have one at each use.
                static ALL: &[crate::reflect::MessageInfo] =
                    &[$(crate::reflect::MessageInfo::of::<$ty>(stringify!($ty))),*];
                ALL
            };

            /// A message all of whose fields are zero or absent.
            pub fn blank(id: CommandId, form: &str) -> Option<Self> {
                $(
                    if id == <$ty as Message>::ID && form == <$ty as Message>::FORM {
                        return Some(Self::$variant(<$ty>::default()));
                    }
                )*
                None
            }

            /// Visits the fields in wire order and returns how many bytes they take.
            pub fn walk(&self, visitor: &mut dyn crate::reflect::Visitor) -> usize {
                match self {
                    $(Self::$variant(message) => crate::reflect::walk(message, visitor),)*
                    Self::Unknown { payload, .. } => crate::reflect::walk(payload, visitor),
                }
            }

            /// Sets the field that `path` names.
            ///
            /// # Errors
            /// When there is no such field, or `value` is not one that it can have.
            pub fn set(
                &mut self,
                path: &str,
                value: crate::reflect::Input<'a>,
            ) -> Result<(), crate::reflect::AssignError> {
                match self {
                    $(Self::$variant(message) => crate::reflect::set(message, path, value),)*
                    Self::Unknown { payload, .. } => crate::reflect::set(payload, path, value),
                }
            }
        }
    )* };
}

impl RequestInfo {
    /// What is known of the command with this id and payload; `None` for one that the protocol does not have.
    pub fn of_payload(command: CommandId, payload: &[u8]) -> Option<Self> {
        OutgoingCommand::request_info(command, payload)
    }
}

#[cfg(all(test, feature = "serde"))]
mod tests {
    use super::{IncomingCommand, OutgoingCommand};

    /// Payloads whose bytes are low, high, mixed: known and unknown values, NaNs, texts that are none.
    pub(super) fn payloads() -> impl Iterator<Item = [u8; 255]> {
        let mixed = core::array::from_fn(|index| u8::try_from(index * 73 % 256).unwrap_or_default());
        let ascending = core::array::from_fn(|index| u8::try_from(index % 256).unwrap_or_default());
        [[0; 255], [1; 255], [0x7F; 255], [0xFF; 255], mixed, ascending].into_iter()
    }

    macro_rules! through_bytes {
        ($message:ident, $ty:ident) => {
            let bytes = postcard::to_stdvec(&$message).unwrap();
            assert_eq!(postcard::from_bytes::<$ty>(&bytes).unwrap(), $message);
        };
    }
    pub(super) use through_bytes;

    macro_rules! through_text {
        ($message:ident, $ty:ident) => {
            let text = serde_json::to_string(&$message).unwrap();
            let again = serde_json::from_str::<$ty>(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
            assert_eq!(again, $message, "{text}");
        };
        // What borrows bytes cannot be read from text.
        ($message:ident, $ty:ident, $lifetime:lifetime) => {
            serde_json::to_string(&$message).unwrap();
        };
    }
    pub(super) use through_text;

    #[test]
    fn nothing_is_lost_in_serde() {
        OutgoingCommand::through_serde();
        IncomingCommand::through_serde();
    }

    #[test]
    fn people_read_names_and_physical_values() {
        let payload = [30, 1, 9, 4, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        let (info, _) = IncomingCommand::decode(crate::CommandId::BoardInfo, &payload).unwrap();
        let text = serde_json::to_value(&info).unwrap();
        let info = &text["BoardInfo"];
        assert_eq!((&info["board_ver"], &info["firmware_ver"]), (&3.0.into(), &"2.30b5".into()));
        assert_eq!(info["state_flags1"], "INIT_STEP1_DONE");
    }
}

commands! {
    /// A message from the host to the controller.
    pub enum OutgoingCommand<'a>: Outgoing {
        BoardInfo3Request(BoardInfo3Request),
        ReadParams3(ReadParams3),
        WriteParams3(WriteParams3),
        RealtimeData3Request(RealtimeData3Request),
        SelectImu3(SelectImu3),
        SelectImu3Extended(SelectImu3Extended<'a>),
        RealtimeData4Request(RealtimeData4Request),
        EncodersCalibOffset4Simple(EncodersCalibOffset4Simple),
        EncodersCalibOffset4(EncodersCalibOffset4),
        EncodersCalibFldOffset4Simple(EncodersCalibFldOffset4Simple),
        EncodersCalibFldOffset4(EncodersCalibFldOffset4),
        EncodersCalibFldOffset4Speed(EncodersCalibFldOffset4Speed),
        EncodersCalibFldOffset4Flags(EncodersCalibFldOffset4Flags),
        ReadProfileNames(ReadProfileNames),
        WriteProfileNames(WriteProfileNames),
        QueueParamsInfo3Request(QueueParamsInfo3Request<'a>),
        SetAdjVarsVal(SetAdjVarsVal),
        SaveParams3(SaveParams3),
        SaveParams3Extended(SaveParams3Extended),
        ReadParamsExt(ReadParamsExt),
        WriteParamsExt(WriteParamsExt),
        AutoPidRequest(AutoPidRequest),
        ServoOut(ServoOut),
        BodeTestStartStopRequest(BodeTestStartStopRequest),
        I2cWriteRegBuf(I2cWriteRegBuf<'a>),
        I2cReadRegBufRequest(I2cReadRegBufRequest),
        WriteExternalData(WriteExternalData),
        ReadExternalData(ReadExternalData),
        ReadAdjVarsCfg(ReadAdjVarsCfg),
        WriteAdjVarsCfg(WriteAdjVarsCfg),
        ApiVirtChControl(ApiVirtChControl),
        ApiVirtChControlVariable(ApiVirtChControlVariable),
        AdjVarsStateRequest(AdjVarsStateRequest),
        AdjVarsStateLegacyRequest(AdjVarsStateLegacyRequest),
        EepromWrite(EepromWrite<'a>),
        EepromReadRequest(EepromReadRequest),
        CalibInfoRequest(CalibInfoRequest),
        SignMessageRequest(SignMessageRequest),
        BootMode3(BootMode3),
        BootMode3Extended(BootMode3Extended),
        SystemStateRequest(SystemStateRequest<'a>),
        ReadFile(ReadFile),
        WriteFile(WriteFile<'a>),
        WriteFileDelete(WriteFileDelete),
        FsClearAll(FsClearAll),
        AhrsHelperLegacyRequest(AhrsHelperLegacyRequest),
        AhrsHelperShortRequest(AhrsHelperShortRequest),
        AhrsHelperRequest(AhrsHelperRequest),
        RunScript(RunScript),
        CalibMagSimple(CalibMagSimple),
        CalibMag(CalibMag),
        UartBypassRequest(UartBypassRequest<'a>),
        GetAnglesExt(GetAnglesExt),
        ReadParamsExt2(ReadParamsExt2),
        WriteParamsExt2(WriteParamsExt2),
        GetAdjVarsVal(GetAdjVarsVal),
        CalibAccSimple(CalibAccSimple),
        CalibAcc(CalibAcc),
        CalibBat(CalibBat),
        ControlLegacy(ControlLegacy),
        Control(Control),
        RealtimeDataRequest(RealtimeDataRequest),
        ExecuteMenuExtended(ExecuteMenuExtended),
        ExecuteMenu(ExecuteMenu),
        UseDefaults(UseDefaults),
        CalibExtGain(CalibExtGain),
        HelperDataLegacy(HelperDataLegacy),
        HelperData(HelperData),
        GetAngles(GetAngles),
        CalibMotorMagLinkRequest(CalibMotorMagLinkRequest<'a>),
        GyroCorrection(GyroCorrection),
        ModuleListRequest(ModuleListRequest),
        MotorsOn(MotorsOn),
        ModuleFlashStart(ModuleFlashStart),
        CalibOffset(CalibOffset),
        CalibPoles(CalibPoles),
        ModuleFlashWrite(ModuleFlashWrite<'a>),
        ReadParams(ReadParams),
        ModuleFlashFinish(ModuleFlashFinish),
        TriggerPin(TriggerPin),
        DataStreamInterval(DataStreamInterval),
        BoardInfoRequest(BoardInfoRequest),
        BoardInfoExtendedRequest(BoardInfoExtendedRequest<'a>),
        WriteParams(WriteParams<'a>),
        RealtimeDataCustomRequest(RealtimeDataCustomRequest),
        BeepSound(BeepSound),
        ControlConfig(ControlConfig),
        CalibOrientCorr(CalibOrientCorr),
        CoggingCalibInfoRequest(CoggingCalibInfoRequest<'a>),
        CalibCogging(CalibCogging),
        CalibAccExtRef(CalibAccExtRef),
        ProfileSet(ProfileSet),
        CanDeviceScanRequest(CanDeviceScanRequest),
        CanDrvHardParamsRequest(CanDrvHardParamsRequest<'a>),
        CanDrvStateRequest(CanDrvStateRequest<'a>),
        CanDrvCalibrateRequest(CanDrvCalibrateRequest<'a>),
        ReadRcInputs(ReadRcInputs),
        RealtimeDataCanDrvRequest(RealtimeDataCanDrvRequest<'a>),
        CalibGyroSimple(CalibGyroSimple),
        CalibGyro(CalibGyro),
        ReadParamsExt3(ReadParamsExt3),
        WriteParamsExt3(WriteParamsExt3),
        ExtImuDebugInfoRequest(ExtImuDebugInfoRequest),
        SetDeviceAddrRequest(SetDeviceAddrRequest<'a>),
        AutoPid2SimpleRequest(AutoPid2SimpleRequest),
        AutoPid2Request(AutoPid2Request),
        MotorsOffSimple(MotorsOffSimple),
        MotorsOff(MotorsOff),
        ExtImuCmdRequest(ExtImuCmdRequest<'a>),
        ReadStateVars(ReadStateVars),
        WriteStateVars(WriteStateVars),
        SerialProxyRequest(SerialProxyRequest<'a>),
        ResetRequest(ResetRequest),
        ResetExtendedRequest(ResetExtendedRequest),
        ImuAdvancedCalibRequest(ImuAdvancedCalibRequest<'a>),
        ApiVirtChHighRes(ApiVirtChHighRes),
        CalibEncoderLutRequest(CalibEncoderLutRequest<'a>),
        CalibEncoderLutResRequest(CalibEncoderLutResRequest<'a>),
        WriteParamsSet(WriteParamsSet),
        CalibCurSensRequest(CalibCurSensRequest<'a>),
        ControlExt(ControlExt),
        EncIntCalibRequest(EncIntCalibRequest<'a>),
        SyncMotors(SyncMotors),
        ExtLicenseInfoRequest(ExtLicenseInfoRequest<'a>),
        VibrationTestStartStopRequest(VibrationTestStartStopRequest<'a>),
        VibrationTestDataRequest(VibrationTestDataRequest<'a>),
        ExtMotorsAction(ExtMotorsAction<'a>),
        ExtMotorsControl(ExtMotorsControl),
        ExtMotorsControlConfig(ExtMotorsControlConfig),
        ExtMotorsStateRequest(ExtMotorsStateRequest),
        AdjVarsInfoRequest(AdjVarsInfoRequest),
        ServoOutExt(ServoOutExt),
        SetAdjVarsValF(SetAdjVarsValF),
        GetAdjVarsValF(GetAdjVarsValF),
        PassProtectReadRequest(PassProtectReadRequest),
        PassProtectWrite(PassProtectWrite<'a>),
        RealtimeDataCustom2Request(RealtimeDataCustom2Request),
        ControlQuat(ControlQuat),
        ControlQuatStatusRequest(ControlQuatStatusRequest),
        ControlQuatConfig(ControlQuatConfig),
        SetTranspProxy(SetTranspProxy),
        UdrvDeviceScan(UdrvDeviceScan),
        ExtSensCmdRequest(ExtSensCmdRequest<'a>),
        TransparentSapiRequest(TransparentSapiRequest<'a>),
        ObgcRequest(ObgcRequest<'a>),
        SetDebugPortRequest(SetDebugPortRequest),
        MavlinkInfoRequest(MavlinkInfoRequest<'a>),
        MavlinkDebugRequest(MavlinkDebugRequest<'a>),
        DebugVarsInfo3Request(DebugVarsInfo3Request),
        DebugVarsInfo3ExtendedRequest(DebugVarsInfo3ExtendedRequest),
        DebugVars3Request(DebugVars3Request),
        DebugVars3ExtendedRequest(DebugVars3ExtendedRequest),
    }

    /// A message from the controller to the host.
    pub enum IncomingCommand<'a>: Incoming {
        BoardInfo3(BoardInfo3),
        Params3(Params3),
        RealtimeData3(RealtimeData3),
        RealtimeData4(RealtimeData4),
        ProfileNames(ProfileNames),
        QueueParamsInfo3(QueueParamsInfo3<'a>),
        AdjVarsVal(AdjVarsVal),
        ParamsExt(ParamsExt),
        AutoPid(AutoPid),
        BodeTestStartStop(BodeTestStartStop),
        BodeTestData(BodeTestData),
        I2cReadRegBuf(I2cReadRegBuf<'a>),
        ExternalData(ExternalData),
        AdjVarsCfg(AdjVarsCfg),
        AdjVarsState(AdjVarsState),
        EepromRead(EepromRead<'a>),
        CalibInfo(CalibInfo),
        SignMessage(SignMessage),
        SystemState(SystemState<'a>),
        FilePart(FilePart<'a>),
        FilePartError(FilePartError),
        AhrsHelperStream(AhrsHelperStream),
        AhrsHelper(AhrsHelper),
        ScriptDebug(ScriptDebug),
        UartBypass(UartBypass<'a>),
        AnglesExt(AnglesExt),
        ParamsExt2(ParamsExt2),
        Confirm(Confirm),
        Angles(Angles),
        CalibMotorMagLink(CalibMotorMagLink<'a>),
        ModuleList(ModuleList),
        Params(Params<'a>),
        BoardInfo(BoardInfo),
        RealtimeDataCustomView(RealtimeDataCustomView<'a>),
        CoggingCalibInfo(CoggingCalibInfo<'a>),
        CanDeviceScan(CanDeviceScan),
        CanDrvHardParams(CanDrvHardParams<'a>),
        CanDrvState(CanDrvState<'a>),
        CanDrvCalibrate(CanDrvCalibrate<'a>),
        RcInputs(RcInputs),
        RealtimeDataCanDrv(RealtimeDataCanDrv<'a>),
        Event(Event<'a>),
        ParamsExt3(ParamsExt3),
        ExtImuDebugInfo(ExtImuDebugInfo),
        SetDeviceAddr(SetDeviceAddr<'a>),
        AutoPid2(AutoPid2<'a>),
        ExtImuCmd(ExtImuCmd<'a>),
        StateVars(StateVars),
        SerialProxy(SerialProxy<'a>),
        Reset(Reset),
        ImuAdvancedCalib(ImuAdvancedCalib<'a>),
        CalibEncoderLut(CalibEncoderLut<'a>),
        CalibEncoderLutRes(CalibEncoderLutRes<'a>),
        CalibCurSens(CalibCurSens<'a>),
        EncIntCalib(EncIntCalib<'a>),
        ExtLicenseInfo(ExtLicenseInfo<'a>),
        VibrationTestStartStop(VibrationTestStartStop<'a>),
        VibrationTestData(VibrationTestData<'a>),
        CanDrvTelemetryView(CanDrvTelemetryView<'a>),
        ExtMotorsState(ExtMotorsState),
        AdjVarsInfo(AdjVarsInfo<'a>),
        AdjVarsValF(AdjVarsValF),
        PassProtectRead(PassProtectRead),
        RealtimeDataCustom2View(RealtimeDataCustom2View<'a>),
        ControlQuatStatus(ControlQuatStatus),
        ExtSensCmd(ExtSensCmd<'a>),
        TransparentSapi(TransparentSapi<'a>),
        Obgc(Obgc<'a>),
        SetDebugPort(SetDebugPort<'a>),
        MavlinkInfo(MavlinkInfo<'a>),
        MavlinkDebug(MavlinkDebug<'a>),
        DebugVarsInfo3(DebugVarsInfo3<'a>),
        DebugVars3(DebugVars3<'a>),
        ErrorLegacy(ErrorLegacy),
        Error(Error),
    }
}
