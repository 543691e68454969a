//! System and SolvedPlan → the statements of each block.
//!
//! A block's function finds its unknowns, their rates and their accelerations, in this order, from those of the blocks before
//! it. Afterwards every symbol is defined before it is used; what only one function needs is a local value there, and what
//! several need is a field of the instant. Deliberately unknown here: the syntax of Rust.

mod block;
mod builder;
mod closeness;
mod evaluation;
mod fields;
mod liveness;
mod lower;
mod newton;
mod one_angle;
mod outputs;
mod responses;
mod sensitivities;
mod sharing;
mod slides;
mod spoken;
mod transmissions;
mod two_rotations;
mod whole;

pub use closeness::Measured;
pub use lower::lower;
pub use outputs::Output;
pub use sensitivities::{Found, SensitiveQuantity, Sensitivity};
pub use transmissions::Transmission;
pub use whole::{WholeBlock, whole};

use std::collections::{HashMap, HashSet};

use super::{Operations, Statement, Straight};
use crate::expr::{ExprId, SymbolId};
use crate::joint::Quantity;
use crate::structure::SolvedPlan;
use crate::system::System;

/// The functions of the solved view.
#[derive(Clone, Debug)]
pub struct SolvedProgram {
    /// In solve order.
    pub blocks: Vec<BlockProgram>,
    /// Arms and displacements that more than one block uses, in order of definition.
    pub fields: Vec<SymbolId>,
    /// The assembly modes of all blocks that have one.
    pub branches: Vec<Branch>,
    /// What is asked for; `None` where everything is.
    pub outputs: Option<Vec<Output>>,
    /// What the drivers transmit, in written order.
    pub transmissions: Vec<Transmission>,
    /// How the motion depends on parameters, in written order.
    pub sensitivities: Vec<Sensitivity>,
    /// What was kept and left out.
    pub report: Report,
    /// The plan that the blocks carry out.
    pub plan: SolvedPlan,
    // The same fields and branches by symbol; only looked up.
    field_set: HashSet<SymbolId>,
    branch_places: HashMap<SymbolId, usize>,
}

impl SolvedProgram {
    /// Whether a value that is no coordinate is kept in the frame.
    pub fn is_field(&self, symbol: SymbolId) -> bool {
        self.field_set.contains(&symbol)
    }

    /// The assembly mode whose sign a symbol stands for.
    pub fn branch_of(&self, symbol: SymbolId) -> Option<&Branch> {
        self.branch_places
            .get(&symbol)
            .map(|&place| &self.branches[place])
    }
}

/// What the solved view computes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// The blocks that are kept, in solve order.
    pub kept: Vec<String>,
    /// The blocks that nothing asks for.
    pub left_out: Vec<String>,
    /// Angles whose sine and cosine suffice.
    pub angles_left_out: Vec<String>,
    /// The operations of each level: position, velocity, acceleration. Those inside Newton-Raphson are not counted.
    pub operations: [Operations; 3],
    /// The same with nothing left out.
    pub all_operations: [Operations; 3],
    /// What the transmissions take beside the pose; `None` where there are none.
    pub transmission: Option<Operations>,
    /// What the sensitivities take beside pose and rates; `None` where there are none.
    pub sensitivity: Option<Operations>,
}

/// The function of one block.
#[derive(Clone, Debug)]
pub struct BlockProgram {
    /// Its name: how it is solved, and the joints it closes.
    pub name: String,
    /// One line of documentation.
    pub title: String,
    /// What a person calls it: `loop F-N-M`.
    pub spoken: String,
    /// The block of the plan that it solves, from 0; `None` for what only follows from the blocks.
    pub place: Option<usize>,
    /// The joints whose equations it uses.
    pub joints: Vec<usize>,
    /// Functions of time alone, computed first.
    pub time: Straight,
    /// What it computes once although it uses it more often, beside the functions of time; by [`Action::Share`]. Nothing where it
    /// evaluates no function of an unknown.
    pub shared: Option<Straight>,
    /// What it does.
    pub actions: Vec<Action>,
    /// The equations of its Newton-Raphson, where it needs it.
    pub newton: Option<NewtonBlock>,
    /// Whether it reads an assembly mode.
    pub reads_branch: bool,
    /// How far its steps are from singular, where a `monitor` statement asks for it, in their order.
    pub measured: Vec<Measured>,
}

impl BlockProgram {
    /// The names of all values that its actions share.
    pub fn named(&self) -> &Straight {
        self.shared.as_ref().unwrap_or(&self.time)
    }
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
}

/// One statement.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// What follows belongs to this level.
    Section(Level),
    /// A line of comment.
    Comment(String),
    /// target = value.
    Let {
        /// A local value, a field or an unknown.
        target: SymbolId,
        /// What it is.
        value: ExprId,
    },
    /// A value that is used more than once, or the value of a function.
    Share(Statement),
    /// The sine and cosine of an angle.
    SineCosine {
        /// The sine.
        sine: SymbolId,
        /// The cosine.
        cosine: SymbolId,
        /// The angle.
        angle: ExprId,
    },
    /// The angle with this sine and cosine that is nearest to the last one.
    Angle {
        /// The angle's unknown.
        unknown: usize,
        /// Its sine, or a positive multiple of it.
        sine: ExprId,
        /// Its cosine, or the same multiple.
        cosine: ExprId,
    },
    /// Fails where `excess` is not positive beside `scale`: a circle is out of reach or just touched. The square of the
    /// gap's length scale turns the excess into a distance.
    Reach {
        /// The square of the half chord, times `scale` over a length squared.
        excess: ExprId,
        /// What the excess is judged against.
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
        /// What it is judged against.
        scale: ExprId,
    },
    /// Runs the block's Newton-Raphson, which finds the tears with their rates and accelerations.
    Newton,
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

