//! The motion of every variant on a machine with an operating system.

use linkwright_embedded::{Machine, run};

/// Prints to the standard output and counts nothing.
struct Host;

impl Machine for Host {
    fn write(&mut self, text: &str) {
        print!("{text}");
    }

    fn count<R>(&mut self, call: impl FnOnce() -> R) -> (u64, R) {
        (0, call())
    }

    fn stack<R>(&mut self, call: impl FnOnce(&mut Self) -> R) -> (u64, R) {
        (0, call(self))
    }
}

fn main() {
    run(&mut Host);
}
