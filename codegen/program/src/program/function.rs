//! Functions as straight-line code.
//!
//! Each statement defines its targets before their first use.

use super::quantities::Quantities;
use super::tearing::TornFields;
use crate::expr::{ExprId, IdMap, SplineId, SymbolId};

use crate::words::Phrase;

/// Statements in the order of evaluation, and results.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Function {
    /// Statements, in order of evaluation.
    pub statements: Vec<Statement>,
    /// Values that the function returns; empty if it assigns to a frame.
    pub results: Vec<Written>,
    /// Names of expressions that a statement has computed; only looked up.
    pub(super) named: IdMap<ExprId, SymbolId>,
    /// Quantities of the derivation that name constants.
    pub(super) quantities: Quantities,
}

/// A result, and the bodies whose order its terms follow.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Value of the result.
    pub expr: ExprId,
    /// Indices of the bodies; may be empty.
    pub bodies: Vec<usize>,
}

/// Group of statements: pose, rates, accelerations, derivatives along a direction, or forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// The pose.
    Position,
    /// Rates.
    Velocity,
    /// Accelerations.
    Acceleration,
    /// Derivatives of the pose along a direction; the value is an index into the system's directions.
    Response(usize),
    /// Rates of these derivatives, which equal the derivatives of the rates; for parameters only.
    ResponseRate(usize),
    /// Driving forces and torques, reactions, and stored energy.
    Forces,
}

/// A statement.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// Level of the statements that follow.
    Section(Level),
    /// Heading: the results of the statements that follow, and their inputs.
    Heading(Phrase),
    /// Note on the statements that follow. Generated code prints the note where values need an explanation.
    Note(Phrase),
    /// Equation that is printed and not computed.
    Shown {
        /// Left side.
        left: Phrase,
        /// Right side.
        right: Phrase,
        /// Origin of the equation; may be empty.
        remark: Phrase,
    },
    /// Assignment of a value to a target.
    Let {
        /// Local value, field or unknown.
        target: SymbolId,
        /// Value of the target.
        value: ExprId,
        /// Remark beside the assignment; may be empty.
        remark: Phrase,
    },
    /// Sine and cosine of one angle.
    SineCosine {
        /// Target of the sine.
        sine: SymbolId,
        /// Target of the cosine.
        cosine: SymbolId,
        /// Angle, in rad.
        angle: ExprId,
    },
    /// Value of a table and its derivatives at one argument; two or more of them.
    Lookup {
        /// Targets by order of the derivative; `None` if a derivative is not needed.
        targets: [Option<SymbolId>; 4],
        /// Table.
        spline: SplineId,
        /// Argument of the table.
        argument: ExprId,
    },
    /// Angle with a given sine and cosine, nearest to the angle of the last frame.
    Angle {
        /// Target of the angle.
        target: SymbolId,
        /// Sine of the angle, or a positive multiple of the sine.
        sine: ExprId,
        /// Cosine of the angle, or the cosine times that multiple.
        cosine: ExprId,
    },
    /// Check that `excess` is positive relative to `scale`. Otherwise a circle is out of reach or tangent.
    Reach {
        /// Square of the half chord, times `scale` over a length squared.
        excess: ExprId,
        /// Scale of the excess.
        scale: ExprId,
        /// Distance between the ends of the links, in m.
        distance: ExprId,
        /// Longest distance that the links can span, in m.
        longest: ExprId,
        /// Shortest distance that the links can span, in m.
        shortest: ExprId,
    },
    /// Check that a divisor does not vanish relative to `scale`.
    Nonzero {
        /// Divisor.
        value: ExprId,
        /// Scale of the divisor.
        scale: ExprId,
    },
    /// Check that a driven length is positive.
    Positive {
        /// Length, in m.
        length: ExprId,
        /// Index of the driven joint.
        joint: usize,
    },
    /// Newton-Raphson iteration of the block, for the tearing variables with their rates and accelerations.
    Newton {
        /// Tearing variables with their rates and accelerations.
        found: Vec<[SymbolId; 3]>,
        /// Determinant and reciprocal condition number; `None` if not requested.
        measure: Option<[SymbolId; 2]>,
        /// Fields of a torn block; `None` if the block is not torn.
        torn: Option<TornFields>,
    },
    /// Bounds on an input between the frames: its largest change (radius) and its deviation from the chord.
    Signal {
        /// Index into the mechanism's inputs.
        input: usize,
        /// Radius and deviation.
        found: [SymbolId; 2],
    },
    /// Check that a value on which bounds rely is not negative.
    Require {
        /// Value that must not be negative.
        value: ExprId,
        /// Position in the plan of the block that a failure names.
        block: usize,
    },
    /// Check that unknowns stay on their path; bounds their deviations from the chord.
    Isolate {
        /// True if each equation but the last two links two unknowns to the next two, and all columns rotate.
        is_chain: bool,
        /// Position in the plan of each equation's block.
        blocks: Vec<usize>,
        /// Deviations, one per unknown.
        found: Vec<SymbolId>,
        /// Bound on each residual on the chord, except for the effects of curvature and of rotating columns.
        bounds: Vec<ExprId>,
        /// Second derivative of each equation over the window, as far as its value and sign are known.
        curvatures: Vec<ExprId>,
        /// Change of each unknown along the chord.
        changes: Vec<ExprId>,
        /// Magnitude of each unknown: 1 for angles, the length itself for lengths.
        sizes: Vec<ExprId>,
        /// Nonzero entries of the Jacobian in this frame, with their rows and columns.
        jacobian: Vec<([usize; 2], ExprId)>,
        /// True for each column that rotates with its angle.
        turns: Vec<bool>,
        /// Derivatives of the entries of these columns.
        turning: Vec<([usize; 2], ExprId)>,
        /// Rows and columns of the other entries that change.
        varied: Vec<[usize; 2]>,
        /// Bound on the variation of these entries, as a function of the deviations.
        variation: Box<Function>,
    },
    /// Solution of Jᵀ λ = f for the multipliers of a subsystem without a closed form.
    Multipliers {
        /// Multipliers, one per equation; `None` if a multiplier is not needed.
        targets: Vec<Option<SymbolId>>,
        /// J, row by row.
        jacobian: Vec<ExprId>,
        /// f, one expression per unknown.
        forces: Vec<ExprId>,
    },
    /// Solution for the forces of friction in joints, pins before slides.
    Friction {
        /// Number of pins.
        pins: usize,
        /// Force or moment of friction, one per joint; `None` if a force is not needed.
        targets: Vec<Option<SymbolId>>,
        /// Forces over the magnitudes of reactions, with the sign of what resists sliding.
        coefficients: Vec<ExprId>,
        /// Both components of each reaction without friction.
        alone: Vec<[ExprId; 2]>,
        /// Components of each reaction to a unit of each force, joint by joint.
        units: Vec<[ExprId; 2]>,
    },
    /// Factorization of the block's Jacobian at the solution of Newton-Raphson.
    Factorize,
    /// Solution of a linear system with the factorized Jacobian.
    Solve {
        /// Solution, one symbol per tearing variable; `None` if a symbol is not needed.
        targets: Vec<Option<SymbolId>>,
        /// Right-hand side, one expression per row.
        right_hand_side: Vec<ExprId>,
    },
}

