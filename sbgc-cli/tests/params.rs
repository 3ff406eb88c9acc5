//! Parameters, profiles and adjustable variables by the program itself, against a board on a pseudo-terminal.
#![cfg(unix)]

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use common::{Board, Served, sbgc, stderr, stdout};
use serde_json::Value;

/// A board, and the program with a state directory of its own.
struct Bench {
    board: Board,
    home: tempfile::TempDir,
}

impl Bench {
    fn new() -> Self {
        Bench { board: Board::start(), home: tempfile::tempdir().unwrap() }
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = sbgc();
        command.env("XDG_STATE_HOME", self.home.path());
        command.args(["--port", &self.board.port()]).args(arguments);
        command.stdin(std::process::Stdio::null());
        command
    }

    fn run(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }

    /// Runs it, which must work.
    fn succeed(&self, arguments: &[&str]) -> Output {
        let output = self.run(arguments);
        assert!(output.status.success(), "{arguments:?}: {}", stderr(&output));
        output
    }

    fn objects(&self, arguments: &[&str]) -> Vec<Value> {
        let mut arguments = arguments.to_vec();
        arguments.push("--json");
        common::objects(&self.succeed(&arguments))
    }

    /// Runs it, which must end with this code.
    fn fail(&self, code: i32, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
        stderr(&output)
    }

    fn value(&self, name: &str) -> Value {
        self.objects(&["params", "get", name])[0]["value"].clone()
    }

    fn backups(&self) -> Vec<PathBuf> {
        let entries = fs::read_dir(self.home.path().join("sbgc/backup")).into_iter().flatten();
        entries.map(|entry| entry.unwrap().path()).collect()
    }

    fn file(&self, name: &str) -> PathBuf {
        self.home.path().join(name)
    }
}

fn keys(object: &Value) -> Vec<&str> {
    object.as_object().unwrap().keys().map(String::as_str).collect()
}

const KEYS: [&str; 9] = ["path", "block", "spec", "value", "unit", "raw", "label", "min", "max"];

#[test]
fn parameters_are_listed_shown_and_described() {
    let bench = Bench::new();
    let all = bench.objects(&["params", "list"]);
    assert!(all.len() > 350, "{}", all.len());
    assert!(all.iter().all(|object| keys(object) == KEYS));
    let blocks: std::collections::BTreeSet<_> =
        all.iter().map(|object| object["block"].as_str().unwrap()).collect();
    assert_eq!(blocks.len(), 4, "{blocks:?}");
    let mut paths: Vec<_> = all.iter().map(|object| object["path"].as_str().unwrap()).collect();
    paths.sort_unstable();
    assert!(paths.windows(2).all(|pair| pair[0] != pair[1]), "one namespace");

    let memory = bench.objects(&["params", "get", "RC_MEMORY"]);
    assert_eq!(memory.len(), 3);
    assert_eq!((&memory[0]["unit"], &memory[0]["spec"]), (&"deg".into(), &"RC_MEMORY".into()));
    let trust = &bench.objects(&["params", "get", "gyro_trust"])[0];
    assert_eq!((&trust["value"], &trust["raw"], &trust["unit"]), (&120.into(), &120.into(), &Value::Null));
    bench.succeed(&["params", "set", "bat_comp_ref=12600mV", "--yes"]);
    let text = stdout(&bench.succeed(&["params", "get", "gyro_trust", "bat_comp_ref"]));
    assert_eq!(text, "gyro_trust = 120\nbat_comp_ref = 12.6 V\n");
    assert!(stdout(&bench.succeed(&["params", "list", "motors.*.p"])).starts_with("motors.roll.p   "));

    let described = common::objects(&common::run(&["params", "describe", "servo_rate", "--json"]));
    assert_eq!(keys(&described[0]), KEYS);
    assert_eq!((&described[0]["value"], &described[0]["max"]), (&Value::Null, &400.into()));
    let text = stdout(&common::run(&["params", "describe", "follow_mode"]));
    assert!(text.contains("FOLLOW_MODE of CMD_READ_PARAMS_3, u8") && text.contains("values: "), "{text}");

    let error = bench.fail(2, &["params", "get", "servo_rat"]);
    assert!(error.contains("\"servo_rat\"") && error.contains("servo_rate"), "{error}");
    let error = bench.fail(2, &["params", "list", "nothing.*"]);
    assert!(error.contains("nothing.*"), "{error}");
}

