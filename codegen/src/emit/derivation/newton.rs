//! What has no closed form: its unknowns and residuals.

use super::document::Equation;
use super::words::{counted, enumerated};
use super::writer::Writer;
use crate::expr::ExprId;

impl Writer<'_> {
    /// Writes the step and returns what it is solved from.
    pub(super) fn newton(&mut self, unknowns: &[usize], residuals: &[ExprId]) -> String {
        let names: Vec<String> = unknowns.iter().map(|&it| self.named(it)).collect();
        let loops = self.loops(residuals);
        let source = match &loops {
            Some(loops) => format!(
                "from {} at once",
                counted(loops.len(), "loop", "coupled loops")
            ),
            None => format!(
                "from {} at once",
                counted(residuals.len(), "equation", "equations")
            ),
        };
        let equations = counted(residuals.len(), "equation", "equations");
        self.sentence(&format!(
            "{} are unknown in {equations}, {}. None of the equations holds fewer unknowns than could be found from it alone, and no \
             part of them determines as many unknowns as it has equations: nothing can be solved one after the other, and no two \
             circles or lines give the solution. Newton-Raphson finds all of them together, starting from the last pose.",
            enumerated(&names),
            match &loops {
                Some(loops) if loops.len() > 1 => format!("the components of {} coupled loops", loops.len()),
                Some(_) => "the components of one loop".to_string(),
                None => "which are coupled".to_string(),
            },
        ));
        if let Some(loops) = loops {
            self.sentence("the loops as vectors:");
            let equations = loops.into_iter().map(|left| Equation {
                left,
                right: "0".to_string(),
                note: String::new(),
            });
            self.equations(equations.collect());
        }
        self.sentence("the residuals by components:");
        let mut equations = Vec::with_capacity(residuals.len());
        for (number, &residual) in residuals.iter().enumerate() {
            let value = self.with_numbers(residual);
            equations.push(Equation {
                left: self.residual(number),
                right: self.formula(value),
                note: String::new(),
            });
        }
        self.equations(equations);
        self.newton_motion(unknowns);
        source
    }

    /// `g1`.
    fn residual(&self, number: usize) -> String {
        let number = number + 1;
        match self.script {
            super::script::Script::Latex => format!("g_{{{number}}}"),
            super::script::Script::Text(_) => format!("g{number}"),
        }
    }

    /// The residuals pair by pair as vectors, where they are the components of such.
    fn loops(&mut self, residuals: &[ExprId]) -> Option<Vec<String>> {
        let pairs = residuals.chunks_exact(2);
        if !pairs.remainder().is_empty() {
            return None;
        }
        let pairs: Vec<[ExprId; 2]> = pairs.map(|pair| [pair[0], pair[1]]).collect();
        let mut loops = Vec::with_capacity(pairs.len());
        for pair in pairs {
            if !self.is_vector_sum(pair) {
                return None;
            }
            loops.push(self.vector_sum(pair));
        }
        Some(loops)
    }

    fn newton_motion(&mut self, unknowns: &[usize]) {
        let size = unknowns.len();
        let matrix = self
            .script
            .either("G_z", "G_z", "\\mathbf{G}_{\\mathbf{z}}")
            .to_string();
        let matrix = self.script.inline(&matrix);
        self.sentence(&format!(
            "velocity and acceleration: with the {size} x {size} Jacobian {matrix} of the residuals in these unknowns, the rates of \
             the unknowns solve one linear system with the right-hand side minus the rates of the residuals with the unknowns held; \
             the accelerations solve the same system. Both exist while the determinant of {matrix} is not zero."
        ));
    }
}
