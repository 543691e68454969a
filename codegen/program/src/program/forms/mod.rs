//! Solution methods for subsystems, one per file.
//!
//! A method defines the equations that it matches, their unknowns, the meaning of its sign and its singular poses. It states
//! position and rates, with the remarks of a derivation. The first matching method of the list is taken; no two closed forms
//! match the same equations. Details of a method stay in its file.

mod closing;
mod determinant;
mod drawn_mode;
mod linear;
mod newton;
mod one_angle;
mod rotation_and_slide;
mod torn;
mod transposed;
mod turning_slide;
mod two_rotations;
mod two_slides;

pub use determinant::Determinant;
pub use drawn_mode::{DrawnMode, sign_of};
pub use transposed::Transposed;

use std::fmt::Debug;
use std::sync::Arc;

use super::block::NewtonBlock;
use super::builder::Builder;
use super::function::Level;
use crate::expr::ExprId;
use crate::joint::Quantity;
use crate::pool::Pool;
use crate::structure::Subsystem;
use crate::system::{System, VectorForm};
use crate::words::Singular;

/// Solution method of a subsystem. Unknowns are indices into the vector form; all other values are known earlier.
pub trait Form: Debug + Send + Sync {
    /// Returns the name of the method: `RRR dyad`.
    fn name(&self) -> String;
    /// Returns the unknowns that the method solves for.
    fn unknowns(&self) -> Vec<usize>;
    /// Returns the determinant of its Jacobian.
    fn determinant(&self, pool: &mut Pool) -> Determinant;
    /// Returns the function that vanishes with the determinant.
    fn singular(&self) -> Singular;
    /// Returns the number of assembly modes; `None` if Newton-Raphson finds them one by one.
    fn modes(&self) -> Option<usize>;
    /// Returns the number of unknowns that Newton-Raphson iterates.
    fn guessed(&self) -> usize {
        self.unknowns().len()
    }
    /// States the position.
    fn position(&self, builder: &mut Builder<'_>) -> Box<dyn Solved>;
}

/// Solution method whose position has been stated, for its rates.
pub trait Solved {
    /// Returns the determinant up to its sign, as the position computed it; `None` if the runtime computes it.
    fn determinant(&self) -> Option<ExprId>;
    /// States the values that the rates of all levels share.
    fn prepare(&mut self, _builder: &mut Builder<'_>) {}
    /// States the rates, the accelerations or a response.
    fn rates(&self, level: Level, builder: &mut Builder<'_>);
    /// Returns the Jacobian for the multipliers of the equations; `None` if the runtime solves them as one dense system.
    fn transposed(&self, _builder: &mut Builder<'_>) -> Option<Transposed> {
        None
    }
    /// Returns the equations of Newton-Raphson; `None` for closed forms.
    fn newton(self: Box<Self>) -> Option<NewtonBlock> {
        None
    }
}

/// Equations of a subsystem, with the mechanism for matching.
pub(super) struct Candidate<'a> {
    equations: Vec<ExprId>,
    rows: Vec<usize>,
    quantities: Vec<Quantity>,
    unknowns: &'a [usize],
    form: &'a VectorForm,
    pool: &'a mut Pool,
}

type Match = fn(&mut Candidate<'_>) -> Option<Arc<dyn Form>>;

/// Closed forms. Newton-Raphson solves all other subsystems.
const FORMS: &[Match] = &[
    linear::recognize,
    one_angle::recognize,
    two_rotations::recognize,
    rotation_and_slide::recognize,
    turning_slide::recognize,
    two_slides::recognize,
];

/// Returns the solution method of a subsystem.
pub(super) fn recognize(part: &Subsystem, pool: &mut Pool, system: &System) -> Arc<dyn Form> {
    let mut candidate = Candidate {
        equations: part.equations.iter().map(|it| it.residual).collect(),
        rows: part.equations.iter().map(|it| it.row).collect(),
        quantities: part.equations.iter().map(|it| it.quantity).collect(),
        unknowns: &part.unknowns,
        form: &system.vector_form,
        pool,
    };
    // Newton-Raphson reports subsystems that are singular in every pose.
    let closed = FORMS.iter().filter(|_| !part.is_singular);
    let closed_form = closed
        .into_iter()
        .find_map(|matches| matches(&mut candidate));
    if let Some(closed_form) = closed_form {
        return closed_form;
    }
    let whole = newton::form(&candidate);
    // A measure of all equations needs all of them.
    let sequences = match part.is_singular || system.mechanism.monitor {
        true => Vec::new(),
        false => torn::sequences(&mut candidate),
    };
    torn::form(whole, sequences, pool, system)
}

/// Returns a closed form for some equations of a subsystem in some of its unknowns, while all others are known; `None` if there
/// is none.
fn closed(
    equations: &[usize],
    unknowns: &[usize],
    whole: &mut Candidate<'_>,
) -> Option<Arc<dyn Form>> {
    let mut candidate = Candidate {
        equations: equations.iter().map(|&it| whole.equations[it]).collect(),
        rows: equations.iter().map(|&it| whole.rows[it]).collect(),
        quantities: equations.iter().map(|&it| whole.quantities[it]).collect(),
        unknowns,
        form: whole.form,
        pool: whole.pool,
    };
    FORMS.iter().find_map(|matches| matches(&mut candidate))
}

impl Candidate<'_> {
    /// Returns the equation and its unknown; `None` if there are several.
    fn single(&self) -> Option<(ExprId, usize)> {
        match (&self.equations[..], self.unknowns) {
            (&[equation], &[unknown]) => Some((equation, unknown)),
            _ => None,
        }
    }

    /// Returns two equations and their unknowns, angles first; otherwise `None`.
    fn pair(&self) -> Option<([ExprId; 2], [usize; 2])> {
        let (&[first, second], &[a, b]) = (&self.equations[..], self.unknowns) else {
            return None;
        };
        let ordered = match [a, b].map(|unknown| self.is_angle(unknown)) {
            [false, true] => [b, a],
            _ => [a, b],
        };
        Some(([first, second], ordered))
    }

    fn is_angle(&self, unknown: usize) -> bool {
        self.form.unknowns[unknown].quantity == Quantity::Angle
    }

    /// Returns two equations if their unknowns are of these kinds, true for an angle.
    fn pair_of(&self, kinds: [bool; 2]) -> Option<([ExprId; 2], [usize; 2])> {
        let pair = self.pair()?;
        (pair.1.map(|unknown| self.is_angle(unknown)) == kinds).then_some(pair)
    }

    /// True if an expression mentions an unknown.
    fn mentions(&self, expr: ExprId, unknown: usize) -> bool {
        self.pool.mentions(expr, unknown)
    }

    /// Returns the two equations as x and y components of a vector equation: as they are, exchanged, or with one sign changed.
    /// [`Transposed`] reverses the arrangement by its index.
    fn arrangements(&mut self, [first, second]: [ExprId; 2]) -> [[ExprId; 2]; 4] {
        let minus_second = self.pool.graph.negate(second);
        [
            [first, second],
            [first, minus_second],
            [second, first],
            [minus_second, first],
        ]
    }
}
