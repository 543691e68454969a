//! Straight-line code: what every function of a mechanism is made of.

use super::tearing::TornFields;
use crate::expr::{ExprId, IdMap, SplineId, SymbolId};
use crate::words::Phrase;

/// Statements, each of which defines something before its first use, and results.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Function {
    /// In order.
    pub statements: Vec<Statement>,
    /// What it returns; nothing where it assigns to a frame.
    pub results: Vec<Written>,
    /// Expressions that a statement has computed, and what they are called from then on; only looked up.
    pub(super) named: IdMap<ExprId, SymbolId>,
}

/// A result, and the bodies in whose order its terms are written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// The result.
    pub expr: ExprId,
    /// Indices of bodies; may be empty.
    pub bodies: Vec<usize>,
}

/// Position, velocity, acceleration, or what the pose does along a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// The pose.
    Position,
    /// First rates.
    Velocity,
    /// Second rates.
    Acceleration,
    /// Derivatives of the pose along a direction: an index into the system's directions.
    Response(usize),
    /// The rates of these derivatives, which are the derivatives of the rates; of parameters alone.
    ResponseRate(usize),
    /// What drivers exert and joints carry, and the work that is stored.
    Forces,
}

/// One statement.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// What follows belongs to this level.
    Section(Level),
    /// What follows finds, and from what.
    Heading(Phrase),
    /// What a person says before what follows. In generated code it stands where values need an explanation.
    Note(Phrase),
    /// An equation that a person writes, and nobody computes.
    Shown {
        /// What stands left of the sign.
        left: Phrase,
        /// What stands right of it.
        right: Phrase,
        /// Where it comes from; may be empty.
        remark: Phrase,
    },
    /// target = value.
    Let {
        /// A local value, a field or an unknown.
        target: SymbolId,
        /// What it is.
        value: ExprId,
        /// What a person says beside it; may be empty.
        remark: Phrase,
    },
    /// The sine and cosine of an angle, together.
    SineCosine {
        /// The sine.
        sine: SymbolId,
        /// The cosine.
        cosine: SymbolId,
        /// The angle.
        angle: ExprId,
    },
    /// Two or more of a table's value and its derivatives at one place, together.
    Lookup {
        /// By the order of the derivative; none for what is not needed.
        targets: [Option<SymbolId>; 4],
        /// The table.
        spline: SplineId,
        /// The place.
        argument: ExprId,
    },
    /// The angle with this sine and cosine that is nearest to the last one.
    Angle {
        /// The angle.
        target: SymbolId,
        /// Its sine, or a positive multiple of it.
        sine: ExprId,
        /// Its cosine, or the same multiple.
        cosine: ExprId,
    },
    /// Fails where `excess` is not positive beside `scale`: a circle is out of reach or just touched.
    Reach {
        /// The square of the half chord, times `scale` over a length squared.
        excess: ExprId,
        /// What the excess is scaled by.
        scale: ExprId,
        /// The distance to be bridged, in m.
        distance: ExprId,
        /// The longest distance that the links bridge, in m.
        longest: ExprId,
        /// The shortest distance that the links bridge, in m.
        shortest: ExprId,
    },
    /// Fails where a divisor vanishes beside `scale`.
    Nonzero {
        /// The divisor.
        value: ExprId,
        /// What it is scaled by.
        scale: ExprId,
    },
    /// Fails where a driven length is not positive.
    Positive {
        /// The length.
        length: ExprId,
        /// The joint that is driven so.
        joint: usize,
    },
    /// Runs the block's Newton-Raphson, which finds the tears with their rates and accelerations.
    Newton {
        /// The tears with their rates and accelerations.
        found: Vec<[SymbolId; 3]>,
        /// The determinant and the reciprocal condition, where they are asked for.
        measure: Option<[SymbolId; 2]>,
        /// What else is found where the block is torn.
        torn: Option<TornFields>,
    },
    /// The bounds of an input, its radius and its deviation: how far it goes between the frames and beyond.
    Signal {
        /// An index into the mechanism's inputs.
        input: usize,
        /// Its radius and its deviation.
        found: [SymbolId; 2],
    },
    /// Fails where a value is negative on which bounds rely.
    Require {
        /// What must not be negative.
        value: ExprId,
        /// The place in the plan of the block that is blamed.
        block: usize,
    },
    /// Fails where unknowns cannot be shown to have stayed on their path; finds how far they may be from a straight line.
    Isolate {
        /// Whether each equation but the last two links two unknowns to the next two, and all columns turn.
        is_chain: bool,
        /// The place in the plan of each equation's block.
        blocks: Vec<usize>,
        /// One deviation an unknown.
        found: Vec<SymbolId>,
        /// How far each equation is from zero on the line, beside what follows from its curvature and from columns that turn.
        bounds: Vec<ExprId>,
        /// The second derivative of each equation over the span, where that is known with its sign.
        curvatures: Vec<ExprId>,
        /// How far each unknown goes along the line.
        changes: Vec<ExprId>,
        /// How large each unknown is: 1 for angles, and lengths as they are.
        sizes: Vec<ExprId>,
        /// The entries of the Jacobian in this frame that are not zero, with their rows and columns.
        jacobian: Vec<([usize; 2], ExprId)>,
        /// Which of its columns turn with their angle.
        turns: Vec<bool>,
        /// The derivatives of their entries.
        turning: Vec<([usize; 2], ExprId)>,
        /// The rows and columns of the other entries that change.
        varied: Vec<[usize; 2]>,
        /// How far these may change, as a function of the deviations.
        variation: Box<Function>,
    },
    /// Solves Jᵀ λ = f for the multipliers of a part that has no closed form.
    Multipliers {
        /// What is found: one symbol an equation, none where nothing needs it.
        targets: Vec<Option<SymbolId>>,
        /// J, row by row.
        jacobian: Vec<ExprId>,
        /// f: one expression an unknown.
        forces: Vec<ExprId>,
    },
    /// Factorizes the block's Jacobian at the tears that Newton-Raphson found.
    Factorize,
    /// Solves with the factorized Jacobian.
    Solve {
        /// What is found: one symbol a tear, none where nothing needs it.
        targets: Vec<Option<SymbolId>>,
        /// The right-hand side: one expression a row.
        right_hand_side: Vec<ExprId>,
    },
}

