//! Every id in every size: what the board answers, as the table in the documentation has it.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::OnceLock;

use sbgc_proto::units::FirmwareVersion;
use sbgc_proto::{CommandId, MessageInfo, OutgoingCommand};

use super::{Bench, Got, ms};
use crate::sim::{Board, Config};

const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/sim/table.md");

/// What the board says to a payload, in short.
fn answer(config: &Config, id: u8, payload: &[u8]) -> String {
    // Laying out an EEPROM for each of them would take most of the time.
    static IMAGE: OnceLock<Vec<u8>> = OnceLock::new();
    let image = IMAGE.get_or_init(|| Board::new(Config::default()).eeprom().to_vec());
    let mut bench = Bench::of(Board::with_eeprom(config.clone(), image.clone()).unwrap());
    bench.send_raw(id, payload);
    let got = bench.run(ms(16));
    let mut words = Vec::new();
    for Got { id: answer, payload, .. } in got {
        let word = match (CommandId::from(answer), &payload[..]) {
            (CommandId::Error, [_, code, ..]) => format!("error {code}"),
            (CommandId::Control, [command, ..]) if *command == id => "confirmed".into(),
            (other, _) => format!("`{}`", other.spec_name(sbgc_proto::Direction::Incoming).unwrap_or("?")),
        };
        if !words.contains(&word) {
            words.push(word);
        }
    }
    if words.is_empty() { "silence".into() } else { words.join(", ") }
}

/// The sizes as ranges.
fn ranges(sizes: &[usize]) -> String {
    let mut parts: Vec<(usize, usize)> = Vec::new();
    for size in sizes {
        match parts.last_mut() {
            Some((_, end)) if *end + 1 == *size => *end = *size,
            _ => parts.push((*size, *size)),
        }
    }
    let part = |(start, end)| if start == end { format!("{start}") } else { format!("{start} to {end}") };
    parts.into_iter().map(part).collect::<Vec<_>>().join(", ")
}

fn forms(id: u8) -> Vec<&'static MessageInfo> {
    OutgoingCommand::ALL.iter().filter(|form| form.id.raw() == id).collect()
}

/// The sizes that a command has.
fn sizes(id: u8) -> Vec<usize> {
    let forms = forms(id);
    (0..=255)
        .filter(|size| forms.iter().any(|form| (form.accepts)(*size) && form.size.contains(size)))
        .collect()
}

#[test]
fn every_id_in_every_size_is_answered_as_the_table_has_it() {
    let config = Config::default();
    let mut table = String::from(
        "# What the simulated board does\n\n\
         What it answers to each id with a payload of zeros in each size, made by a test; sizes that are not listed \
         are ignored, and those beyond 250 bytes never fit the input buffer. Errors are those of zeros, which are no valid parameters of many commands: 2 is \
         `ERR_WRONG_PARAMS`, 8 `ERR_WRONG_STATE`, 9 `ERR_NOT_SUPPORTED`, 10 `ERR_OPERATION_FAILED` or the code of \
         the file system. Only commands of which nobody has published the payload are not supported.\n\n\
         | id | command | sizes | answer |\n| --- | --- | --- | --- |\n",
    );
    for id in 1..=255 {
        let known = sizes(id);
        let mut answers: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for size in 251..=255 {
            assert_eq!(answer(&config, id, &vec![0; size]), "silence", "it does not fit the input buffer");
        }
        for size in 0..=250 {
            // Long payloads that are not distinguished by their size are looked at in steps.
            let edge = known.iter().any(|known| known.abs_diff(size) <= 1);
            if size > 16 && size % 16 != 15 && !edge {
                continue;
            }
            if known.len() > 100 && size > 16 && size % 16 != 15 {
                continue;
            }
            let answer = answer(&config, id, &vec![0; size]);
            if known.is_empty() {
                assert_eq!(answer, "error 6", "nobody knows {id}");
            } else if known.contains(&size) {
                answers.entry(answer).or_default().push(size);
            } else if id == CommandId::AutoPid2.raw() {
                assert_eq!(answer, "error 5", "{size}");
            } else {
                assert_eq!(answer, "silence", "{id} does not have {size}");
            }
        }
        let undocumented = forms(id).iter().all(|form| form.form == "undocumented");
        let mut rows: Vec<_> = answers.into_iter().collect();
        rows.sort_by_key(|(_, sizes)| sizes[0]);
        let of_old = matches!(CommandId::from(id), CommandId::ReadParams | CommandId::WriteParams);
        for (answer, sizes) in rows {
            let unsupported = answer == "error 9";
            assert_eq!(unsupported, undocumented && !of_old, "{id}, {sizes:?}: {answer}");
            let name = CommandId::from(id).spec_name(sbgc_proto::Direction::Outgoing).unwrap_or("?");
            let sizes = if known.len() > 100 {
                format!("{} to {}", known[0], known[known.len() - 1])
            } else {
                ranges(&sizes)
            };
            writeln!(table, "| {id} | `{name}` | {sizes} | {answer} |").unwrap();
        }
    }
    let saved = std::fs::read_to_string(TABLE).unwrap_or_default();
    if saved != table {
        if std::env::var_os("UPDATE_TABLE").is_some() {
            std::fs::write(TABLE, &table).unwrap();
            return;
        }
        let difference = table.lines().zip(saved.lines()).find(|(new, old)| new != old);
        panic!("the table is not what the board does ({difference:?}); set UPDATE_TABLE to write it anew");
    }
}

#[test]
fn old_firmware_does_not_know_what_came_later() {
    let old = Config { firmware: FirmwareVersion::new(2, 68, 9), ..Config::default() };
    for form in OutgoingCommand::ALL {
        let size = *form.size.start();
        let known = old.knows(form.since);
        let answer = answer(&old, form.id.raw(), &vec![0; size]);
        assert_eq!(!known, answer == "error 6", "{} {}: {answer}", form.spec, form.form);
    }
}
