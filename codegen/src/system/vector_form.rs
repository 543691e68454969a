//! The same constraints in vector form: what the solved view starts from.
//!
//! Every turned local vector R s is a pair of symbols, an *arm*, so that the rows are linear in positions and arms, and a
//! sliding joint has its displacement ℓ as an unknown, a link without a body its angle ψ. Afterwards an unknown has a constant coefficient wherever a person
//! would eliminate it by inspection. Time derivatives follow from the rule that an arm turns with its body: d(R s)/dt = φ̇ Ω R s.

use std::collections::{HashMap, HashSet};

use super::assemble::Watch;
use super::mark_names::MarkNames;
use super::orientation::Orientations;
use super::{SymbolRole, Unknown};
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::geometry::{BodyFrame, BodyId, Mark, Vector, turned};
use crate::joint::{Kind, Quantity, Resolved, Row};
use crate::model::{Body, Joint, Mechanism, Naming, Role};

/// The vector form of a mechanism.
#[derive(Clone, Debug)]
pub struct VectorForm {
    /// The coordinates in their order, then the auxiliary unknowns of the joints.
    pub unknowns: Vec<Unknown>,
    /// As many rows as unknowns where the mechanism is driven.
    pub rows: Vec<VectorRow>,
    /// Every turned local vector that occurs, in order of first use.
    pub arms: Vec<Arm>,
    /// Which bodies share their sine and cosine.
    pub orientations: Orientations,
    /// r + arm of each declared point, in the mechanism's order.
    pub points: Vec<Vector>,
    naming: &'static Naming,
    /// Which of the textbook's rows of each joint are monitored and not solved.
    pub(super) dropped: Vec<Vec<bool>>,
    // The angle of each body; none for the ground.
    angles: Vec<Option<usize>>,
    /// d/dt of each symbol that moves.
    pub(super) rates: HashMap<SymbolId, ExprId>,
    // Looked up, never iterated.
    arm_places: HashMap<(usize, Vector), usize>,
    // The unknowns beyond the coordinates, by symbol; only looked up.
    pub(super) auxiliary_places: HashMap<SymbolId, usize>,
    // The names of unknowns and arms; only looked up.
    pub(super) taken_names: HashSet<String>,
    // Of a name the number up to which all are taken; only looked up.
    name_numbers: HashMap<String, usize>,
    // Which arms each angle turns.
    arms_of: HashMap<usize, Vec<usize>>,
    // Which arm a symbol belongs to; only looked up.
    arm_of: HashMap<SymbolId, usize>,
    // Which unknown a symbol is; only looked up.
    unknown_of: HashMap<SymbolId, usize>,
    pub(super) mark_names: MarkNames,
}

/// One scalar equation of the vector form.
#[derive(Clone, Copy, Debug)]
pub struct VectorRow {
    /// Index into the mechanism's joints.
    pub joint: usize,
    /// Zero when satisfied.
    pub residual: ExprId,
    /// What the residual is measured in.
    pub quantity: Quantity,
    /// Which of the joint's rows it is: `x`, `angle`; empty where there is only one.
    pub component: &'static str,
}

/// A local vector turned with a body or a link: a = R(φ) s.
#[derive(Clone, Debug)]
pub struct Arm {
    /// The unknown angle that turns it: that of a body that is no follower, or of a link without a body.
    pub angle: usize,
    /// s in the orientation of that angle.
    pub local: Vector,
    /// a.
    pub symbols: [SymbolId; 2],
    /// What it is called: `g_c3`.
    pub name: String,
}