impl Statement {
    /// Returns the assignment of a value to a target, without a remark.
    pub fn assignment(target: SymbolId, value: ExprId) -> Statement {
        Statement::Let {
            target,
            value,
            remark: Phrase::default(),
        }
    }

    /// Returns the expressions that the statement evaluates, in order.
    pub fn values(&self) -> Vec<ExprId> {
        match self {
            Statement::Let { value, .. } => vec![*value],
            Statement::SineCosine { angle, .. } => vec![*angle],
            Statement::Lookup { argument, .. } => vec![*argument],
            Statement::Angle { sine, cosine, .. } => vec![*sine, *cosine],
            Statement::Reach {
                excess,
                scale,
                distance,
                longest,
                shortest,
            } => vec![*excess, *scale, *distance, *longest, *shortest],
            Statement::Nonzero { value, scale } => vec![*value, *scale],
            Statement::Positive { length, .. } => vec![*length],
            Statement::Solve {
                right_hand_side, ..
            } => right_hand_side.clone(),
            Statement::Multipliers {
                jacobian, forces, ..
            } => jacobian.iter().chain(forces).copied().collect(),
            Statement::Friction {
                coefficients,
                alone,
                units,
                ..
            } => {
                let pairs = alone.iter().chain(units).flatten();
                coefficients.iter().chain(pairs).copied().collect()
            }
            Statement::Require { value, .. } => vec![*value],
            Statement::Isolate {
                bounds,
                curvatures,
                changes,
                sizes,
                jacobian,
                turning,
                ..
            } => {
                let entries = jacobian.iter().chain(turning).map(|(_, entry)| *entry);
                let vectors = [bounds, curvatures, changes, sizes].into_iter().flatten();
                vectors.copied().chain(entries).collect()
            }
            Statement::Signal { .. }
            | Statement::Section(_)
            | Statement::Heading(_)
            | Statement::Note(_)
            | Statement::Shown { .. }
            | Statement::Newton { .. }
            | Statement::Factorize => Vec::new(),
        }
    }

