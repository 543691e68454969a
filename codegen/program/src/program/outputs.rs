//! Computes the quantities of `output` statements in a last block.

use super::block::Block;
use super::function::{Level, Statement};
use crate::expr::{ExprId, SymbolId};
use crate::joint::Quantity;
use crate::model::{Request, Requested};
use crate::pool::Pool;
use crate::system::System;

/// Quantity that the frame offers.
#[derive(Clone, Debug, PartialEq)]
pub enum Output {
    /// Point, with fields up to the requested level of position, velocity and acceleration.
    Point {
        /// Name of the point.
        name: String,
        /// Fields of x and y, by level.
        fields: Vec<[SymbolId; 2]>,
    },
    /// Coordinate, with fields up to the requested level of rate and acceleration.
    Coordinate {
        /// Name of the coordinate.
        name: String,
        /// Quantity of the coordinate.
        quantity: Quantity,
        /// Fields, one per level.
        fields: Vec<SymbolId>,
    },
}

impl Output {
    /// Returns the fields of all levels.
    pub fn fields(&self) -> Vec<SymbolId> {
        match self {
            Output::Point { fields, .. } => fields.concat(),
            Output::Coordinate { fields, .. } => fields.clone(),
        }
    }
}

/// Returns the requested outputs, and the block that computes those of points; `None` if everything is requested.
pub(super) fn outputs(pool: &mut Pool, system: &System) -> Option<(Vec<Output>, Block)> {
    if system.mechanism.requests.is_empty() {
        return None;
    }
    let mut sections: [Vec<Statement>; 3] = [const { Vec::new() }; 3];
    let mut outputs: Vec<Output> = Vec::new();
    for request in highest_levels(&system.mechanism.requests) {
        let output = match request.quantity {
            // A block of its own computes measures.
            Requested::Measure(_) => continue,
            Requested::Coordinate(place) => {
                let unknown = &system.vector_form.unknowns[place];
                let all = [unknown.position, unknown.rate, unknown.acceleration];
                Output::Coordinate {
                    name: unknown.name.clone(),
                    quantity: unknown.quantity,
                    fields: all[..=request.level].to_vec(),
                }
            }
            Requested::Point(place) => {
                let name = system.mechanism.points[place].name.to_lowercase();
                let mut expressions = system.vector_form.points[place];
                let mut fields = Vec::new();
                for (level, section) in sections.iter_mut().enumerate().take(request.level + 1) {
                    let suffix = ["", "_rate", "_acceleration"][level];
                    let symbols = ["x", "y"]
                        .map(|axis| pool.intermediate(&format!("point_{name}_{axis}{suffix}")));
                    for (target, value) in symbols.into_iter().zip(expressions) {
                        section.push(Statement::assignment(target, value));
                    }
                    fields.push(symbols);
                    if level < request.level {
                        expressions = expressions.map(|expr: ExprId| pool.rate(expr));
                    }
                }
                Output::Point { name, fields }
            }
        };
        outputs.push(output);
    }
    let levels = [Level::Position, Level::Velocity, Level::Acceleration];
    let mut statements = Vec::new();
    for (level, mut section) in levels.into_iter().zip(sections) {
        if !section.is_empty() {
            statements.push(Statement::Section(level));
            statements.append(&mut section);
        }
    }
    let block = Block::following("outputs", "What is asked for.", statements);
    Some((outputs, block))
}

/// Returns each quantity once, up to the highest requested level, in order of first mention.
pub(super) fn highest_levels(requests: &[Request]) -> Vec<Request> {
    let mut highest: Vec<Request> = Vec::new();
    for request in requests {
        match highest
            .iter_mut()
            .find(|other| other.quantity == request.quantity)
        {
            Some(other) => other.level = other.level.max(request.level),
            None => highest.push(request.clone()),
        }
    }
    highest
}
