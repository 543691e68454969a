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
        let made_of = match &loops {
            Some(loops) => format!(
                ", the components of {},",
                counted(loops.len(), "loop", "coupled loops")
            ),
            None => String::new(),
        };
        let text = match &names[..] {
            [only] if loops.is_none() => format!(
                "There is no closed form here: the equation is linear neither in {only} nor in its cosine and sine. \
                 Newton-Raphson finds it, starting from the last pose.",
            ),
            _ => format!(
                "There is no closed form here: {equations}{made_of} hold {} together. No part of the equations holds only as \
                 many unknowns as it has equations, so they cannot be solved one loop after the other, and the whole is not \
                 one of the pairs of circles and lines whose intersection is a square root. Newton-Raphson finds all of them \
                 at once, starting from the last pose.",
                enumerated(&names),
            ),
        };
        self.paragraph(text);
        if let Some(loops) = loops {
            self.paragraph("The loops as vectors:");
            let equations = loops.into_iter().map(|left| Equation {
                left,
                right: "0".to_string(),
                note: String::new(),
            });
            self.equations(equations.collect());
        }
        self.paragraph("The residuals by components:");
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
        self.paragraph(format!(
            "Velocity and acceleration: with the {size} by {size} Jacobian {matrix} of the residuals in these unknowns, the rates of \
             the unknowns solve one linear system with the right-hand side minus the rates of the residuals with the unknowns held; \
             the accelerations solve the same system. Both exist while the determinant of {matrix} is not zero."
        ));
    }
}
