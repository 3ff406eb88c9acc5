//! `sbgc decode`: captures of every kind, as text and as JSON.

mod common;

use common::{objects, run, run_with_input, stderr, stdout};
use serde_json::{Value, json};

const READ_PARAMS_V1: &str = "3E 52 01 53 01 01";
const READ_PARAMS_V2: &str = "24 52 01 53 01 12 3D";

#[test]
fn a_frame_by_hand_is_explained_in_both_versions() {
    for (version, hex) in [(1, READ_PARAMS_V1), (2, READ_PARAMS_V2)] {
        let output = run_with_input(&["decode", "--from", "hex", "--json"], hex.as_bytes());
        assert!(output.status.success(), "{}", stderr(&output));
        assert_eq!(
            objects(&output),
            [json!({
                "kind": "frame", "at": 0, "version": version, "direction": "outgoing", "id": 82,
                "name": "CMD_READ_PARAMS", "form": "full", "length": 1, "payload": "01",
                "fields": [{
                    "path": "profile_id", "spec": "PROFILE_ID", "offset": 0, "size": 1, "type": "u8",
                    "raw": 1, "value": 1, "unit": null, "label": "PROFILE_2",
                }],
            })]
        );
    }
    let text = stdout(&run_with_input(&["decode"], READ_PARAMS_V1.as_bytes()));
    assert_eq!(
        text,
        "0: CMD_READ_PARAMS (82) outgoing, form full, 1 byte, version 1\n    profile_id = PROFILE_2 (1)\n"
    );
}

#[test]
fn fields_are_as_the_contract_says() {
    let frame = "3E 56 12 68 1E 01 09 04 00 00 01 00 00 00 00 00 00 00 00 00 00 00 2D";
    let objects = objects(&run_with_input(&["decode", "--json"], frame.as_bytes()));
    let fields = &objects[0]["fields"];
    assert_eq!(
        fields[0],
        json!({"path": "board_ver", "spec": "BOARD_VER", "offset": 0, "size": 1, "type": "u8", "raw": 30, "value": 3.0,
            "unit": null, "label": null})
    );
    assert_eq!(fields[1]["label"], "2.30b5");
    assert_eq!(fields[2]["label"], "INIT_STEP1_DONE");
    assert_eq!(objects[0]["direction"], "incoming");
}

/// Noise, a frame, a corrupted frame with an intact one inside, and a frame that is cut short.
fn damaged() -> Vec<u8> {
    let corrupted = [0x3E, 0x52, 0x08, 0x5A, 0x3E, 0x52, 0x01, 0x53, 0x01, 0x01, 7, 7, 0x00];
    let whole = [0x24, 0x52, 0x01, 0x53, 0x01, 0x12, 0x3D];
    [&[1, 2, 3][..], &whole, &corrupted, &whole, &[0x3E, 0x52, 0x01]].concat()
}

#[test]
fn every_intact_frame_is_found_and_every_other_byte_accounted_for() {
    let capture = damaged();
    let output = run_with_input(&["decode", "--from", "bin", "--json"], &capture);
    assert!(output.status.success());
    let objects = objects(&output);
    let frames: Vec<u64> = objects
        .iter()
        .filter(|object| object["kind"] == "frame")
        .filter_map(|object| object["at"].as_u64())
        .collect();
    assert_eq!(frames, [3, 14, 23]);
    let skipped = objects.iter().filter(|object| object["kind"] == "skipped");
    let lost: u64 = skipped.clone().filter_map(|object| object["length"].as_u64()).sum();
    assert_eq!(usize::try_from(lost), Ok(capture.len() - 7 - 6 - 7));
    let causes: Vec<&Value> = skipped.map(|object| &object["cause"]).collect();
    for cause in ["no_start_byte", "payload_checksum", "truncated"] {
        assert!(causes.contains(&&json!(cause)), "{causes:?}");
    }
}

#[test]
fn a_summary_accounts_for_every_byte() {
    let capture = [&damaged()[..], &[0x3E, 0x52, 0, 0x52, 0]].concat();
    let output = run_with_input(&["decode", "--direction", "outgoing", "--json", "--summary"], &capture);
    let objects = objects(&output);
    assert_eq!(
        objects[0],
        json!({
            "kind": "frames", "direction": "outgoing", "id": 82, "name": "CMD_READ_PARAMS",
            "frames": 4, "bytes": 25, "undecoded": 1,
        })
    );
    let skipped: u64 = objects[1..]
        .iter()
        .map(|object| {
            assert_eq!(object["kind"], "skipped");
            object["length"].as_u64().unwrap()
        })
        .sum();
    assert_eq!(usize::try_from(skipped), Ok(capture.len() - 25));
    let text = stdout(&run_with_input(&["decode", "--direction", "outgoing", "--summary"], &capture));
    assert!(text.contains("CMD_READ_PARAMS (82) outgoing: 4 frames, 25 bytes, 1 undecoded\n"), "{text}");
}

