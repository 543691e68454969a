//! Adds friction to forces from the textbook formulation: one dense solution for a unit of friction in each joint.

use linkwright::generated::{friction, multipliers};
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::model::Surfaces;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;
use nalgebra::{DMatrix, DVector};

/// Joints with friction, pins before slides.
#[derive(Clone, Debug)]
pub(crate) struct DenseFriction {
    joints: Vec<DenseJoint>,
    /// Number of pins.
    pins: usize,
    /// Number of coordinates.
    coordinates: usize,
}

/// Joint with friction.
#[derive(Clone, Copy, Debug)]
struct DenseJoint {
    /// Index in the mechanism.
    joint: usize,
    surfaces: Surfaces,
}

/// Friction at an instant.
pub(crate) struct Settled {
    /// Linear columns with friction, and with the friction of the motion in reverse.
    pub columns: [Vec<f64>; 2],
    /// Friction in each joint.
    pub forces: Vec<f64>,
    /// Power of friction.
    pub power: f64,
}

impl DenseFriction {
    /// Creates the joints with friction; `None` if no joint has any.
    pub fn new(system: &System) -> Option<DenseFriction> {
        let frictions = &system.mechanism.forces.frictions;
        let joints = frictions.iter().map(|it| DenseJoint {
            joint: it.joint,
            surfaces: it.surfaces,
        });
        (!frictions.is_empty()).then(|| DenseFriction {
            joints: joints.collect(),
            pins: frictions.iter().filter(|it| it.is_pin()).count(),
            coordinates: system.coordinates.len(),
        })
    }

    /// Joints in the order of their columns.
    pub fn joints(&self) -> impl Iterator<Item = usize> {
        self.joints.iter().map(|it| it.joint)
    }

    /// Returns the evaluated expressions: of each joint the coefficient, the velocity of sliding, the friction on its second body to 1 N,
    /// the length of a slide, and the load of 1 N on all coordinates.
    pub fn roots(&self, pool: &mut Pool, system: &System) -> Vec<ExprId> {
        let mut roots = Vec::new();
        for (own, friction) in self.joints.iter().zip(&system.mechanism.forces.frictions) {
            let zero = pool.graph.zero();
            let mut load = vec![zero; self.coordinates];
            let [mut coefficient, mut rate, mut lever] = [zero; 3];
            if let Some(resisting) = system.resisting(friction, pool) {
                coefficient = resisting.coefficient(&mut pool.graph);
                (rate, lever) = (resisting.rate, resisting.lever);
                for (coordinate, value) in resisting.load {
                    load[coordinate] = pool.graph.add(load[coordinate], value);
                }
            }
            let length = match own.surfaces {
                Surfaces::Slide(Some(length)) => length,
                _ => pool.graph.one(),
            };
            roots.extend([coefficient, rate, lever, length]);
            roots.extend(load);
        }
        roots
    }

    /// Solves for friction, given the values of [`DenseFriction::roots`], the Jacobian, and the multipliers without friction.
    ///
    /// `linear` returns all linear columns of multipliers, those of the joints' reactions last, with these numbers of components.
    pub fn settle(
        &self,
        values: &[f64],
        jacobian: &DMatrix<f64>,
        alone: &DVector<f64>,
        linear: impl Fn(&DVector<f64>) -> Vec<f64>,
        components: &[usize],
    ) -> Option<Settled> {
        let without = linear(alone);
        let [mut coefficients, mut rates, mut levers, mut lengths] = [const { Vec::new() }; 4];
        let mut units = Vec::with_capacity(self.joints.len());
        for own in values.chunks_exact(4 + self.coordinates) {
            coefficients.push(own[0]);
            rates.push(own[1]);
            levers.push(own[2]);
            lengths.push(own[3]);
            let mut unit = DVector::from_column_slice(&own[4..]);
            multipliers::solve(jacobian, &mut unit).ok()?;
            units.push(linear(&unit));
        }
        let reactions = |columns: &[f64]| -> Vec<[f64; 2]> {
            let count: usize = components.iter().sum();
            let mut rest = &columns[columns.len() - count..];
            let joints = self.joints.iter().zip(components).zip(&lengths);
            let reactions = joints.map(|((joint, &count), length)| {
                let (own, others) = rest.split_at(count);
                rest = others;
                joint.components(own, *length)
            });
            reactions.collect()
        };
        let alone = reactions(&without);
        let to_units: Vec<Vec<[f64; 2]>> = units.iter().map(|it| reactions(it)).collect();
        let joints = 0..self.joints.len();
        let to_units = joints.flat_map(|joint| to_units.iter().map(move |unit| unit[joint]));
        let to_units: Vec<[f64; 2]> = to_units.collect();
        let coefficients = DVector::from_vec(coefficients);
        let forward = friction::settle(self.pins, &coefficients, &alone, &to_units).ok()?;
        let backward = friction::settle(self.pins, &-coefficients, &alone, &to_units).ok()?;
        let columns = [&forward, &backward].map(|forces| {
            let mut columns = without.clone();
            for (unit, force) in units.iter().zip(forces) {
                let pairs = columns.iter_mut().zip(unit);
                pairs.for_each(|(column, unit)| *column += force * unit);
            }
            columns
        });
        let powers = forward.iter().zip(&rates);
        Some(Settled {
            columns,
            power: powers.map(|(force, rate)| force * rate).sum(),
            forces: forward
                .iter()
                .zip(&levers)
                .map(|(it, lever)| it * lever)
                .collect(),
        })
    }
}

impl DenseJoint {
    /// Returns both components of a reaction of which friction is a multiple.
    fn components(&self, own: &[f64], length: f64) -> [f64; 2] {
        match (self.surfaces, own) {
            (Surfaces::Pin(_), &[x, y, ..]) => [x, y],
            (Surfaces::Slide(Some(_)), &[normal, moment, ..]) => [
                0.5 * normal + moment / length,
                0.5 * normal - moment / length,
            ],
            (_, &[normal, ..]) => [normal, 0.0],
            _ => [0.0; 2],
        }
    }
}
