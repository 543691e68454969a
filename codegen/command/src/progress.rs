//! *How many of all times are visited → a bar on the terminal, if it takes long.*
//!
//! The bar goes to stderr, only if that is a terminal, and only after [`PATIENCE`]. The module does not know what is counted.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// How long nothing is shown.
pub const PATIENCE: Duration = Duration::from_secs(1);

/// A bar that appears when it is needed, and disappears at the end.
pub struct Progress {
    begin: Instant,
    total: usize,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// A bar for `total` times; the clock starts.
    pub fn new(total: usize) -> Progress {
        Progress {
            begin: Instant::now(),
            total,
            bar: None,
        }
    }

    /// `count` of the times are visited.
    pub fn reached(&mut self, count: usize) {
        match &self.bar {
            Some(bar) => bar.set_position(count as u64),
            None if self.begin.elapsed() > PATIENCE => {
                // `ProgressBar` draws on stderr, and nothing at all if that is no terminal.
                let bar = ProgressBar::new(self.total as u64);
                let template = "solving {wide_bar} {pos}/{len} frames, {eta} left";
                if let Ok(style) = ProgressStyle::with_template(template) {
                    bar.set_style(style);
                }
                bar.set_position(count as u64);
                self.bar = Some(bar);
            }
            None => {}
        }
    }

    /// Removes the bar; the time it took in all.
    pub fn finish(self) -> Duration {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
        self.begin.elapsed()
    }
}
