//! The driver's machine under any order of calls: everybody is told exactly once and in time, and it always sleeps.
#![no_main]

use std::cell::RefCell;
use std::rc::Rc;
use std::time::Duration;

use bytes::Bytes;
use libfuzzer_sys::fuzz_target;
use sbgc_host::machine::{Call, Failure, Machine, Priority, Setup, Shape, StreamCall, Waiter};
use sbgc_proto::{CommandId, Expected};

/// How long each attempt may take.
const TIMEOUT: Duration = Duration::from_millis(500);

struct Asker {
    number: usize,
    gone: bool,
    told: Rc<RefCell<Vec<usize>>>,
}

impl Waiter for Asker {
    fn is_gone(&self) -> bool {
        self.gone
    }

    fn tell(self, _: Result<Bytes, Failure>) {
        self.told.borrow_mut().push(self.number);
    }
}

fuzz_target!(|steps: &[u8]| {
    let mut machine = Machine::new(Setup::default());
    let told = Rc::<RefCell<Vec<usize>>>::default();
    // Whether somebody waits, and until when.
    let mut asked: Vec<Option<Duration>> = Vec::new();
    let mut now = Duration::ZERO;
    let mut rest = steps;
    while let [kind, value, following @ ..] = rest {
        rest = following;
        let asker = |asked: &Vec<Option<Duration>>| Asker {
            number: asked.len(),
            gone: value % 7 == 6,
            told: Rc::clone(&told),
        };
        match kind % 9 {
            0 | 1 => {
                let (command, attempts) =
                    ([21, 48, 73, 77, 86, 109][usize::from(*value) % 6], 1 + u32::from(value % 3));
                let payload = Bytes::copy_from_slice(&[value % 4; 6]);
                let id = CommandId::from_raw(command);
                let expected = Expected::of_payload(id, &payload).unwrap_or(Expected::confirmation(id));
                let priority = Priority::of(command, &payload);
                let call = Call {
                    command,
                    payload,
                    expected,
                    shape: None,
                    timeout: TIMEOUT,
                    attempts,
                    priority,
                    probe: None,
                };
                let asker = asker(&asked);
                let waits = !asker.gone;
                machine.request(now, call, asker);
                asked.push(waits.then(|| now + TIMEOUT * attempts));
            }
            2 => drop(machine.send(now, 89, Bytes::copy_from_slice(&[*value]))),
            3 => drop(machine.set(now, 67, Bytes::copy_from_slice(&[*value; 15]))),
            4 => drop(machine.send_now(now, 67, Bytes::copy_from_slice(&[*value; 15]))),
            5 => {
                let command = CommandId::from_raw([23, 25, 88][usize::from(*value) % 3]);
                let shape = Shape::new(command, [0; 8]);
                let call = StreamCall { shape, interval_ms: 20, synced: value % 3 == 0, capacity: 4 };
                let asker = asker(&asked);
                let (number, _) = machine.subscribe(call, asker);
                // Leaving gives up waiting.
                asked.push(None);
                if value % 2 == 0 {
                    machine.leave(number);
                }
            }
            6 => {
                let count = usize::from(*value).min(rest.len());
                let (bytes, left) = rest.split_at(count);
                rest = left;
                machine.receive(now, bytes);
            }
            7 => {
                let pending = machine.pending(now).len();
                machine.written(now, pending.min(usize::from(*value)));
            }
            _ => now += Duration::from_millis(u64::from(*value) * 2),
        }
        // Time does not pass what the machine waits for.
        machine.pending(now);
        let mut told = told.borrow_mut();
        for number in told.drain(..) {
            let _ = asked[number].take();
        }
        let wake = machine.next_wake(now);
        assert!(
            asked.iter().flatten().all(|deadline| now < *deadline || wake.is_some()),
            "a deadline has no alarm"
        );
        assert!(asked.iter().flatten().all(|deadline| now < *deadline), "a request outlived its deadline");
    }
    machine.close(now);
    machine.closed_port();
    assert!(told.borrow().iter().all(|number| *number < asked.len()));
});
