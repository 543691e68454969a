//! Verifies windows of time about two frames, for any mechanism: results, enclosures, and the largest windows that are proven.

use std::fmt::Debug;

use linkwright::generated::{Conditions, Pair, Start, TimeWindow};
use linkwright::{Blocks, Settings, Shell};

use super::frame_numbers::numbers_of;

/// Lengths of windows in steps of the mechanism; windows of 0 steps end with the frames.
const STEPS: [f64; 4] = [0.0, 1.0, 8.0, 200.0];

/// Largest length of a window in steps.
const MAX_STEPS: f64 = 4096.0;

/// Mechanism with its last two frames.
pub struct Moved<'a, B: Blocks> {
    shell: &'a Shell<B>,
    last: &'a B::Frame,
    inputs: [&'a B::Inputs; 2],
}

/// Verifications of windows.
#[derive(Default)]
pub struct Verified {
    /// Results in words.
    pub results: Vec<String>,
    /// Numbers of enclosures, and lengths of the largest windows in steps.
    pub bounds: Vec<f64>,
}

impl<'a, B: Blocks<Scalar = f64, PathEnclosures: Debug>> Moved<'a, B> {
    /// Mechanism that has come from another frame, with the inputs of both frames.
    pub fn new(shell: &'a Shell<B>, last: &'a B::Frame, inputs: [&'a B::Inputs; 2]) -> Self {
        Moved {
            shell,
            last,
            inputs,
        }
    }

    fn step(&self) -> f64 {
        B::time(self.shell.frame()) - B::time(self.last)
    }

    fn window(&self, steps: f64) -> TimeWindow {
        match steps < 1.0 {
            true => TimeWindow::between(self.step()),
            false => TimeWindow::around(self.step(), steps),
        }
    }

    /// Calls `verify` with both frames.
    fn with<R>(&self, verify: impl FnOnce(&B, &Pair<'_, B>) -> R) -> R {
        let settings = Settings::default();
        let conditions = Conditions {
            t: B::time(self.shell.frame()),
            start: Start::LastFrame,
            parameters: self.shell.parameters(),
            inputs: self.inputs[1],
            settings: &settings,
        };
        let pair = Pair {
            at: self.shell.frame(),
            last: self.last,
            before: self.inputs[0],
            conditions: &conditions,
        };
        verify(self.shell.blocks(), &pair)
    }

    /// Verifies both frames in windows of some lengths.
    pub fn verified(&self) -> Verified {
        let mut all = Verified::default();
        let blocks = self.shell.blocks();
        let kinds = [blocks.is_guarded(), blocks.is_closed()];
        all.results.push(format!("{kinds:?}"));
        if self.step() != 0.0 && blocks.is_guarded() {
            for steps in STEPS {
                self.window_of(steps, &mut all);
            }
        }
        all
    }

    fn window_of(&self, steps: f64, all: &mut Verified) {
        let window = self.window(steps);
        let mut enclosures = self.shell.blocks().enclosures();
        let (whole, closed) = self.with(|blocks, pair| {
            let closed = blocks.verify_nonsingular(pair, &window);
            (blocks.verify_path(pair, &window, &mut enclosures), closed)
        });
        all.results.push(format!("{whole:?}"));
        all.results.push(format!("{closed:?}"));
        if whole.is_ok() {
            let blocks = self.shell.blocks();
            let (at, last) = (self.shell.frame(), self.last);
            let within = [(at, 0.0), (last, -1.0), (last, 0.0), (at, 1e-3), (at, 0.5)];
            let within = within.map(|(frame, steps)| blocks.is_within(frame, &enclosures, steps));
            all.results.push(format!("{within:?}"));
            all.bounds.extend(numbers_of(&enclosures));
        }
    }

    /// Lengths in steps of the largest windows that all equations together and closed forms alone prove, to the last bit: every bound of
    /// a proof moves them.
    pub fn largest(&self) -> [f64; 2] {
        let whole = self.largest_of(|blocks, pair, window| {
            blocks
                .verify_path(pair, window, &mut blocks.enclosures())
                .is_ok()
        });
        let closed =
            self.largest_of(|blocks, pair, window| blocks.verify_nonsingular(pair, window).is_ok());
        [whole, closed]
    }

    fn largest_of(&self, holds: impl Fn(&B, &Pair<'_, B>, &TimeWindow) -> bool) -> f64 {
        let proves = |steps: f64| {
            let window = self.window(steps);
            self.with(|blocks, pair| holds(blocks, pair, &window))
        };
        if self.step() == 0.0 || !proves(1.0) {
            return 0.0;
        }
        let (mut near, mut far) = (1.0, MAX_STEPS);
        if proves(far) {
            return far;
        }
        loop {
            let middle = 0.5 * (near + far);
            if middle == near || middle == far {
                return near;
            }
            match proves(middle) {
                true => near = middle,
                false => far = middle,
            }
        }
    }
}
