//! Makes rotated local vectors (*arms*): pairs of symbols, one pair per vector and angle, with the rates that rotation gives
//! them.

use super::VectorForm;
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::Resolved;
use crate::joint::geometry::{BodyFrame, Mark, Vector, turned};
use crate::model::Body;
use crate::system::SymbolRole;

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

impl VectorForm {
    /// Returns R(φ) s of a local vector in the orientation of the unknown `angle`; a zero vector stays zero.
    pub fn arm(&mut self, angle: usize, local: Vector, name: &str, graph: &mut Graph) -> Vector {
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
        let base = (self.naming.apart)(name, "point");
        let mut name = base.clone();
        let mut number = self.name_numbers.get(&base).copied().unwrap_or(2);
        while taken(&name) {
            name = format!("{base}_{number}");
            number += 1;
        }
        self.name_numbers.insert(base, number);
        let symbols = ["x", "y"].map(|axis| graph.symbol(&format!("{name}_{axis} arm")));
        let [x, y] = symbols.map(|symbol| graph.variable(symbol));
        let turning = graph.variable(self.unknowns[angle].rate);
        let backward = graph.multiply(turning, y);
        self.rates.insert(symbols[0], graph.negate(backward));
        self.rates.insert(symbols[1], graph.multiply(turning, x));
        self.taken_names.insert(name.clone());
        let place = self.arms.len();
        self.arm_places.insert((angle, local), place);
        self.arms_of.entry(angle).or_default().push(place);
        let roles = symbols.map(|symbol| (symbol, SymbolRole::Arm(place)));
        self.roles.extend(roles);
        self.arms.write().push(Arm {
            angle,
            local,
            symbols,
            name,
        });
        [x, y]
    }

    /// Returns the operands with symbols for all rotated vectors.
    pub(in crate::system) fn with_arms(
        &mut self,
        operands: &Resolved,
        bodies: &[Body],
        graph: &mut Graph,
    ) -> Resolved {
        let marks = operands
            .marks
            .iter()
            .map(|mark| self.mark_with_arm(mark, bodies, graph))
            .collect();
        let axis = operands.axis.map(|axis| {
            let frame = operands.marks[axis.owner].frame;
            let body = frame.body.0;
            let name = format!("axis_{}", bodies[body].name.to_lowercase());
            let turned = self.turned(&frame, axis.direction, &name, graph);
            crate::joint::Axis { turned, ..axis }
        });
        let curve = operands.curve.map(|curve| {
            let body = curve.frame.body.0;
            let name = format!("axis_{}", bodies[body].name.to_lowercase());
            let along = [graph.one(), graph.zero()];
            let axis = self.turned(&curve.frame, along, &name, graph);
            crate::joint::Curve { axis, ..curve }
        });
        let auxiliaries = operands
            .auxiliaries
            .iter()
            .map(|auxiliary| self.auxiliary_with_arm(auxiliary, graph))
            .collect();
        Resolved {
            marks,
            drawn: operands.drawn.clone(),
            axis,
            curve,
            value: operands.value,
            auxiliaries,
            formula: operands.formula.clone(),
        }
    }

    pub(in crate::system) fn mark_with_arm(
        &mut self,
        mark: &Mark,
        bodies: &[Body],
        graph: &mut Graph,
    ) -> Mark {
        let body = &bodies[mark.frame.body.0];
        let point = self.mark_names.on_body(mark).map_or("arm", String::as_str);
        let name = format!("{point}_{}", body.name).to_lowercase();
        let arm = self.turned(&mark.frame, mark.local, &name, graph);
        Mark { arm, ..*mark }
    }

    /// Returns R s as an arm of the leader, or a constant vector on a body that does not rotate.
    pub(super) fn turned(
        &mut self,
        frame: &BodyFrame,
        local: Vector,
        name: &str,
        graph: &mut Graph,
    ) -> Vector {
        let (leader, offset) = self.orientations.leader(frame.body);
        let toward_leader = BodyFrame {
            angle: offset,
            ..*frame
        };
        let local = toward_leader.rotate(local, graph);
        if leader.0 == 0 {
            local
        } else {
            self.arm(self.angle_of(leader.0), local, name, graph)
        }
    }

    /// Returns an expression with its arms expanded as sines and cosines of their angles.
    pub fn written_out(&self, expr: ExprId, graph: &mut Graph) -> ExprId {
        let mut replacements = Vec::new();
        for place in self.arms_mentioned(expr, graph) {
            let arm = &self.arms[place];
            let angle = graph.variable(self.unknowns[arm.angle].position);
            let (sine, cosine) = (graph.sin(angle), graph.cos(angle));
            let written = turned(cosine, sine, arm.local, graph);
            replacements.extend(arm.symbols.into_iter().zip(written));
        }
        graph.substitute(expr, &replacements)
    }

    /// Returns the index of the arm of a local vector and an angle; `None` if there is none.
    pub(in crate::system) fn place_of_arm(&self, angle: usize, local: Vector) -> Option<usize> {
        self.arm_places.get(&(angle, local)).copied()
    }

    /// Returns the index of the arm that has a symbol as component; `None` if there is none.
    pub fn place_of_symbol(&self, symbol: SymbolId) -> Option<usize> {
        match self.roles.get(&symbol) {
            Some(&SymbolRole::Arm(place)) => Some(place),
            _ => None,
        }
    }

    /// Returns the arms that rotate with the angle `unknown`.
    pub fn arms_of(&self, unknown: usize) -> impl Iterator<Item = &Arm> {
        let places = self.arms_of.get(&unknown).into_iter().flatten();
        places.map(|&place| &self.arms[place])
    }

    /// Returns the indices of the arms that an expression mentions, ascending.
    pub(in crate::system) fn arms_mentioned(&self, expr: ExprId, graph: &Graph) -> Vec<usize> {
        let symbols = graph.symbols(expr).iter();
        let mut places: Vec<usize> = symbols
            .filter_map(|&symbol| self.place_of_symbol(symbol))
            .collect();
        places.sort_unstable();
        places.dedup();
        places
    }
}
