//! Verifies that pairs of links between known pins never become collinear.
//!
//! Two links of lengths a and b, joined by a pin, make an angle ψ with ab cos ψ = (d² − a² − b²)/2, where d is the distance of
//! the outer pins. They can leave their assembly mode only at sin ψ = 0. Both frames give the course of cos ψ and of the links'
//! angles. Bounds on the deviation follow from the change of the pins (m), from their deviation from the chord (σ), and from the
//! interpolation remainder. The factors are 1/a + 1/b, the largest derivative of cos ψ, and 1/(a |sin ψ|), that of an angle.
//!
//! Bounds of the angles are those of vectors in the next block. The guide (`theory.md`) has the argument. Mechanisms with other
//! blocks are not verified by this method.

mod course;
mod pair;
mod ratio;

use std::collections::HashMap;

use super::builder::Builder;
use super::function::Function;
use super::passes::enclosure::Enclosure;
use super::pin_motion::Known;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::structure::{SolvedBlock, Subsystem};

pub(super) use course::Course;

/// Smallest number of pairs in series whose courses are followed. Fewer pairs have windows of many steps without courses, at less
/// cost.
const ROW: usize = 16;

/// Pair of links R(φ_a) p + R(φ_b) q + c = 0, as recorded by a closed form.
#[derive(Clone, Copy, Debug)]
pub(super) struct TwoLinks {
    /// Angles φ_a and φ_b.
    pub angles: [usize; 2],
    /// Vectors p and q.
    pub links: [Vector; 2],
    /// Vector c.
    pub closure: Vector,
    /// Scalar product of both links, as the frame keeps it.
    pub product: ExprId,
}

impl Builder<'_> {
    /// Records the two links of a closed form that is not inside a torn block.
    pub(super) fn note_links(&mut self, links: TwoLinks) {
        if self.inside.is_none() {
            let both = links.angles.map(|angle| (angle, links));
            self.paths.links.extend(both);
        }
    }

    /// Returns the verification that these blocks, with their indices in the plan, stay on their path because no links become
    /// collinear. `None` if a block is of another kind.
    pub(super) fn two_links<'b>(
        mut self,
        blocks: impl Iterator<Item = (usize, &'b SolvedBlock)> + Clone,
    ) -> Option<Function> {
        self.begin_path();
        let mut known = Known {
            is_row: self.longest_row(blocks.clone().map(|(_, block)| block)) >= ROW,
            ..Known::default()
        };
        let mut pairs = 0;
        for (place, block) in blocks {
            for part in &block.parts {
                pairs += usize::from(self.bound_part(part, place, &mut known)?);
            }
            for definition in &block.definitions {
                self.note_size(definition, &mut known);
                self.path_of_definition(definition, place);
            }
        }
        (pairs > 0).then(|| Function {
            statements: self.statements,
            ..Function::default()
        })
    }

    /// Returns the largest number of pairs in series.
    fn longest_row<'b>(&mut self, blocks: impl Iterator<Item = &'b SolvedBlock>) -> usize {
        let mut rows: HashMap<usize, usize> = HashMap::new();
        for block in blocks {
            for part in &block.parts {
                let residuals = part.equations.iter().map(|it| it.residual);
                let before = residuals.map(|it| self.row_before(it, &rows)).max();
                let is_pair = |unknown| self.paths.links.contains_key(unknown);
                let count = usize::from(part.unknowns.first().is_some_and(is_pair));
                let row = before.unwrap_or(0) + count;
                rows.extend(part.unknowns.iter().map(|&unknown| (unknown, row)));
            }
            for definition in &block.definitions {
                let row = self.row_before(definition.value, &rows);
                rows.insert(definition.unknown, row);
            }
        }
        rows.into_values().max().unwrap_or(0)
    }

    fn row_before(&self, expr: ExprId, rows: &HashMap<usize, usize>) -> usize {
        let symbols = self.pool.graph.symbols(expr).iter();
        let moving = symbols.filter_map(|&symbol| self.moving(symbol));
        moving
            .filter_map(|unknown| rows.get(&unknown).copied())
            .max()
            .unwrap_or(0)
    }

    /// Bounds the results of a subsystem. Returns false if they are constant; `None` if the subsystem is not a pair of links.
    fn bound_part(&mut self, part: &Subsystem, block: usize, known: &mut Known) -> Option<bool> {
        let equations = part.equations.iter();
        let residuals: Vec<ExprId> = equations.map(|it| self.in_short(it.residual)).collect();
        for &residual in &residuals {
            self.bound_definitions(residual, known);
        }
        if self.is_still(&part.unknowns, &residuals) {
            part.unknowns.iter().for_each(|&it| self.know_still(it));
            return Some(false);
        }
        let links = *self.paths.links.get(part.unknowns.first()?)?;
        self.bound_links(links, block, known);
        Some(true)
    }

    /// Bounds the unknowns of an expression that have no bounds yet.
    fn bound_definitions(&mut self, expr: ExprId, known: &mut Known) {
        for symbol in self.pool.graph.symbols(expr).to_vec() {
            let Some((definition, block)) = self.awaited(symbol) else {
                continue;
            };
            let unknown = definition.unknown;
            let value = self.in_short(definition.value);
            self.bound_definitions(value, known);
            let enclosure = self.enclosure(value);
            self.path_geometry(&[enclosure.radius, enclosure.deviation]);
            self.require(block);
            if enclosure.radius == self.graph().zero() {
                self.know(unknown, enclosure);
                continue;
            }
            if self.is_linked(value, known) {
                known.linked.insert(unknown);
            }
            // Between both frames, the unknown changes by their difference, and beyond them by as much.
            let name = self.system.unknown_name(unknown).to_string();
            let rounding = self.paths.window.rounding;
            let [rounding, value] = [self.graph().variable(rounding), self.position(unknown)];
            let size = self.graph().magnitude(value);
            let rounding = self.graph().multiply(rounding, size);
            let deviation = self.graph().add(enclosure.deviation, rounding);
            let deviation = self.bounded(&format!("{name}_deviation"), deviation);
            let change = self.change_of(value);
            let radius = self.graph().add(change, deviation);
            let radius = self.bounded(&format!("{name}_radius"), radius);
            self.know(unknown, Enclosure { radius, deviation });
        }
    }
}