    /// Replaces the expressions that the statement evaluates.
    pub(super) fn change_values(&mut self, change: &mut dyn FnMut(ExprId) -> ExprId) {
        let values: Vec<&mut ExprId> = match self {
            Statement::Let { value, .. } => vec![value],
            Statement::SineCosine { angle, .. } => vec![angle],
            Statement::Lookup { argument, .. } => vec![argument],
            Statement::Angle { sine, cosine, .. } => vec![sine, cosine],
            Statement::Reach {
                excess,
                scale,
                distance,
                longest,
                shortest,
            } => vec![excess, scale, distance, longest, shortest],
            Statement::Nonzero { value, scale } => vec![value, scale],
            Statement::Positive { length, .. } => vec![length],
            Statement::Solve {
                right_hand_side, ..
            } => right_hand_side.iter_mut().collect(),
            Statement::Multipliers {
                jacobian, forces, ..
            } => jacobian.iter_mut().chain(forces).collect(),
            Statement::Friction {
                coefficients,
                alone,
                units,
                ..
            } => {
                let pairs = alone.iter_mut().chain(units).flatten();
                coefficients.iter_mut().chain(pairs).collect()
            }
            Statement::Require { value, .. } => vec![value],
            Statement::Isolate {
                bounds,
                curvatures,
                changes,
                sizes,
                jacobian,
                turning,
                ..
            } => {
                let entries = jacobian.iter_mut().chain(turning);
                let entries = entries.map(|(_, entry)| entry);
                let vectors = [bounds, curvatures, changes, sizes].into_iter().flatten();
                vectors.chain(entries).collect()
            }
            Statement::Signal { .. }
            | Statement::Section(_)
            | Statement::Heading(_)
            | Statement::Note(_)
            | Statement::Shown { .. }
            | Statement::Newton { .. }
            | Statement::Factorize => Vec::new(),
        };
        for value in values {
            *value = change(*value);
        }
    }

    /// Returns the symbols that the statement defines.
    pub fn targets(&self) -> Vec<SymbolId> {
        match self {
            Statement::Let { target, .. } | Statement::Angle { target, .. } => vec![*target],
            Statement::SineCosine { sine, cosine, .. } => vec![*sine, *cosine],
            Statement::Lookup { targets, .. } => targets.iter().copied().flatten().collect(),
            Statement::Solve { targets, .. }
            | Statement::Multipliers { targets, .. }
            | Statement::Friction { targets, .. } => targets.iter().copied().flatten().collect(),
            Statement::Signal { found, .. } => found.to_vec(),
            Statement::Isolate {
                found, variation, ..
            } => found.iter().copied().chain(variation.targets()).collect(),
            Statement::Newton {
                found,
                measure,
                torn,
            } => {
                let symbols = found.iter().flatten().copied();
                let symbols = symbols.chain(measure.iter().flatten().copied());
                symbols
                    .chain(torn.iter().flat_map(TornFields::targets))
                    .collect()
            }
            Statement::Section(_)
            | Statement::Heading(_)
            | Statement::Note(_)
            | Statement::Shown { .. }
            | Statement::Reach { .. }
            | Statement::Nonzero { .. }
            | Statement::Positive { .. }
            | Statement::Require { .. }
            | Statement::Factorize => Vec::new(),
        }
    }

    /// Returns the function that the statement evaluates repeatedly; `None` if there is none.
    pub fn inner(&self) -> Option<&Function> {
        match self {
            Statement::Isolate { variation, .. } => Some(variation),
            _ => None,
        }
    }

    /// Returns that function for changes.
    pub(super) fn inner_mut(&mut self) -> Option<&mut Function> {
        match self {
            Statement::Isolate { variation, .. } => Some(variation),
            _ => None,
        }
    }

    /// True if the statement is text and computes nothing.
    pub fn is_said(&self) -> bool {
        matches!(
            self,
            Statement::Section(_)
                | Statement::Heading(_)
                | Statement::Note(_)
                | Statement::Shown { .. }
        )
    }
}

impl Function {
    /// Returns a function of results without statements.
    pub fn of_results(results: impl IntoIterator<Item = ExprId>) -> Function {
        let written = |expr| Written {
            expr,
            bodies: Vec::new(),
        };
        Function {
            results: results.into_iter().map(written).collect(),
            ..Function::default()
        }
    }

    /// Returns the name of an expression that a statement has computed; `None` if none has.
    pub fn name_of(&self, expr: ExprId) -> Option<SymbolId> {
        self.named.get(&expr).copied()
    }

    /// Returns all expressions that the function evaluates, except for inner functions.
    pub fn values(&self) -> impl Iterator<Item = ExprId> {
        let statements = self.statements.iter().flat_map(Statement::values);
        statements.chain(self.results.iter().map(|result| result.expr))
    }

    /// Returns all expressions that the function evaluates, including inner functions.
    pub fn all_values(&self) -> impl Iterator<Item = ExprId> {
        let inner = self.statements.iter().filter_map(Statement::inner);
        let inner = inner.flat_map(|it| it.values().collect::<Vec<_>>());
        self.values().chain(inner)
    }

    /// Returns all symbols that the function defines.
    pub fn targets(&self) -> impl Iterator<Item = SymbolId> {
        self.statements.iter().flat_map(Statement::targets)
    }
}
