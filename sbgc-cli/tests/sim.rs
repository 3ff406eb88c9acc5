//! `sbgc sim` and the addresses of simulated boards.

mod common;

use std::fs;

use common::{Served, objects, run, stderr, stdout};

#[test]
fn a_board_with_a_state_remembers() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("state");
    let port = format!("sim:{}", file.display());
    assert!(run(&["--port", &port, "profile", "use", "4"]).status.success());
    let profiles = objects(&run(&["--port", &port, "--json", "profile", "list"]));
    let active: Vec<_> = profiles.iter().filter(|profile| profile["active"] == true).collect();
    assert_eq!((active.len(), &active[0]["profile"]), (1, &4.into()), "{profiles:?}");
    // The one that is fresh each time has not heard of it.
    let fresh = objects(&run(&["--port", "sim", "--json", "profile", "list"]));
    assert_eq!(fresh[0]["active"], true);
}

#[test]
fn a_state_is_used_once_at_a_time_and_a_broken_one_is_left_alone() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("state");
    let path = file.to_str().unwrap();
    let served = Served::start(&["--tcp", "127.0.0.1:0", "--state", path]);
    let second = run(&["sim", "--tcp", "127.0.0.1:0", "--state", path]);
    assert_eq!(second.status.code(), Some(1));
    assert!(stderr(&second).contains("in use by another"), "{}", stderr(&second));
    drop(served);
    for broken in [&b""[..], b"something else"] {
        fs::write(&file, broken).unwrap();
        let refused = run(&["sim", "--tcp", "127.0.0.1:0", "--state", path]);
        assert_eq!(refused.status.code(), Some(1), "{}", stderr(&refused));
        assert_eq!(run(&["--port", &format!("sim:{path}"), "info"]).status.code(), Some(1));
        assert_eq!(fs::read(&file).unwrap(), broken);
    }
}

#[test]
fn what_it_behaves_as_and_what_goes_wrong_are_options() {
    let old = Served::start(&["--tcp", "127.0.0.1:0", "--firmware", "2.68"]);
    assert!(stdout(&old.run(&["info"])).contains("2.68"));
    let dead = Served::start(&["--tcp", "127.0.0.1:0", "--fault", "drop=1", "--seed", "7"]);
    assert_eq!(dead.run(&["--timeout", "200ms", "info"]).status.code(), Some(3));
    for wrong in [&["--fault", "melt"][..], &["--fault", "drop"], &["--line", "fast"], &["--firmware", "1.0"]]
    {
        let refused = run(&[&["sim", "--tcp", "127.0.0.1:0"], wrong].concat());
        assert_eq!(refused.status.code(), Some(2), "{wrong:?}");
    }
}

#[cfg(unix)]
#[test]
fn a_client_with_another_bit_rate_gets_no_frame() {
    let served = Served::start(&["--pty", "--line", "57600"]);
    assert_eq!(served.run(&["--timeout", "200ms", "info"]).status.code(), Some(3));
    assert!(served.run(&["--baud", "57600", "info"]).status.success());
    let any = Served::start(&["--pty", "--line", "any"]);
    for baud in ["9600", "256000"] {
        assert!(any.run(&["--baud", baud, "info"]).status.success(), "{baud}");
    }
}
