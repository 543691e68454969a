//! Solves for the rates of two unknowns that close a loop, by Cramer's rule for its x and y components.

use crate::expr::{ExprId, SymbolId};
use crate::joint::geometry::Vector;
use crate::program::builder::Builder;
use crate::program::function::Level;
use crate::program::stretch::Stretch;
use crate::words::{Piece, phrase};

/// Closed chain of links, with its derivatives at constant unknowns.
#[derive(Clone, Debug)]
pub(super) struct Closing {
    unknowns: [usize; 2],
    /// Chain as a sum that moves by the rules of its symbols.
    whole: Vector,
    /// Rate at zero rates of the unknowns, and second rate at zero accelerations of the unknowns.
    levels: [Vector; 2],
    stretches: Vec<Stretch>,
}

impl Closing {
    /// Returns the chain of these links and their closure.
    pub(super) fn new(
        unknowns: [usize; 2],
        parts: &[Vector],
        stretches: impl IntoIterator<Item = Stretch>,
        builder: &mut Builder<'_>,
    ) -> Closing {
        let described = unknowns.map(|unknown| &builder.system.vector_form.unknowns[unknown]);
        let held: Vec<SymbolId> = described.iter().map(|it| it.rate).collect();
        let steady: Vec<SymbolId> = described.iter().map(|it| it.acceleration).collect();
        let [x, y] = [0, 1].map(|axis| {
            let parts: Vec<ExprId> = parts.iter().map(|part| part[axis]).collect();
            let whole = builder.graph().sum(&parts);
            let first = builder.rate(whole);
            let second = builder.rate(first);
            let levels = [
                builder.without(first, &held),
                builder.without(second, &steady),
            ];
            (whole, levels)
        });
        Closing {
            unknowns,
            whole: [x.0, y.0],
            levels: [[x.1[0], y.1[0]], [x.1[1], y.1[1]]],
            stretches: stretches.into_iter().collect(),
        }
    }

    /// Describes the solution for the rates, with the determinant as it was computed.
    pub(super) fn say(
        &self,
        determinant: impl Into<crate::words::Phrase>,
        builder: &mut Builder<'_>,
    ) {
        let determinant = determinant.into();
        let [first, second] = self.unknowns.map(Piece::Rate);
        builder.say(|_| {
            phrase![
                "Velocity: the loop differentiated is a linear system for ",
                first,
                " and ",
                second,
                " with the determinant ",
                determinant,
                "; ",
                Piece::Vector("v".to_string()),
                " is what the loop does while both rest."
            ]
        });
    }

    /// Returns the loop's derivative for a level at constant unknowns, as local values, after the values that it needs.
    pub(super) fn drift(&self, level: Level, builder: &mut Builder<'_>) -> Vector {
        if level == Level::Acceleration {
            let [first, second] = self.unknowns.map(Piece::Acceleration);
            builder.say(|_| {
                phrase![
                    "Acceleration: the same system with ",
                    Piece::Vector("a".to_string()),
                    " in the place of ",
                    Piece::Vector("v".to_string()),
                    " gives ",
                    first,
                    " and ",
                    second,
                    ":"
                ]
            });
        }
        for stretch in &self.stretches {
            stretch.at(level, builder);
        }
        let vector = match level {
            Level::Velocity => self.levels[0],
            Level::Acceleration => self.levels[1],
            _ => self.whole.map(|part| builder.rate_at(part, level)),
        };
        let name = match level {
            Level::Velocity | Level::Response(_) => "v",
            _ => "a",
        };
        builder.vector(name, vector)
    }

    /// States the results of a level: u d + w e = −v by Cramer's rule, u = (e × v)/D and w = (v × d)/D with D = d × e. `inverse`
    /// is 1/D.
    pub(super) fn solve(
        &self,
        [d, e]: [Vector; 2],
        inverse: ExprId,
        level: Level,
        builder: &mut Builder<'_>,
    ) {
        let v = self.drift(level, builder);
        let numerators = [builder.cross(e, v), builder.cross(v, d)];
        for (unknown, numerator) in self.unknowns.into_iter().zip(numerators) {
            let value = builder.graph().multiply(numerator, inverse);
            builder.find(unknown, level, value);
        }
    }
}
