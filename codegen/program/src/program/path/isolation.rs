//! Formulates the uniqueness of the solution of all loop equations near the chord.

use std::collections::HashMap;

use super::chain::Order;
use super::columns::Columns;
use crate::expr::{ExprId, SymbolId};
use crate::joint::Quantity;
use crate::program::builder::Builder;
use crate::program::function::{Function, Statement, Written};
use crate::program::passes::enclosure::Enclosure;

/// Equations that are verified together.
#[derive(Default)]
pub(super) struct Loops {
    pub unknowns: Vec<usize>,
    /// Index of each unknown among the columns.
    pub columns: HashMap<usize, usize>,
    /// Changes of the unknowns along the chord.
    pub changes: Vec<SymbolId>,
    pub residuals: Vec<ExprId>,
    /// Block of each equation, by its index in the plan.
    pub blocks: Vec<usize>,
}

impl Loops {
    /// Returns these loops with equations and unknowns in this order.
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
    /// Adds equations to loops.
    pub(super) fn join(
        &mut self,
        unknowns: &[usize],
        residuals: &[ExprId],
        block: usize,
        loops: &mut Loops,
    ) {
        for &unknown in unknowns {
            let change = self.change(unknown);
            // On the chord, unknowns have no deviation.
            let (radius, deviation) = (self.graph().variable(change), self.graph().zero());
            self.know(unknown, Enclosure { radius, deviation });
            loops.changes.push(change);
            loops.columns.insert(unknown, loops.unknowns.len());
            loops.unknowns.push(unknown);
        }
        loops.residuals.extend(residuals);
        loops.blocks.extend(residuals.iter().map(|_| block));
    }

    /// Requires that equations have one solution near the chord.
    pub(super) fn isolate(&mut self, mut loops: Loops) {
        if loops.unknowns.is_empty() {
            return;
        }
        let mut jacobian = self.columns(&loops.residuals, &loops.columns);
        let mut order = jacobian.chain();
        // Chains of cells are short already.
        if order.is_none() && self.shorten_loops(&mut loops) {
            jacobian = self.columns(&loops.residuals, &loops.columns);
            order = jacobian.chain();
        }
        if let Some(order) = &order {
            loops = loops.in_order(order);
            jacobian = jacobian.in_order(order);
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
        } = jacobian;
        let deviations: Vec<SymbolId> = unknowns
            .iter()
            .map(|&it| self.bound(it, "deviation"))
            .collect();
        // Vectors that rotate with such a column need no bounds.
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
                quantities: self.quantities.clone(),
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

    /// Returns the magnitude of an unknown, to which its rounding is proportional: its value if it is a length.
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
