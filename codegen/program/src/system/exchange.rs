//! *A system whose coordinate is free, and a coordinate of a body* → *the same mechanism with that one free in its place*.
//!
//! All else stays as it is: coordinates, the order of rows, which of them are monitored, what is asked for and how it is named.

use super::{Described, System, assemble_without};
use crate::expr::{ExprId, Number};
use crate::joint::geometry::Mark;
use crate::joint::{DRIVERS, Drawn, Kind, Resolved};
use crate::model::{Dimension, Joint};

/// The drivers of x, y and φ of a body.
const KEYWORDS: [&str; 3] = ["x", "y", "phi"];

impl System {
    /// The same mechanism where a coordinate, an index into q, is free in place of that of the `place`-th `free` statement. `None`
    /// where no driver holds that coordinate, or where formulas mention the one that is free now.
    pub fn exchanged(&self, place: usize, coordinate: usize) -> Option<System> {
        let free = *self.mechanism.forces.free.get(place)?;
        let unknown = self.coordinates.get(coordinate)?;
        let Described::Pose { body, axis } = unknown.describes else {
            return None;
        };
        if self.is_mentioned(place) {
            return None;
        }
        let kind = driver(KEYWORDS[axis])?;
        let (quantity, drawn) = (unknown.quantity, self.drawn_unknown(coordinate));
        let mut mechanism = self.mechanism.clone();
        let monitored = self.places_of_monitored();
        let (graph, own) = (&mut mechanism.graph, &mechanism.bodies[body]);
        let value = graph.number(Number::Float(drawn));
        let origin = [graph.zero(); 2];
        let mark = Mark::new(own.frame, origin, graph);
        let input = &mut mechanism.inputs[free.input];
        input.initial = value;
        input.signal = [value, graph.zero(), graph.zero()];
        input.dimension = Dimension::of(quantity);
        let signal = graph.variable(input.symbols[0]);
        let label = format!("free {}: {}({})", input.name, KEYWORDS[axis], own.name);
        let operands = Resolved {
            marks: vec![mark],
            drawn: vec![Drawn {
                frame: own.drawn,
                position: own.drawn.origin,
            }],
            axis: None,
            curve: None,
            value: Some(signal),
            auxiliaries: Vec::new(),
            formula: None,
        };
        let joint = &mut mechanism.joints[free.joint];
        *joint = Joint {
            kind,
            label,
            operands,
            ..joint.clone()
        };
        Some(assemble_without(mechanism, &monitored))
    }

    /// Whether anything but its own driver mentions what is free.
    fn is_mentioned(&self, place: usize) -> bool {
        let free = &self.mechanism.forces.free[place];
        let symbols = self.mechanism.inputs[free.input].symbols;
        let rows = self.rows.iter().chain(&self.monitored);
        let rows = rows.filter(|row| row.joint != free.joint);
        let rows = rows.flat_map(|row| [row.residual, row.time_derivative, row.gamma]);
        let forces = self.forces.iter().flat_map(|forces| {
            let lengths = forces.lengths.iter().map(|(_, length)| *length);
            let energies = [forces.kinetic, forces.potential, forces.added];
            forces.loads.iter().copied().chain(energies).chain(lengths)
        });
        let mut all = rows.chain(forces);
        let graph = &self.mechanism.graph;
        let mentions = |expr: ExprId| {
            let own = graph.symbols(expr);
            own.iter().any(|symbol| symbols.contains(symbol))
        };
        all.any(mentions)
    }

    /// The places of the monitored rows among all rows in written order.
    fn places_of_monitored(&self) -> Vec<usize> {
        let mut graph = self.mechanism.graph.clone();
        let (mut places, mut place) = (Vec::new(), 0);
        for (index, joint) in self.mechanism.joints.iter().enumerate() {
            for stated in joint.kind.rows(&joint.operands, &mut graph) {
                let mut monitored = self.monitored.iter();
                let is_own =
                    |row: &super::Row| row.joint == index && row.residual == stated.residual;
                if monitored.any(is_own) {
                    places.push(place);
                }
                place += 1;
            }
        }
        places
    }
}

fn driver(keyword: &str) -> Option<&'static dyn Kind> {
    DRIVERS
        .iter()
        .copied()
        .find(|kind| kind.keyword() == keyword)
}
