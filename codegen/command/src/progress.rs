//! Shows a progress bar on the terminal during long work.
//!
//! The bar goes to stderr, only if that is a terminal, and only after [`PATIENCE`].

use std::fmt::Write;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressState, ProgressStyle};

/// Time before the bar appears.
pub const PATIENCE: Duration = Duration::from_secs(1);

/// Writes how many sets are solved in a second.
fn rate(state: &ProgressState, output: &mut dyn Write) {
    // A bar that cannot be drawn is left out.
    let _ = write!(output, "{:.0} per second", state.per_sec());
}

/// Bar that appears when work takes long, and disappears at its end.
pub struct Progress {
    begin: Instant,
    total: u64,
    /// Template of the bar.
    template: &'static str,
    bar: Option<ProgressBar>,
}

/// Template of a bar that counts frames.
const FRAMES: &str = "solving {wide_bar} {pos}/{len} frames, {eta} left";

/// Template of a bar that counts sets of parameters.
const SETS: &str = "solving {wide_bar} {pos}/{len} sets, {rate}, {eta} left";

/// Template of a bar that shows a share of the work.
const SHARE: &str = "searching {wide_bar} {percent}%, {eta} left";

/// Parts of the whole work.
const SHARES: u64 = 1000;
/// Template of a bar that counts starts of a search.
const STARTS: &str = "searching {wide_bar} {pos}/{len} starts, {eta} left";

impl Progress {
    /// Creates a bar for `total` starts of a search, and starts the clock.
    pub fn of_starts(total: u32) -> Progress {
        Progress::of(u64::from(total), STARTS)
    }

    /// Creates a bar for `total` times, and starts the clock.
    pub fn new(total: usize) -> Progress {
        Progress::of(total as u64, FRAMES)
    }

    /// Creates a bar for `total` sets of parameters with their rate, and starts the clock.
    pub fn of_sets(total: u64) -> Progress {
        Progress::of(total, SETS)
    }

    /// Creates a bar for a share of the work, and starts the clock.
    pub fn of_share() -> Progress {
        Progress::of(SHARES, SHARE)
    }

    /// Reports that a share of the work is done, from 0 to 1.
    pub fn reached_share(&mut self, share: f64) {
        self.reached((share * SHARES as f64) as usize);
    }

    fn of(total: u64, template: &'static str) -> Progress {
        Progress {
            begin: Instant::now(),
            total,
            template,
            bar: None,
        }
    }

    /// Reports that `count` of the frames or sets are solved.
    pub fn reached(&mut self, count: usize) {
        match &self.bar {
            Some(bar) => bar.set_position(count as u64),
            None if self.begin.elapsed() > PATIENCE => {
                // `ProgressBar` draws on stderr, and only if that is a terminal.
                let bar = ProgressBar::new(self.total);
                if let Ok(style) = ProgressStyle::with_template(self.template) {
                    bar.set_style(style.with_key("rate", rate));
                }
                bar.set_position(count as u64);
                // What was done before the bar, or by an interrupted run, says nothing of the rate.
                bar.reset_eta();
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