#[test]
fn writes_are_shown_confirmed_backed_up_and_verified() {
    let bench = Bench::new();
    let set = ["params", "set", "rc_memory.pitch=-30deg", "gyro_trust=77"];
    // Nobody can be asked.
    let error = bench.fail(5, &set);
    assert!(
        error.contains("rc_memory.pitch: 0 deg -> -29.99 deg") && error.contains("gyro_trust: 120 -> 77"),
        "{error}"
    );
    assert_eq!(bench.value("gyro_trust"), 120);
    assert!(bench.backups().is_empty());

    let with_yes = |more: &[&str]| {
        let mut arguments = set.to_vec();
        arguments.extend(more);
        bench.succeed(&arguments)
    };
    let frames = stdout(&with_yes(&["--dry-run"]));
    assert!(frames.lines().count() >= 1 && frames.starts_with("24 "), "{frames}");
    assert_eq!(bench.value("gyro_trust"), 120);
    let frames = common::objects(&with_yes(&["--dry-run", "--yes", "--json"]));
    assert!(frames.iter().all(|frame| keys(frame) == ["name", "id", "frame"]), "{frames:?}");
    assert!(frames.iter().any(|frame| frame["name"] == "CMD_WRITE_PARAMS_3" && frame["id"] == 22));

    let output = with_yes(&["--yes", "--json"]);
    let objects = common::objects(&output);
    assert_eq!(objects.len(), 2);
    assert_eq!(keys(&objects[0]), ["path", "before", "after", "verified"]);
    let trust = objects.iter().find(|object| object["path"] == "gyro_trust").unwrap();
    assert_eq!(
        (&trust["before"], &trust["after"], &trust["verified"]),
        (&120.into(), &77.into(), &true.into())
    );
    assert_eq!(bench.value("gyro_trust"), 77);
    let pitch = bench.value("rc_memory.pitch").as_f64().unwrap();
    assert!((pitch + 30.0).abs() < 0.02, "{pitch}");

    let backups = bench.backups();
    assert_eq!(backups.len(), 1);
    assert!(stderr(&output).contains(backups[0].to_str().unwrap()), "{}", stderr(&output));
    assert!(fs::read_to_string(&backups[0]).unwrap().contains("gyro_trust = 120\n"));

    // The second time nothing is left to write.
    let again = with_yes(&[]);
    assert!(stdout(&again).is_empty() && stderr(&again).contains("nothing to change"));
    assert_eq!(bench.backups().len(), 1);

    // Another profile is another matter.
    bench.succeed(&["params", "set", "gyro_trust=5", "--profile", "3", "--yes"]);
    assert_eq!(bench.value("gyro_trust"), 77);
    assert_eq!(bench.objects(&["params", "get", "gyro_trust", "--profile", "3"])[0]["value"], 5);
}

#[test]
fn bad_input_is_wrong_usage_and_says_what_would_be_right() {
    let bench = Bench::new();
    for (argument, parts) in [
        ("servo_rate=5000", &["servo_rate", "5000", "50 to 400 Hz"][..]),
        ("servo_rat=50", &["\"servo_rat\"", "servo_rate"]),
        ("rc_memory=3", &["rc_memory.roll", "rc_memory.pitch", "rc_memory.yaw"]),
        ("rc_memory.yaw=3V", &["expected a value in deg", "\"V\""]),
        ("gyro_trust=high", &["gyro_trust", "high"]),
        ("cur_profile_id=2", &["cur_profile_id", "cannot be written"]),
        ("gyro_trust", &["NAME=VALUE"]),
        ("gyro_trust=256", &["0 to 255"]),
    ] {
        let error = bench.fail(2, &["params", "set", argument, "--yes"]);
        assert!(parts.iter().all(|part| error.contains(part)), "{argument}: {error}");
    }
    let output = bench.run(&["params", "set", "servo_rate=5000", "--yes", "--json"]);
    let error: Value = serde_json::from_str(stderr(&output).trim()).unwrap();
    assert_eq!((&error["error"]["kind"], &error["error"]["code"]), (&"usage".into(), &2.into()));
    bench.fail(2, &["params", "set", "gyro_trust=1", "--profile", "6", "--yes"]);
    bench.fail(2, &["params", "set", "gyro_trust=1", "gyro_trust=2", "--yes"]);
    assert!(bench.backups().is_empty());
}

