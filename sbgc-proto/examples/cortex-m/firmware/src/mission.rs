//! What the firmware is for.

use cortex_m_semihosting::hprintln;
use embedded_io::{Read, ReadReady, Write};
use sbgc_proto::commands::{
    BoardInfo, BoardInfoRequest, Confirm, Control, DataStreamInterval, MotorsOn, RealtimeData4, StreamSource,
};
use sbgc_proto::link::port::Port;
use sbgc_proto::link::{Millis, PortError, Update};
use sbgc_proto::units::{Angle, ControlRate, StreamInterval};
use sbgc_proto::wire::PerAxis;

/// Where the camera is to look: 20 degrees down.
const PITCH: Angle = Angle::from_whole_degrees(20);
/// Near enough: a degree.
const TOLERANCE: i16 = Angle::from_whole_degrees(1).0;
/// How long the camera may take.
const PATIENCE_MS: Millis = 20_000;
/// How often a command is sent whose confirmation was lost.
const TRIES: usize = 10;

/// Why the camera did not get there.
#[derive(Clone, Copy)]
pub enum Failure {
    NoBoard,
    NotConfirmed,
    NoStream,
    NotThere,
    Line,
}

impl Failure {
    pub fn as_str(self) -> &'static str {
        match self {
            Self::NoBoard => "no board answered",
            Self::NotConfirmed => "the board did not confirm a command",
            Self::NoStream => "no sample of the stream came",
            Self::NotThere => "the camera did not arrive",
            Self::Line => "the UART failed",
        }
    }
}

pub fn fly<R, W, C, const N: usize>(port: &mut Port<R, W, C, N>) -> Result<(), Failure>
where
    R: Read + ReadReady,
    W: Write<Error = R::Error>,
    C: FnMut() -> Millis,
{
    let board: BoardInfo =
        port.request(&BoardInfoRequest {}, |board| board, |_| {}).map_err(|_| Failure::NoBoard)?;
    let (major, minor, last) = board.firmware_ver.parts();
    hprintln!(
        "board with firmware {}.{} {}, frames of version {}",
        major,
        minor,
        last,
        port.link().version().number()
    );

    confirmed(port, &MotorsOn {})?;
    confirmed(port, &DataStreamInterval::new(StreamSource::RealtimeData4, StreamInterval(50)))?;
    let target = PerAxis { pitch: PITCH, ..PerAxis::default() };
    let control = Control::angles(target, ControlRate(500));
    port.send(&control).map_err(|_| Failure::Line)?;

    let start = port.now();
    let (mut sent, mut samples) = (start, 0_u32);
    while port.now().wrapping_sub(start) < PATIENCE_MS {
        // A command may be lost on the way.
        if port.now().wrapping_sub(sent) >= 500 {
            sent = port.now();
            port.send(&control).map_err(|_| Failure::Line)?;
        }
        if port.poll().map_err(|_| Failure::Line)? != Some(Update::Message) {
            continue;
        }
        let Some(Ok(data)) = port.frame().read::<RealtimeData4>() else { continue };
        samples += 1;
        let angle = data.realtime_data_3.imu_angle.pitch;
        if samples.is_multiple_of(10) {
            hprintln!("pitch {} of {}", angle.0, PITCH.0);
        }
        if angle.0.abs_diff(PITCH.0) <= TOLERANCE.unsigned_abs() {
            hprintln!("there after {} samples", samples);
            let stop = DataStreamInterval::new(StreamSource::RealtimeData4, StreamInterval::UNREGISTER);
            return confirmed(port, &stop);
        }
    }
    Err(if samples == 0 { Failure::NoStream } else { Failure::NotThere })
}

/// Sends a command until the board confirms it. These may be sent twice without doing more than once.
fn confirmed<Q, R, W, C, const N: usize>(port: &mut Port<R, W, C, N>, command: &Q) -> Result<(), Failure>
where
    Q: for<'a> sbgc_proto::Request<Answer<'a> = Confirm> + sbgc_proto::wire::ToWire,
    R: Read + ReadReady,
    W: Write<Error = R::Error>,
    C: FnMut() -> Millis,
{
    for _ in 0..TRIES {
        match port.request(command, |_| (), |_| {}) {
            Ok(()) => return Ok(()),
            Err(PortError::TimedOut) => hprintln!("{} was not confirmed in time, once more", Q::SPEC),
            Err(_) => return Err(Failure::Line),
        }
    }
    Err(Failure::NotConfirmed)
}
