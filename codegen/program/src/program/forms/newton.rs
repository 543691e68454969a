//! Solves all equations of a subsystem at once by Newton-Raphson, in the absence of a closed form.
//!
//! The runtime finds the unknowns with their rates and accelerations. It needs the residuals g of the block, their Jacobian, and
//! their first and second rates at constant unknowns. All four are functions of the unknowns and of earlier results.

use super::determinant::LARGEST_WRITTEN_OUT;
use super::drawn_mode::{DrawnMode, drawn_mode};
use super::{Candidate, Determinant, Form, Solved};
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::Quantity;
use crate::joint::geometry::Vector;
use crate::pool::Pool;
use crate::program::block::NewtonBlock;
use crate::program::builder::Builder;
use crate::program::function::{Function, Level, Statement};
use crate::program::lengths::Lengths;
use crate::program::passes::liveness;
use crate::words::{Phrase, Piece, Singular, counted, enumerated, phrase};

/// Equations g(z) = 0.
#[derive(Clone, Debug)]
pub(super) struct Newton {
    pub unknowns: Vec<usize>,
    pub residuals: Vec<ExprId>,
    pub quantities: Vec<Quantity>,
}

pub(super) fn form(candidate: &Candidate<'_>) -> Newton {
    Newton {
        unknowns: candidate.unknowns.to_vec(),
        residuals: candidate.equations.clone(),
        quantities: candidate.quantities.clone(),
    }
}

impl Form for Newton {
    fn name(&self) -> String {
        format!("Newton of size {}", self.unknowns.len())
    }

    fn unknowns(&self) -> Vec<usize> {
        self.unknowns.clone()
    }

    fn determinant(&self, pool: &mut Pool) -> Determinant {
        let jacobian: Vec<Vec<ExprId>> = self
            .residuals
            .iter()
            .map(|&residual| {
                let residual = pool.written_out(residual);
                let slope =
                    |&unknown: &usize| pool.graph.derivative(residual, pool.position(unknown));
                self.unknowns.iter().map(slope).collect()
            })
            .collect();
        let written =
            jacobian.len() <= LARGEST_WRITTEN_OUT && self.unknowns.len() == jacobian.len();
        let value = written.then(|| expanded(&jacobian, &mut pool.graph));
        Determinant {
            value: value.filter(|&value| pool.graph.is_finite(value)),
            size: None,
            normalized: None,
            jacobian,
        }
    }

    fn singular(&self) -> Singular {
        Singular::Jacobian(self.unknowns.clone())
    }

    fn modes(&self) -> Option<usize> {
        None
    }

    fn position(&self, builder: &mut Builder<'_>) -> Box<dyn Solved> {
        self.open(builder);
        let block = self.equations(builder);
        let unknowns = self.found(builder);
        builder.state(Statement::Newton {
            found: unknowns,
            measure: None,
            torn: None,
        });
        // Rotated vectors are computed again from the converged unknowns, now for all readers.
        for &unknown in &self.unknowns {
            builder.explicit_angle(unknown);
        }
        Box::new(Found::new(block, self.residuals.clone()))
    }
}

impl Newton {
    /// Returns each unknown with its rate and its acceleration.
    pub fn found(&self, builder: &Builder<'_>) -> Vec<[SymbolId; 3]> {
        let unknowns = self.unknowns.iter();
        let unknowns = unknowns.map(|&unknown| &builder.system.vector_form.unknowns[unknown]);
        unknowns
            .map(|it| [it.position, it.rate, it.acceleration])
            .collect()
    }

    /// Returns the residuals, their Jacobian and rates as functions of the unknowns.
    pub fn equations(&self, builder: &mut Builder<'_>) -> NewtonBlock {
        let unknowns = self.found(builder);
        let held: Vec<SymbolId> = unknowns.iter().map(|it| it[1]).collect();
        let steady: Vec<SymbolId> = unknowns.iter().map(|it| it[2]).collect();
        let (mut jacobian, mut time_derivative, mut gamma) = (Vec::new(), Vec::new(), Vec::new());
        for &residual in &self.residuals {
            let first = builder.rate(residual);
            let second = builder.rate(first);
            // The residual's rate is linear in the rates of the unknowns; its coefficients are the Jacobian's row.
            let slopes = held
                .iter()
                .map(|&rate| builder.graph().derivative(first, rate));
            jacobian.extend(slopes.collect::<Vec<_>>());
            time_derivative.push(builder.without(first, &held));
            let drift = builder.without(second, &steady);
            gamma.push(builder.graph().negate(drift));
        }
        let unknowns = &builder.system.vector_form.unknowns;
        let columns: Vec<Quantity> = self
            .unknowns
            .iter()
            .map(|&it| unknowns[it].quantity)
            .collect();
        let scaled_by = Lengths::of_block(
            &self.residuals,
            &self.quantities,
            builder.pool,
            builder.system,
        );
        let drawn = drawn_mode(
            &self.residuals,
            &jacobian,
            [&self.quantities, &columns],
            &scaled_by,
            builder.pool,
            builder.system,
        );
        builder.say(|_| {
            match drawn {
                DrawnMode::Sign(_) => "Of several assemblies, the one is kept whose determinant has the sign of the design configuration.",
                DrawnMode::Open => "The design configuration does not satisfy these equations: the assembly is the one that Newton-Raphson finds from it.",
                DrawnMode::Undecided => "The design configuration is nearly singular: of several assemblies the nearest one is kept.",
            }
            .into()
        });
        let geometry = builder.geometry(&self.unknowns);
        let function = |results: Vec<ExprId>| {
            let results = Function::of_results(results);
            let statements = geometry.clone();
            liveness::for_results(
                Function {
                    statements,
                    ..results
                },
                &builder.pool.graph,
            )
        };
        NewtonBlock {
            unknowns: self.unknowns.clone(),
            drawn,
            quantities: self.quantities.clone(),
            scaled_by,
            residual: function(self.residuals.clone()),
            jacobian: function(jacobian),
            time_derivative: function(time_derivative),
            gamma: function(gamma),
            tearing: None,
        }
    }

