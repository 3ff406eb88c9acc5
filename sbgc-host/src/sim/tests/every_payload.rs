//! Every form of every command with payloads that mean anything: boundary values and seeded random bytes.

use sbgc_proto::units::FirmwareVersion;
use sbgc_proto::{CommandId, IncomingCommand, MessageInfo, OutgoingCommand, RequestInfo};

use super::{Bench, Got, ms};
use crate::sim::noise::Noise;
use crate::sim::{Board, Config};

/// What may come unasked while a payload acts.
const UNASKED: [CommandId; 8] = [
    CommandId::Reset,
    CommandId::ScriptDebug,
    CommandId::AutoPid,
    CommandId::BodeTestData,
    CommandId::BodeTestStartStop,
    CommandId::ReadParams3,
    CommandId::ReadParamsExt2,
    CommandId::Event,
];

/// Payloads of one size: boundary values of all types of fields, and random bytes.
fn payloads(id: CommandId, size: usize, count: usize) -> Vec<Vec<u8>> {
    let pattern = |bytes: [u8; 4]| (0..size).map(|index| bytes[index % 4]).collect::<Vec<u8>>();
    // 1, -1, the ends of i16, i32 and i8, infinity, NaN and the greatest float.
    let patterns = [
        [1, 0, 1, 0],
        [0xFF; 4],
        [0x00, 0x80, 0x00, 0x80],
        [0xFF, 0x7F, 0xFF, 0x7F],
        [0x00, 0x00, 0x00, 0x80],
        [0xFF, 0xFF, 0xFF, 0x7F],
        [0x80; 4],
        [0x7F; 4],
        [0x00, 0x00, 0x80, 0x7F],
        [0x00, 0x00, 0xC0, 0x7F],
        [0xFF, 0xFF, 0x7F, 0x7F],
    ];
    let mut noise = Noise::new(u64::from(id.raw()) << 16 | size as u64);
    let mut all: Vec<_> = patterns.into_iter().map(pattern).collect();
    for number in 0..count {
        let mut payload: Vec<u8> = (0..size).map(|_| noise.byte()).collect();
        // Small numbers are more often valid: the first bytes choose what is done.
        let small = if number % 2 == 0 { 3 } else { 0 };
        payload.iter_mut().take(small).for_each(|byte| *byte %= 8);
        all.push(payload);
    }
    all
}

/// The sizes at the ends of what a form has, and some between.
fn sizes(form: &MessageInfo) -> Vec<usize> {
    let (first, last) = (*form.size.start(), (*form.size.end()).min(249));
    let mut sizes: Vec<_> = [first, first + 1, usize::midpoint(first, last), last.saturating_sub(1), last]
        .into_iter()
        .filter(|size| form.size.contains(size) && *size <= last && (form.accepts)(*size))
        .collect();
    sizes.dedup();
    sizes
}

fn expected(id: CommandId, payload: &[u8], got: &Got) -> bool {
    let answer = CommandId::from(got.id);
    let about = got.payload.first() == Some(&id.raw());
    match answer {
        // The confirmation, and the one that a target which was near anyway is reached.
        CommandId::Control => about,
        CommandId::Error => about && got.payload.len() == 6,
        _ => {
            RequestInfo::of_payload(id, payload).is_some_and(|info| info.answer == Some(answer))
                || answer == id
                || UNASKED.contains(&answer)
        }
    }
}

fn try_all(config: &Config, count: usize) -> usize {
    let image = Board::new(config.clone()).eeprom().to_vec();
    let mut tried = 0;
    for form in OutgoingCommand::ALL {
        for size in sizes(form) {
            for payload in payloads(form.id, size, count) {
                let mut bench = Bench::of(Board::with_eeprom(config.clone(), image.clone()).unwrap());
                bench.send_raw(form.id.raw(), &payload);
                // The bench fails where the board sends anything but frames.
                let got = bench.run(ms(64));
                for got in &got {
                    let what = format!("{} {payload:02x?}: {got:?}", form.spec);
                    assert!(expected(form.id, &payload, got), "{what}");
                    // The answer that needs the request to be read is the only one that cannot be decoded.
                    let decoded = IncomingCommand::decode(got.id.into(), &got.payload);
                    assert!(decoded.is_ok(), "{what} {decoded:?}");
                }
                tried += 1;
                // Whatever it did, the board is there afterwards: at the latest when its boot loader has ended.
                let alive = (0..45).any(|_| {
                    bench.send_raw(CommandId::BoardInfo.raw(), &[]);
                    let got = bench.run(ms(100));
                    got.iter().any(|got| got.id == CommandId::BoardInfo.raw())
                });
                let later = matches!(form.id, CommandId::Reset | CommandId::BootMode3);
                assert!(alive || later, "{} {payload:02x?}", form.spec);
            }
        }
    }
    tried
}

#[test]
fn whatever_comes_is_answered_as_declared_and_leaves_a_board_that_answers() {
    let tried = try_all(&Config::default(), 6);
    assert!(tried > 4000, "{tried}");
}

#[test]
fn old_firmware_stands_it_as_well() {
    let old = Config { firmware: FirmwareVersion::new(2, 68, 9), ..Config::default() };
    let tried = try_all(&old, 2);
    assert!(tried > 3000, "{tried}");
}
