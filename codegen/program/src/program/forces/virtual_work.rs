//! Loads on coordinates → what the equations of every part carry, and the work along the value of every driver.
//!
//! What follows from others passes its load on to them: where x = v(u), a force on x does the work of ∂v/∂u times as much on u. Where
//! a part is solved for its unknowns, its multipliers are Jᵀ λ = f, and −λ · ∂g/∂u is passed on to everything else that its equations
//! mention. From the last block to the first, and from the last formula of each to its first, every unknown has all of its load
//! when it is looked at. Forces on arms are summed before they become moments: that of an arm is taken once.

use std::collections::HashMap;

use crate::expr::{ExprId, SymbolId};
use crate::force::moment;
use crate::program::builder::Builder;
use crate::program::forms::Transposed;
use crate::program::function::Statement;
use crate::structure::{Addition, SolvedPlan, Subsystem};
use crate::words::{Phrase, Piece, enumerated, phrase};

/// What is carried.
#[derive(Debug, Default)]
pub(super) struct Carried {
    /// The multiplier of each equation of a part, by its row of the vector form.
    pub multipliers: HashMap<usize, ExprId>,
    /// The work along what is no unknown, term by term.
    along: HashMap<SymbolId, Vec<ExprId>>,
}

impl Carried {
    /// The work of all loads along the value of a driver, per step of that value.
    pub fn along(&self, shift: SymbolId, builder: &mut Builder<'_>) -> ExprId {
        let terms = self.along.get(&shift);
        builder.graph().sum(terms.map_or(&[], Vec::as_slice))
    }
}

/// The loads that have not been passed on yet.
struct Sweep<'b, 'a> {
    builder: &'b mut Builder<'a>,
    /// By unknown.
    pending: Vec<Vec<ExprId>>,
    /// By arm: forces along x and y.
    on_arms: Vec<[Vec<ExprId>; 2]>,
    carried: Carried,
    /// What names begin with.
    prefix: &'b str,
}

/// Passes all loads on, from the last unknown to the drivers, with names that begin with `prefix`.
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
        on_arms: vec![[const { Vec::new() }; 2]; form.arms.len()],
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
    /// All of the load on an unknown, under a name.
    fn take(&mut self, unknown: usize) -> ExprId {
        let mut terms = std::mem::take(&mut self.pending[unknown]);
        let form = &self.builder.system.vector_form;
        let arms = form.arms.iter().enumerate();
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

    /// Passes a multiple of an expression's derivatives on to what it mentions, but for some unknowns.
    fn give(&mut self, expr: ExprId, factor: ExprId, except: &[usize]) {
        let zero = self.builder.graph().zero();
        if factor == zero {
            return;
        }
        for symbol in self.builder.graph().symbols(expr).to_vec() {
            let form = &self.builder.system.vector_form;
            let unknown = form.place_of_unknown(symbol);
            let arm = form.place_of_symbol(symbol);
            let turned_by = arm.map(|place| form.arms[place].angle);
            let moved = unknown.or(turned_by);
            if moved.is_some_and(|moved| except.contains(&moved)) {
                continue;
            }
            let component = arm.map(|place| usize::from(form.arms[place].symbols[0] != symbol));
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

    /// Finds the multipliers of a part and passes on what its equations carry.
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

    /// The multipliers of equations to which others were added → those of the equations themselves: with g = f ± h, what g carries h
    /// carries too, or its opposite.
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

    /// Says what the equations of a part carry, and why.
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

    /// The multipliers of a part without a closed form, by one dense system with its Jacobian.
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
            .map(|_| self.builder.system.intermediate("carried"))
            .collect();
        self.builder.state(Statement::Multipliers {
            targets: targets.iter().copied().map(Some).collect(),
            jacobian,
            forces,
        });
        let graph = self.builder.graph();
        targets.into_iter().map(|it| graph.variable(it)).collect()
    }

    /// The derivative of an expression in an unknown, through the arms that it turns.
    fn slope(&mut self, expr: ExprId, unknown: usize) -> ExprId {
        let mut terms = Vec::new();
        for symbol in self.builder.graph().symbols(expr).to_vec() {
            let form = &self.builder.system.vector_form;
            let arm = form.place_of_symbol(symbol).map(|place| &form.arms[place]);
            let turned = arm
                .filter(|arm| arm.angle == unknown)
                .map(|arm| arm.symbols);
            let is_own = form.place_of_unknown(symbol) == Some(unknown);
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