    /// Explains the lack of a closed form, and prints the residuals.
    fn open(&self, builder: &mut Builder<'_>) {
        let names = self.unknowns.iter().map(|&it| Piece::Unknown(it).into());
        let names: Vec<Phrase> = names.collect();
        let count = self.residuals.len();
        let loops = self.loops(builder);
        let loops_counted = loops
            .as_ref()
            .map(|it| counted(it.len(), "loop", "coupled loops"));
        let equations = counted(count, "equation", "equations");
        let source = loops_counted.as_ref().unwrap_or(&equations);
        builder.heading(phrase![
            enumerated(&names),
            format!(" from {source} at once")
        ]);
        builder.say(|_| match (&names[..], &loops_counted) {
            ([only], None) => phrase![
                "No closed form is known here: the equation is linear neither in ",
                only,
                " nor in its cosine and sine. Newton-Raphson finds it, starting from the last pose."
            ],
            (_, made_of) => {
                let made_of = made_of.as_ref().map(|it| format!(", the components of {it},"));
                phrase![
                    format!("No closed form is known here: {equations}{} hold ", made_of.unwrap_or_default()),
                    enumerated(&names),
                    " together. No part of the equations holds only as many unknowns as it has equations, so they cannot be \
                     solved one loop after the other, and the whole is not one of the pairs of circles and lines whose \
                     intersection is a square root. Newton-Raphson finds all of them at once, starting from the last pose."
                ]
            }
        });
        if let Some(loops) = loops {
            builder.say(|_| "The loops as vectors:".into());
            builder.show(|_| {
                let equations = loops
                    .into_iter()
                    .map(|it| [Piece::Sum(it).into(), "0".into(), "".into()]);
                equations.collect()
            });
        }
        builder.say(|_| "The residuals by components:".into());
        builder.show(|_| {
            let numbered = self.residuals.iter().enumerate();
            let equations = numbered.map(|(place, &residual)| {
                let name = Piece::Numbered("g", place + 1);
                [name.into(), Piece::Formula(residual).into(), "".into()]
            });
            equations.collect()
        });
    }

    /// Returns the residuals in pairs as vectors; `None` if they are not components of vectors.
    pub fn loops(&self, builder: &mut Builder<'_>) -> Option<Vec<Vector>> {
        let pairs = self.residuals.chunks_exact(2);
        if !pairs.remainder().is_empty() {
            return None;
        }
        let pairs: Vec<Vector> = pairs.map(|pair| [pair[0], pair[1]]).collect();
        let are_sums = pairs
            .iter()
            .all(|&pair| builder.system.vector_sum(pair, builder.pool).is_some());
        are_sums.then_some(pairs)
    }
}

/// Equations of a block that are solved at once.
pub(super) struct Found {
    block: NewtonBlock,
    residuals: Vec<ExprId>,
}

impl Found {
    pub fn new(block: NewtonBlock, residuals: Vec<ExprId>) -> Found {
        Found { block, residuals }
    }
}

impl Solved for Found {
    fn determinant(&self) -> Option<ExprId> {
        None
    }

    fn prepare(&mut self, builder: &mut Builder<'_>) {
        let size = self.residuals.len();
        builder.say(|_| {
            let matrix = || Piece::Matrix("G", "z");
            phrase![
                format!("Velocity and acceleration: with the {size} by {size} Jacobian "),
                matrix(),
                " of the residuals in these unknowns, the rates of the unknowns solve one linear system with the right-hand side \
                 minus the rates of the residuals with the unknowns held; the accelerations solve the same system. Both exist while \
                 the determinant of ",
                matrix(),
                " is not zero."
            ]
        });
    }

    fn rates(&self, level: Level, builder: &mut Builder<'_>) {
        builder.newton_response(&self.block.unknowns, &self.residuals, level);
    }

    fn newton(self: Box<Self>) -> Option<NewtonBlock> {
        Some(self.block)
    }
}

/// Expands the determinant by cofactors of the first row.
fn expanded(rows: &[Vec<ExprId>], graph: &mut Graph) -> ExprId {
    let Some((first, others)) = rows.split_first() else {
        return graph.one();
    };
    let zero = graph.zero();
    let mut terms = Vec::with_capacity(first.len());
    for (column, &entry) in first.iter().enumerate() {
        if entry == zero {
            continue;
        }
        let minor: Vec<Vec<ExprId>> = others
            .iter()
            .map(|row| {
                let kept = row.iter().enumerate().filter(|(place, _)| *place != column);
                kept.map(|(_, &entry)| entry).collect()
            })
            .collect();
        let cofactor = expanded(&minor, graph);
        let term = graph.multiply(entry, cofactor);
        terms.push(if column % 2 == 0 {
            term
        } else {
            graph.negate(term)
        });
    }
    graph.sum(&terms)
}
