//! Derives the multipliers of each subsystem and the work along each driver from loads on coordinates.
//!
//! Explicit unknowns transfer their load: for x = v(u), a force on x equals ∂v/∂u times this force on u. A solved subsystem has
//! the multipliers Jᵀ λ = f, and −λ · ∂g/∂u acts on all other unknowns of its equations. The sweep runs from the last block and
//! formula to the first, so every unknown has its whole load in time. Forces on rotated vectors are summed before conversion to
//! moments, so that the moment of each vector is computed once.

use std::collections::HashMap;

use crate::expr::{ExprId, SymbolId};
use crate::force::moment;
use crate::program::builder::Builder;
use crate::program::forms::Transposed;
use crate::program::function::Statement;
use crate::structure::{Addition, SolvedPlan, Subsystem};
use crate::words::{Phrase, Piece, enumerated, phrase};

/// Results of the sweep.
#[derive(Debug, Default)]
pub(super) struct Carried {
    /// Multiplier of each equation of a subsystem, by its row of the vector form.
    pub multipliers: HashMap<usize, ExprId>,
    /// Work along symbols that are not unknowns, term by term.
    along: HashMap<SymbolId, Vec<ExprId>>,
}

impl Carried {
    /// Returns the work of all loads along the value of a driver, per unit of that value.
    pub fn along(&self, shift: SymbolId, builder: &mut Builder<'_>) -> ExprId {
        let terms = self.along.get(&shift);
        builder.graph().sum(terms.map_or(&[], Vec::as_slice))
    }
}

/// Loads that have not been transferred yet.
struct Sweep<'b, 'a> {
    builder: &'b mut Builder<'a>,
    /// Loads by unknown.
    pending: Vec<Vec<ExprId>>,
    /// Forces along x and y by rotated vector.
    on_arms: Vec<[Vec<ExprId>; 2]>,
    carried: Carried,
    /// Prefix of names.
    prefix: &'b str,
}

/// Transfers all loads from the last unknown to the drivers, with names that begin with `prefix`.
pub(super) fn sweep(
    plan: &SolvedPlan,
    transposed: &[Vec<Option<Transposed>>],
    loads: &[ExprId],
    prefix: &str,
    builder: &mut Builder<'_>,
) -> Carried {
    let form = &builder.system.vector_form;
    let mut pending = vec![Vec::new(); form.unknowns.len()];
    for (own, &load) in pending.iter_mut().zip(loads) {
        own.push(load);
    }
    let mut sweep = Sweep {
        on_arms: vec![[const { Vec::new() }; 2]; builder.pool.arms().len()],
        builder,
        pending,
        carried: Carried::default(),
        prefix,
    };
    for (block, transposed) in plan.blocks.iter().zip(transposed).rev() {
        for definition in block.definitions.iter().rev() {
            let load = sweep.take(definition.unknown);
            sweep.give(definition.value, load, &[]);
        }
        for (part, transposed) in block.parts.iter().zip(transposed).rev() {
            sweep.part(part, transposed.as_ref());
        }
    }
    sweep.separate(&plan.additions);
    sweep.carried
}

impl Sweep<'_, '_> {
    /// Returns the whole load on an unknown, as a named value.
    fn take(&mut self, unknown: usize) -> ExprId {
        let mut terms = std::mem::take(&mut self.pending[unknown]);
        let arms = self.builder.pool.arms().iter().enumerate();
        let arms: Vec<(usize, [SymbolId; 2], String)> = arms
            .filter(|(_, arm)| arm.angle == unknown)
            .map(|(place, arm)| (place, arm.symbols, arm.name.clone()))
            .collect();
        for (place, symbols, name) in arms {
            let Some(forces) = self.on_arms.get_mut(place).map(std::mem::take) else {
                continue;
            };
            if forces.iter().all(Vec::is_empty) {
                continue;
            }
            let graph = self.builder.graph();
            let force = forces.map(|terms| graph.sum(&terms));
            let [x, y] = ["x", "y"].map(|axis| format!("{}force_{name}_{axis}", self.prefix));
            let force = [
                self.builder.value(&x, force[0]),
                self.builder.value(&y, force[1]),
            ];
            let graph = self.builder.graph();
            let arm = symbols.map(|symbol| graph.variable(symbol));
            terms.push(moment(arm, force, graph));
        }
        let load = self.builder.graph().sum(&terms);
        let name = self.builder.system.unknown_name(unknown).to_string();
        let name = format!("{}work_{name}", self.prefix);
        self.builder.value(&name, load)
    }

    /// Adds a multiple of an expression's derivatives to the loads on its symbols, except for some unknowns.
    fn give(&mut self, expr: ExprId, factor: ExprId, except: &[usize]) {
        let zero = self.builder.graph().zero();
        if factor == zero {
            return;
        }
        for symbol in self.builder.graph().symbols(expr).to_vec() {
            let unknown = self.builder.pool.place_of_unknown(symbol);
            let arm = self.builder.pool.place_of_symbol(symbol);
            let turned_by = arm.map(|place| self.builder.pool.arms()[place].angle);
            let moved = unknown.or(turned_by);
            if moved.is_some_and(|moved| except.contains(&moved)) {
                continue;
            }
            let component =
                arm.map(|place| usize::from(self.builder.pool.arms()[place].symbols[0] != symbol));
            let graph = self.builder.graph();
            let slope = graph.derivative(expr, symbol);
            let term = graph.multiply(factor, slope);
            match (unknown, arm, component) {
                (Some(unknown), ..) => self.pending[unknown].push(term),
                (None, Some(arm), Some(component)) => {
                    if self.on_arms.len() <= arm {
                        self.on_arms.resize(arm + 1, [const { Vec::new() }; 2]);
                    }
                    self.on_arms[arm][component].push(term);
                }
                _ => self.carried.along.entry(symbol).or_default().push(term),
            }
        }
    }

