//! The blocks of a plan that are two links between known pins → what shows that they do not come in line.
//!
//! Two links of lengths a and b, from one pin to the other by way of the pin between them, make an angle ψ with
//! ab cos ψ = (d² − a² − b²)/2, where d is the distance of the outer pins. They can leave their assembly mode only where sin ψ is zero.
//! Both frames say how cos ψ and the angles of the links run on; how far they may be from that follows from how far the pins go (m)
//! and how far they are from a straight line (σ), with 1/a + 1/b as the largest derivative of cos ψ, 1/(a |sin ψ|) as that of an
//! angle, and the remainder of linear interpolation. The bounds of the angles are those of arms in the next block. The guide
//! (`theory.md`) has the argument.
//!
//! A mechanism that has other blocks is not looked at so. Deliberately unknown here: how a part is solved.

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

/// The number of pairs one behind the other from which on courses are followed. Fewer have windows of many steps without, for less.
const ROW: usize = 16;

/// R(φ_a) p + R(φ_b) q + c = 0, as a closed form has noted it.
#[derive(Clone, Copy, Debug)]
pub(super) struct TwoLinks {
    /// φ_a and φ_b.
    pub angles: [usize; 2],
    /// p and q.
    pub links: [Vector; 2],
    /// c.
    pub closure: Vector,
    /// The scalar product of both links, as the frame holds it.
    pub product: ExprId,
}

impl Builder<'_> {
    /// Notes two links of a closed form that stands by itself.
    pub(super) fn note_links(&mut self, links: TwoLinks) {
        if self.inside.is_none() {
            let both = links.angles.map(|angle| (angle, links));
            self.paths.links.extend(both);
        }
    }

    /// What shows that all of these blocks, with their places in the plan, stay on their path because no two links come in line;
    /// `None` where one of them is something else.
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

    /// The largest number of pairs of which each moves the next one.
    fn longest_row<'b>(&mut self, blocks: impl Iterator<Item = &'b SolvedBlock>) -> usize {
        let mut rows: HashMap<usize, usize> = HashMap::new();
        for block in blocks {
            for part in &block.parts {
                let residuals = part.equations.iter().map(|it| it.residual);
                let before = residuals.map(|it| self.row_before(it, &rows)).max();
                let is_pair = |unknown| self.paths.links.contains_key(unknown);
                let own = usize::from(part.unknowns.first().is_some_and(is_pair));
                let row = before.unwrap_or(0) + own;
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
        let symbols = self.system.mechanism.graph.symbols(expr).iter();
        let moving = symbols.filter_map(|&symbol| self.moving(symbol));
        moving
            .filter_map(|unknown| rows.get(&unknown).copied())
            .max()
            .unwrap_or(0)
    }

    /// Bounds what a part finds; false where it does not move.
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

    /// Bounds what an expression mentions, as far as nothing has mentioned it before.
    fn bound_definitions(&mut self, expr: ExprId, known: &mut Known) {
        for symbol in self.system.mechanism.graph.symbols(expr).to_vec() {
            let Some((definition, block)) = self.awaited(symbol) else {
                continue;
            };
            let unknown = definition.unknown;
            let value = self.in_short(definition.value);
            self.bound_definitions(value, known);
            let found = self.enclosure(value);
            self.path_geometry(&[found.radius, found.deviation]);
            self.require(block);
            if found.radius == self.graph().zero() {
                self.know(unknown, found);
                continue;
            }
            if self.is_linked(value, known) {
                known.linked.insert(unknown);
            }
            // Between both frames it moves by their difference, and beyond them as much.
            let name = self.system.unknown_name(unknown).to_string();
            let rounding = self.paths.window.rounding;
            let [rounding, value] = [self.graph().variable(rounding), self.position(unknown)];
            let size = self.graph().magnitude(value);
            let rounding = self.graph().multiply(rounding, size);
            let deviation = self.graph().add(found.deviation, rounding);
            let deviation = self.bounded(&format!("{name}_deviation"), deviation);
            let change = self.change_of(value);
            let radius = self.graph().add(change, deviation);
            let radius = self.bounded(&format!("{name}_radius"), radius);
            self.know(unknown, Enclosure { radius, deviation });
        }
    }
}
