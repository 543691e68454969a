//! Solvers of a mechanism, by name: the generated code and the interpreter behind one interface, so that each check
//! of a test applies to both.

use linkwright::generated::newton;
use linkwright::{Equations, Frame, PointMotion, Settings, Step};
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::textbook::TextbookEquations;
use nalgebra::{DMatrix, DVector, Dyn};

use crate::description;
use crate::generated::{self, Module};

/// Solver of a mechanism.
pub trait Solver {
    /// `generated` or `interpreted`, for messages.
    fn kind(&self) -> &'static str;
    /// Φ, Φ_q, Φ_t and γ at (q, q̇, t).
    fn functions(&self, q: &[f64], qd: &[f64], t: f64) -> Functions;
    /// Φ at (q, t).
    fn residual(&self, q: &[f64], t: f64) -> DVector<f64>;
    /// Assembles at `t` from the drawing.
    fn assemble(&mut self, t: f64);
    /// Advances the last frame to `t`.
    fn advance(&mut self, t: f64);
    /// The last frame.
    fn frame(&self) -> &Frame<f64, Dyn>;
    /// The motion of a point at the last frame.
    fn point(&self, name: &str) -> PointMotion;
    /// One Newton-Raphson step.
    fn newton_step(&self, q: &[f64], t: f64) -> Step<f64, Dyn>;

    /// Advances in steps of 0.01 s until `t` is reached.
    fn sweep_to(&mut self, t: f64) {
        const PER_SECOND: f64 = 100.0;
        let from = (self.frame().t * PER_SECOND).round() as i64;
        let to = (t * PER_SECOND).round() as i64;
        for step in from + 1..=to {
            self.advance(step as f64 / PER_SECOND);
        }
    }
}

/// The values of a mechanism's functions.
#[derive(Clone, Debug)]
pub struct Functions {
    /// Φ (n).
    pub phi: DVector<f64>,
    /// Φ_q (n × n).
    pub phi_q: DMatrix<f64>,
    /// Φ_t (n).
    pub phi_t: DVector<f64>,
    /// γ (n).
    pub gamma: DVector<f64>,
}

/// Both solvers of a mechanism.
///
/// # Panics
/// If the mechanism is not described or not generated.
pub fn both(name: &str) -> [Box<dyn Solver>; 2] {
    [
        generated::module(name).solver(),
        Box::new(Interpreted::new(name)),
    ]
}

/// The interpreter with the frame it has reached.
pub struct Interpreted {
    /// The equations.
    pub equations: TextbookEquations,
    frame: Option<Frame<f64, Dyn>>,
}

impl Interpreted {
    /// The interpreter of a described mechanism, not yet assembled.
    pub fn new(name: &str) -> Interpreted {
        Self::of(&description::system(name))
    }

    /// The interpreter of a system, not yet assembled.
    pub fn of(derived: &Derived) -> Interpreted {
        Interpreted {
            equations: TextbookEquations::new(&derived.pool, &derived.system),
            frame: None,
        }
    }
}

impl Solver for Interpreted {
    fn kind(&self) -> &'static str {
        "interpreted"
    }

    fn functions(&self, q: &[f64], qd: &[f64], t: f64) -> Functions {
        let n = q.len();
        let (q, qd) = (
            DVector::from_column_slice(q),
            DVector::from_column_slice(qd),
        );
        // Unwritten entries stay NaN and fail every comparison.
        let unset = DVector::from_element(n, f64::NAN);
        let mut functions = Functions {
            phi: unset.clone(),
            phi_q: DMatrix::from_element(n, n, f64::NAN),
            phi_t: unset.clone(),
            gamma: unset,
        };
        self.equations.residual(&q, t, &mut functions.phi);
        self.equations.jacobian(&q, t, &mut functions.phi_q);
        self.equations.time_derivative(&q, t, &mut functions.phi_t);
        self.equations.gamma(&q, &qd, t, &mut functions.gamma);
        functions
    }

    fn residual(&self, q: &[f64], t: f64) -> DVector<f64> {
        let mut phi = DVector::from_element(q.len(), f64::NAN);
        self.equations
            .residual(&DVector::from_column_slice(q), t, &mut phi);
        phi
    }

    fn assemble(&mut self, t: f64) {
        let solved = linkwright::Frame::assemble(
            &self.equations,
            self.equations.estimate(),
            t,
            &Settings::default(),
        );
        self.frame = Some(solved.unwrap_or_else(|failure| panic!("{failure}")));
    }

    fn advance(&mut self, t: f64) {
        let solved = self
            .frame()
            .advance(&self.equations, t, &Settings::default());
        self.frame = Some(solved.unwrap_or_else(|failure| panic!("{failure}")));
    }

    fn frame(&self) -> &Frame<f64, Dyn> {
        self.frame
            .as_ref()
            .expect("the mechanism has been assembled")
    }

    fn point(&self, name: &str) -> PointMotion {
        let index = self
            .equations
            .point_names()
            .iter()
            .position(|it| it == name);
        self.equations.points(self.frame())[index.unwrap_or_else(|| panic!("no point {name}"))]
    }

    fn newton_step(&self, q: &[f64], t: f64) -> Step<f64, Dyn> {
        let step = newton::step(
            &self.equations,
            &DVector::from_column_slice(q),
            t,
            &Settings::default(),
        );
        step.unwrap_or_else(|failure| panic!("{failure}"))
    }
}

/// Generated module that has a solver.
pub trait Solvable {
    /// A solver that is not yet assembled.
    fn solver(&self) -> Box<dyn Solver>;
}

impl Solvable for Module {
    fn solver(&self) -> Box<dyn Solver> {
        (self.make)()
    }
}
