//! Attributes the failure of an interpreted frame to the load that is not finite, as generated modules do.

use linkwright::Failure;
use linkwright::generated::load_not_finite;

use super::compiled::Compiled;
use crate::instant::Instant;
use crate::reader::{Formulas, Reader};

/// Evaluator of loads that may become infinite.
#[derive(Clone, Debug)]
pub(super) struct LoadReader {
    loads: Reader,
    /// Indices in instants of the values that the loads follow from.
    read: Vec<usize>,
    block: u16,
}

impl LoadReader {
    /// Creates the evaluator; `None` if no load of the program may become infinite.
    pub(super) fn new(compiled: &Compiled) -> Option<LoadReader> {
        let Compiled { solved, layout, .. } = compiled;
        let (pool, system) = (solved.pool(), solved.system());
        let program = solved.program();
        let loads = program.loads.as_ref()?;
        let read = loads.read.iter();
        Some(LoadReader {
            loads: Reader::of(Formulas::new(
                [&loads.function],
                pool,
                system,
                program,
                layout,
            )),
            read: read.filter_map(|&it| layout.slot(it)).collect(),
            block: loads.block,
        })
    }

    /// Returns the failure of an instant, attributed to the first load that is not finite there if the pose is.
    pub(super) fn blame(&self, failure: Failure, at: &Instant) -> Failure {
        let read: Vec<f64> = self.read.iter().map(|&slot| at.values()[slot]).collect();
        load_not_finite(failure, &read, &self.loads.values(at), self.block)
    }
}
