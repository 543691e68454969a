//! A formula of the plan → the row of the joint that it is.

use super::writer::Writer;
use crate::expr::ExprId;

impl Writer<'_> {
    /// The row of the vector form whose residual this is, up to the sign.
    pub(super) fn row_of(&mut self, residual: ExprId) -> Option<usize> {
        let minus = self.graph().negate(residual);
        (0..self.system.vector_form.rows.len()).find(|&row| {
            let written = self.row_with_constants(row, None);
            written == residual || written == minus
        })
    }

    /// A row with the unknowns put in that are known to be constant, but for `unknown`.
    fn row_with_constants(&mut self, row: usize, unknown: Option<usize>) -> ExprId {
        let kept = unknown.map(|unknown| self.system.vector_form.unknowns[unknown].position);
        let known: Vec<_> = self
            .constants
            .iter()
            .copied()
            .filter(|(symbol, _)| Some(*symbol) != kept)
            .collect();
        let residual = self.system.vector_form.rows[row].residual;
        self.graph().substitute(residual, &known)
    }

    /// The row among these joints that says `unknown = value`.
    pub(super) fn defining_row(
        &mut self,
        joints: &[usize],
        unknown: usize,
        value: ExprId,
    ) -> Option<usize> {
        let variable = self.variable(unknown);
        let symbol = self.system.vector_form.unknowns[unknown].position;
        let rows = 0..self.system.vector_form.rows.len();
        let mentioning: Vec<usize> = rows
            .filter(|&row| {
                let row = &self.system.vector_form.rows[row];
                joints.contains(&row.joint)
                    && self.system.mechanism.graph.depends_on(row.residual, symbol)
            })
            .collect();
        let candidates: Vec<(usize, ExprId)> = mentioning
            .into_iter()
            .map(|row| (row, self.row_with_constants(row, Some(unknown))))
            .collect();
        let graph = self.graph();
        let difference = graph.subtract(variable, value);
        let found = candidates.into_iter().find(|&(_, residual)| {
            let slope = graph.derivative(residual, symbol);
            graph.divide(residual, slope) == difference
        });
        found.map(|(index, _)| index)
    }

    /// The joint of a row and which of its rows it is: `revolute P(1, 2), x`.
    pub(super) fn row_note(&mut self, row: usize) -> String {
        let (label, component) = self.row_names(row);
        match component {
            "" => label,
            component => format!("{label}, {component}"),
        }
    }

    /// The same as part of a sentence: `the x row of revolute P(1, 2)`.
    pub(super) fn row_words(&mut self, row: usize) -> String {
        let (label, component) = self.row_names(row);
        match component {
            "" => label,
            component => format!("the {component} row of {label}"),
        }
    }

    fn row_names(&mut self, row: usize) -> (String, &'static str) {
        let rows = &self.system.vector_form.rows;
        let joint = rows[row].joint;
        let first = rows.iter().position(|it| it.joint == joint).unwrap_or(row);
        let (kind, operands) = {
            let joint = &self.system.mechanism.joints[joint];
            (joint.kind, joint.operands.clone())
        };
        // The rows of a joint are in the same order whether or not its arms have names.
        let written = kind.vector_rows(&operands, self.graph());
        let component = written.get(row - first).map_or("", |row| row.component);
        let label = &self.system.mechanism.joints[joint].label;
        (self.script.word(label), component)
    }

    /// The vector equation of the joint that a row belongs to, where its rows are the components of one.
    pub(super) fn vector_equation(&mut self, row: usize) -> Option<String> {
        let rows = &self.system.vector_form.rows;
        let joint = rows[row].joint;
        let lengths: Vec<ExprId> = (0..rows.len())
            .filter(|&it| rows[it].joint == joint)
            .map(|it| rows[it].residual)
            .collect();
        match lengths[..] {
            [x, y] | [_, x, y] => Some(self.vector_sum([x, y])),
            _ => None,
        }
    }
}
