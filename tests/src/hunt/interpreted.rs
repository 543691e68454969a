//! *A mechanism with its truth* → *what the interpreted views make of it*, in f64.

use linkwright_cli::solved_interpreter::{SolvedInterpreter, Values};

use super::known::Known;
use super::ways::{Answered, Blocks, named, solved, textbook};
use nalgebra::DVector;

/// The interpreted solved view in motion.
#[derive(Clone)]
struct Interpreted<'a> {
    view: &'a SolvedInterpreter,
    values: Values,
}

impl Blocks for Interpreted<'_> {
    fn moved(&mut self, t: f64) -> Result<(), String> {
        let signs = self.view.drawn_signs();
        self.view
            .solve(t, &signs, &mut self.values)
            .map_err(|failure| named(failure.kind))
    }

    fn levels(&self) -> [Vec<f64>; 3] {
        let levels = self.view.levels(&self.values);
        levels.map(|level| level.as_slice().to_vec())
    }
}

/// All answers of the textbook view, then all of the solved view.
pub fn answers(known: &Known) -> [Vec<Answered>; 2] {
    let dense = textbook(&known.interpreter, &known.task);
    let blocks = SolvedInterpreter::new(&known.system).map(|view| {
        let assembled = |estimate: &[f64], t: f64| {
            let mut new = Interpreted {
                view: &view,
                values: view.begin(t),
            };
            let estimate = DVector::from_column_slice(estimate);
            view.set_pose(&mut new.values, &estimate);
            new.moved(t)?;
            Ok(new)
        };
        solved(assembled, &known.task)
    });
    [dense, blocks.unwrap_or_default()]
}
