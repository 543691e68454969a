//! Describes the equations and lengths of solution methods.

use super::builder::Builder;
use crate::expr::ExprId;
use crate::joint::geometry::{Vector, turned};
use crate::model::Role;
use crate::pool::SymbolRole;
use crate::words::{Phrase, Piece, phrase};

impl Builder<'_> {
    /// Returns R(φ) v with sines and cosines of an unknown expanded.
    pub fn turned_by(&mut self, angle: usize, v: Vector) -> Vector {
        let angle = self.position(angle);
        let graph = self.graph();
        let (sine, cosine) = (graph.sin(angle), graph.cos(angle));
        turned(cosine, sine, v, graph)
    }

    /// Returns a closed loop as vectors and by components.
    pub fn closed_loop(&self, vectors: Phrase, whole: Vector) -> Vec<[Phrase; 3]> {
        let mut equations = vec![[vectors, "0".into(), "".into()]];
        for (part, axis) in whole.into_iter().zip(["x", "y"]) {
            equations.push([Piece::Formula(part).into(), "0".into(), axis.into()]);
        }
        equations
    }

    /// Returns the cosine or the sine of an angle as a local value.
    pub fn angle_function(
        &mut self,
        unknown: usize,
        is_cosine: bool,
        value: ExprId,
        remark: Phrase,
    ) -> ExprId {
        let function = if is_cosine { "cos" } else { "sin" };
        let name = format!("{function}_{}", self.system.unknown_name(unknown));
        let named = self.value_with(&name, value, remark);
        if named != value {
            self.call_function(named, unknown, is_cosine);
        }
        named
    }

    /// Describes a row, `the x row of revolute P(1, 2)`; `None` if it mentions other unknowns than `sought`.
    pub fn row_words(&self, row: usize, sought: &[usize]) -> Option<Phrase> {
        let graph = &self.pool.graph;
        let row = &self.plan.rows[row];
        let is_known =
            |unknown: usize| sought.contains(&unknown) || self.known.block_of(unknown).is_some();
        let mut symbols = graph.symbols(row.residual).iter();
        let stands_alone = symbols.all(|symbol| match self.pool.role(*symbol) {
            SymbolRole::Position(unknown) => is_known(unknown),
            SymbolRole::Arm(place) => is_known(self.pool.arms()[place].angle),
            _ => true,
        });
        let label = Piece::Name(self.system.mechanism.joints[row.joint].label.clone());
        stands_alone.then(|| match row.component {
            "" => label.into(),
            component => phrase![format!("the {component} row of "), label],
        })
    }

    /// Returns the vector equation of the joint of a row; `None` if the rows are not the components of one.
    pub fn vector_equation(&mut self, row: usize) -> Option<Vector> {
        let rows = &self.plan.rows;
        let joint = rows[row].joint;
        let rows_of_joint = rows.iter().filter(|it| it.joint == joint);
        let lengths: Vec<ExprId> = rows_of_joint.map(|it| it.residual).collect();
        let (&[x, y] | &[_, x, y]) = &lengths[..] else {
            return None;
        };
        self.system.vector_sum([x, y], self.pool).map(|_| [x, y])
    }

    /// Returns the length of a link, its source, and true if a driver gives the length; `None` if it is not a number or a
    /// displacement.
    pub fn known_length(&mut self, local: Vector) -> Option<(Phrase, Phrase, bool)> {
        let square = self.dot(local, local);
        let graph = self.graph();
        if graph.is_fixed(square) {
            let length = graph.sqrt(square);
            return Some((
                Piece::Formula(length).into(),
                "a fixed length".into(),
                false,
            ));
        }
        let &[symbol] = graph.symbols(square) else {
            return None;
        };
        let SymbolRole::Position(unknown) = self.pool.role(symbol) else {
            return None;
        };
        let variable = self.position(unknown);
        if self.graph().multiply(variable, variable) != square {
            return None;
        }
        let driver = self.system.mechanism.joints.iter().find(|joint| {
            let mut auxiliaries = joint.operands.auxiliaries.iter();
            joint.role == Role::Driver && auxiliaries.any(|it| it.value == variable)
        });
        let reason = match driver {
            Some(driver) => phrase!["known from ", Piece::Name(driver.label.clone())],
            None => {
                let block = self.known.block_of(unknown).map_or(0, |block| block + 1);
                format!("known from block {block}").into()
            }
        };
        Some((Piece::Unknown(unknown).into(), reason, driver.is_some()))
    }
}