impl Statement {
    /// target = value, without a remark.
    pub fn assignment(target: SymbolId, value: ExprId) -> Statement {
        Statement::Let {
            target,
            value,
            remark: Phrase::default(),
        }
    }

    /// The expressions that it evaluates.
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

    /// Changes the expressions that it evaluates.
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

    /// The symbols that it defines.
    pub fn targets(&self) -> Vec<SymbolId> {
        match self {
            Statement::Let { target, .. } | Statement::Angle { target, .. } => vec![*target],
            Statement::SineCosine { sine, cosine, .. } => vec![*sine, *cosine],
            Statement::Lookup { targets, .. } => targets.iter().copied().flatten().collect(),
            Statement::Solve { targets, .. } | Statement::Multipliers { targets, .. } => {
                targets.iter().copied().flatten().collect()
            }
            Statement::Signal { found, .. } => found.to_vec(),
            Statement::Isolate {
                found, variation, ..
            } => found.iter().copied().chain(variation.targets()).collect(),
            Statement::Newton {
                found,
                measure,
                torn,
            } => {
                let found = found.iter().flatten().copied();
                let found = found.chain(measure.iter().flatten().copied());
                found
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

    /// A function of what it finds, which is evaluated again and again.
    pub fn inner(&self) -> Option<&Function> {
        match self {
            Statement::Isolate { variation, .. } => Some(variation),
            _ => None,
        }
    }

    /// The same, to be changed.
    pub(super) fn inner_mut(&mut self) -> Option<&mut Function> {
        match self {
            Statement::Isolate { variation, .. } => Some(variation),
            _ => None,
        }
    }

    /// Whether it only says something.
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
    /// The results alone, nothing computed before them.
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

    /// What an expression is called that was computed before.
    pub fn name_of(&self, expr: ExprId) -> Option<SymbolId> {
        self.named.get(&expr).copied()
    }

    /// Everything that it evaluates.
    pub fn values(&self) -> impl Iterator<Item = ExprId> {
        let statements = self.statements.iter().flat_map(Statement::values);
        statements.chain(self.results.iter().map(|result| result.expr))
    }

    /// Everything that it evaluates, inner functions included.
    pub fn all_values(&self) -> impl Iterator<Item = ExprId> {
        let inner = self.statements.iter().filter_map(Statement::inner);
        let inner = inner.flat_map(|it| it.values().collect::<Vec<_>>());
        self.values().chain(inner)
    }

    /// Everything that it defines.
    pub fn targets(&self) -> impl Iterator<Item = SymbolId> {
        self.statements.iter().flat_map(Statement::targets)
    }
}