impl Action {
    /// The expressions that it evaluates.
    pub fn values(&self) -> Vec<ExprId> {
        match self {
            Action::Let { value, .. } => vec![*value],
            Action::Share(Statement::Value { expr, .. }) => vec![*expr],
            Action::Share(Statement::SineCosine { angle, .. }) => vec![*angle],
            Action::Share(Statement::Lookup { argument, .. }) => vec![*argument],
            Action::SineCosine { angle, .. } => vec![*angle],
            Action::Angle { sine, cosine, .. } => vec![*sine, *cosine],
            Action::Reach {
                excess,
                scale,
                distance,
                longest,
                shortest,
            } => {
                vec![*excess, *scale, *distance, *longest, *shortest]
            }
            Action::Nonzero { value, scale } => vec![*value, *scale],
            Action::Solve {
                right_hand_side, ..
            } => right_hand_side.clone(),
            Action::Section(_) | Action::Comment(_) | Action::Newton | Action::Factorize => {
                Vec::new()
            }
        }
    }

    /// Changes the expressions that it evaluates.
    fn change_values(&mut self, change: &mut dyn FnMut(ExprId) -> ExprId) {
        let mut each = |values: &mut [&mut ExprId]| {
            for value in values {
                **value = change(**value);
            }
        };
        match self {
            Action::Let { value, .. } => each(&mut [value]),
            Action::SineCosine { angle, .. } => each(&mut [angle]),
            Action::Angle { sine, cosine, .. } => each(&mut [sine, cosine]),
            Action::Reach {
                excess,
                scale,
                distance,
                longest,
                shortest,
            } => each(&mut [excess, scale, distance, longest, shortest]),
            Action::Nonzero { value, scale } => each(&mut [value, scale]),
            Action::Solve {
                right_hand_side, ..
            } => right_hand_side
                .iter_mut()
                .for_each(|value| each(&mut [value])),
            // What is shared is found when all actions are as they stay.
            Action::Share(_)
            | Action::Section(_)
            | Action::Comment(_)
            | Action::Newton
            | Action::Factorize => {}
        }
    }

    /// The symbols that it defines, angles of closed forms apart.
    pub fn targets(&self) -> Vec<SymbolId> {
        match self {
            Action::Let { target, .. } => vec![*target],
            Action::SineCosine { sine, cosine, .. } => vec![*sine, *cosine],
            Action::Solve { targets, .. } => targets.iter().copied().flatten().collect(),
            Action::Section(_)
            | Action::Comment(_)
            | Action::Share(_)
            | Action::Angle { .. }
            | Action::Reach { .. }
            | Action::Nonzero { .. }
            | Action::Newton
            | Action::Factorize => Vec::new(),
        }
    }
}

/// An assembly mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Its name in the generated code.
    pub name: String,
    /// The symbol that is +1 or −1.
    pub symbol: SymbolId,
    /// Whether it is positive in the drawing.
    pub positive: bool,
    /// What its sign tells apart.
    pub meaning: String,
}

/// The equations that Newton-Raphson solves in one block.
#[derive(Clone, Debug)]
pub struct NewtonBlock {
    /// The tears.
    pub unknowns: Vec<usize>,
    /// Sines, cosines and arms of the tears, from the tears themselves, as the residuals need them.
    pub geometry: Vec<Action>,
    /// One residual a row.
    pub residuals: Vec<ExprId>,
    /// What each residual is measured in.
    pub quantities: Vec<Quantity>,
    /// Row by row.
    pub jacobian: Vec<ExprId>,
    /// The rates of the residuals with the tears held.
    pub time_derivative: Vec<ExprId>,
    /// Minus the second rates of the residuals with the tears' accelerations zero.
    pub gamma: Vec<ExprId>,
    /// The fields for its determinant and reciprocal condition, where they are asked for.
    pub measure: Option<[SymbolId; 2]>,
    /// What its functions compute once, beside the functions of time. Nothing where they evaluate no function of an unknown.
    pub shared: Option<Straight>,
}

impl NewtonBlock {
    /// The part of the geometry that these results need.
    pub fn geometry_for(&self, results: &[ExprId], system: &System) -> Vec<Action> {
        let read: Vec<SymbolId> = results
            .iter()
            .flat_map(|&expr| system.mechanism.graph.symbols(expr))
            .copied()
            .collect();
        let mut live = read.into_iter().collect();
        liveness::needed(self.geometry.clone(), None, &mut live, &|_| false, system)
    }

    /// Everything that it evaluates but its geometry.
    pub fn expressions(&self) -> impl Iterator<Item = ExprId> {
        let lists = [
            &self.residuals,
            &self.jacobian,
            &self.time_derivative,
            &self.gamma,
        ];
        lists.into_iter().flatten().copied()
    }
}
