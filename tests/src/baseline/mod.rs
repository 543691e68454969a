//! Dense solver of the usual kind for a described mechanism, the baseline of other methods.
//!
//! A `Vec` of joint objects fills a `DMatrix` and a residual; nalgebra's LU solves; a Taylor polynomial predicts;
//! Newton-Raphson stops at max |Φ| ≤ 1e-12, and two more solves give velocities and accelerations. Equations,
//! derivatives and γ are written by hand, as a careful programmer would with a textbook beside the keyboard. Only
//! dimensions and the estimate of the pose are taken from the description. The solve calls neither the generator nor
//! the runtime.

pub mod drive;
pub mod joint;

use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::joint::geometry::{self, BodyId};
use linkwright_codegen::stages::system::Derived;
use nalgebra::{DMatrix, DVector, Vector2};

use self::drive::{Drive, drives};
use self::joint::{
    AbsoluteCoordinate, Angle, AngleDriver, Joint, LengthDriver, Mark, Offset, Revolute,
    Translational,
};

/// The residual that ends the iteration, in m or rad.
const TOLERANCE: f64 = 1e-12;

/// The largest number of iterations of one frame.
const ITERATIONS: usize = 50;

/// A mechanism with its last frame.
pub struct Baseline {
    joints: Vec<Box<dyn Joint>>,
    drawn: DVector<f64>,
    /// The time of the frame (s).
    pub t: f64,
    /// The pose q (n).
    pub q: DVector<f64>,
    /// The velocity q̇ (n).
    pub qd: DVector<f64>,
    /// The acceleration q̈ (n).
    pub qdd: DVector<f64>,
    phi: DVector<f64>,
    phi_q: DMatrix<f64>,
}

impl Baseline {
    /// The joints of a described mechanism, its coordinates as drawn, with nothing solved.
    ///
    /// # Panics
    /// If the table of drives does not fit the mechanism, or it has a joint of a kind that is not written here.
    pub fn new(derived: &Derived) -> Baseline {
        let reading = Reading { derived };
        let mut drives = drives(&derived.system.mechanism.name).into_iter();
        let mut joints = Vec::new();
        for joint in &derived.system.mechanism.joints {
            let drive = |drives: &mut dyn Iterator<Item = Drive>| {
                drives
                    .next()
                    .unwrap_or_else(|| panic!("no drive for {}", joint.label))
            };
            joints.push(reading.joint(joint, || drive(&mut drives)));
        }
        assert!(drives.next().is_none(), "a drive without a joint");
        let n = derived.system.coordinates.len();
        let estimate = derived
            .system
            .coordinates
            .iter()
            .map(|it| reading.constant(it.estimate));
        let drawn = DVector::from_iterator(n, estimate);
        Baseline {
            joints,
            t: 0.0,
            q: drawn.clone(),
            drawn,
            qd: DVector::zeros(n),
            qdd: DVector::zeros(n),
            phi: DVector::zeros(n),
            phi_q: DMatrix::zeros(n, n),
        }
    }

    /// Back to the drawing at t = 0, at rest.
    pub fn reset(&mut self) {
        self.t = 0.0;
        self.q.copy_from(&self.drawn);
        self.qd.fill(0.0);
        self.qdd.fill(0.0);
    }

    /// Moves the mechanism to the time `t`.
    ///
    /// # Panics
    /// If the iteration does not converge or meets a singular matrix: a measurement needs a motion that exists.
    pub fn advance(&mut self, t: f64) {
        let h = t - self.t;
        self.q += &self.qd * h + &self.qdd * (0.5 * h * h);
        self.t = t;
        let mut iterations = 0;
        loop {
            self.fill_residual();
            if self.phi.amax() <= TOLERANCE {
                break;
            }
            assert!(iterations < ITERATIONS, "no convergence at t = {t}");
            iterations += 1;
            self.fill_jacobian();
            let update = self.phi_q.clone().lu().solve(&self.phi);
            self.q -= update.expect("a regular Jacobian");
        }
        self.fill_jacobian();
        let factorization = self.phi_q.clone().lu();
        let n = self.q.len();
        let mut right_hand_side = DVector::zeros(n);
        let mut row = 0;
        for joint in &self.joints {
            joint.velocity(t, &mut right_hand_side, row);
            row += joint.rows();
        }
        self.qd = factorization
            .solve(&right_hand_side)
            .expect("a regular Jacobian");
        right_hand_side.fill(0.0);
        row = 0;
        for joint in &self.joints {
            joint.acceleration(&self.q, &self.qd, t, &mut right_hand_side, row);
            row += joint.rows();
        }
        self.qdd = factorization
            .solve(&right_hand_side)
            .expect("a regular Jacobian");
    }

    fn fill_residual(&mut self) {
        let mut row = 0;
        for joint in &self.joints {
            joint.residual(&self.q, self.t, &mut self.phi, row);
            row += joint.rows();
        }
    }

    fn fill_jacobian(&mut self) {
        self.phi_q.fill(0.0);
        let mut row = 0;
        for joint in &self.joints {
            joint.jacobian(&self.q, &mut self.phi_q, row);
            row += joint.rows();
        }
    }
}

/// Numbers out of a description.
struct Reading<'a> {
    derived: &'a Derived,
}

impl Reading<'_> {
    fn constant(&self, expression: ExprId) -> f64 {
        self.derived
            .pool
            .graph
            .constant_value(expression)
            .expect("a dimension is constant")
    }

    fn vector(&self, vector: geometry::Vector) -> Vector2<f64> {
        Vector2::new(self.constant(vector[0]), self.constant(vector[1]))
    }

    fn mark(&self, mark: &geometry::Mark) -> Mark {
        let local = self.vector(mark.local);
        match mark.frame.body {
            BodyId::GROUND => Mark { body: None, local },
            // The moving bodies are numbered from 1.
            BodyId(body) => Mark {
                body: Some(body - 1),
                local,
            },
        }
    }

    fn joint(
        &self,
        joint: &linkwright_codegen::stages::model::Joint,
        drive: impl FnOnce() -> Drive,
    ) -> Box<dyn Joint> {
        let operands = &joint.operands;
        let mark = |index: usize| self.mark(&operands.marks[index]);
        let value = || self.constant(operands.value.expect("the joint has a value"));
        let axis = || operands.axis.expect("the joint has an axis");
        let moving = || mark(0).body.expect("the body moves");
        match joint.kind.keyword {
            "revolute" => Box::new(Revolute {
                i: mark(0),
                j: mark(1),
            }),
            "translational" => {
                let direction = self.vector(axis().direction);
                Box::new(Translational {
                    across: Offset {
                        i: mark(0),
                        j: mark(1),
                        direction: Vector2::new(-direction.y, direction.x),
                    },
                    relative_angle: self.constant(axis().relative_angle),
                })
            }
            "absolute_x" => Box::new(AbsoluteCoordinate {
                mark: mark(0),
                axis: 0,
                value: value(),
            }),
            "absolute_y" => Box::new(AbsoluteCoordinate {
                mark: mark(0),
                axis: 1,
                value: value(),
            }),
            "absolute_angle" => Box::new(Angle {
                body: moving(),
                value: value(),
            }),
            "phi" => Box::new(AngleDriver {
                body: moving(),
                drive: drive(),
            }),
            "length" => Box::new(LengthDriver {
                along: Offset {
                    i: mark(0),
                    j: mark(1),
                    direction: self.vector(axis().direction),
                },
                drive: drive(),
            }),
            other => panic!("the baseline has no joint `{other}`"),
        }
    }
}
