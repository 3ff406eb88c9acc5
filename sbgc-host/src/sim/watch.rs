//! Who opens and closes a device.

use std::io;
use std::path::Path;

/// What was seen since the last look.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Seen {
    /// Somebody came, and somebody left.
    pub(super) came: bool,
    pub(super) left: bool,
    /// Somebody has it open now.
    pub(super) open: bool,
}

#[cfg(target_os = "linux")]
pub(super) use linux::Watch;
#[cfg(not(target_os = "linux"))]
pub(super) use other::Watch;

#[cfg(target_os = "linux")]
mod linux {
    use std::mem::MaybeUninit;
    use std::os::fd::OwnedFd;

    use rustix::fs::inotify::{self, CreateFlags, ReadFlags, WatchFlags};
    use rustix::io::Errno;
    use tokio::time::sleep;

    use super::{Path, Seen, io};

    /// How often it is looked who comes and goes while nothing else happens.
    const LOOK: std::time::Duration = std::time::Duration::from_millis(20);

    /// Watches who opens and closes a device, besides those who had it open before.
    #[derive(Debug)]
    pub(in crate::sim) struct Watch {
        events: OwnedFd,
        open: usize,
    }

    impl Watch {
        pub(in crate::sim) fn new(path: &Path) -> io::Result<Self> {
            let events = inotify::init(CreateFlags::NONBLOCK | CreateFlags::CLOEXEC)?;
            let flags = WatchFlags::OPEN | WatchFlags::CLOSE_WRITE | WatchFlags::CLOSE_NOWRITE;
            inotify::add_watch(&events, path, flags)?;
            Ok(Self { events, open: 0 })
        }

        pub(in crate::sim) fn look(&mut self) -> io::Result<Seen> {
            let mut seen = Seen::default();
            let mut buffer = [MaybeUninit::uninit(); 1024];
            let mut reader = inotify::Reader::new(&self.events, &mut buffer);
            loop {
                match reader.next() {
                    Ok(event) if event.events().contains(ReadFlags::OPEN) => {
                        // Of several at once the first is the one who came.
                        seen.came |= self.open == 0;
                        self.open += 1;
                    }
                    Ok(_) => {
                        self.open = self.open.saturating_sub(1);
                        seen.left |= self.open == 0;
                    }
                    Err(Errno::WOULDBLOCK) => break,
                    Err(error) => return Err(error.into()),
                }
            }
            seen.open = self.open > 0;
            Ok(seen)
        }

        /// Returns when there may be something to look at.
        pub(in crate::sim) async fn ready(&mut self) -> io::Result<()> {
            sleep(LOOK).await;
            Ok(())
        }
    }
}

#[cfg(not(target_os = "linux"))]
mod other {
    use super::{Path, Seen, io};

    /// Somebody is always taken to be there: this system does not tell.
    #[derive(Debug)]
    pub(in crate::sim) struct Watch;

    impl Watch {
        pub(in crate::sim) fn new(_: &Path) -> io::Result<Self> {
            Ok(Self)
        }

        #[allow(clippy::unnecessary_wraps, clippy::unused_self, reason = "others have more to do")]
        pub(in crate::sim) fn look(&mut self) -> io::Result<Seen> {
            Ok(Seen { open: true, ..Seen::default() })
        }

        pub(in crate::sim) async fn ready(&mut self) -> io::Result<()> {
            std::future::pending().await
        }
    }
}