#[test]
fn a_dump_with_one_line_changed_restores_that_line() {
    let bench = Bench::new();
    let path = bench.file("gimbal.toml");
    let file = path.to_str().unwrap();
    bench.succeed(&["params", "dump", file, "--profile", "all"]);
    assert!(bench.objects(&["params", "diff", file]).is_empty());

    let text = fs::read_to_string(&path).unwrap();
    let at = text.find("[profile.4]\n").unwrap();
    let (before, after) = text.split_at(at);
    let line = after.lines().find(|line| line.starts_with("follow_range.yaw = ")).unwrap();
    fs::write(&path, format!("{before}{}", after.replacen(line, "follow_range.yaw = 45", 1))).unwrap();

    let objects = bench.objects(&["params", "diff", file]);
    assert_eq!(objects.len(), 1, "{objects:?}");
    assert_eq!(keys(&objects[0]), ["profile", "path", "a", "b", "unit"]);
    assert_eq!((&objects[0]["profile"], &objects[0]["path"]), (&4.into(), &"follow_range.yaw".into()));
    assert_eq!((&objects[0]["a"], &objects[0]["unit"]), (&45.into(), &"deg".into()));
    assert_eq!(bench.run(&["params", "diff", file, "--exit-code"]).status.code(), Some(1));
    assert_eq!(bench.run(&["params", "diff", file, file, "--exit-code"]).status.code(), Some(0));

    let error = bench.fail(5, &["params", "restore", file]);
    assert!(error.contains("profile 4: follow_range.yaw: ") && error.contains("-> 45 deg"), "{error}");
    let frames = bench.objects(&["params", "restore", file, "--dry-run"]);
    let written: Vec<_> = frames.iter().filter(|frame| frame["name"] != "CMD_WRITE_PARAMS_SET").collect();
    assert_eq!(written.len(), 1, "{frames:?}");
    assert_eq!(written[0]["name"], "CMD_WRITE_PARAMS_EXT2");

    let restored = bench.objects(&["params", "restore", file, "--yes"]);
    assert_eq!(restored.len(), 1);
    assert_eq!((&restored[0]["profile"], &restored[0]["b"]), (&4.into(), &45.into()));
    assert_eq!(bench.objects(&["params", "get", "follow_range.yaw", "--profile", "4"])[0]["value"], 45);
    assert!(bench.objects(&["params", "diff", file]).is_empty());
}

#[test]
fn files_are_checked_before_anything_is_sent() {
    let bench = Bench::new();
    let write = |text: &str| {
        let path = bench.file("bad.toml");
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    for (text, part) in [
        (
            "firmware = \"2.73.5\"\n[profile.1]\ngyro_trst = 3\n",
            "bad.toml:3: no parameter is called \"gyro_trst\"",
        ),
        (
            "firmware = \"2.73.5\"\n[profile.1]\ngyro_trust = 300\n",
            "bad.toml:3: gyro_trust = 300: out of range",
        ),
        ("firmware = \"2.73.5\"\n[profile.1\n", "bad.toml:2: "),
    ] {
        // No board is needed to see that.
        let output =
            sbgc().args(["--port", "/dev/null/none", "params", "restore", &write(text), "--yes"]).output();
        let output = output.unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(stderr(&output).contains(part), "{}", stderr(&output));
    }
    bench.fail(1, &["params", "restore", "/nonexistent.toml", "--yes"]);

    let other = write("firmware = \"2.68\"\n[profile.1]\ngyro_trust = 3\n");
    let error = bench.fail(1, &["params", "restore", &other, "--yes"]);
    assert!(error.contains("2.68") && error.contains("2.73") && error.contains("--force"), "{error}");
    assert_eq!(bench.value("gyro_trust"), 120);
    bench.succeed(&["params", "restore", &other, "--yes", "--force"]);
    assert_eq!(bench.value("gyro_trust"), 3);
    // One profile goes where it is told to.
    bench.succeed(&["params", "restore", &other, "--yes", "--force", "--profile", "5"]);
    assert_eq!(bench.objects(&["params", "get", "gyro_trust", "--profile", "5"])[0]["value"], 3);
}

#[test]
fn dumping_keeps_comments_and_replaces_files_as_a_whole() {
    let bench = Bench::new();
    let path = bench.file("mine.toml");
    let file = path.to_str().unwrap();
    bench.succeed(&["params", "dump", file]);
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace("gyro_trust = 120\n", "gyro_trust = 120  # drifts in the cold\n")).unwrap();
    bench.succeed(&["params", "set", "gyro_trust=90", "--yes"]);
    bench.succeed(&["params", "dump", file]);
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains("gyro_trust = 90  # drifts in the cold\n"), "{text}");

    // A dump that fails leaves the old one, and nothing beside it.
    let output = sbgc().args(["--port", "/dev/null/none", "params", "dump", file]).output().unwrap();
    assert!(!output.status.success());
    assert_eq!(fs::read_to_string(&path).unwrap(), text);
    let names: Vec<_> =
        fs::read_dir(bench.home.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert!(names.iter().all(|name| !name.to_string_lossy().contains("tmp")), "{names:?}");
    assert!(stdout(&bench.succeed(&["params", "dump"])).contains("\n[profile.1]\n"));
    assert!(bench.objects(&["params", "dump"])[0]["document"].is_string());
}

