//! Random poses, rates and times, assembled or not: the functions of a mechanism are defined everywhere.

use std::f64::consts::PI;

use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::system::Derived;

use crate::random::Random;

/// Arguments of the functions of a mechanism.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The pose q.
    pub q: Vec<f64>,
    /// The rates q̇.
    pub qd: Vec<f64>,
    /// The time t.
    pub t: f64,
}

impl Sample {
    /// Lengths up to 2 m, angles up to a turn, rates up to 2 m/s or 2 rad/s, times up to 5 s.
    pub fn random(derived: &Derived, random: &mut Random) -> Sample {
        let q = derived
            .system
            .coordinates
            .iter()
            .map(|coordinate| match coordinate.quantity {
                Quantity::Length | Quantity::Power(_) => random.between(-2.0, 2.0),
                Quantity::Angle => random.between(-PI, PI),
            });
        let q: Vec<f64> = q.collect();
        let qd = q.iter().map(|_| random.between(-2.0, 2.0)).collect();
        Sample {
            q,
            qd,
            t: random.between(0.0, 5.0),
        }
    }

    /// The value of every symbol by its index: q, q̇, t, the defaults of parameters and signals, and zero for accelerations.
    pub fn symbols(&self, derived: &Derived) -> Vec<f64> {
        let mut symbols = vec![0.0; derived.pool.graph.symbol_count()];
        for ((coordinate, q), qd) in derived.system.coordinates.iter().zip(&self.q).zip(&self.qd) {
            symbols[coordinate.position.index()] = *q;
            symbols[coordinate.rate.index()] = *qd;
        }
        symbols[derived.system.mechanism.time.index()] = self.t;
        derived.pool.graph.fill_nominal(&mut symbols);
        for input in &derived.system.mechanism.inputs {
            let initial = derived.pool.graph.constant_value(input.initial);
            symbols[input.symbols[0].index()] = initial.expect("a constant");
        }
        symbols
    }
}
