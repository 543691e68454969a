//! *A solved view and the times of its frames → how close each block is to singular at each of them, under the name of a column.*
//!
//! What is measured is said in [`crate::closeness`]. Frames are taken as they are: where the smallest value lies between two of
//! them is found by `linkwright check`.

use crate::closeness::Closeness;
use crate::solved_interpreter::SolvedInterpreter;

/// The measures of all blocks over the frames.
#[derive(Clone, Debug, Default)]
pub struct Monitor {
    /// `closeness_phi_c3_phi_c10`: one for each step that can be singular, after its unknowns.
    pub names: Vec<String>,
    /// One measure a name at each time, from 0, singular, to 1; `None` where the blocks cannot be solved.
    pub measures: Vec<Option<Vec<f64>>>,
}

impl Monitor {
    /// The measures at these times, ascending.
    pub fn over(solved: &SolvedInterpreter, times: &[f64]) -> Monitor {
        let closeness = Closeness::new(solved);
        let name = |(block, step): (usize, usize)| {
            let unknowns = solved.plan.blocks[block].steps[step].unknowns();
            let names: Vec<&str> = unknowns
                .into_iter()
                .map(|unknown| solved.system.unknown_name(unknown))
                .collect();
            format!("closeness_{}", names.join("_"))
        };
        Monitor {
            names: closeness.measured().map(name).collect(),
            measures: closeness.measures(times),
        }
    }

    /// The smallest measure of all: the name of its column, the index of its time, and itself.
    pub fn smallest(&self) -> Option<(&str, usize, f64)> {
        let all = self.measures.iter().enumerate().flat_map(|(at, measures)| {
            let measures = measures.iter().flatten().zip(&self.names);
            measures.map(move |(measure, name)| (name.as_str(), at, *measure))
        });
        all.min_by(|a, b| a.2.total_cmp(&b.2))
    }
}