/// A dump that was cut short before its first table would otherwise pass for one without differences.
#[test]
fn a_file_without_parameters_is_refused() {
    let bench = Bench::new();
    let file = bench.file("empty.toml");
    let path = file.to_str().unwrap();
    for content in ["", "# gimbal\n", "firmware = \"2.73.5\"\n"] {
        fs::write(&file, content).unwrap();
        for command in ["diff", "restore"] {
            let message = bench.fail(2, &["params", command, path]);
            assert!(message.contains("empty.toml: no parameters"), "{message}");
        }
    }
}

#[test]
fn a_file_keeps_its_permissions_when_it_is_replaced() {
    use std::os::unix::fs::PermissionsExt as _;

    let bench = Bench::new();
    let file = bench.file("private.toml");
    fs::write(&file, "").unwrap();
    fs::set_permissions(&file, fs::Permissions::from_mode(0o600)).unwrap();
    bench.succeed(&["params", "dump", file.to_str().unwrap()]);
    let metadata = file.metadata().unwrap();
    assert_eq!((metadata.permissions().mode() & 0o777, metadata.len() > 100), (0o600, true));
}

#[test]
fn a_misspelled_beginning_gets_the_real_one() {
    let message = Bench::new().fail(2, &["adj", "config", "triger_slots[0]"]);
    assert!(message.contains("similar names: trigger_slots[0]"), "{message}");
}

