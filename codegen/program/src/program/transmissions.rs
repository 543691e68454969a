//! What `transmission` statements ask for → a last block that computes it.

use super::block::Block;
use super::directional_derivatives::DirectionalDerivatives;
use super::function::{Level, Statement};
use crate::expr::SymbolId;
use crate::joint::Quantity;
use crate::model::Requested;
use crate::system::System;

/// The rates of a point or a coordinate per rate of each driver.
#[derive(Clone, Debug, PartialEq)]
pub struct Transmission {
    /// `k`, `phi_c1`: what its functions are named after.
    pub name: String,
    /// `the point K`, `the coordinate phi_c1`.
    pub what: String,
    /// What the rows are measured in: of a point x and y, of a coordinate itself.
    pub rows: Vec<Quantity>,
    /// The fields of each column: a driver each, in written order.
    pub columns: Vec<Vec<SymbolId>>,
}

impl Transmission {
    /// The fields of all columns.
    pub fn fields(&self) -> Vec<SymbolId> {
        self.columns.concat()
    }
}

/// The transmissions that are asked for, and the block that computes them; `None` where there are none.
pub(super) fn transmissions(
    system: &mut System,
    derivatives: &mut DirectionalDerivatives,
) -> Option<(Vec<Transmission>, Block)> {
    let requested = system.mechanism.transmissions.clone();
    if requested.is_empty() {
        return None;
    }
    let mut found: Vec<Transmission> = requested
        .iter()
        .map(|quantity| described(*quantity, system))
        .collect();
    let mut statements = Vec::new();
    let driven: Vec<usize> = system.driven().map(|(place, ..)| place).collect();
    for direction in driven {
        statements.push(Statement::Section(Level::Response(direction)));
        for (quantity, transmission) in requested.iter().zip(&mut found) {
            let (components, values) = match *quantity {
                Requested::Point(place) => {
                    let position = system.vector_form.points[place];
                    let along = position.map(|part| derivatives.along(part, direction, system));
                    (vec!["_x", "_y"], along.to_vec())
                }
                Requested::Coordinate(unknown) => {
                    let value = derivatives.of_unknown(unknown, direction, system);
                    (vec![""], vec![value])
                }
            };
            let mut column = Vec::with_capacity(values.len());
            for (component, value) in components.into_iter().zip(values) {
                let what = format!("transmission_{}{component}", transmission.name);
                let name = derivatives.name(&what, direction);
                let target = system.intermediate(&name);
                statements.push(Statement::assignment(target, value));
                column.push(target);
            }
            transmission.columns.push(column);
        }
    }
    let block = Block::following("transmission", "What the drivers transmit.", statements);
    Some((found, block))
}

pub(super) fn described(quantity: Requested, system: &System) -> Transmission {
    let (name, what, rows) = match quantity {
        Requested::Point(place) => {
            let name = &system.mechanism.points[place].name;
            (
                name.to_lowercase(),
                format!("the point {name}"),
                vec![Quantity::Length; 2],
            )
        }
        Requested::Coordinate(place) => {
            let unknown = &system.vector_form.unknowns[place];
            (
                unknown.name.clone(),
                format!("the coordinate {}", unknown.name),
                vec![unknown.quantity],
            )
        }
    };
    Transmission {
        name,
        what,
        rows,
        columns: Vec::new(),
    }
}
