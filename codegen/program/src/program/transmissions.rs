//! Computes the transmission ratios of `transmission` statements in a last block.

use super::block::Block;
use super::directional_derivatives::DirectionalDerivatives;
use super::function::{Level, Statement};
use crate::expr::SymbolId;
use crate::model::{Dimension, Requested, field_name};
use crate::pool::Pool;
use crate::system::System;

/// Rates of a point, a coordinate or a measure per rate of each driver.
#[derive(Clone, Debug, PartialEq)]
pub struct Transmission {
    /// Base of function names: `k`, `phi_c1`.
    pub name: String,
    /// Description: `the point K`, `the coordinate phi_c1`.
    pub what: String,
    /// Dimensions of the rows: x and y of a point, or the coordinate or measure itself.
    pub rows: Vec<Dimension>,
    /// Fields of each column, one column per driver, in written order.
    pub columns: Vec<Vec<SymbolId>>,
}

impl Transmission {
    /// Returns the fields of all columns.
    pub fn fields(&self) -> Vec<SymbolId> {
        self.columns.concat()
    }
}

/// Returns the requested transmissions, and the block that computes them; `None` if there are none.
pub(super) fn transmissions(
    pool: &mut Pool,
    system: &System,
    derivatives: &mut DirectionalDerivatives,
) -> Option<(Vec<Transmission>, Block)> {
    let requested = system.mechanism.transmissions.clone();
    if requested.is_empty() {
        return None;
    }
    let mut transmissions: Vec<Transmission> = requested
        .iter()
        .map(|quantity| described(*quantity, system))
        .collect();
    let mut statements = Vec::new();
    let driven: Vec<usize> = system.driven().map(|(place, ..)| place).collect();
    for direction in driven {
        statements.push(Statement::Section(Level::Response(direction)));
        for (quantity, transmission) in requested.iter().zip(&mut transmissions) {
            let (components, values) = match *quantity {
                Requested::Point(place) => {
                    let position = system.vector_form.points[place];
                    let along =
                        position.map(|part| derivatives.along(part, direction, pool, system));
                    (vec!["_x", "_y"], along.to_vec())
                }
                Requested::Coordinate(unknown) => {
                    let value = derivatives.of_unknown(unknown, direction, pool);
                    (vec![""], vec![value])
                }
                Requested::Measure(place) => {
                    let measure = system.measures.values[place];
                    let value = derivatives.along(measure, direction, pool, system);
                    (vec![""], vec![value])
                }
            };
            let mut column = Vec::with_capacity(values.len());
            for (component, value) in components.into_iter().zip(values) {
                let what = format!("transmission_{}{component}", transmission.name);
                let name = derivatives.name(&what, direction);
                let target = pool.intermediate(&name);
                statements.push(Statement::assignment(target, value));
                column.push(target);
            }
            transmission.columns.push(column);
        }
    }
    let block = Block::following("transmission", "What the drivers transmit.", statements);
    Some((transmissions, block))
}

pub(super) fn described(quantity: Requested, system: &System) -> Transmission {
    let (name, what, rows) = match quantity {
        Requested::Point(place) => {
            let name = &system.mechanism.points[place].name;
            (
                name.to_lowercase(),
                format!("the point {name}"),
                vec![Dimension::LENGTH; 2],
            )
        }
        Requested::Coordinate(place) => {
            let unknown = &system.vector_form.unknowns[place];
            (
                unknown.name.clone(),
                format!("the coordinate {}", unknown.name),
                vec![Dimension::of(unknown.quantity)],
            )
        }
        Requested::Measure(place) => {
            let measure = &system.mechanism.measurements[place];
            (
                field_name(&measure.name),
                format!("the measure {}", measure.name),
                vec![measure.dimension],
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
