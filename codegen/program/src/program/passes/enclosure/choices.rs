//! Bounds choices, magnitudes and periodic arguments, whose functions have kinks and jumps.

use super::{Enclosure, Enclosures, still};
use crate::expr::{ExprId, Node};
use crate::pool::Pool;
use crate::system::System;

impl Enclosures {
    /// Bounds |x|, which changes by at most as much as x and has a kink.
    pub(super) fn of_magnitude(
        &mut self,
        x: ExprId,
        pool: &mut Pool,
        system: &System,
    ) -> Enclosure {
        let Enclosure { radius, deviation } = self.of(x, pool, system);
        let graph = &mut pool.graph;
        let size = graph.magnitude(x);
        let kept = graph.subtract(size, radius);
        Enclosure {
            radius,
            deviation: graph.choose(kept, radius, deviation),
        }
    }

    /// Bounds a choice: by one branch if that is certain, otherwise by both, as the value is continuous and moves at most as both
    /// do.
    pub(super) fn of_choice(
        &mut self,
        expr: ExprId,
        [condition, below, otherwise]: [ExprId; 3],
        pool: &mut Pool,
        system: &System,
    ) -> Enclosure {
        if let Some(periodic) = self.of_periodic(expr, pool, system) {
            return periodic;
        }
        let deciding = self.of(condition, pool, system).radius;
        let arms = [below, otherwise].map(|arm| self.of(arm, pool, system));
        let graph = &mut pool.graph;
        let size = graph.magnitude(condition);
        let certain = graph.subtract(size, deciding);
        let zero = graph.zero();
        let both = graph.add(arms[0].radius, arms[1].radius);
        let [surely_below, surely_otherwise] = [
            graph.subtract(condition, deciding),
            graph.add(condition, deciding),
        ];
        let mut bound = |[below, otherwise]: [ExprId; 2]| match [below == zero, otherwise == zero] {
            // If one branch is constant, the other one suffices wherever it may be taken.
            [_, true] if both == below => graph.choose(surely_below, below, zero),
            [true, _] if both == otherwise => graph.choose(surely_otherwise, zero, otherwise),
            _ => {
                let chosen = graph.choose(condition, below, otherwise);
                graph.choose(certain, both, chosen)
            }
        };
        let [radius, deviation] =
            [arms.map(|arm| arm.radius), arms.map(|arm| arm.deviation)].map(&mut bound);
        Enclosure { radius, deviation }
    }

    /// Bounds a choice by a periodic argument, which is continuous too: beyond the end of a period, the value continues with the
    /// previous number of periods.
    fn of_periodic(&mut self, expr: ExprId, pool: &mut Pool, system: &System) -> Option<Enclosure> {
        let floors = floors(expr, pool);
        let &[floor] = &floors[..] else {
            return None;
        };
        let Node::Floor(periods) = *pool.graph.node(floor) else {
            return None;
        };
        let inner = self.of(periods, pool, system);
        // One end of a period may lie between the frames, none beyond them.
        let beyond = pool.graph.variable(self.window.beyond);
        let radius = pool.graph.multiply(beyond, inner.radius);
        self.require_between_integers(periods, radius, pool);
        let last = pool.in_last_frame(periods);
        let graph = &mut pool.graph;
        let before = graph.floor(last);
        let passed = graph.subtract(floor, before);
        let passed = graph.magnitude(passed);
        let one_and_a_half = graph.rational(3, 2);
        let few = graph.subtract(one_and_a_half, passed);
        self.required.push(few);
        let number = pool.intermediate("periods");
        let graph = &mut pool.graph;
        let held = graph.variable(number);
        let fixed = graph.replace_parts(expr, &[(floor, held)]);
        self.known.insert(number, still(graph));
        let bounds = self.of(fixed, pool, system);
        let [now, then] = [floor, before].map(|value| {
            [bounds.radius, bounds.deviation].map(|bound| {
                let graph = &mut pool.graph;
                graph.substitute(bound, &[(number, value)])
            })
        });
        let required: Vec<ExprId> = std::mem::take(&mut self.required);
        let graph = &mut pool.graph;
        self.required = required
            .into_iter()
            .flat_map(|expr| match graph.depends_on(expr, number) {
                true => [floor, before]
                    .map(|value| graph.substitute(expr, &[(number, value)]))
                    .to_vec(),
                false => vec![expr],
            })
            .collect();
        let over = graph.multiply(passed, then[0]);
        let bent = graph.multiply(passed, now[0]);
        let parts = [now[1], bent, over];
        Some(Enclosure {
            radius: graph.add(now[0], over),
            deviation: graph.sum(&parts),
        })
    }

    pub(super) fn require_between_integers(&mut self, x: ExprId, radius: ExprId, pool: &mut Pool) {
        let graph = &mut pool.graph;
        let floor = graph.floor(x);
        let above = graph.subtract(x, floor);
        let one = graph.one();
        let below = graph.subtract(one, above);
        self.required.push(graph.subtract(above, radius));
        self.required.push(graph.subtract(below, radius));
    }
}

/// Returns the moving roundings to an integer in an expression.
fn floors(expr: ExprId, pool: &Pool) -> Vec<ExprId> {
    let graph = &pool.graph;
    let mut roundings = Vec::new();
    let (mut open, mut seen) = (vec![expr], std::collections::HashSet::new());
    while let Some(expr) = open.pop() {
        if graph.is_fixed(expr) || !seen.insert(expr) {
            continue;
        }
        if let Node::Floor(_) = graph.node(expr) {
            roundings.push(expr);
        }
        open.extend(graph.operands(expr));
    }
    roundings
}
