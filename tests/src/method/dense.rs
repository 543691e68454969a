//! The baseline as a method.

use std::hint::black_box;

use linkwright_codegen::stages::system::Derived;

use super::{Levels, Method};
use crate::baseline::Baseline;

/// The dense solver of the usual kind.
pub struct Dense {
    baseline: Baseline,
}

impl Dense {
    /// The baseline of a mechanism.
    pub fn new(derived: &Derived) -> Dense {
        Dense {
            baseline: Baseline::new(derived),
        }
    }
}

impl Method for Dense {
    fn family(&self) -> &str {
        "dense joint objects (baseline)"
    }

    fn setting(&self) -> &str {
        ""
    }

    fn scalar(&self) -> &'static str {
        "f64"
    }

    fn sweep(&mut self, times: &[f64]) {
        self.baseline.reset();
        for &t in times {
            self.baseline.advance(t);
            black_box(&self.baseline.qdd);
        }
    }

    fn record(&mut self, times: &[f64], indices: &[usize]) -> Vec<Levels> {
        self.baseline.reset();
        let mut records = Vec::new();
        for (index, &t) in times.iter().enumerate() {
            self.baseline.advance(t);
            if indices.contains(&index) {
                let levels = [&self.baseline.q, &self.baseline.qd, &self.baseline.qdd];
                records.push(levels.map(|level| level.as_slice().to_vec()));
            }
        }
        records
    }
}
