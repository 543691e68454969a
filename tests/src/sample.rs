//! Random poses, rates and times, assembled or not: the functions of a mechanism are defined everywhere.

use std::f64::consts::PI;

use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::system::System;

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
    pub fn random(system: &System, random: &mut Random) -> Sample {
        let q = system
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
    pub fn symbols(&self, system: &System) -> Vec<f64> {
        let mut symbols = vec![0.0; system.mechanism.graph.symbol_count()];
        for ((coordinate, q), qd) in system.coordinates.iter().zip(&self.q).zip(&self.qd) {
            symbols[coordinate.position.index()] = *q;
            symbols[coordinate.rate.index()] = *qd;
        }
        symbols[system.mechanism.time.index()] = self.t;
        system.mechanism.graph.fill_nominal(&mut symbols);
        for input in &system.mechanism.inputs {
            let initial = system.mechanism.graph.constant_value(input.initial);
            symbols[input.symbols[0].index()] = initial.expect("a constant");
        }
        symbols
    }
}
