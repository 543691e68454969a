//! The functions of the textbook view.

use super::constants::Constants;
use super::statements::Straight;
use super::{LARGEST_TEXTBOOK, Program, Textbook, solved};
use crate::expr::ExprId;
use crate::structure::SolvedPlan;
use crate::system::{Row, System};

/// Straight-line code for Φ, Φ_q, Φ_t, γ and the motion of every point.
pub fn lower(system: &mut System, solved_plan: Option<&SolvedPlan>) -> Program {
    let mut constants = Constants::default();
    let solved = solved_plan.map(|plan| solved::lower(system, plan, &mut constants));
    let system = &*system;
    // Without a solved view the dense system is all there is, whatever its size.
    let is_small = system.coordinates.len() <= LARGEST_TEXTBOOK;
    let textbook = (is_small || solved.is_none()).then(|| textbook(system, &mut constants));
    // The points of a mechanism with outputs are among its blocks.
    let whole = solved
        .as_ref()
        .is_none_or(|solved| solved.outputs.is_none());
    let points = system
        .outputs
        .iter()
        .filter(|_| whole)
        .map(|output| {
            let components = [output.position, output.velocity, output.acceleration].concat();
            let results = components
                .into_iter()
                .map(|component| (component, Vec::new()))
                .collect();
            Straight::new(results, system, &mut constants)
        })
        .collect();
    let drawn = drawn(system, &mut constants);
    let lengths = (!system.lengths.is_empty()).then(|| {
        let results = system.lengths.iter().map(|&expr| (expr, Vec::new()));
        Straight::new(results.collect(), system, &mut constants)
    });
    let pressures = system
        .pressures
        .iter()
        .filter(|_| whole)
        .map(|pressure| {
            let components = [pressure.along, pressure.across, pressure.sliding];
            let results = components.map(|component| (component, Vec::new()));
            Straight::new(results.to_vec(), system, &mut constants)
        })
        .collect();
    Program {
        solved,
        constants,
        textbook,
        drawn,
        lengths,
        points,
        pressures,
    }
}

fn textbook(system: &System, constants: &mut Constants) -> Textbook {
    let by_row = |of: &dyn Fn(&Row) -> ExprId| -> Vec<(ExprId, Vec<usize>)> {
        system
            .rows
            .iter()
            .map(|row| (of(row), row.bodies.clone()))
            .collect()
    };
    let entries = system
        .rows
        .iter()
        .flat_map(|row| {
            row.jacobian
                .iter()
                .map(|entry| (entry.value, row.bodies.clone()))
        })
        .collect();
    let watched = system.monitored.iter();
    let watched: Vec<_> = watched
        .map(|row| (row.residual, row.bodies.clone()))
        .collect();
    Textbook {
        residual: Straight::new(by_row(&|row| row.residual), system, constants),
        jacobian: Straight::new(entries, system, constants),
        time_derivative: Straight::new(by_row(&|row| row.time_derivative), system, constants),
        gamma: Straight::new(by_row(&|row| row.gamma), system, constants),
        monitored: (!watched.is_empty()).then(|| Straight::new(watched, system, constants)),
    }
}

/// The estimates of all unknowns, where one of them depends on a parameter.
fn drawn(system: &System, constants: &mut Constants) -> Option<Straight> {
    let estimates: Vec<ExprId> = system
        .vector_form
        .unknowns
        .iter()
        .map(|unknown| unknown.estimate)
        .collect();
    let graph = &system.mechanism.graph;
    let is_given = estimates.iter().any(|&expr| !graph.is_constant(expr));
    is_given.then(|| {
        let results = estimates.into_iter().map(|expr| (expr, Vec::new()));
        Straight::new(results.collect(), system, constants)
    })
}
