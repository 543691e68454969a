//! Makes rotated local vectors (*arms*): pairs of symbols, one pair per vector and angle, with the rates that rotation gives
//! them.

use super::{Pool, SymbolRole};
use crate::expr::{ExprId, SymbolId};
use crate::joint::geometry::{Vector, turned};

/// Local vector that rotates with a body or a link: a = R(φ) s.
#[derive(Clone, Debug)]
pub struct Arm {
    /// Unknown angle that rotates the vector: that of a leading body, or of a link without a body.
    pub angle: usize,
    /// Vector s in the orientation of that angle.
    pub local: Vector,
    /// Components of a.
    pub symbols: [SymbolId; 2],
    /// Name in generated code: `g_c3`.
    pub name: String,
}

impl Pool {
    /// Rotated local vectors, in order of first use.
    pub fn arms(&self) -> &[Arm] {
        &self.arms
    }

    /// Returns R(φ) s of a local vector in the orientation of the unknown `angle`; a zero vector stays zero.
    pub fn arm(&mut self, angle: usize, local: Vector, name: &str) -> Vector {
        let graph = &mut self.graph;
        let zero = graph.zero();
        if local == [zero, zero] {
            return local;
        }
        if let Some(&place) = self.arm_places.get(&(angle, local)) {
            return self.arms[place]
                .symbols
                .map(|symbol| graph.variable(symbol));
        }
        let taken = |name: &str| {
            let names = &self.taken_names;
            names.contains(name)
                || ["x", "y"]
                    .iter()
                    .any(|axis| names.contains(&format!("{name}_{axis}")))
        };
        // These names distinguish the symbols, so two arms never share a name.
        let base = (self.apart)(name, "point");
        let mut name = base.clone();
        let mut number = self.name_numbers.get(&base).copied().unwrap_or(2);
        while taken(&name) {
            name = format!("{base}_{number}");
            number += 1;
        }
        self.name_numbers.insert(base, number);
        let symbols = ["x", "y"].map(|axis| graph.symbol(&format!("{name}_{axis} arm")));
        let [x, y] = symbols.map(|symbol| graph.variable(symbol));
        let [_, rate, _] = self.unknowns[angle];
        let turning = graph.variable(rate);
        let backward = graph.multiply(turning, y);
        self.rates.insert(symbols[0], graph.negate(backward));
        self.rates.insert(symbols[1], graph.multiply(turning, x));
        self.taken_names.insert(name.clone());
        let place = self.arms.len();
        self.arm_places.insert((angle, local), place);
        self.arms_of.entry(angle).or_default().push(place);
        for symbol in symbols {
            self.set_role(symbol, SymbolRole::Arm(place));
        }
        self.arms.push(Arm {
            angle,
            local,
            symbols,
            name,
        });
        [x, y]
    }

    /// Returns an expression with its arms expanded as sines and cosines of their angles.
    pub fn written_out(&mut self, expr: ExprId) -> ExprId {
        let mut replacements = Vec::new();
        for place in self.arms_mentioned(expr) {
            let (arm, graph) = (&self.arms[place], &mut self.graph);
            let [position, ..] = self.unknowns[arm.angle];
            let angle = graph.variable(position);
            let (sine, cosine) = (graph.sin(angle), graph.cos(angle));
            let written = turned(cosine, sine, arm.local, graph);
            replacements.extend(arm.symbols.into_iter().zip(written));
        }
        self.graph.substitute(expr, &replacements)
    }

    /// Returns the arms that rotate with the angle `unknown`.
    pub fn arms_of(&self, unknown: usize) -> impl Iterator<Item = &Arm> {
        let places = self.arms_of.get(&unknown).into_iter().flatten();
        places.map(|&place| &self.arms[place])
    }

    /// Returns the indices of the arms that an expression mentions, ascending.
    pub fn arms_mentioned(&self, expr: ExprId) -> Vec<usize> {
        let symbols = self.graph.symbols(expr).iter();
        let mut places: Vec<usize> = symbols
            .filter_map(|&symbol| self.place_of_symbol(symbol))
            .collect();
        places.sort_unstable();
        places.dedup();
        places
    }

    /// Returns the unknowns that an expression mentions, directly or through arms that they rotate, ascending.
    pub fn mentioned(&self, expr: ExprId) -> Vec<usize> {
        let symbols = self.graph.symbols(expr).iter();
        let mut unknowns: Vec<usize> = symbols
            .filter_map(|&symbol| match self.role(symbol) {
                SymbolRole::Position(unknown) => Some(unknown),
                SymbolRole::Arm(place) => Some(self.arms[place].angle),
                _ => None,
            })
            .collect();
        unknowns.sort_unstable();
        unknowns.dedup();
        unknowns
    }
}
