//! The link: the board asked who it is, a stream of CMD_REALTIME_DATA_4 started and read, the camera moved.
#![no_std]
#![no_main]

use sbgc_proto::commands::{BoardInfoRequest, Control, DataStreamInterval, RealtimeData4, StreamSource};
use sbgc_proto::link::{Link, Settings, Update};
use sbgc_proto::units::{ControlRate, StreamInterval};
use sizes::{receive, send};

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut link = Link::<64>::new(Settings::DEFAULT);
    let _ = link.request(&BoardInfoRequest {}, 0);
    loop {
        let now = u32::from(receive());
        link.receive(receive(), now);
        while let Some(update) = link.poll(now) {
            let sent = match update {
                Update::Answer if link.frame().id == 86 => {
                    let stream = DataStreamInterval::new(StreamSource::RealtimeData4, StreamInterval(50));
                    link.request(&stream, now)
                }
                Update::Message => match link.frame().read::<RealtimeData4>() {
                    Some(Ok(data)) => {
                        link.send(&Control::angles(data.realtime_data_3.target_angle, ControlRate(500)))
                    }
                    _ => Ok(()),
                },
                _ => Ok(()),
            };
            send(u8::from(sent.is_ok()));
        }
        link.output().iter().copied().for_each(send);
        link.sent(usize::MAX);
    }
}
