//! A part of a block → how it is solved: one file for each form.
//!
//! A form says which equations it matches, what they are solved for, what its sign means and when it is singular, and it states its
//! position and rates with the words that a person writes beside them. The first form of the list here that matches is taken; no two
//! closed forms match the same equations. Nothing outside its file knows what is particular to a form.

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
use crate::expr::{ExprId, Graph};
use crate::joint::Quantity;
use crate::structure::Subsystem;
use crate::system::{System, VectorForm};
use crate::words::Singular;

/// How a part is solved. Unknowns are indices into the vector form; everything else is known before.
pub trait Form: Debug + Send + Sync {
    /// What the form is called: `two rotations`.
    fn name(&self) -> String;
    /// What it finds.
    fn unknowns(&self) -> Vec<usize>;
    /// The determinant of its Jacobian.
    fn determinant(&self, form: &VectorForm, graph: &mut Graph) -> Determinant;
    /// What vanishes where that is zero.
    fn singular(&self) -> Singular;
    /// How many assembly modes it has; `None` where Newton-Raphson finds them one by one.
    fn modes(&self) -> Option<usize>;
    /// How many of its unknowns are guessed, where Newton-Raphson finds it.
    fn guessed(&self) -> usize {
        self.unknowns().len()
    }
    /// States the position.
    fn position(&self, builder: &mut Builder<'_>) -> Box<dyn Solved>;
}

/// A form whose position has been stated: what its rates are found from.
pub trait Solved {
    /// The determinant up to its sign, as it was computed on the way; `None` where the runtime finds it.
    fn determinant(&self) -> Option<ExprId>;
    /// States what the rates of all levels share.
    fn prepare(&mut self, _builder: &mut Builder<'_>) {}
    /// States the rates, the accelerations or a response.
    fn rates(&self, level: Level, builder: &mut Builder<'_>);
    /// Its Jacobian, for the multipliers of its equations; `None` where the runtime solves it as one dense system.
    fn transposed(&self, _builder: &mut Builder<'_>) -> Option<Transposed> {
        None
    }
    /// The equations of its Newton-Raphson, where it has one.
    fn newton(self: Box<Self>) -> Option<NewtonBlock> {
        None
    }
}

/// The equations of a part, and what its forms look for in them.
pub(super) struct Candidate<'a> {
    equations: Vec<ExprId>,
    rows: Vec<usize>,
    quantities: Vec<Quantity>,
    unknowns: &'a [usize],
    form: &'a VectorForm,
    graph: &'a mut Graph,
}

type Match = fn(&mut Candidate<'_>) -> Option<Arc<dyn Form>>;

/// The closed forms. What none of them matches is left to Newton-Raphson.
const FORMS: &[Match] = &[
    linear::recognize,
    one_angle::recognize,
    two_rotations::recognize,
    rotation_and_slide::recognize,
    turning_slide::recognize,
    two_slides::recognize,
];

/// The form of a part.
pub(super) fn recognize(part: &Subsystem, system: &mut System) -> Arc<dyn Form> {
    let System {
        vector_form: form,
        mechanism,
        ..
    } = system;
    let graph = &mut mechanism.graph;
    let mut candidate = Candidate {
        equations: part.equations.iter().map(|it| it.residual).collect(),
        rows: part.equations.iter().map(|it| it.row).collect(),
        quantities: part.equations.iter().map(|it| it.quantity).collect(),
        unknowns: &part.unknowns,
        form,
        graph,
    };
    // What is singular in every pose Newton-Raphson reports.
    let closed = FORMS.iter().filter(|_| !part.is_singular);
    let found = closed
        .into_iter()
        .find_map(|matches| matches(&mut candidate));
    if let Some(found) = found {
        return found;
    }
    let whole = newton::form(&candidate);
    // A measure of all equations needs all of them.
    let sequences = match part.is_singular || mechanism.monitor {
        true => Vec::new(),
        false => torn::sequences(&mut candidate),
    };
    torn::form(whole, sequences, system)
}

/// The closed form of some of the equations of a part in some of its unknowns, where there is one; everything else is known before.
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
        graph: whole.graph,
    };
    FORMS.iter().find_map(|matches| matches(&mut candidate))
}

impl Candidate<'_> {
    /// The equation and its unknown, where there is one.
    fn single(&self) -> Option<(ExprId, usize)> {
        match (&self.equations[..], self.unknowns) {
            (&[equation], &[unknown]) => Some((equation, unknown)),
            _ => None,
        }
    }

    /// Two equations and their unknowns, angles first.
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

    /// The unknowns of a pair, where they are of these kinds: angle or not.
    fn pair_of(&self, kinds: [bool; 2]) -> Option<([ExprId; 2], [usize; 2])> {
        let pair = self.pair()?;
        (pair.1.map(|unknown| self.is_angle(unknown)) == kinds).then_some(pair)
    }

    /// Whether an expression mentions an unknown.
    fn mentions(&self, expr: ExprId, unknown: usize) -> bool {
        self.form.mentions(expr, unknown, self.graph)
    }

    /// The two equations as the x and the y component of a vector equation: as they are, exchanged, or with one sign changed.
    /// [`Transposed`] undoes them by their places.
    fn arrangements(&mut self, [first, second]: [ExprId; 2]) -> [[ExprId; 2]; 4] {
        let minus_second = self.graph.negate(second);
        [
            [first, second],
            [first, minus_second],
            [second, first],
            [minus_second, first],
        ]
    }
}
