//! Shows a progress bar on the terminal during long work.
//!
//! The bar goes to stderr, only if that is a terminal, and only after [`PATIENCE`].

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Time before the bar appears.
pub const PATIENCE: Duration = Duration::from_secs(1);

/// Bar that appears when work takes long, and disappears at its end.
pub struct Progress {
    begin: Instant,
    total: usize,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Creates a bar for `total` times, and starts the clock.
    pub fn new(total: usize) -> Progress {
        Progress {
            begin: Instant::now(),
            total,
            bar: None,
        }
    }

    /// Reports that `count` of the times are visited.
    pub fn reached(&mut self, count: usize) {
        match &self.bar {
            Some(bar) => bar.set_position(count as u64),
            None if self.begin.elapsed() > PATIENCE => {
                // `ProgressBar` draws on stderr, and only if that is a terminal.
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

    /// Removes the bar, and returns the total time.
    pub fn finish(self) -> Duration {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
        self.begin.elapsed()
    }
}