#[test]
fn profiles_are_listed_switched_named_copied_and_reset() {
    let bench = Bench::new();
    let list = bench.objects(&["profile", "list"]);
    assert_eq!(list.len(), 5);
    assert!(list.iter().all(|object| keys(object) == ["profile", "name", "active"]));
    assert_eq!((&list[0]["active"], &list[1]["active"]), (&true.into(), &false.into()));

    let used = bench.objects(&["profile", "use", "2"]);
    assert_eq!((&used[0]["profile"], &used[0]["active"]), (&2.into(), &true.into()));
    assert_eq!(used.len(), 1);

    bench.fail(5, &["profile", "name", "2", "Heavy"]);
    let named = bench.objects(&["profile", "name", "2", "Heavy \u{1b}[31m lens", "--yes"]);
    assert_eq!(named[0]["name"], "Heavy \u{1b}[31m lens");
    let text = stdout(&bench.succeed(&["profile", "list"]));
    assert!(text.contains("* 2  Heavy \\u{1b}[31m lens\n"), "{text:?}");
    assert!(bench.fail(2, &["profile", "name", "2", &"x".repeat(49), "--yes"]).contains("48 bytes"));

    bench.succeed(&["params", "set", "gyro_trust=33", "--yes"]);
    bench.fail(5, &["profile", "copy", "2", "4"]);
    let differences = bench.objects(&["params", "diff", "profile:2", "profile:4"]);
    assert!(differences.iter().any(|object| object["path"] == "gyro_trust" && object["a"] == 33));
    assert!(differences.iter().all(|object| object["profile"].is_null()));
    let copied = bench.objects(&["profile", "copy", "2", "4", "--yes"]);
    assert_eq!((&copied[0]["profile"], &copied[0]["active"]), (&4.into(), &false.into()));
    assert!(bench.objects(&["params", "diff", "profile:2", "profile:4"]).is_empty());

    // A simulated board's factory values are known, those of a real one once it was reset.
    let changed = bench.objects(&["params", "diff", "defaults", "profile:2"]);
    assert!(changed.iter().any(|object| object["path"] == "gyro_trust" && object["b"] == 33), "{changed:?}");
    assert!(bench.objects(&["params", "diff", "defaults", "profile:3"]).is_empty());
    let real = common::boards::moody(common::boards::Mood::Refuses(1)).0;
    let output = common::run(&["--port", &real, "params", "diff", "defaults"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("profile reset"), "{}", stderr(&output));
    bench.fail(5, &["profile", "reset", "4"]);
    assert!(stdout(&bench.succeed(&["profile", "reset", "4", "--dry-run"])).starts_with("24 46 "));
    bench.succeed(&["profile", "reset", "4", "--yes"]);
    assert_eq!(bench.objects(&["params", "get", "gyro_trust", "--profile", "4"])[0]["value"], 120);
    let differences = bench.objects(&["params", "diff", "defaults"]);
    assert!(
        differences
            .iter()
            .any(|object| object["path"] == "gyro_trust" && object["b"] == 33 && object["a"] == 120)
    );
    assert!(bench.objects(&["params", "diff", "profile:4", "defaults"]).is_empty());
    bench.fail(2, &["profile", "use", "6"]);
}

#[test]
fn adjustable_variables_are_listed_set_and_saved() {
    let bench = Bench::new();
    let list = bench.objects(&["adj", "list"]);
    assert!(list.len() > 60, "{}", list.len());
    assert!(list.iter().all(|object| keys(object) == ["name", "id", "value", "min", "max", "unit"]));
    let set = bench.objects(&["adj", "set", "p_roll=41", "FRAME_HEADING_ANGLE=-30deg"]);
    assert_eq!(set.len(), 2);
    let got = bench.objects(&["adj", "get", "P_ROLL", "37"]);
    assert_eq!((&got[0]["value"], &got[1]["value"]), (&41.into(), &(-30).into()));
    assert!(bench.fail(2, &["adj", "set", "P_ROLL=900"]).contains("0 to 255"));
    assert!(bench.fail(2, &["adj", "get", "P_ROL"]).contains("P_ROLL"));
    bench.fail(2, &["adj", "set", "P_*=3"]);
    assert!(stdout(&bench.succeed(&["adj", "set", "P_ROLL=42", "--dry-run"])).starts_with("24 1F "));
    assert_eq!(bench.objects(&["adj", "get", "P_ROLL"])[0]["value"], 41);
    bench.fail(5, &["adj", "save", "P_ROLL"]);
    let saved = bench.objects(&["adj", "save", "P_ROLL", "--yes"]);
    assert_eq!((&saved[0]["name"], &saved[0]["value"]), (&"P_ROLL".into(), &41.into()));
}

#[test]
fn a_silent_board_is_an_exit_code_of_its_own() {
    let port = Path::new("/nonexistent/port");
    assert!(!port.exists());
    let bench = Bench::new();
    bench.board.signal("STOP");
    let silent = bench.run(&["--timeout", "50ms", "params", "set", "gyro_trust=3", "--yes"]);
    bench.board.signal("CONT");
    assert_eq!(silent.status.code(), Some(3), "{}", stderr(&silent));
}

const EXAMPLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../sbgc-host/tests/gui/example.profile");

#[test]
fn files_of_the_gui_are_compared_restored_and_filled() {
    let bench = Bench::new();
    let error = bench.fail(1, &["params", "restore", EXAMPLE, "--yes"]);
    assert!(error.contains("2.70") && error.contains("2.73") && error.contains("--force"), "{error}");

    let differences = bench.objects(&["params", "diff", EXAMPLE]);
    let profiles: std::collections::BTreeSet<_> =
        differences.iter().map(|object| object["profile"].as_u64()).collect();
    assert_eq!(profiles.into_iter().collect::<Vec<_>>(), [Some(1), Some(2)]);
    bench.fail(5, &["params", "restore", EXAMPLE, "--force"]);

    let output = bench.succeed(&["params", "restore", EXAMPLE, "--force", "--yes", "--json"]);
    assert_eq!(common::objects(&output).len(), differences.len());
    let talk = stderr(&output);
    for part in [
        "profile 1: not written without --include likely: ",
        "profile 1: not written without --include unit-specific: ",
        "profile 1: not written for this firmware: motors.roll.p",
        "not written: angleAccLimit3 (",
    ] {
        assert!(talk.contains(part), "{part:?} is not in: {talk}");
    }
    assert!(bench.objects(&["params", "diff", EXAMPLE]).is_empty());
    let more =
        bench.objects(&["params", "diff", EXAMPLE, "--include", "likely", "--include", "unit-specific"]);
    assert!(more.iter().any(|object| object["path"] == "rc_map_yaw"));
    assert!(more.iter().any(|object| object["path"] == "motors.yaw.poles"));
    // Signals of variables belong to no profile.
    assert!(
        more.iter()
            .any(|object| object["path"] == "trigger_slots[0].trigger_src_ch" && object["profile"].is_null())
    );

    // One profile goes where it is told to.
    let text = fs::read_to_string(EXAMPLE).unwrap();
    let start = text.find("<profile>").unwrap();
    let end = text.find("</profile>").unwrap() + "</profile>".len();
    let (before, after) = (text.find("<all-profiles>").unwrap(), text.find("</all-profiles>").unwrap());
    let single =
        format!("{}{}{}", &text[..before], &text[start..end], &text[after + "</all-profiles>".len()..]);
    let path = bench.file("one.profile");
    fs::write(&path, &single).unwrap();
    let file = path.to_str().unwrap();
    assert!(bench.objects(&["params", "diff", file, "--profile", "1"]).is_empty());
    let differences = bench.objects(&["params", "diff", file, "--profile", "4"]);
    assert!(!differences.is_empty() && differences.iter().all(|object| object["profile"] == 4));
    bench.succeed(&["params", "restore", file, "--profile", "4", "--force", "--yes"]);
    assert!(bench.objects(&["params", "diff", file, "profile:4"]).is_empty());

    // What is not understood refuses the whole file.
    fs::write(&path, single.replace("<gyroSens>58<", "<gyroSens>300<")).unwrap();
    let error = bench.fail(2, &["params", "restore", file, "--force", "--yes"]);
    assert!(error.contains("one.profile:") && error.contains("<gyroSens> 300: out of range"), "{error}");
    bench.fail(2, &["params", "restore", file, "--include", "everything"]);
}

#[test]
fn a_template_of_the_gui_takes_the_values_of_the_board() {
    let bench = Bench::new();
    let path = bench.file("out.profile");
    let out = path.to_str().unwrap();
    let dump = ["params", "dump", "--profile-template", EXAMPLE, out];
    bench.fail(1, &dump);
    assert!(!path.exists());
    bench.succeed(&["params", "set", "gyro_trust=83", "--profile", "2", "--yes"]);
    let output = bench.succeed(&[&dump[..], &["--force"]].concat());
    assert!(stderr(&output).contains("left as in the template: "), "{}", stderr(&output));
    let (filled, template) = (fs::read_to_string(&path).unwrap(), fs::read_to_string(EXAMPLE).unwrap());
    let second = filled.rfind("<profile>").unwrap();
    assert!(filled[second..].contains("<gyroTrust>83</gyroTrust>"));
    assert_eq!(filled.lines().count(), template.lines().count());
    assert!(bench.objects(&["params", "diff", out, "--include", "likely"]).is_empty());
    bench.fail(2, &["params", "dump", "--profile-template", EXAMPLE]);
}

/// A terminal for standard input: what is written to the first is read by the program that has the second.
fn terminal() -> (serialport::TTYPort, fs::File) {
    use serialport::SerialPort as _;

    let (master, slave) = serialport::TTYPort::pair().unwrap();
    let file = fs::OpenOptions::new().read(true).write(true).open(slave.name().unwrap()).unwrap();
    // The slave stays open until the program has its own.
    std::mem::forget(slave);
    (master, file)
}

/// Runs `params set gyro_trust=77` on a terminal and lets `answer` act once it asks.
fn asked(bench: &Bench, answer: impl FnOnce(&mut serialport::TTYPort, u32)) -> (Option<i32>, String) {
    use std::io::Read as _;

    let (mut master, input) = terminal();
    let mut command = bench.command(&["params", "set", "gyro_trust=77"]);
    command.stdin(input).stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut error = child.stderr.take().unwrap();
    let mut talk = Vec::new();
    let mut byte = [0];
    while !String::from_utf8_lossy(&talk).ends_with("[y/N] ") {
        assert_eq!(error.read(&mut byte).unwrap(), 1, "{}", String::from_utf8_lossy(&talk));
        talk.push(byte[0]);
    }
    answer(&mut master, child.id());
    let code = child.wait().unwrap().code();
    error.read_to_end(&mut talk).unwrap();
    (code, String::from_utf8(talk).unwrap())
}

#[test]
fn only_yes_is_yes() {
    use std::io::Write as _;

    let bench = Bench::new();
    for answer in ["\n", "n\n", "yep\n"] {
        let (code, talk) = asked(&bench, |terminal, _| terminal.write_all(answer.as_bytes()).unwrap());
        assert_eq!(code, Some(5), "{answer:?}: {talk}");
        assert!(
            talk.contains("gyro_trust: 120 -> 77") && talk.contains("Write 1 value in 1 block?"),
            "{talk}"
        );
    }
    let (code, talk) = asked(&bench, |_, id| {
        let sent = Command::new("kill").args(["-s", "INT", &id.to_string()]).status().unwrap();
        assert!(sent.success());
    });
    assert_eq!(code, Some(5), "{talk}");
    assert_eq!(bench.value("gyro_trust"), 120);
    assert!(bench.backups().is_empty());

    let (code, talk) = asked(&bench, |terminal, _| terminal.write_all(b"y\n").unwrap());
    assert_eq!(code, Some(0), "{talk}");
    assert_eq!((bench.value("gyro_trust"), bench.backups().len()), (77.into(), 1));
}

/// Passes bytes between one client on TCP and a board on a pseudo-terminal; after so many writes of parameter blocks
/// the line is dead. Returns the port for the client, and what ends when the board is free again.
fn failing_line(board: &Board, writes: usize) -> (String, std::thread::JoinHandle<()>) {
    use std::io::{Read as _, Write as _};

    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = format!("tcp://{}", listener.local_addr().unwrap());
    let serial = serialport::new(board.port(), 115_200).timeout(std::time::Duration::from_millis(20));
    let mut to_board = serial.open_native().unwrap();
    let relay = std::thread::spawn(move || {
        let (mut client, _) = listener.accept().unwrap();
        let over = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(false));
        let ended = std::sync::Arc::clone(&over);
        let mut from_board = serialport::SerialPort::try_clone(&to_board).unwrap();
        let mut to_client = client.try_clone().unwrap();
        let back = std::thread::spawn(move || {
            let mut buffer = [0; 512];
            while !ended.load(std::sync::atomic::Ordering::Relaxed) {
                match from_board.read(&mut buffer) {
                    Ok(count) if to_client.write_all(&buffer[..count]).is_err() => return,
                    Ok(_) => {}
                    Err(error) if error.kind() == std::io::ErrorKind::TimedOut => {}
                    Err(_) => return,
                }
            }
        });
        let (mut left, mut buffer) = (writes, [0; 512]);
        while let Ok(count @ 1..) = client.read(&mut buffer) {
            // Each batch of the driver begins with a frame; writes fill batches of their own.
            if [22, 34, 63, 105].contains(&buffer[1]) {
                if left == 0 {
                    break;
                }
                left -= 1;
            }
            to_board.write_all(&buffer[..count]).unwrap();
        }
        client.shutdown(std::net::Shutdown::Both).unwrap();
        over.store(true, std::sync::atomic::Ordering::Relaxed);
        back.join().unwrap();
    });
    (port, relay)
}