impl VectorForm {
    /// The vector form of every joint, with the drawn values of the auxiliary unknowns; `dropped` says of each joint which of
    /// the textbook's rows are not solved.
    pub(super) fn new(
        mechanism: &mut Mechanism,
        coordinates: &[Unknown],
        dropped: &[Vec<bool>],
        watch: &mut Watch,
    ) -> VectorForm {
        let mut form = VectorForm {
            unknowns: coordinates.to_vec(),
            rows: Vec::new(),
            arms: Vec::new(),
            orientations: Orientations::new(mechanism.bodies.len(), &mechanism.graph),
            points: Vec::new(),
            naming: mechanism.naming,
            dropped: dropped.to_vec(),
            angles: mechanism
                .bodies
                .iter()
                .map(|body| body.coordinates[2].map(|it| it.place))
                .collect(),
            rates: HashMap::new(),
            arm_places: HashMap::new(),
            auxiliary_places: HashMap::new(),
            taken_names: coordinates
                .iter()
                .map(|coordinate| coordinate.name.clone())
                .collect(),
            name_numbers: HashMap::new(),
            arms_of: HashMap::new(),
            arm_of: HashMap::new(),
            unknown_of: HashMap::new(),
            mark_names: MarkNames::new(&mechanism.bodies, &mechanism.points),
        };
        let moved = !mechanism.transmissions.is_empty() || mechanism.forces.need_multipliers();
        form.rates.extend(mechanism.explicit_rates());
        let Mechanism {
            graph,
            joints,
            bodies,
            points,
            parameters,
            ..
        } = mechanism;
        let fixed = parameters.iter().map(|own| (own.symbol, graph.zero()));
        form.rates.extend(fixed);
        // Which angles are tied must be known before the first arm is made.
        let angles = bodies.iter().enumerate().filter_map(|(body, own)| {
            let [_, _, angle] = own.coordinates;
            Some((angle?.symbol, body))
        });
        let angles: HashMap<SymbolId, usize> = angles.collect();
        for (joint, dropped) in joints.iter().zip(dropped) {
            // A driver that holds an angle ties it, unless its value is to be moved.
            if moved && joint.role == Role::Driver {
                continue;
            }
            for row in kept_rows(joint.kind, &joint.operands, dropped, graph) {
                if row.quantity == Quantity::Angle {
                    form.orientations.tie(&row, &angles, graph);
                }
            }
        }
        form.orientations.settle(graph);
        for (index, (joint, dropped)) in joints.iter().zip(dropped).enumerate() {
            if !dropped.contains(&true) {
                form.add_auxiliaries(joint, bodies, graph);
            }
            let operands = form.with_arms(&joint.operands, bodies, graph);
            let rows = kept_rows(joint.kind, &operands, dropped, graph);
            form.rows.extend(rows.iter().map(|row| VectorRow {
                joint: index,
                residual: row.residual,
                quantity: row.quantity,
                component: row.component,
            }));
            if watch.is_beyond(graph, joint.span) {
                break;
            }
        }
        for point in points.iter() {
            let mark = form.mark_with_arm(&point.mark, bodies, graph);
            let position = mark.position(graph);
            form.points.push(position);
        }
        for unknown in &form.unknowns {
            let (rate, acceleration) = (
                graph.variable(unknown.rate),
                graph.variable(unknown.acceleration),
            );
            form.rates.insert(unknown.position, rate);
            form.rates.insert(unknown.rate, acceleration);
        }
        let unknowns = form.unknowns.iter().enumerate();
        form.unknown_of = unknowns.map(|(place, own)| (own.position, place)).collect();
        form
    }

    /// Adds a symbol that does not depend on time to the value of a driver, a joint of the mechanism.
    pub(super) fn shift_driver(
        &mut self,
        joint: usize,
        shift: SymbolId,
        mechanism: &mut Mechanism,
    ) {
        let Mechanism {
            graph,
            joints,
            bodies,
            ..
        } = mechanism;
        let Joint { kind, operands, .. } = &joints[joint];
        let Some(value) = operands.value else {
            return;
        };
        self.rates.insert(shift, graph.zero());
        let delta = graph.variable(shift);
        let shifted = Resolved {
            value: Some(graph.add(value, delta)),
            ..self.with_arms(operands, bodies, graph)
        };
        let own = self.rows.iter_mut().filter(|row| row.joint == joint);
        for (row, shifted) in own.zip(kind.vector_rows(&shifted, graph)) {
            row.residual = shifted.residual;
        }
    }

    /// An expression with its arms written out as sines and cosines of the angles that turn them.
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

    /// States how a symbol that was made later moves.
    pub fn set_rate(&mut self, symbol: SymbolId, rate: ExprId) {
        self.rates.insert(symbol, rate);
    }

    /// The unknown angle of a body.
    pub fn angle_of(&self, body: usize) -> usize {
        let Some(angle) = self.angles[body] else {
            unreachable!("the ground has no angle")
        };
        angle
    }

