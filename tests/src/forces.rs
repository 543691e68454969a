//! Descriptions with forces: the requested values of their instants by name, and loads on their bodies by an
//! independent computation.
//!
//! The loads are those of the textbook (Q − M q̈, body by body, about the origin of each frame) in plain numbers,
//! without the generator's forces.

use linkwright::{Settings, Shell};
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::reported::names;
use linkwright_solver::{Instant, Interpreted, View};
use nalgebra::{DMatrix, DVector};

use crate::values::assembled_from;

/// Followed mechanism.
pub struct Followed {
    /// Mechanism at an instant.
    pub shell: Shell<Interpreted>,
    view: Interpreted,
    names: Vec<String>,
}

/// Systems of all motions of a text.
///
/// # Panics
/// If the text has errors.
pub fn systems(name: &str, text: &str) -> Vec<Derived> {
    let source = Source::new(format!("{name}.mech"), text.to_string());
    let read = linkwright_codegen::read(&source)
        .unwrap_or_else(|errors| panic!("{}", errors.render(&source)));
    if let Err(errors) = linkwright_codegen::stages::check_all(&read.motions) {
        panic!("{}", errors.render(&source));
    }
    read.motions
}

impl Followed {
    /// Mechanism assembled at a time; `None` if the assembly fails.
    pub fn new(derived: &Derived, t: f64) -> Option<Followed> {
        let view = Interpreted::new(derived)?;
        let shell = assembled_from(view.clone(), &[], t, Settings::default());
        Some(Followed {
            shell: shell.ok()?,
            names: names(&derived.pool, &derived.system)
                .into_iter()
                .map(|(name, _)| name)
                .collect(),
            view,
        })
    }

    /// Advances to a time; false if the motion ends before.
    pub fn advance(&mut self, t: f64) -> bool {
        let inputs = self.view.input_laws().at(t);
        self.shell.advance(t, &inputs).is_ok()
    }

    /// The instant.
    pub fn instant(&self) -> &Instant {
        self.shell.frame()
    }

    /// Requested values, by name.
    ///
    /// # Panics
    /// If one is unknown.
    pub fn all(&self) -> Vec<(&str, f64)> {
        let values = self.view.reported(self.instant()).expect("known");
        assert_eq!(values.len(), self.names.len());
        let names = self.names.iter().map(String::as_str);
        names.zip(values).collect()
    }

    /// Values of requested transmissions and sensitivities.
    ///
    /// # Panics
    /// If one is unknown.
    pub fn derivatives(&self) -> Vec<f64> {
        self.view.derivatives(self.instant()).expect("known")
    }

    /// Requested value.
    ///
    /// # Panics
    /// If no value of this name is requested.
    pub fn value(&self, name: &str) -> f64 {
        let all = self.all();
        let named = all.iter().find(|(own, _)| *own == name);
        named.unwrap_or_else(|| panic!("no {name} in {all:?}")).1
    }
}

/// Body with its mass.
#[derive(Clone, Copy, Debug)]
pub struct Weight {
    /// Index of the body among those that move.
    pub body: usize,
    /// In kg.
    pub mass: f64,
    /// In the frame of the body, in m.
    pub center: [f64; 2],
    /// About the center of mass, in kg·m².
    pub inertia: f64,
}

/// Coordinates, rates and accelerations of a body.
#[derive(Clone, Copy, Debug)]
pub struct Moving {
    /// x, y, φ.
    pub at: [f64; 3],
    /// Their rates.
    pub rate: [f64; 3],
    /// Their accelerations.
    pub acceleration: [f64; 3],
}

/// A body at an instant.
pub fn moving(body: usize, instant: &Instant) -> Moving {
    let of = |values: &[f64]| [0, 1, 2].map(|axis| values[3 * body + axis]);
    Moving {
        at: of(instant.q()),
        rate: of(instant.qd()),
        acceleration: of(instant.qdd()),
    }
}

impl Moving {
    /// R(φ) s.
    pub fn arm(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sine, cosine) = self.at[2].sin_cos();
        [cosine * x - sine * y, sine * x + cosine * y]
    }

    /// The velocity of a point of the body.
    pub fn velocity(&self, local: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.arm(local);
        [
            self.rate[0] - self.rate[2] * y,
            self.rate[1] + self.rate[2] * x,
        ]
    }

    /// Acceleration of a point of the body.
    pub fn acceleration(&self, local: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.arm(local);
        let (turning, spin) = (self.rate[2], self.acceleration[2]);
        [
            self.acceleration[0] - spin * y - turning * turning * x,
            self.acceleration[1] + spin * x - turning * turning * y,
        ]
    }
}

/// a_x b_y − a_y b_x.
pub fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

impl Weight {
    /// Load Q − M q̈ of the body.
    pub fn load(&self, gravity: [f64; 2], moving: &Moving) -> [f64; 3] {
        let acceleration = moving.acceleration(self.center);
        let force = [0, 1].map(|axis| self.mass * (gravity[axis] - acceleration[axis]));
        let torque = cross(moving.arm(self.center), force) - self.inertia * moving.acceleration[2];
        [force[0], force[1], torque]
    }

    /// Kinetic energy, and its rate.
    pub fn kinetic(&self, moving: &Moving) -> [f64; 2] {
        let (v, a) = (
            moving.velocity(self.center),
            moving.acceleration(self.center),
        );
        let energy = 0.5 * self.mass * (v[0] * v[0] + v[1] * v[1])
            + 0.5 * self.inertia * moving.rate[2] * moving.rate[2];
        let rate = self.mass * (v[0] * a[0] + v[1] * a[1])
            + self.inertia * moving.rate[2] * moving.acceleration[2];
        [energy, rate]
    }

    /// Potential energy, and its rate.
    pub fn potential(&self, gravity: [f64; 2], moving: &Moving) -> [f64; 2] {
        let (arm, v) = (moving.arm(self.center), moving.velocity(self.center));
        let [x, y] = [moving.at[0] + arm[0], moving.at[1] + arm[1]];
        [
            -self.mass * (gravity[0] * x + gravity[1] * y),
            -self.mass * (gravity[0] * v[0] + gravity[1] * v[1]),
        ]
    }
}

/// Multipliers λ of Φ_qᵀ λ = g, by a linear algebra other than ours.
///
/// # Panics
/// If Φ_q is singular.
pub fn multipliers(jacobian: &DMatrix<f64>, loads: &DVector<f64>) -> DVector<f64> {
    let solved = jacobian.transpose().full_piv_lu().solve(loads);
    solved.expect("a regular pose")
}