#[test]
fn files_and_pipes_are_the_same() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("capture.bin");
    std::fs::write(&path, damaged()).unwrap();
    let from_file = run(&["decode", path.to_str().unwrap()]);
    assert_eq!(stdout(&from_file), stdout(&run_with_input(&["decode", "-"], &damaged())));

    let missing = run(&["decode", "/nowhere/capture.bin"]);
    assert_eq!(missing.status.code(), Some(1));
    assert!(stderr(&missing).contains("/nowhere/capture.bin"), "{}", stderr(&missing));
}

#[test]
fn what_is_no_hex_is_named_with_its_place() {
    let output = run_with_input(&["decode", "--from", "hex"], b"3E 52 01 53 01 01\n3E zz");
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("line 2, column 4: 'z'"), "{}", stderr(&output));
    assert!(stdout(&output).contains("CMD_READ_PARAMS"), "what came before is shown");
}

#[test]
fn logs_of_both_kinds_are_read() {
    let log = "12:00:01.250 out: [82,1] 01\n\
               12:00:01.300 in: [67,2] 5D FF\n\
               not a line of a log\n\
               99 port1.in: [82,1] 04\n\
               99 port1.in: [82,2] 04\n";
    let objects = objects(&run_with_input(&["decode", "--json"], log.as_bytes()));
    let kinds: Vec<_> = objects
        .iter()
        .map(|object| (object["at"].as_u64().unwrap(), object["kind"].as_str().unwrap()))
        .collect();
    assert_eq!(kinds, [(1, "frame"), (2, "frame"), (3, "skipped"), (4, "frame"), (5, "skipped")]);
    assert_eq!(objects[1]["name"], "CMD_CONFIRM");
    assert_eq!(objects[1]["version"], Value::Null);
    assert_eq!(objects[3]["direction"], "outgoing");
}

#[test]
fn answers_are_read_with_their_request_in_mind() {
    // A request for the angles of the IMU, then the answer: time stamp, ROLL 90, PITCH 0, YAW -45 degrees.
    let log = "1 out: [88,10] 01000000000000000000\n1 in: [88,8] 10270010000000F8\n";
    let objects = objects(&run_with_input(&["decode", "--json"], log.as_bytes()));
    let values: Vec<_> =
        objects[1]["fields"].as_array().unwrap().iter().map(|field| field["value"].clone()).collect();
    assert_eq!(values, [json!(10_000), json!(90.0), json!(0.0), json!(-45.0)]);

    let alone = "1 in: [88,8] 10270010000000F8\n";
    let raw = run_with_input(&["decode", "--json"], alone.as_bytes());
    assert_eq!(common::objects(&raw)[0]["fields"][1]["raw"], "0010000000f8");
    let told = run_with_input(&["decode", "--json", "--custom-flags", "0x1"], alone.as_bytes());
    assert_eq!(common::objects(&told)[0]["fields"], objects[1]["fields"]);
}

#[test]
fn chosen_debug_variables_are_read_with_the_request_and_their_description() {
    // Three variables described: u8, i16, float; then the first and the third asked for.
    let log = "1 in: [253,16] 03 0141010000 0142040000 0143070000\n\
               2 out: [254,4] 05000000\n\
               3 in: [254,9] 05000000 2A 0000803F\n";
    let objects = objects(&run_with_input(&["decode", "--json", "--from", "log"], log.as_bytes()));
    let last = objects.last().unwrap();
    assert_eq!(last["form"], "masked", "{last}");
    let shown: Vec<_> = last["fields"]
        .as_array()
        .unwrap()
        .iter()
        .map(|field| (field["path"].as_str().unwrap(), field["offset"].clone(), field["value"].clone()))
        .collect();
    assert_eq!(
        shown,
        [
            ("selected_mask[0]", json!(0), json!(5)),
            ("var_value[0]", json!(4), json!(42)),
            ("var_value[2]", json!(5), json!(1.0)),
        ]
    );
}

