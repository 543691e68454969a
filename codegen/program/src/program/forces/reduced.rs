//! Derives the reduced masses and forces of the coordinates that forces move.
//!
//! With K = ∂q/∂s, (Kᵀ M K) s̈ = Kᵀ (Q − M q̈) + (Kᵀ M K) s̈, where q̈ is that of the frame. The contribution of s̈ to q̈
//! cancels, so a frame of any s̈ gives the same force. K consists of the exact responses of the blocks. The mass is a sum of
//! squares over bodies: for one coordinate, it is never negative.

use super::virtual_work::Carried;
use crate::expr::{ExprId, SymbolId};
use crate::joint::Quantity;
use crate::joint::geometry::{dot, perpendicular};
use crate::program::builder::Builder;
use crate::system::Weight;

/// Equation of motion of the free coordinates: mass · s̈ = force.
#[derive(Clone, Debug, PartialEq)]
pub struct Reduced {
    /// Coordinates s in written order.
    pub coordinates: Vec<FreeCoordinate>,
    /// Reduced mass: the lower triangle of a symmetric matrix row by row, in kg, kg·m or kg·m².
    pub masses: Vec<SymbolId>,
}

/// Coordinate that forces move.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeCoordinate {
    /// Index into the mechanism's joints.
    pub joint: usize,
    /// Signal that the coordinate follows: an index into the mechanism's inputs.
    pub input: usize,
    /// Base of function names.
    pub name: String,
    /// Quantity of the coordinate.
    pub quantity: Quantity,
    /// Reduced force along the coordinate, in N or N·m.
    pub force: SymbolId,
}

impl Reduced {
    /// Returns all fields.
    pub fn fields(&self) -> impl Iterator<Item = SymbolId> {
        let forces = self.coordinates.iter().map(|it| it.force);
        self.masses.iter().copied().chain(forces)
    }

    /// Returns the index of a row and a column of the mass in its triangle.
    pub fn place(row: usize, column: usize) -> usize {
        let (row, column) = (row.max(column), row.min(column));
        row * (row + 1) / 2 + column
    }
}

/// Response of a body to a coordinate: of its center of mass, and of its angle.
#[derive(Clone, Copy)]
struct Following {
    center: [ExprId; 2],
    turning: ExprId,
    /// True if the origin of the body's frame does not move.
    turns_only: bool,
}

/// States the reduced mass and force.
pub(super) fn reduced(carried: &Carried, weights: &[Weight], builder: &mut Builder<'_>) -> Reduced {
    let free = builder.system.mechanism.forces.free.clone();
    let driven: Vec<(usize, usize, Quantity)> = builder.system.driven().collect();
    let free: Vec<(usize, usize, usize, Quantity)> = free
        .iter()
        .filter_map(|it| {
            let mut driven = driven.iter();
            let &(direction, joint, quantity) = driven.find(|(_, joint, _)| *joint == it.joint)?;
            Some((direction, joint, it.input, quantity))
        })
        .collect();
    let name =
        |builder: &Builder<'_>, joint: usize| builder.system.mechanism.joints[joint].slug.clone();
    builder.say(|_| {
        "How the centers of mass and the angles follow each free coordinate, squared and weighed, is the mass along it. How an unknown follows it is its velocity while that of the coordinate is one:".into()
    });
    let mut followings: Vec<Vec<Following>> = Vec::with_capacity(free.len());
    for &(direction, joint, ..) in &free {
        let slug = name(builder, joint);
        let responses = weights.iter();
        let responses = responses.map(|weight| following(weight, direction, &slug, builder));
        followings.push(responses.collect());
    }
    let mut masses = Vec::new();
    for (row, &(_, joint, ..)) in free.iter().enumerate() {
        for (column, &(_, other, ..)) in free[..=row].iter().enumerate() {
            let name_of_row = name(builder, joint);
            let named = match row == column {
                true => format!("reduced_mass_{name_of_row}"),
                false => format!("reduced_mass_{name_of_row}_{}", name(builder, other)),
            };
            let mut terms = Vec::with_capacity(2 * weights.len());
            for (body, weight) in weights.iter().enumerate() {
                let [one, other] = [row, column].map(|place| followings[place][body]);
                let graph = builder.graph();
                let turned = graph.multiply(one.turning, other.turning);
                if one.turns_only && other.turns_only {
                    terms.push(graph.multiply(weight.about_origin, turned));
                    continue;
                }
                let moved = dot(one.center, other.center, graph);
                terms.push(graph.multiply(weight.mass, moved));
                terms.push(graph.multiply(weight.inertia, turned));
            }
            let mass = builder.graph().sum(&terms);
            let target = builder.pool.intermediate(&named);
            builder.assign(target, mass);
            masses.push(target);
        }
    }
    builder.say(|_| {
        "The work of all of this along it, without what its own acceleration adds, is the force along it:".into()
    });
    let at_rest = builder.system.mechanism.forces.at_rest;
    let mut coordinates = Vec::with_capacity(free.len());
    for (row, &(direction, joint, input, quantity)) in free.iter().enumerate() {
        let symbol = builder.system.directions[direction].symbol;
        let mut terms = vec![carried.along(symbol, builder)];
        for (column, &(_, _, other, _)) in free.iter().enumerate().filter(|_| !at_rest) {
            let acceleration = builder.system.mechanism.inputs[other].symbols[2];
            let mass = masses[Reduced::place(row, column)];
            let graph = builder.graph();
            let [mass, acceleration] = [mass, acceleration].map(|it| graph.variable(it));
            terms.push(graph.multiply(mass, acceleration));
        }
        let force = builder.graph().sum(&terms);
        let name_of_row = name(builder, joint);
        let target = builder
            .pool
            .intermediate(&format!("reduced_force_{name_of_row}"));
        builder.assign(target, force);
        coordinates.push(FreeCoordinate {
            joint,
            input,
            name: name_of_row,
            quantity,
            force: target,
        });
    }
    Reduced {
        coordinates,
        masses,
    }
}

/// Returns the response of a body to a coordinate, as named values.
fn following(
    weight: &Weight,
    direction: usize,
    slug: &str,
    builder: &mut Builder<'_>,
) -> Following {
    let body = builder.system.mechanism.bodies[weight.body].name.clone();
    let [x, y, turning] = weight.unknowns.map(|unknown| {
        builder
            .derivatives
            .of_unknown(unknown, direction, builder.pool)
    });
    let zero = builder.graph().zero();
    let turns_only = [x, y] == [zero; 2];
    let turned = perpendicular(weight.arm, builder.graph());
    let center = [(x, turned[0], "x"), (y, turned[1], "y")].map(|(origin, across, axis)| {
        let graph = builder.graph();
        let moved = graph.multiply(turning, across);
        let moved = graph.add(origin, moved);
        builder.value(&format!("center_{axis}_{body}_by_{slug}"), moved)
    });
    Following {
        center,
        turning,
        turns_only,
    }
}