    /// Solves for the multipliers of a subsystem and transfers the forces of its equations.
    fn part(&mut self, part: &Subsystem, transposed: Option<&Transposed>) {
        let forces: Vec<ExprId> = part.unknowns.iter().map(|&it| self.take(it)).collect();
        let zero = self.builder.graph().zero();
        self.say_part(part, transposed, &forces);
        let multipliers = if forces.iter().all(|&force| force == zero) {
            vec![zero; part.equations.len()]
        } else {
            let closed = transposed.and_then(|it| it.solve(&forces, self.builder));
            closed.unwrap_or_else(|| self.dense(part, forces))
        };
        for (equation, multiplier) in part.equations.iter().zip(multipliers) {
            let row = &self.builder.system.vector_form.rows[equation.row];
            let slug = &self.builder.system.mechanism.joints[row.joint].slug;
            let name = match row.component {
                "" => format!("{}carried_{slug}", self.prefix),
                component => format!("{}carried_{slug}_{component}", self.prefix),
            };
            let multiplier = self.builder.value(&name, multiplier);
            self.carried.multipliers.insert(equation.row, multiplier);
            let opposite = self.builder.graph().negate(multiplier);
            self.give(equation.residual, opposite, &part.unknowns);
        }
    }

    /// Converts the multipliers of equations to which others were added to those of the original equations: with g = f ± h, the
    /// multiplier of g is added to that of h, or subtracted.
    fn separate(&mut self, additions: &[Addition]) {
        for addition in additions.iter().rev() {
            let [to, added] = [addition.to, addition.added]
                .map(|row| self.carried.multipliers.get(&row).copied());
            if let (Some(to), Some(added)) = (to, added) {
                let graph = self.builder.graph();
                let sum = match addition.is_subtracted {
                    true => graph.subtract(added, to),
                    false => graph.add(added, to),
                };
                self.carried.multipliers.insert(addition.added, sum);
            }
        }
    }

    /// Describes the multipliers of a subsystem and their equations.
    fn say_part(&mut self, part: &Subsystem, transposed: Option<&Transposed>, forces: &[ExprId]) {
        let rows = part.equations.iter().map(|it| it.row);
        self.builder.say(|builder| {
            let system = &builder.system;
            let mut joints: Vec<usize> =
                rows.map(|row| system.vector_form.rows[row].joint).collect();
            joints.dedup();
            let joints: Vec<Phrase> = joints
                .into_iter()
                .map(|joint| Piece::Name(system.mechanism.joints[joint].label.clone()).into())
                .collect();
            let unknowns: Vec<Phrase> = part
                .unknowns
                .iter()
                .map(|&it| Piece::Unknown(it).into())
                .collect();
            let works: Vec<Phrase> = forces.iter().map(|&it| Piece::Formula(it).into()).collect();
            let solved = match transposed {
                Some(_) => "; so, with the determinant of the position, it carries:",
                None => {
                    "; so one linear system with the transposed Jacobian gives what it carries:"
                }
            };
            phrase![
                "Cut free at ",
                enumerated(&joints),
                ", what is left works ",
                enumerated(&works),
                " along ",
                enumerated(&unknowns),
                ", and what is carried there balances it",
                solved
            ]
        });
    }

    /// Returns the multipliers of a subsystem without a closed form, by one dense system with its Jacobian.
    fn dense(&mut self, part: &Subsystem, forces: Vec<ExprId>) -> Vec<ExprId> {
        let mut jacobian = Vec::with_capacity(forces.len() * forces.len());
        for equation in &part.equations {
            for &unknown in &part.unknowns {
                jacobian.push(self.slope(equation.residual, unknown));
            }
        }
        let targets: Vec<SymbolId> = part
            .equations
            .iter()
            .map(|_| self.builder.pool.intermediate("carried"))
            .collect();
        self.builder.state(Statement::Multipliers {
            targets: targets.iter().copied().map(Some).collect(),
            jacobian,
            forces,
        });
        let graph = self.builder.graph();
        targets.into_iter().map(|it| graph.variable(it)).collect()
    }

    /// Returns the derivative of an expression in an unknown, including the vectors that the unknown rotates.
    fn slope(&mut self, expr: ExprId, unknown: usize) -> ExprId {
        let mut terms = Vec::new();
        for symbol in self.builder.graph().symbols(expr).to_vec() {
            let arm = self
                .builder
                .pool
                .place_of_symbol(symbol)
                .map(|place| &self.builder.pool.arms()[place]);
            let turned = arm
                .filter(|arm| arm.angle == unknown)
                .map(|arm| arm.symbols);
            let is_own = self.builder.pool.place_of_unknown(symbol) == Some(unknown);
            let graph = self.builder.graph();
            if is_own {
                terms.push(graph.derivative(expr, symbol));
            } else if let Some([x, y]) = turned {
                let slope = graph.derivative(expr, symbol);
                let other = graph.variable(if symbol == x { y } else { x });
                let term = graph.multiply(slope, other);
                terms.push(if symbol == x {
                    graph.negate(term)
                } else {
                    term
                });
            }
        }
        self.builder.graph().sum(&terms)
    }
}
