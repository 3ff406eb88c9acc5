//! Bars for what takes a while: on standard error, and on a terminal only.

use std::io::{self, IsTerminal as _};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::options::Global;

/// A bar that may be invisible.
#[derive(Debug)]
pub(crate) struct Bar(ProgressBar);

impl Bar {
    /// A bar for bytes.
    pub(crate) fn bytes(global: &Global, what: &'static str) -> Self {
        Self::new(global, what, "{msg} {wide_bar} {binary_bytes}/{binary_total_bytes}")
    }

    /// A bar for a part of a whole, in thousandths.
    pub(crate) fn part(global: &Global, what: &'static str) -> Self {
        let bar = Self::new(global, what, "{msg} {wide_bar} {percent:>3} % {elapsed}");
        bar.0.set_length(1000);
        bar
    }

    fn new(global: &Global, what: &'static str, template: &str) -> Self {
        let visible = io::stderr().is_terminal() && !global.json && global.verbose == 0;
        let target = if visible { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = ProgressBar::with_draw_target(None, target);
        bar.set_style(style.progress_chars("=> "));
        bar.set_message(what);
        Self(bar)
    }

    /// So much of so much is done.
    pub(crate) fn show(&self, done: usize, all: usize) {
        self.0.set_length(all as u64);
        self.0.set_position(done as u64);
    }

    /// This part is done, and this is what happens.
    pub(crate) fn show_part(&self, part: f64, message: String) {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a part of a whole")]
        self.0.set_position((part.clamp(0.0, 1.0) * 1000.0) as u64);
        self.0.set_message(message);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