#[test]
fn an_interrupted_restore_is_completed_by_the_next() {
    let bench = Bench::new();
    let path = bench.file("gimbal.toml");
    let file = path.to_str().unwrap();
    bench.succeed(&["params", "dump", file]);
    let mut text = fs::read_to_string(&path).unwrap();
    for (name, value) in
        [("gyro_trust", "11"), ("beeper_volume", "12"), ("auto_speed", "13"), ("motor_startup_delay", "14")]
    {
        let line = text.lines().find(|line| line.starts_with(&format!("{name} = "))).unwrap().to_owned();
        text = text.replacen(&line, &format!("{name} = {value}"), 1);
    }
    fs::write(&path, text).unwrap();
    assert_eq!(bench.objects(&["params", "diff", file]).len(), 4);

    let (port, relay) = failing_line(&bench.board, 2);
    let mut command = sbgc();
    command.env("XDG_STATE_HOME", bench.home.path());
    let output = command.args(["--port", &port, "params", "restore", file, "--yes"]).output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    relay.join().unwrap();
    let talk = stderr(&output);
    let written = "written: CMD_READ_PARAMS_3 of profile 1, CMD_READ_PARAMS_EXT of profile 1; \
        not written: CMD_READ_PARAMS_EXT2 of profile 1, CMD_READ_PARAMS_EXT3 of profile 1; run the same command again";
    assert!(talk.contains(written), "{talk}");

    let left = bench.objects(&["params", "restore", file, "--yes"]);
    let paths: Vec<_> = left.iter().map(|object| object["path"].as_str().unwrap()).collect();
    assert_eq!(paths, ["auto_speed", "motor_startup_delay"]);
    assert!(bench.objects(&["params", "diff", file]).is_empty());
}

