//! Lists the compiled modules of `linkwright-mechanisms`, each wrapped as a [`Solver`].
//!
//! Modules have no names at run time, so that the build script writes the list from the descriptions.

use std::marker::PhantomData;

use linkwright::generated::newton;
use linkwright::nalgebra::{Const, OMatrix, OVector, SVector};
use linkwright::{
    Blocks, Equations, Failure, Frame, Mechanism, PointMotion, Settings, Shell, Step,
};
use nalgebra::{DMatrix, DVector, Dyn};

use crate::solver::{Functions, Solver};
use crate::values::{assembled_from, levels, point_names};

/// A compiled module.
pub struct Module {
    /// The mechanism's name.
    pub name: &'static str,
    /// Its points, in the order of their declaration.
    pub points: fn() -> Vec<String>,
    /// Makes a solver that is not yet assembled.
    pub make: fn() -> Box<dyn Solver>,
    /// The pose to which the mechanism is assembled from an estimate at a time, in the modes of the drawing.
    pub assemble_from: fn(&[f64], f64) -> Result<Vec<f64>, Failure>,
}

/// The module of a mechanism.
///
/// # Panics
/// If the list lacks it.
pub fn module(name: &str) -> &'static Module {
    MODULES
        .iter()
        .find(|module| module.name == name)
        .unwrap_or_else(|| panic!("`{name}` is not compiled"))
}

impl Module {
    /// The module with this mechanism and these equations.
    const fn of<M, E, const N: usize>(name: &'static str) -> Module
    where
        M: Mechanism<Blocks: Blocks<Scalar = f64> + Default> + 'static,
        E: Equations<f64, Const<N>> + Default + 'static,
    {
        Module {
            name,
            points: points::<M>,
            make: make::<M, E, N>,
            assemble_from: assemble_from::<M>,
        }
    }
}

fn points<M: Mechanism<Blocks: Default>>() -> Vec<String> {
    let blocks = M::Blocks::default();
    point_names(&blocks)
        .iter()
        .map(ToString::to_string)
        .collect()
}

fn make<M, E, const N: usize>() -> Box<dyn Solver>
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default> + 'static,
    E: Equations<f64, Const<N>> + Default + 'static,
{
    Box::new(Generated::<M, E, N> {
        textbook: E::default(),
        solved: None,
        mechanism: PhantomData,
    })
}

fn assemble_from<M>(estimate: &[f64], t: f64) -> Result<Vec<f64>, Failure>
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>,
{
    let shell = assembled_from(M::Blocks::default(), estimate, t, Settings::default())?;
    let [q, ..] = levels(shell.blocks(), shell.frame());
    Ok(q)
}

/// A mechanism at an instant, and its frame as vectors.
type Solved<B> = (Shell<B>, Frame<f64, Dyn>);

/// A generated mechanism with its textbook view, and its last frame as vectors.
struct Generated<M: Mechanism, E, const N: usize> {
    textbook: E,
    solved: Option<Solved<M::Blocks>>,
    mechanism: PhantomData<M>,
}

impl<M, E, const N: usize> Generated<M, E, N>
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>,
    E: Equations<f64, Const<N>>,
{
    fn store(&mut self, shell: Shell<M::Blocks>) {
        let levels = levels(shell.blocks(), shell.frame());
        let [q, qd, qdd] = levels.map(DVector::from_vec);
        let t = M::Blocks::time(shell.frame());
        self.solved = Some((shell, Frame { t, q, qd, qdd }));
    }

    fn shell(&self) -> &Shell<M::Blocks> {
        let (shell, _) = self
            .solved
            .as_ref()
            .expect("the mechanism has been assembled");
        shell
    }
}

fn dynamic<const N: usize>(vector: SVector<f64, N>) -> DVector<f64> {
    DVector::from_column_slice(vector.as_slice())
}

impl<M, E, const N: usize> Solver for Generated<M, E, N>
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>,
    E: Equations<f64, Const<N>>,
{
    fn kind(&self) -> &'static str {
        "generated"
    }

    fn functions(&self, q: &[f64], qd: &[f64], t: f64) -> Functions {
        let (q, qd) = (
            SVector::from_column_slice(q),
            SVector::from_column_slice(qd),
        );
        // What is not written stays NaN and fails every comparison.
        let unset = OVector::<f64, Const<N>>::repeat(f64::NAN);
        let (mut phi, mut phi_t, mut gamma) = (unset, unset, unset);
        let mut phi_q = OMatrix::<f64, Const<N>, Const<N>>::repeat(f64::NAN);
        self.textbook.residual(&q, t, &mut phi);
        self.textbook.jacobian(&q, t, &mut phi_q);
        self.textbook.time_derivative(&q, t, &mut phi_t);
        self.textbook.gamma(&q, &qd, t, &mut gamma);
        Functions {
            phi: dynamic(phi),
            phi_q: DMatrix::from_column_slice(N, N, phi_q.as_slice()),
            phi_t: dynamic(phi_t),
            gamma: dynamic(gamma),
        }
    }

    fn residual(&self, q: &[f64], t: f64) -> DVector<f64> {
        let mut phi = SVector::repeat(f64::NAN);
        self.textbook
            .residual(&SVector::from_column_slice(q), t, &mut phi);
        dynamic(phi)
    }

    fn assemble(&mut self, t: f64) {
        let shell = assembled_from(M::Blocks::default(), &[], t, Settings::default());
        self.store(shell.unwrap_or_else(|failure| panic!("{failure}")));
    }

    fn advance(&mut self, t: f64) {
        let (mut shell, _) = self
            .solved
            .take()
            .expect("the mechanism has been assembled");
        let inputs = shell.blocks().initial_inputs();
        if let Err(failure) = shell.advance(t, &inputs) {
            panic!("{failure}");
        }
        self.store(shell);
    }

    fn frame(&self) -> &Frame<f64, Dyn> {
        let (_, frame) = self
            .solved
            .as_ref()
            .expect("the mechanism has been assembled");
        frame
    }

    fn point(&self, name: &str) -> PointMotion {
        let shell = self.shell();
        let names = point_names(shell.blocks());
        let index = names.iter().position(|it| *it == name);
        let motion = index.and_then(|index| shell.blocks().point(shell.frame(), index));
        motion.unwrap_or_else(|| panic!("no point {name}"))
    }

    fn newton_step(&self, q: &[f64], t: f64) -> Step<f64, Dyn> {
        let q = SVector::from_column_slice(q);
        let step = newton::step(&self.textbook, &q, t, &Settings::default());
        let step = step.unwrap_or_else(|failure| panic!("{failure}"));
        Step {
            jacobian: DMatrix::from_column_slice(N, N, step.jacobian.as_slice()),
            right_hand_side: dynamic(step.right_hand_side),
            update: dynamic(step.update),
            pose: dynamic(step.pose),
        }
    }
}

include!(concat!(env!("OUT_DIR"), "/modules.rs"));
