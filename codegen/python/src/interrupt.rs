//! Ends long work when the user interrupts it.

use std::io;
use std::time::{Duration, Instant};

use linkwright_page::motion::{Shown, Sink};
use pyo3::prelude::*;

/// Time between looks at signals.
const BETWEEN: Duration = Duration::from_millis(100);

/// Watch for signals such as Ctrl-C, for a thread without the interpreter.
pub struct Interrupt {
    next: Instant,
}

impl Interrupt {
    /// Begins to watch.
    pub fn new() -> Interrupt {
        Interrupt {
            next: Instant::now() + BETWEEN,
        }
    }

    /// Looks at signals, unless it has just done so.
    ///
    /// # Errors
    /// The exception of a handler of a signal.
    pub fn check(&mut self) -> PyResult<()> {
        let now = Instant::now();
        if now < self.next {
            return Ok(());
        }
        self.next = now + BETWEEN;
        Python::attach(|py| py.check_signals())
    }
}

/// Ends a motion at an instant.
impl Sink for Interrupt {
    fn take(&mut self, _: &Shown<'_>) -> io::Result<()> {
        self.check().map_err(io::Error::other)
    }
}
