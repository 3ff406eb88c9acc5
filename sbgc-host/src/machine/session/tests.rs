//! The table, call by call.

use std::cell::Cell;
use std::rc::Rc;

use super::*;

#[derive(Clone, Debug)]
struct Who(&'static str, Rc<Cell<bool>>);

/// A table that has had an answer at once, so that the grace is the shortest.
fn session() -> Session<Who> {
    let mut session = Session::new(|who: &Who| who.1.get());
    session.request(START, read(86, &[]), who("first"));
    sent(&mut session, START);
    session.on_frame(START, 86, &[]);
    session
}

impl PartialEq for Who {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

const START: Duration = Duration::from_secs(1);
const MS: fn(u64) -> Duration = Duration::from_millis;

fn who(name: &'static str) -> Who {
    Who(name, Rc::default())
}

fn bytes(payload: &[u8]) -> Bytes {
    Bytes::copy_from_slice(payload)
}

/// A read of `command` that is answered under the same id.
fn read(command: u8, payload: &[u8]) -> Call {
    let expected = Expected::of_payload(command.into(), payload).expect("a request");
    Call {
        command,
        payload: bytes(payload),
        expected,
        shape: None,
        timeout: MS(500),
        attempts: 3,
        priority: Priority::Normal,
        probe: None,
    }
}

fn write(command: u8) -> Call {
    let expected = Expected::confirmation(command.into());
    Call {
        command,
        payload: Bytes::new(),
        expected,
        shape: None,
        timeout: MS(500),
        attempts: 1,
        priority: Priority::Normal,
        probe: None,
    }
}

/// What goes out now; the port takes it at once.
fn sent(session: &mut Session<Who>, now: Duration) -> Vec<u8> {
    let mut commands = Vec::new();
    while let Some(next) = session.next_urgent(now, 255).or_else(|| session.next_to_send(now, 255)) {
        session.written(now, next.number);
        commands.push(next.command);
    }
    commands
}

/// Who waited in vain.
fn expired(session: &mut Session<Who>, now: Duration) -> Option<(Who, Failure)> {
    loop {
        let expired = session.on_deadline(now)?;
        if let Some(waiter) = expired.waiter {
            return Some((waiter, expired.failure));
        }
    }
}

fn answer(name: &'static str, payload: &[u8]) -> Verdict<Who> {
    Verdict::Answer(who(name), Ok(bytes(payload)))
}

#[test]
fn an_answer_completes_the_request() {
    let (mut session, now) = (session(), START);
    session.request(now, read(86, &[]), who("a"));
    assert_eq!(sent(&mut session, now), [86]);
    assert_eq!(session.next_deadline(now), Some(now + MS(500)));
    assert_eq!(session.on_frame(now, 20, &bytes(&[1])), Verdict::Unsolicited);
    assert_eq!(session.on_frame(now, 86, &bytes(&[1])), answer("a", &[1]));
    assert_eq!(session.on_frame(now, 86, &bytes(&[1])), Verdict::Unsolicited);
    assert_eq!(session.next_deadline(now), None);
}

#[test]
fn the_deadline_counts_from_the_call() {
    let (mut session, now) = (session(), START);
    session.request(now, write(77), who("a"));
    assert_eq!(session.next_deadline(now), Some(now + MS(500)));
    assert_eq!(sent(&mut session, now + MS(400)), [77]);
    assert_eq!(session.next_deadline(now + MS(400)), Some(now + MS(500)));
    assert_eq!(expired(&mut session, now + MS(499)), None);
    let failure = Failure::Timeout { after: MS(500), attempts: 1 };
    assert_eq!(expired(&mut session, now + MS(500)), Some((who("a"), failure)));
    assert_eq!(expired(&mut session, now + MS(500)), None);
}

#[test]
fn what_is_never_sent_ends_by_its_deadline_as_well() {
    let (mut session, start) = (session(), START);
    session.request(start, read(86, &[]), who("read"));
    session.request(start + MS(100), write(77), who("write"));
    let failure = Failure::Timeout { after: MS(500), attempts: 0 };
    assert_eq!(expired(&mut session, start + MS(599)), None);
    assert_eq!(expired(&mut session, start + MS(600)), Some((who("write"), failure)));
    let failure = Failure::Timeout { after: MS(1500), attempts: 0 };
    assert_eq!(expired(&mut session, start + MS(1500)), Some((who("read"), failure)));
    assert_eq!((session.queued(), session.next_deadline(start)), (0, None));
}

#[test]
fn an_attempt_counts_from_when_the_port_has_taken_it() {
    let (mut session, start) = (session(), START);
    session.request(start, read(86, &[]), who("a"));
    let next = session.next_to_send(start, 255).unwrap();
    session.written(start + MS(300), next.number);
    assert_eq!(expired(&mut session, start + MS(799)), None);
    assert_eq!(sent(&mut session, start + MS(799)), []);
    assert_eq!(expired(&mut session, start + MS(800)), None);
    assert_eq!(sent(&mut session, start + MS(800)), [86]);
}

#[test]
fn reads_that_wait_behind_a_silent_board_fail_together() {
    let (mut session, start) = (session(), START);
    for _ in 0..200 {
        session.request(start, read(86, &[]), who("read"));
    }
    let mut told = 0;
    for millis in [0, 500, 1000, 1500] {
        while expired(&mut session, start + MS(millis)).is_some() {
            told += 1;
        }
        sent(&mut session, start + MS(millis));
    }
    assert_eq!((told, session.queued()), (200, 0));
}

#[test]
fn urgent_commands_overtake_all_that_wait() {
    let (mut session, now) = (session(), START);
    for _ in 0..200 {
        session.request(now, read(86, &[]), who("read"));
        session.send(now, 89, Bytes::new(), Priority::Normal);
    }
    let off = Call { priority: Priority::Urgent, ..write(109) };
    session.request(now, off.clone(), who("off"));
    session.send(now, 67, Bytes::new(), Priority::Urgent);
    assert_eq!(sent(&mut session, now)[..3], [109, 67, 86]);
    // Nor does one of its own kind hold it back.
    session.request(now, off, who("again"));
    assert_eq!(sent(&mut session, now), [109]);
    assert_eq!(session.on_frame(now, 67, &[109]), answer("off", &[109]));
    assert_eq!(session.on_frame(now, 67, &[109]), answer("again", &[109]));
}

#[test]
fn before_the_first_answer_the_grace_is_long() {
    let (mut session, start) = (Session::new(|who: &Who| who.1.get()), START);
    session.request(start, write(77), who("a"));
    assert_eq!(sent(&mut session, start), [77]);
    assert!(expired(&mut session, start + MS(500)).is_some());
    session.request(start + MS(500), Call { timeout: MS(3000), ..write(77) }, who("b"));
    assert_eq!(sent(&mut session, start + MS(999)), []);
    assert_eq!(sent(&mut session, start + MS(1000)), [77]);
}

#[test]
fn the_grace_follows_the_latency() {
    let (mut session, mut now) = (session(), START);
    session.request(now, read(86, &[]), who("slow"));
    assert_eq!(sent(&mut session, now), [86]);
    now += MS(480);
    assert_eq!(session.on_frame(now, 86, &[1]), answer("slow", &[1]));
    session.request(now, write(77), who("a"));
    assert_eq!(sent(&mut session, now), [77]);
    let sent_at = now;
    now += MS(500);
    assert!(expired(&mut session, now).is_some());
    let patient = Call { timeout: MS(2000), ..write(77) };
    session.request(now, patient, who("b"));
    assert_eq!(sent(&mut session, sent_at + MS(959)), []);
    assert_eq!(session.on_frame(sent_at + MS(959), 67, &[77]), Verdict::Late);
    assert_eq!(sent(&mut session, sent_at + MS(959)), [77]);
}

#[test]
fn an_error_without_a_name_after_a_set_point_fails_nobody() {
    let (mut session, now) = (session(), START);
    let number = session.sent_unawaited(now, 67);
    session.written(now, number);
    session.request(now, read(86, &[]), who("a"));
    assert_eq!(sent(&mut session, now), [86]);
    assert_eq!(session.on_frame(now, 255, &[6, 0, 0, 0, 0]), Verdict::Unawaited);
    assert_eq!(session.on_frame(now, 86, &[1]), answer("a", &[1]));
}

#[test]
fn what_was_taken_back_before_it_was_written_leaves_no_tombstone() {
    let (mut session, start) = (session(), START);
    session.request(start, write(77), who("a"));
    let next = session.next_to_send(start, 255).unwrap();
    let expired = session.on_deadline(start + MS(500)).unwrap();
    assert_eq!(expired.number, next.number);
    session.withdrawn(expired.number);
    session.request(start + MS(500), write(77), who("b"));
    assert_eq!(sent(&mut session, start + MS(500)), [77]);
}

#[test]
fn reads_repeat_and_writes_do_not() {
    let (mut session, start) = (session(), START);
    session.request(start, read(86, &[]), who("read"));
    session.request(start, write(77), who("write"));
    assert_eq!(sent(&mut session, start), [86, 77]);
    let mut now = start + MS(500);
    let failure = Failure::Timeout { after: MS(500), attempts: 1 };
    assert_eq!(expired(&mut session, now), Some((who("write"), failure)));
    assert_eq!(expired(&mut session, now), None);
    assert_eq!(sent(&mut session, now), [86]);
    now += MS(500);
    assert_eq!(expired(&mut session, now), None);
    assert_eq!(sent(&mut session, now), [86]);
    now += MS(500);
    let failure = Failure::Timeout { after: MS(1500), attempts: 3 };
    assert_eq!(expired(&mut session, now), Some((who("read"), failure)));
    assert_eq!((session.timeouts(), session.repeats()), (2, 2));
}

#[test]
fn equal_keys_queue_and_others_overtake() {
    let (mut session, now) = (session(), START);
    for name in ["a", "b"] {
        session.request(now, read(73, &[]), who(name));
    }
    session.request(now, read(21, &[0]), who("c"));
    session.request(now, read(21, &[1]), who("d"));
    session.request(now, read(21, &[255]), who("e"));
    assert_eq!(sent(&mut session, now), [73, 21, 21]);
    assert_eq!(session.queued(), 2);
    assert_eq!(session.on_frame(now, 21, &bytes(&[1, 5])), answer("d", &[1, 5]));
    assert_eq!(session.on_frame(now, 73, &bytes(&[])), answer("a", &[]));
    assert_eq!(sent(&mut session, now), [73]);
    assert_eq!(session.on_frame(now, 21, &bytes(&[0, 5])), answer("c", &[0, 5]));
    assert_eq!(sent(&mut session, now), [21]);
    assert_eq!(session.on_frame(now, 21, &bytes(&[3, 5])), answer("e", &[3, 5]));
    assert_eq!(session.on_frame(now, 73, &bytes(&[])), answer("b", &[]));
}

#[test]
fn a_late_answer_is_swallowed_and_does_not_answer_the_next_request() {
    let (mut session, start) = (session(), START);
    session.request(start, write(77), who("a"));
    assert_eq!(sent(&mut session, start), [77]);
    let now = start + MS(500);
    assert!(expired(&mut session, now).is_some());
    session.request(now, write(77), who("b"));
    assert_eq!(sent(&mut session, now), []);
    let late = now + MS(100);
    assert_eq!(session.on_frame(late, 67, &bytes(&[77])), Verdict::Late);
    assert_eq!(sent(&mut session, late), [77]);
    assert_eq!(session.on_frame(late, 67, &bytes(&[77])), answer("b", &[77]));
}

#[test]
fn a_tombstone_holds_back_no_longer_than_its_grace() {
    let (mut session, start) = (session(), START);
    session.request(start, write(77), who("a"));
    assert_eq!(sent(&mut session, start), [77]);
    let now = start + MS(500);
    assert!(expired(&mut session, now).is_some());
    session.request(now, write(77), who("b"));
    session.request(now, write(109), who("c"));
    assert_eq!(sent(&mut session, now), [109]);
    assert_eq!(session.next_deadline(now), Some(now + GRACE));
    assert_eq!(expired(&mut session, now + GRACE), None);
    assert_eq!(sent(&mut session, now + GRACE), [77]);
}

#[test]
fn a_tombstone_also_holds_back_what_was_queued_long_before() {
    let (mut session, start) = (session(), START);
    session.request(start, write(77), who("a"));
    session.request(start, Call { timeout: MS(2000), ..write(77) }, who("b"));
    assert_eq!(sent(&mut session, start), [77]);
    let now = start + MS(500);
    assert!(expired(&mut session, now).is_some());
    assert_eq!(sent(&mut session, now), []);
    assert_eq!(session.next_deadline(now), Some(now + GRACE));
    assert_eq!(sent(&mut session, now + GRACE), [77]);
}

#[test]
fn answers_to_repeats_do_not_answer_the_next_request() {
    let (mut session, start) = (session(), START);
    session.request(start, read(73, &[]), who("a"));
    assert_eq!(sent(&mut session, start), [73]);
    let now = start + MS(500);
    assert_eq!(expired(&mut session, now), None);
    assert_eq!(sent(&mut session, now), [73]);
    assert_eq!(session.on_frame(now, 73, &bytes(&[1])), answer("a", &[1]));
    session.request(now, read(73, &[]), who("b"));
    assert_eq!(sent(&mut session, now), []);
    assert_eq!(session.on_frame(now, 73, &bytes(&[2])), Verdict::Late);
    assert_eq!(sent(&mut session, now), [73]);
    assert_eq!(session.on_frame(now, 73, &bytes(&[3])), answer("b", &[3]));
}

#[test]
fn a_caller_that_left_before_sending_is_skipped() {
    let (mut session, now) = (session(), START);
    let gone = who("a");
    session.request(now, read(73, &[]), gone.clone());
    gone.1.set(true);
    assert_eq!(sent(&mut session, now), []);
    assert_eq!(session.queued(), 0);
}

#[test]
fn a_caller_that_left_after_sending_still_consumes_its_answer() {
    let (mut session, now) = (session(), START);
    let gone = who("a");
    session.request(now, read(73, &[]), gone.clone());
    assert_eq!(sent(&mut session, now), [73]);
    gone.1.set(true);
    session.request(now, read(73, &[]), who("b"));
    assert_eq!(sent(&mut session, now), []);
    assert_eq!(session.on_frame(now, 73, &bytes(&[1])), Verdict::Late);
    assert_eq!(sent(&mut session, now), [73]);
    assert_eq!(session.on_frame(now, 73, &bytes(&[2])), answer("b", &[2]));
}

#[test]
fn a_caller_that_left_is_not_repeated_nor_told() {
    let (mut session, now) = (session(), START);
    let gone = who("a");
    session.request(now, read(73, &[]), gone.clone());
    assert_eq!(sent(&mut session, now), [73]);
    gone.1.set(true);
    assert_eq!(expired(&mut session, now + MS(500)), None);
    assert_eq!(sent(&mut session, now + MS(500)), []);
    assert_eq!((session.timeouts(), session.repeats()), (0, 0));
}

#[test]
fn an_error_finds_the_command_that_it_names() {
    let (mut session, now) = (session(), START);
    session.request(now, read(86, &[]), who("a"));
    session.request(now, write(77), who("b"));
    assert_eq!(sent(&mut session, now), [86, 77]);
    let failure = Failure::Refused { code: 8, data: bytes(&[0, 0, 0, 0]) };
    let refused = Verdict::Answer(who("b"), Err(failure));
    assert_eq!(session.on_frame(now, 255, &bytes(&[77, 8, 0, 0, 0, 0])), refused);
    assert_eq!(session.on_frame(now, 255, &bytes(&[77, 8, 0, 0, 0, 0])), Verdict::Unsolicited);
    assert_eq!(session.on_frame(now, 86, &bytes(&[])), answer("a", &[]));
}

#[test]
fn an_error_without_a_name_is_for_the_oldest() {
    let (mut session, now) = (session(), START);
    session.request(now, read(86, &[]), who("a"));
    session.request(now, write(77), who("b"));
    assert_eq!(sent(&mut session, now), [86, 77]);
    for (name, payload) in [("a", &[6, 0, 0, 0, 0][..]), ("b", &[6])] {
        let failure = Failure::Refused { code: 6, data: bytes(&payload[1..]) };
        assert_eq!(session.on_frame(now, 255, &bytes(payload)), Verdict::Answer(who(name), Err(failure)));
    }
    assert_eq!(session.on_frame(now, 255, &bytes(&[])), Verdict::Unsolicited);
}

#[test]
fn confirmations_of_unawaited_commands_are_not_taken_for_others() {
    let (mut session, now) = (session(), START);
    {
        let number = session.sent_unawaited(now, 67);
        session.written(now, number);
    }
    {
        let number = session.sent_unawaited(now, 67);
        session.written(now, number);
    }
    session.request(now, write(67), who("a"));
    assert_eq!(sent(&mut session, now), []);
    assert_eq!(session.on_frame(now, 67, &bytes(&[67])), Verdict::Unawaited);
    assert_eq!(session.on_frame(now, 67, &bytes(&[67])), Verdict::Unawaited);
    assert_eq!(sent(&mut session, now), [67]);
    assert_eq!(session.on_frame(now, 67, &bytes(&[67])), answer("a", &[67]));
}

#[test]
fn unawaited_commands_that_go_on_hold_nobody_back_for_ever() {
    let (mut session, start) = (session(), START);
    session.request(start, write(67), who("a"));
    for millis in (0..250).step_by(10) {
        let number = session.sent_unawaited(start + MS(millis), 67);
        session.written(start + MS(millis), number);
        assert_eq!(sent(&mut session, start + MS(millis)), []);
    }
    assert_eq!(sent(&mut session, start + GRACE), [67]);
}

#[test]
fn a_disconnect_releases_everybody() {
    let (mut session, now) = (session(), START);
    session.request(now, read(73, &[]), who("a"));
    session.request(now, read(73, &[]), who("b"));
    assert_eq!(sent(&mut session, now), [73]);
    assert_eq!(session.on_disconnect(), [who("a"), who("b")]);
    assert_eq!((session.next_deadline(now), session.queued()), (None, 0));
    assert_eq!(session.on_frame(now, 73, &bytes(&[])), Verdict::Unsolicited);
}

#[test]
fn commands_keep_their_order_among_requests() {
    let (mut session, now) = (session(), START);
    session.send(now, 119, bytes(&[1]), Priority::Normal);
    session.request(now, write(22), who("a"));
    session.send(now, 119, bytes(&[0]), Priority::Normal);
    assert!(session.wants_to_send(now));
    assert_eq!(sent(&mut session, now), [119, 22, 119]);
    assert!(!session.wants_to_send(now));
    assert_eq!(session.on_frame(now, 67, &bytes(&[119])), Verdict::Unawaited);
}

#[test]
fn what_does_not_fit_is_not_overtaken() {
    let (mut session, now) = (session(), START);
    session.send(now, 1, bytes(&[0; 100]), Priority::Normal);
    session.send(now, 2, bytes(&[0; 10]), Priority::Normal);
    assert_eq!(session.next_to_send(now, 99), None);
    assert_eq!(session.queued(), 2);
    assert_eq!(sent(&mut session, now), [1, 2]);
}

#[test]
fn the_end_gives_up_requests_and_keeps_commands() {
    let (mut session, now) = (session(), START);
    session.request(now, read(73, &[]), who("a"));
    session.request(now, read(73, &[]), who("b"));
    assert_eq!(session.next_to_send(now, 255).map(|outgoing| outgoing.command), Some(73));
    session.send(now, 85, bytes(&[]), Priority::Normal);
    assert_eq!(session.dismiss(), [who("a"), who("b")]);
    assert_eq!(sent(&mut session, now), [85]);
}

mod whatever_happens {
    use std::collections::HashSet;

    use proptest::prelude::*;

    use super::*;

    /// A waiter that can be told from all others.
    #[derive(Debug)]
    struct Number(usize);

    /// Some leave at once.
    fn is_gone(number: &Number) -> bool {
        number.0 % 7 == 6
    }

    #[derive(Clone, Debug)]
    enum Step {
        Request { command: u8, payload: u8, answer: u8, attempts: u32 },
        Send(u8),
        Frame(u8, Vec<u8>),
        Wait(u64),
    }

    fn step() -> impl Strategy<Value = Step> {
        // Few ids and values, so that they meet.
        let command = prop_oneof![Just(21_u8), Just(48), Just(77), Just(86)];
        let answer = prop_oneof![Just(21_u8), Just(48), Just(67), Just(86), Just(255)];
        prop_oneof![
            (command.clone(), 0..6_u8, answer.clone(), 1..4_u32).prop_map(
                |(command, payload, answer, attempts)| Step::Request { command, payload, answer, attempts }
            ),
            command.prop_map(Step::Send),
            (answer, prop::collection::vec(prop_oneof![0..6_u8, Just(77), Just(86)], 0..7))
                .prop_map(|(id, payload)| Step::Frame(id, payload)),
            (0..400_u64).prop_map(Step::Wait),
        ]
    }

    proptest! {
        #[test]
        fn everybody_is_told_exactly_once(steps in prop::collection::vec(step(), 0..200)) {
            let (mut session, mut now) = (Session::new(is_gone), START);
            let (mut asked, mut told) = (0, HashSet::new());
            let mut tell = |waiter: Number| assert!(told.insert(waiter.0), "{} is told twice", waiter.0);
            let quiet = std::iter::repeat_n(Step::Wait(400), 4 * 200 * 3);
            for step in steps.into_iter().chain(quiet) {
                match step {
                    Step::Request { command, payload, answer, attempts } => {
                        let payload = bytes(&[payload; 6]);
                        let declared = Expected::of_payload(command.into(), &payload);
                        let expected = declared.unwrap_or(Expected::any(answer.into()));
                        let priority = if attempts == 3 { Priority::Urgent } else { Priority::Normal };
                        let call = Call { command, payload, expected, shape: None, timeout: MS(500), attempts, priority, probe: None };
                        session.request(now, call, Number(asked));
                        asked += 1;
                    }
                    Step::Send(command) => session.send(now, command, Bytes::new(), Priority::Normal),
                    Step::Frame(id, payload) => {
                        if let Verdict::Answer(waiter, _) = session.on_frame(now, id, &bytes(&payload)) {
                            tell(waiter);
                        }
                    }
                    Step::Wait(millis) => now += MS(millis),
                }
                while let Some(expired) = session.on_deadline(now) {
                    expired.waiter.into_iter().for_each(&mut tell);
                }
                while let Some(next) = session.next_urgent(now, 255).or_else(|| session.next_to_send(now, 255)) {
                    session.written(now, next.number);
                }
                prop_assert!(!session.wants_to_send(now));
                // Or the task would never sleep.
                prop_assert!(session.next_deadline(now).is_none_or(|deadline| deadline > now));
            }
            prop_assert_eq!(session.queued(), 0);
            prop_assert_eq!(told.len(), (0..asked).filter(|number| number % 7 != 6).count());
        }
    }
}