/// Runs a restore of 20 values in 20 blocks at a board that is unplugged after this time. Returns what it said and its
/// exit code.
fn unplugged(after: f64, file: &str, home: &Path) -> (Served, Output) {
    let fault = format!("unplug={after}s/4s");
    // Each answer takes a while, so that writing does, too.
    let board = Served::start(&["--pty", "--fault", "delay=30ms", "--fault", &fault]);
    let mut command = sbgc();
    command.env("XDG_STATE_HOME", home);
    command.args(["--port", board.port(), "--timeout", "150ms", "params", "restore", file, "--yes"]);
    let output = command.output().unwrap();
    (board, output)
}

#[test]
fn a_board_that_is_unplugged_half_way_is_restored_by_the_next_run() {
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("all.toml");
    let file = path.to_str().unwrap();
    assert!(common::run(&["--port", "sim", "params", "dump", file, "--profile", "all"]).status.success());
    let mut text = fs::read_to_string(&path).unwrap();
    for (name, value) in
        [("gyro_trust", "11"), ("beeper_volume", "12"), ("auto_speed", "13"), ("motor_startup_delay", "14")]
    {
        let line = text.lines().find(|line| line.starts_with(&format!("{name} = "))).unwrap().to_owned();
        text = text.replace(&line, &format!("{name} = {value}"));
    }
    fs::write(&path, text).unwrap();

    // How far it gets in a time depends on the machine, so the time is looked for.
    let mut after = 4.5;
    for _ in 0..20 {
        let (board, output) = unplugged(after, file, home.path());
        let talk = stderr(&output);
        if output.status.success() {
            after -= 0.5;
            continue;
        }
        // It was unplugged before anything was written.
        let begun = talk.split_once("written: ").filter(|_| !talk.contains("nothing was written"));
        let Some((_, outcome)) = begun else {
            after += 0.3;
            continue;
        };
        let Some((written, left)) = outcome.split_once("not written: ") else {
            // All was written, and then it could not be read back.
            assert!(talk.contains("could not be verified"), "{talk}");
            after -= 0.4;
            continue;
        };
        assert_eq!(output.status.code(), Some(3), "{talk}");
        assert!(left.contains("; run the same command again to complete it"), "{talk}");
        let (written, left) = (written.matches("CMD_").count(), left.matches(" of profile ").count());
        assert!(written > 0 && left > 0 && written + left == 20, "{talk}");
        // Until it is plugged in again.
        while !board.run(&["--timeout", "150ms", "info"]).status.success() {}
        let mut command = sbgc();
        command.env("XDG_STATE_HOME", home.path());
        let again = command.args(["--port", board.port(), "--json", "params", "restore", file, "--yes"]);
        let restored = common::objects(&again.output().unwrap());
        // Of the block on the way nobody knows whether it has arrived.
        assert!(restored.len() == left || restored.len() + 1 == left, "{} of {left}: {talk}", restored.len());
        let differences = common::objects(&board.run(&["params", "diff", file, "--json"]));
        assert!(differences.is_empty(), "{differences:?}");
        return;
    }
    panic!("it was never interrupted while it wrote");
}