#[test]
fn what_cannot_be_decoded_is_shown_as_fully_as_what_can() {
    let frame = b"3E 56 03 59 01 02 03 06";
    let output = run_with_input(&["decode", "--json", "--direction", "incoming"], frame);
    assert!(output.status.success());
    let objects = objects(&output);
    let error = objects[0]["error"].as_str().unwrap();
    assert!(error.contains('3') && error.contains("18"), "both lengths are said: {error}");
    assert_eq!(
        objects,
        [json!({
            "kind": "undecoded", "at": 0, "version": 1, "direction": "incoming", "id": 86, "name": "CMD_BOARD_INFO",
            "length": 3, "payload": "010203", "error": error,
        })]
    );
    let keys: Vec<&String> = objects[0].as_object().unwrap().keys().collect();
    assert_eq!(keys, ["kind", "at", "version", "direction", "id", "name", "length", "payload", "error"]);
    let text = stdout(&run_with_input(&["decode", "--direction", "incoming"], frame));
    assert!(text.starts_with("0: CMD_BOARD_INFO (86) incoming, undecoded, 3 bytes, version 1\n"), "{text}");
    assert!(text.contains("payload 010203\n"), "{text}");

    let unknown = common::objects(&run_with_input(&["decode", "--json"], b"3E C8 01 C9 05 05"));
    assert_eq!((&unknown[0]["name"], &unknown[0]["form"]), (&Value::Null, &json!("unknown")));
    assert_eq!(unknown[0]["fields"][0]["raw"], "05");
}

/// Example frames of all commands, made independently of this program.
const VECTORS: &str = include_str!("../../sbgc-proto/tests/protocol/vectors.jsonl");

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect::<Vec<_>>().concat()
}

/// The line of a log that says how to read the payload of `example`.
fn what_came_before(example: &Value) -> String {
    let context = &example["context"];
    if let Some(flags) = context["request_flags"].as_u64() {
        // A stream of CAN telemetry with these flags.
        let mut registration = vec![127, 100, 0];
        registration.extend(u32::try_from(flags).unwrap().to_le_bytes());
        registration.resize(21, 0);
        return format!("0 out: [85,21] {}\n", hex(&registration));
    }
    let kinds = context["var_types"].as_array().expect("no other context is known");
    let mut description = vec![u8::try_from(kinds.len()).unwrap()];
    for kind in kinds {
        description.extend([0, u8::try_from(kind.as_u64().unwrap()).unwrap(), 0, 0]);
    }
    format!("0 in: [253,{}] {}\n", description.len(), hex(&description))
}

#[test]
fn every_example_that_needs_its_request_is_read_with_it() {
    let examples = VECTORS.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let mut checked = 0;
    for example in examples.filter(|example| example.get("context").is_some()) {
        let payload = example["payload"].as_str().unwrap();
        let log = format!(
            "{}0 in: [{},{}] {payload}\n",
            what_came_before(&example),
            example["cmd_id"],
            payload.len() / 2
        );
        let decoded = objects(&run_with_input(&["decode", "--from", "log", "--json"], log.as_bytes()));
        let fields = decoded[1]["fields"].as_array().unwrap();
        let expected = example["fields"].as_array().unwrap();
        assert_eq!(fields.len(), expected.len(), "{log}");
        for (field, expected) in fields.iter().zip(expected) {
            for key in ["offset", "size", "type", "raw"] {
                assert_eq!(field[key], expected[key], "{key} of {}: {log}", expected["field"]);
            }
        }
        checked += 1;
    }
    assert_eq!(checked, 36);
}

#[test]
fn frames_are_shown_while_the_pipe_stays_open() {
    use std::io::{BufRead as _, Write as _};
    use std::process::Stdio;

    let mut command = common::sbgc();
    command.args(["decode", "--json"]).stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    let mut lines = std::io::BufReader::new(child.stdout.take().unwrap()).lines();
    for profile in [1, 2] {
        input.write_all(&[0x3E, 0x52, 0x01, 0x53, profile, profile]).unwrap();
        let shown: Value = serde_json::from_str(&lines.next().unwrap().unwrap()).unwrap();
        assert_eq!(shown["fields"][0]["raw"], profile);
    }
    // A false start that announces 200 bytes hides the next frame until the gap that ends it.
    input.write_all(&[0x24, 0x20, 0xC8, 0xE8, 0x3E, 0x52, 0x01, 0x53, 4, 4]).unwrap();
    let shown = loop {
        let shown: Value = serde_json::from_str(&lines.next().unwrap().unwrap()).unwrap();
        if shown["kind"] == "frame" {
            break shown;
        }
    };
    assert_eq!(shown["at"], 16);
    // Whoever reads has had enough.
    drop(lines);
    let _ = input.write_all(&[0x3E, 0x52, 0x01, 0x53, 3, 3]);
    drop(input);
    assert_eq!(child.wait().unwrap().code(), Some(0));
}
