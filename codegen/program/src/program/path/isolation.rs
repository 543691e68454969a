//! Equations that are looked at together → the question whether they have one solution near the line.

use std::collections::HashMap;

use super::chain::Order;
use super::columns::Columns;
use crate::expr::{ExprId, SymbolId};
use crate::joint::Quantity;
use crate::program::builder::Builder;
use crate::program::function::{Function, Statement, Written};
use crate::program::passes::enclosure::Enclosure;

/// Equations that are looked at together.
#[derive(Default)]
pub(super) struct Loops {
    pub unknowns: Vec<usize>,
    /// Where each unknown stands among them.
    pub columns: HashMap<usize, usize>,
    /// How far the unknowns go along the line.
    pub changes: Vec<SymbolId>,
    pub residuals: Vec<ExprId>,
    /// The block of each equation, by its place in the plan.
    pub blocks: Vec<usize>,
}

impl Loops {
    /// The same with its equations and unknowns in this order.
    fn in_order(self, order: &Order) -> Loops {
        let unknowns: Vec<usize> = order.columns.iter().map(|&it| self.unknowns[it]).collect();
        let places = unknowns.iter().enumerate();
        Loops {
            columns: places.map(|(place, &unknown)| (unknown, place)).collect(),
            changes: order.columns.iter().map(|&it| self.changes[it]).collect(),
            residuals: order.rows.iter().map(|&it| self.residuals[it]).collect(),
            blocks: order.rows.iter().map(|&it| self.blocks[it]).collect(),
            unknowns,
        }
    }
}

impl Builder<'_> {
    /// Looks at these equations together with others.
    pub(super) fn join(
        &mut self,
        unknowns: &[usize],
        residuals: &[ExprId],
        block: usize,
        loops: &mut Loops,
    ) {
        for &unknown in unknowns {
            let change = self.change(unknown);
            // On the line the unknowns have no deviation of their own.
            let (radius, deviation) = (self.graph().variable(change), self.graph().zero());
            self.know(unknown, Enclosure { radius, deviation });
            loops.changes.push(change);
            loops.columns.insert(unknown, loops.unknowns.len());
            loops.unknowns.push(unknown);
        }
        loops.residuals.extend(residuals);
        loops.blocks.extend(residuals.iter().map(|_| block));
    }

    /// Asks that equations have one solution near the line.
    pub(super) fn isolate(&mut self, mut loops: Loops) {
        if loops.unknowns.is_empty() {
            return;
        }
        let mut found = self.columns(&loops.residuals, &loops.columns);
        let mut order = found.chain();
        // What hangs together cell by cell is short already.
        if order.is_none() && self.shorten_loops(&mut loops) {
            found = self.columns(&loops.residuals, &loops.columns);
            order = found.chain();
        }
        if let Some(order) = &order {
            loops = loops.in_order(order);
            found = found.in_order(order);
        }
        let Loops {
            unknowns,
            changes,
            residuals,
            blocks,
            ..
        } = loops;
        let Columns {
            jacobian,
            turns,
            turning,
        } = found;
        let deviations: Vec<SymbolId> = unknowns
            .iter()
            .map(|&it| self.bound(it, "deviation"))
            .collect();
        // What arms do that turn with such a column is known without bounds.
        for (&unknown, _) in unknowns.iter().zip(&turns).filter(|(_, turns)| **turns) {
            self.know_still(unknown);
        }
        let (mut bounds, mut curvatures) = (Vec::new(), Vec::new());
        for &residual in &residuals {
            let on_line = self.on_line(residual);
            bounds.push(on_line.bound);
            curvatures.push(on_line.curvature);
        }
        self.require(blocks[0]);
        for ((&unknown, &change), &deviation) in unknowns.iter().zip(&changes).zip(&deviations) {
            let [change, deviation] = [change, deviation].map(|it| self.graph().variable(it));
            let radius = self.graph().add(change, deviation);
            self.know(unknown, Enclosure { radius, deviation });
        }
        let zero = self.graph().zero();
        let mut varied = Vec::new();
        let mut variation = Vec::new();
        for &(place, entry) in jacobian.iter().filter(|([_, column], _)| !turns[*column]) {
            let radius = self.enclosure(entry).radius;
            if radius != zero {
                varied.push(place);
                variation.push(Written {
                    expr: radius,
                    bodies: Vec::new(),
                });
            }
        }
        let entries = jacobian.iter().chain(&turning).map(|(_, entry)| *entry);
        let variations = variation.iter().map(|it| it.expr);
        let on_line = bounds.iter().chain(&curvatures).copied();
        let all: Vec<ExprId> = entries.chain(variations).chain(on_line).collect();
        let sizes = unknowns.iter().map(|&it| self.size(it)).collect();
        self.path_geometry(&all);
        let distances = changes
            .iter()
            .map(|&it| self.graph().variable(it))
            .collect();
        self.state(Statement::Isolate {
            is_chain: order.is_some(),
            blocks: blocks.clone(),
            found: deviations.clone(),
            bounds,
            curvatures,
            changes: distances,
            sizes,
            jacobian,
            turns,
            turning,
            varied,
            variation: Box::new(Function {
                results: variation,
                ..Function::default()
            }),
        });
        for ((&unknown, change), deviation) in unknowns.iter().zip(changes).zip(deviations) {
            self.paths.deviations.insert(unknown, deviation);
            let [change, deviation] = [change, deviation].map(|it| self.graph().variable(it));
            let reach = self.graph().add(change, deviation);
            let radius = self.bound(unknown, "radius");
            self.assign(radius, reach);
            let radius = self.graph().variable(radius);
            self.know(unknown, Enclosure { radius, deviation });
        }
        self.require(blocks[0]);
    }

    /// What rounding of an unknown is a part of: its value where it is a length.
    fn size(&mut self, unknown: usize) -> ExprId {
        let unknown = &self.system.vector_form.unknowns[unknown];
        match unknown.quantity {
            Quantity::Angle => self.graph().one(),
            Quantity::Length | Quantity::Power(_) => {
                let position = unknown.position;
                self.graph().variable(position)
            }
        }
    }
}
