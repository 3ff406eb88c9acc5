//! `sbgc sim` and the addresses of simulated boards.

mod common;

use std::fs;
use std::io::{ErrorKind, Read, Write};
use std::net::TcpStream;
use std::time::Duration;

use common::{Served, objects, run, stderr, stdout};

/// A client of a board, which says nothing by itself.
fn client(served: &Served) -> TcpStream {
    let line = TcpStream::connect(served.port().trim_start_matches("tcp://")).unwrap();
    line.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
    line
}

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

/// The active profile as a client sees it.
fn profile(served: &Served) -> serde_json::Value {
    let profiles = objects(&served.run(&["--json", "profile", "list"]));
    profiles.into_iter().find(|profile| profile["active"] == true).unwrap()["profile"].clone()
}

#[test]
fn clients_have_boards_of_their_own_unless_they_share_one() {
    for (options, expected) in [(&[][..], 1), (&["--shared"], 4)] {
        let served = Served::start(&[&["--tcp", "127.0.0.1:0"], options].concat());
        assert!(served.run(&["profile", "use", "4"]).status.success());
        assert_eq!(profile(&served), expected, "{options:?}");
    }
}

#[test]
fn idle_clients_hold_up_nobody() {
    for options in [&[][..], &["--shared"]] {
        let served = Served::start(&[&["--tcp", "127.0.0.1:0"], options].concat());
        let idle: Vec<_> = (0..20).map(|_| client(&served)).collect();
        assert!(served.run(&["--timeout", "2s", "info"]).status.success(), "{options:?}");
        drop(idle);
    }
}

#[test]
fn a_client_that_never_reads_is_obeyed_and_disturbs_nobody() {
    let served = Served::start(&["--tcp", "127.0.0.1:0", "--shared", "--line", "any"]);
    let mut deaf = client(&served);
    // Half a minute's worth of answers that nobody fetches, and then a command.
    for _ in 0..3000 {
        deaf.write_all(&[0x3E, 25, 0, 25, 0]).unwrap();
    }
    for _ in 0..50 {
        // It may come while others still fill the buffer.
        deaf.write_all(&[0x3E, 69, 1, 70, 3, 3]).unwrap();
        if profile(&served) == 3 {
            return;
        }
    }
    panic!("it was not obeyed");
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    let said = |seed: &str| {
        let served = Served::start(&["--tcp", "127.0.0.1:0", "--seed", seed]);
        let mut line = client(&served);
        let mut said = Vec::new();
        for _ in 0..5 {
            line.write_all(&[0x3E, 23, 0, 23, 0]).unwrap();
            let mut answer = [0; 68];
            line.read_exact(&mut answer).unwrap();
            // Sensors: the battery and others follow the clock.
            said.extend_from_slice(&answer[4..16]);
        }
        said
    };
    assert_eq!(said("7"), said("7"));
    assert_ne!(said("7"), said("8"));
}

#[test]
fn each_fault_does_what_it_is_called() {
    let with = |fault: &str| Served::start(&["--tcp", "127.0.0.1:0", "--fault", fault]);
    let code = |served: &Served, arguments: &[&str]| served.run(arguments).status.code();
    for fault in ["corrupt=1", "corrupt:in=1", "drop:in=1", "stall=0s/60s", "delay=2s", "delay:in=2s"] {
        assert_eq!(code(&with(fault), &["--timeout", "300ms", "info"]), Some(3), "{fault}");
    }
    for fault in ["duplicate=1", "duplicate:in=1", "delay=5ms", "reset=60s", "unplug=60s/1s"] {
        assert_eq!(code(&with(fault), &["info"]), Some(0), "{fault}");
    }
    let silent = with("no-confirm");
    assert_eq!(code(&silent, &["info"]), Some(0));
    assert_eq!(code(&silent, &["--timeout", "300ms", "motors", "off"]), Some(3));
    let broken = with("sensor");
    let sample = objects(&broken.run(&["--json", "stream", "realtime3", "--count", "1"])).remove(0);
    assert_eq!(sample["system_sub_error"], "SUB_ERR_IMU_SENSOR_NOT_RESPONDING", "{sample}");
    assert_eq!(code(&broken, &["motors", "on"]), Some(4), "not without a sensor");
    let unplugged = with("unplug=300ms/60s");
    let ended = client(&unplugged).read(&mut [0]);
    assert!(matches!(&ended, Ok(0)) || ended.is_err_and(|error| error.kind() == ErrorKind::ConnectionReset));
    let refused = TcpStream::connect(unplugged.port().trim_start_matches("tcp://"));
    assert!(refused.is_err(), "{refused:?}");
}

#[test]
fn a_reset_is_announced_to_who_is_there() {
    let served = Served::start(&["--tcp", "127.0.0.1:0", "--fault", "reset=200ms"]);
    let mut notice = [0; 5];
    client(&served).read_exact(&mut notice).unwrap();
    assert_eq!(notice, [0x3E, 114, 0, 114, 0]);
}

#[test]
fn what_cannot_be_meant_is_refused() {
    for wrong in [
        &["--fault", "drop=2"][..],
        &["--fault", "no-confirm=1"],
        &["--fault", "unplug=5s"],
        &["--fault", "reset"],
        &["--link", "/tmp/gimbal"],
        &["--pty"],
        &["--line", "0"],
    ] {
        let refused = run(&[&["sim", "--tcp", "127.0.0.1:0"], wrong].concat());
        assert_eq!(refused.status.code(), Some(2), "{wrong:?}");
    }
    assert_eq!(run(&["sim"]).status.code(), Some(2));
    assert_eq!(run(&["sim", "--pty", "--shared"]).status.code(), Some(2));
    let served = Served::start(&["--tcp", "127.0.0.1:0"]);
    let second = run(&["sim", "--tcp", served.port().trim_start_matches("tcp://")]);
    assert_eq!(second.status.code(), Some(1), "the address is in use");
}

#[cfg(unix)]
#[test]
fn the_link_to_the_terminal_goes_with_the_program_and_replaces_no_file() {
    let directory = tempfile::tempdir().unwrap();
    let link = directory.path().join("gimbal");
    let path = link.to_str().unwrap();
    for signal in ["TERM", "INT", "HUP"] {
        let served = Served::start(&["--pty", "--link", path]);
        assert!(link.is_symlink() && run(&["--port", path, "info"]).status.success());
        assert_eq!(served.end(signal), Some(0), "{signal}");
        assert!(!link.is_symlink(), "{signal}");
    }
    // What a killed one has left is replaced.
    drop(Served::start(&["--pty", "--link", path]));
    assert!(link.is_symlink());
    let served = Served::start(&["--pty", "--link", path]);
    assert!(run(&["--port", path, "info"]).status.success());
    drop(served);
    fs::remove_file(&link).unwrap();
    fs::write(&link, b"mine").unwrap();
    assert_eq!(run(&["sim", "--pty", "--link", path]).status.code(), Some(1));
    assert_eq!(fs::read(&link).unwrap(), b"mine");
}
