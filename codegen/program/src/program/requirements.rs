//! Lists the values of joints, masses and loads that must be positive for all parameters and drivers.
//!
//! Invalid constant lengths, ratios and masses are rejected in the description; values that depend on parameters are checked by
//! the runtime. Lengths that depend on t or inputs are checked at every instant by the blocks that compute them.

use super::function::Function;
use super::passes::sharing::share_all;
use crate::expr::{ExprId, Graph, Number, Rational, SymbolId};
use crate::joint::geometry::{length, subtract};
use crate::joint::{Feature, Mesh};
use crate::model::{Mass, Mechanism, Surfaces};
use crate::pool::{Pool, SymbolRole};
use crate::system::System;

/// Values that must be positive.
#[derive(Clone, Debug)]
pub struct Requirements {
    /// Values that depend on parameters alone.
    pub function: Function,
    /// Owner and name of each value: first the values of the function, then the driven lengths of joints.
    pub names: Vec<(String, &'static str)>,
    /// Joints whose lengths depend on t or inputs.
    driven: Vec<usize>,
}

impl Requirements {
    /// True if parameters alone can violate a requirement.
    pub fn limit_parameters(&self) -> bool {
        !self.function.results.is_empty()
    }

    /// Returns the index of a driven joint's length.
    pub fn place_of(&self, joint: usize) -> usize {
        let driven = self.driven.iter().position(|&it| it == joint);
        self.function.results.len() + driven.unwrap_or_default()
    }
}

/// Value that must be positive.
struct Required {
    /// Owner of the value.
    owner: String,
    /// Name of the value.
    what: &'static str,
    value: ExprId,
}

/// Returns the requirements of all statements; `None` if none can be violated.
pub(super) fn requirements(pool: &mut Pool, system: &System) -> Option<Requirements> {
    let mut names = Vec::new();
    let mut values = Vec::new();
    let mut required = of_joints(&system.mechanism, &mut pool.graph);
    required.extend(of_teeth(&system.mechanism, &mut pool.graph));
    required.extend(of_forces(&system.mechanism, &mut pool.graph));
    for Required { owner, what, value } in required {
        let is_parameter =
            |symbol: &SymbolId| matches!(pool.role(*symbol), SymbolRole::Parameter(_));
        let mut symbols = pool.graph.symbols(value).iter();
        if symbols.len() > 0 && symbols.all(is_parameter) && !values.contains(&value) {
            values.push(value);
            names.push((owner, what));
        }
    }
    let mut driven = Vec::new();
    for joint in 0..system.mechanism.joints.len() {
        if let Some((_, what)) = driven_length(joint, &system.mechanism, &mut pool.graph) {
            names.push((system.mechanism.joints[joint].label.clone(), what));
            driven.push(joint);
        }
    }
    if names.is_empty() {
        return None;
    }
    let mut function = Function::of_results(values);
    share_all(&mut function, pool, system);
    Some(Requirements {
        function,
        names,
        driven,
    })
}

/// Returns the length of a joint that depends on t or inputs, and its name; `None` for other joints.
pub(super) fn driven_length(
    joint: usize,
    mechanism: &Mechanism,
    graph: &mut Graph,
) -> Option<(ExprId, &'static str)> {
    let Mechanism {
        joints,
        time,
        inputs,
        ..
    } = mechanism;
    let joint = &joints[joint];
    let (length, what) = joint.kind.positive(&joint.operands, graph)?;
    let drives = |symbol: &SymbolId| {
        symbol == time || inputs.iter().any(|input| input.symbols[0] == *symbol)
    };
    let is_driven = graph.symbols(length).iter().any(drives);
    is_driven.then_some((length, what))
}

fn of_joints(mechanism: &Mechanism, graph: &mut Graph) -> Vec<Required> {
    let joints = mechanism.joints.iter();
    let required = joints.filter_map(|joint| {
        let (value, what) = joint.kind.positive(&joint.operands, graph)?;
        let owner = joint.label.clone();
        Some(Required { owner, what, value })
    });
    required.collect()
}

/// Returns the center distances by which pitch radii of gears are divided, and their pressure angles.
fn of_teeth(mechanism: &Mechanism, graph: &mut Graph) -> Vec<Required> {
    let Mechanism { joints, forces, .. } = mechanism;
    let mut required = Vec::new();
    for teeth in &forces.teeth {
        let gear = &joints[teeth.gear];
        let mut require = |what, value| {
            required.push(Required {
                owner: gear.label.clone(),
                what,
                value,
            });
        };
        let [from, to] = teeth.axes.each_ref().map(|axis| axis.place.local);
        let apart = subtract(to, from, graph);
        require("the distance of the axes", length(apart, graph));
        if let Some(Feature::Wheels(Mesh::Internal, ratio)) =
            gear.kind.feature(&gear.operands, graph)
        {
            let one = graph.one();
            let difference = graph.subtract(one, ratio);
            require("the difference of the radii", graph.magnitude(difference));
        }
        let angle = teeth.pressure_angle;
        require(
            "the pressure angle, unless zero,",
            positive_unless_zero(angle, graph),
        );
        let right = graph.pi();
        let right = graph.scale(Number::rational(Rational::HALF), right);
        let rest = graph.subtract(right, angle);
        require("the right angle less the pressure angle", rest);
    }
    required
}

fn of_forces(mechanism: &Mechanism, graph: &mut Graph) -> Vec<Required> {
    let Mechanism { forces, bodies, .. } = mechanism;
    let mut required = Vec::new();
    for weighed in &forces.masses {
        let owner = format!("body {}", bodies[weighed.body].name);
        required.extend(of_mass(weighed, &owner, graph));
    }
    for load in &forces.loads {
        for (value, what) in load.element.not_negative() {
            let owner = load.label.clone();
            let value = positive_unless_zero(value, graph);
            required.push(Required { owner, what, value });
        }
    }
    for friction in &forces.frictions {
        let owner = &mechanism.joints[friction.joint].label;
        let coefficient = positive_unless_zero(friction.coefficient, graph);
        let mut values = vec![("the coefficient of friction, unless zero,", coefficient)];
        values.extend(match friction.surfaces {
            Surfaces::Pin(radius) => Some(("the radius of the pin", radius)),
            Surfaces::Slide(length) => length.map(|it| ("the length of the slide", it)),
        });
        required.extend(values.into_iter().map(|(what, value)| Required {
            owner: owner.clone(),
            what,
            value,
        }));
    }
    for motor in &mechanism.motors {
        let owner = format!("motor of {}", mechanism.joints[motor.joint].label);
        let one = graph.one();
        let lost = graph.subtract(one, motor.efficiency);
        let values = [
            ("the ratio of the gear", motor.gear),
            ("the efficiency", motor.efficiency),
            (
                "1 less the efficiency, unless zero,",
                positive_unless_zero(lost, graph),
            ),
            (
                "the moment of inertia, unless zero,",
                positive_unless_zero(motor.inertia, graph),
            ),
        ];
        required.extend(values.map(|(what, value)| Required {
            owner: owner.clone(),
            what,
            value,
        }));
    }
    required
}

/// Returns the requirements of a mass. A body without a mass has no moment of inertia.
fn of_mass(weighed: &Mass, owner: &str, graph: &mut Graph) -> Vec<Required> {
    let &Mass { mass, inertia, .. } = weighed;
    let required = |what, value| Required {
        owner: owner.to_string(),
        what,
        value,
    };
    let mut all = vec![
        required("the mass, unless zero,", positive_unless_zero(mass, graph)),
        required(
            "the moment of inertia, unless zero,",
            positive_unless_zero(inertia, graph),
        ),
    ];
    let is_sure = graph.is_constant(mass) && graph.constant_value(mass).is_some_and(|it| it > 0.0);
    if !is_sure {
        let (opposite, one) = (graph.negate(inertia), graph.one());
        let where_inert = graph.choose(opposite, mass, one);
        all.push(required(
            "the mass of what has a moment of inertia",
            where_inert,
        ));
    }
    all
}

/// Returns the value if it is negative, otherwise 1.
fn positive_unless_zero(value: ExprId, graph: &mut Graph) -> ExprId {
    let one = graph.one();
    graph.choose(value, value, one)
}
