//! `sbgc encode` is the inverse of `sbgc decode`.

mod common;

use common::{objects, run, run_with_input, stderr, stdout};
use serde_json::Value;

#[test]
fn names_and_values_become_a_frame() {
    let output = run(&["--protocol", "1", "encode", "CMD_READ_PARAMS", "profile_id=PROFILE_2"]);
    assert_eq!(stdout(&output), "3E 52 01 53 01 01\n", "{}", stderr(&output));
    let output = run(&["encode", "read_params", "PROFILE_ID=1", "--json"]);
    assert_eq!(objects(&output)[0]["frame"], "245201530112 3d".replace(' ', ""));
}

#[test]
fn as_json_it_is_what_decode_shows_and_the_bytes() {
    for arguments in [
        &["READ_PARAMS_3", "profile_id=PROFILE_2"][..],
        &["CONFIRM", "cmd_id=77", "--direction", "incoming"],
        &["200", "payload=0102"],
    ] {
        let mut built = objects(&run(&[&["--json", "encode"], arguments].concat())).remove(0);
        let frame = built.as_object_mut().unwrap().remove("frame").unwrap();
        let direction = built["direction"].as_str().unwrap();
        let decode = ["--json", "decode", "--direction", direction];
        let decoded = objects(&run_with_input(&decode, frame.as_str().unwrap().as_bytes())).remove(0);
        assert_eq!(built, decoded, "{arguments:?}");
    }
}

/// Leaving fields out never deletes, sets up or picks the form of old firmware.
#[test]
fn without_a_form_the_default_one_is_built() {
    for (name, form, payload_length) in
        [("BOARD_INFO", "simple", 0), ("ADJ_VARS_STATE", "extended", 7), ("CONTROL", "extended", 15)]
    {
        let message = &objects(&run(&["--json", "encode", name]))[0];
        assert_eq!(message["form"], form, "{name}");
        assert_eq!(message["frame"].as_str().unwrap().len() / 2, payload_length + 6, "{name}");
    }
    // Without data it would be the frame that deletes the file.
    let output = run(&["encode", "WRITE_FILE", "file_id=0x0201"]);
    assert_eq!(output.status.code(), Some(2), "{}", stdout(&output));
    let output = run(&["--json", "encode", "WRITE_FILE", "file_id=0x0201", "data=ff"]);
    assert_eq!(objects(&output)[0]["form"], "write");
}

#[test]
fn mistakes_are_named() {
    for (arguments, expected) in [
        (&["encode", "NOTHING"][..], "unknown outgoing command \"NOTHING\""),
        (&["encode", "CMD_READ_PARMAS"], "did you mean READ_PARAMS"),
        (&["encode", "READ_PARAMS", "profil=1"], "unknown field \"profil\"; did you mean profile_id?"),
        (&["encode", "CONTROL", "axes.pich.angle=1"], "unknown part \"pich\"; did you mean pitch?"),
        (&["encode", "READ_PARAMS", "profile_id=300"], "profile_id=300: out of range; expected 0 to 255"),
        (&["encode", "READ_PARAMS", "profile_id=1.5"], "1.5: the field cannot hold this value exactly"),
        (&["encode", "CONTROL", "axes.yaw.angle=721"], "out of range; expected -720 to 719.978 deg"),
        (&["encode", "READ_PARAMS", "profile_id"], "expected FIELD=VALUE, got \"profile_id\""),
        (&["encode", "CONTROL", "--form", "other"], "no form \"other\"; available: legacy, extended"),
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains(expected), "{arguments:?}: {}", stderr(&output));
    }
}

#[test]
fn values_outside_of_their_documented_range_are_taken_with_a_warning() {
    let output = run(&["--protocol", "1", "encode", "I2C_READ_REG_BUF", "data_len=0"]);
    assert_eq!(stdout(&output), "3E 28 03 2B 00 00 00 00\n");
    assert_eq!(stderr(&output), "warning: data_len=0: out of range; expected 1 to 255 byte\n");
    let output = run(&["encode", "I2C_READ_REG_BUF", "data_len=256"]);
    assert_eq!(output.status.code(), Some(2), "the wire cannot hold it");
}

/// The field as an argument that gives it back: what is printed as its value, or else its raw number or bytes.
fn argument(field: &Value) -> String {
    let printed = if field["value"].is_null() { &field["raw"] } else { &field["value"] };
    let value = printed.as_str().map_or_else(|| printed.to_string(), str::to_owned);
    format!("{}={value}", field["path"].as_str().unwrap())
}

/// Example frames of all commands, made independently of this program.
const VECTORS: &str = include_str!("../../sbgc-proto/tests/protocol/vectors.jsonl");

/// All of them are tried without starting a program for each in the tests of the command itself.
#[test]
fn examples_are_decoded_and_encoded_to_the_same_bytes() {
    let vectors: Vec<Value> = VECTORS.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    assert!(vectors.len() > 400);
    let mut checked = 0;
    for direction in ["outgoing", "incoming"] {
        let frames: Vec<&str> = vectors
            .iter()
            .filter(|vector| vector["direction"] == direction)
            .map(|vector| vector["frame"].as_str().unwrap())
            .collect();
        let decoded = run_with_input(
            &["decode", "--from", "hex", "--json", "--direction", direction],
            frames.join("\n").as_bytes(),
        );
        let decoded = objects(&decoded);
        assert_eq!(decoded.len(), frames.len());
        for (message, frame) in decoded.iter().zip(frames).step_by(9) {
            assert_eq!(message["kind"], "frame", "{message}");
            let version = message["version"].to_string();
            let mut arguments = vec!["--json", "--protocol", &version, "encode", "--direction", direction];
            let (name, form) = (message["name"].as_str().unwrap(), message["form"].as_str().unwrap());
            arguments.extend([name, "--form", form]);
            let fields: Vec<String> = message["fields"].as_array().unwrap().iter().map(argument).collect();
            arguments.extend(fields.iter().map(String::as_str));
            let output = run(&arguments);
            assert!(output.status.success(), "{arguments:?}: {}", stderr(&output));
            assert_eq!(objects(&output)[0]["frame"], frame, "{name} {form}");
            checked += 1;
        }
    }
    assert!(checked > 50);
}