    /// Whether a body turns with the angle `unknown`.
    pub fn turns(&self, body: BodyId, unknown: usize) -> bool {
        let (leader, _) = self.orientations.leader(body);
        leader != BodyId::GROUND && self.angle_of(leader.0) == unknown
    }

    /// The arms that turn with the angle `unknown`.
    pub fn arms_of(&self, unknown: usize) -> impl Iterator<Item = &Arm> {
        let places = self.arms_of.get(&unknown).into_iter().flatten();
        places.map(|&place| &self.arms[place])
    }

    /// The place of the arm among all that a symbol is a component of.
    pub fn place_of_symbol(&self, symbol: SymbolId) -> Option<usize> {
        self.arm_of.get(&symbol).copied()
    }

    /// The unknown that a symbol is.
    pub fn place_of_unknown(&self, symbol: SymbolId) -> Option<usize> {
        self.unknown_of.get(&symbol).copied()
    }

    /// The places of the arms that an expression mentions: ascending.
    pub(super) fn arms_mentioned(&self, expr: ExprId, graph: &Graph) -> Vec<usize> {
        let symbols = graph.symbols(expr).iter();
        let mut places: Vec<usize> = symbols
            .filter_map(|&symbol| self.place_of_symbol(symbol))
            .collect();
        places.sort_unstable();
        places.dedup();
        places
    }

    /// The unknowns that an expression mentions, themselves or through the arms that they turn: ascending.
    pub fn mentioned(&self, expr: ExprId, graph: &Graph) -> Vec<usize> {
        let symbols = graph.symbols(expr).iter();
        let mut unknowns: Vec<usize> = symbols
            .filter_map(|&symbol| {
                let turned_by = |place: usize| self.arms[place].angle;
                let turning = || self.place_of_symbol(symbol).map(turned_by);
                self.place_of_unknown(symbol).or_else(turning)
            })
            .collect();
        unknowns.sort_unstable();
        unknowns.dedup();
        unknowns
    }

    /// The place of the arm that this angle makes of a local vector.
    pub(super) fn place_of_arm(&self, angle: usize, local: Vector) -> Option<usize> {
        self.arm_places.get(&(angle, local)).copied()
    }

    /// The arm R(φ) s of a local vector in the orientation of the unknown `angle`; a zero vector stays zero.
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
        // The symbols are told apart by these names, so no two arms may share one.
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
        self.arm_of.extend(symbols.map(|symbol| (symbol, place)));
        self.arms.push(Arm {
            angle,
            local,
            symbols,
            name,
        });
        [x, y]
    }

    /// The operands with symbols for all turned vectors.
    pub(super) fn with_arms(
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

    pub(super) fn mark_with_arm(
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

    /// R s as an arm of the leader, or a constant vector on a body that does not turn.
    fn turned(
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

    /// What the symbols of the vector form are.
    pub(crate) fn note_roles(&self, roles: &mut Vec<SymbolRole>, coordinates: usize) {
        for (index, unknown) in self.unknowns.iter().enumerate().skip(coordinates) {
            set(roles, unknown.position, SymbolRole::Position(index));
            set(roles, unknown.rate, SymbolRole::Rate(index));
            set(roles, unknown.acceleration, SymbolRole::Acceleration(index));
        }
        for (index, arm) in self.arms.iter().enumerate() {
            for symbol in arm.symbols {
                set(roles, symbol, SymbolRole::Arm(index));
            }
        }
    }
}

/// The rows of the vector form of a joint. Where one of the textbook's rows is not solved, the textbook's others: they need no
/// auxiliary unknown, whose equations would not be as many.
pub(super) fn kept_rows(
    kind: &dyn Kind,
    operands: &Resolved,
    dropped: &[bool],
    graph: &mut Graph,
) -> Vec<Row> {
    if !dropped.contains(&true) {
        return kind.vector_rows(operands, graph);
    }
    let rows = kind.rows(operands, graph).into_iter().zip(dropped);
    rows.filter(|(_, dropped)| !**dropped)
        .map(|(row, _)| row)
        .collect()
}

fn set(roles: &mut Vec<SymbolRole>, symbol: SymbolId, role: SymbolRole) {
    if roles.len() <= symbol.index() {
        roles.resize(symbol.index() + 1, SymbolRole::Intermediate);
    }
    roles[symbol.index()] = role;
}
