//! Computes derivatives of `sensitivity` statements in a last block, as far as no other block does.
//!
//! Blocks find the derivatives of their unknowns; those of points follow from them here. If `output` statements exist, only their
//! quantities are differentiated.

use super::block::Block;
use super::directional_derivatives::DirectionalDerivatives;
use super::function::{Level, Statement};
use super::outputs::highest_levels;
use super::transmissions::described;
use crate::expr::{ExprId, Node, SymbolId};
use crate::model::{Dimension, Request, Requested};
use crate::pool::Pool;
use crate::system::{Cause, System};

/// Derivative along a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Found {
    /// Field of the frame.
    Field(SymbolId),
    /// Constant derivative.
    Constant(f64),
}

/// Sensitivity of the motion to one parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    /// Index into the mechanism's parameters.
    pub parameter: usize,
    /// Name in generated code: `l2`.
    pub name: String,
    /// Derivatives of every coordinate and its rate; `None` if there are `output` statements.
    pub coordinates: Option<Vec<[Found; 2]>>,
    /// Derivatives of points, and of the coordinates of `output` statements.
    pub quantities: Vec<SensitiveQuantity>,
}

/// Point, coordinate or measure with its derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct SensitiveQuantity {
    /// Base of function names: `k`, `phi_c1`.
    pub name: String,
    /// Description: `the point K`, `the coordinate phi_c1`.
    pub what: String,
    /// True for a measure, which has one derivative.
    pub is_measure: bool,
    /// Dimensions of the components: x and y of a point, or the coordinate or measure itself.
    pub components: Vec<Dimension>,
    /// Derivatives by level, position and velocity as far as requested, then by component.
    pub levels: Vec<Vec<Found>>,
}

impl Sensitivity {
    /// Returns the fields of all derivatives.
    pub fn fields(&self) -> Vec<SymbolId> {
        let coordinates = self.coordinates.iter().flatten().flatten();
        let quantities = self.quantities.iter().flat_map(|it| &it.levels).flatten();
        coordinates
            .chain(quantities)
            .filter_map(|found| match found {
                Found::Field(symbol) => Some(*symbol),
                Found::Constant(_) => None,
            })
            .collect()
    }
}

/// Returns the requested sensitivities, and the block that computes those of points; `None` if there are none.
pub(super) fn sensitivities(
    pool: &mut Pool,
    system: &System,
    derivatives: &mut DirectionalDerivatives,
) -> Option<(Vec<Sensitivity>, Block)> {
    if system.mechanism.sensitivities.is_empty() {
        return None;
    }
    let whole = system.mechanism.requests.is_empty();
    let mut requests: Vec<Request> = if whole {
        let points = (0..system.mechanism.points.len()).map(Requested::Point);
        let measures = (0..system.measures.values.len()).map(Requested::Measure);
        points
            .chain(measures)
            .map(|quantity| Request { quantity, level: 1 })
            .collect()
    } else {
        highest_levels(&system.mechanism.requests)
    };
    // Derivatives exist for positions and rates.
    requests.retain(|request| match request.quantity {
        Requested::Measure(measure) => system.mechanism.measurements[measure].order <= 1,
        Requested::Point(_) | Requested::Coordinate(_) => true,
    });
    let mut statements = Vec::new();
    let mut all = Vec::new();
    for direction in 0..system.directions.len() {
        let Cause::Parameter(parameter) = system.directions[direction].cause else {
            continue;
        };
        let coordinates = whole.then(|| {
            (0..system.coordinates.len())
                .map(|unknown| {
                    let levels = of_unknown(unknown, direction, derivatives, pool);
                    levels
                        .map(|value| kept(value, "", direction, derivatives, &mut statements, pool))
                })
                .collect()
        });
        let mut quantities: Vec<SensitiveQuantity> = requests
            .iter()
            .map(|request| {
                let about = described(request.quantity, system);
                SensitiveQuantity {
                    name: match request.quantity {
                        Requested::Measure(_) => format!("measure_{}", about.name),
                        Requested::Point(_) | Requested::Coordinate(_) => about.name,
                    },
                    what: about.what,
                    is_measure: matches!(request.quantity, Requested::Measure(_)),
                    components: about.rows,
                    levels: Vec::new(),
                }
            })
            .collect();
        for level in 0..2 {
            statements.push(Statement::Section(match level {
                0 => Level::Response(direction),
                _ => Level::ResponseRate(direction),
            }));
            for (request, quantity) in requests.iter().zip(&mut quantities) {
                if request.level < level {
                    continue;
                }
                let values = match request.quantity {
                    Requested::Measure(measure) => {
                        // A measure has one derivative, at the level at which the derivatives of its terms are known.
                        if system.mechanism.measurements[measure].order != level {
                            continue;
                        }
                        let value = system.measures.values[measure];
                        vec![derivatives.along(value, direction, pool, system)]
                    }
                    Requested::Point(place) => {
                        let position = system.vector_form.points[place];
                        let along =
                            position.map(|part| derivatives.along(part, direction, pool, system));
                        match level {
                            0 => along.to_vec(),
                            _ => along.map(|part| pool.rate(part)).to_vec(),
                        }
                    }
                    Requested::Coordinate(unknown) => {
                        vec![of_unknown(unknown, direction, derivatives, pool)[level]]
                    }
                };
                let suffix = ["", "_rate"][level];
                let components = values.into_iter().zip(["_x", "_y"]);
                let components = components.map(|(value, axis)| {
                    let what = match request.quantity {
                        Requested::Measure(_) => quantity.name.clone(),
                        _ => format!("point_{}{axis}{suffix}", quantity.name),
                    };
                    kept(value, &what, direction, derivatives, &mut statements, pool)
                });
                quantity.levels.push(components.collect());
            }
        }
        all.push(Sensitivity {
            parameter,
            name: system.directions[direction].name.clone(),
            coordinates,
            quantities,
        });
    }
    let title = "How what is asked for depends on parameters.";
    let block = Block::following("sensitivity", title, statements);
    Some((all, block))
}

/// Returns the derivatives of an unknown and of its rate: symbols or constants.
fn of_unknown(
    unknown: usize,
    direction: usize,
    derivatives: &DirectionalDerivatives,
    pool: &Pool,
) -> [ExprId; 2] {
    [
        derivatives.of_unknown(unknown, direction, pool),
        derivatives.rate_of_unknown(unknown, direction, pool),
    ]
}

/// Returns a value as the frame keeps it; an unnamed value becomes a new field.
fn kept(
    value: ExprId,
    what: &str,
    direction: usize,
    derivatives: &mut DirectionalDerivatives,
    statements: &mut Vec<Statement>,
    pool: &mut Pool,
) -> Found {
    let graph = &pool.graph;
    if let Some(value) = graph
        .constant_value(value)
        .filter(|_| graph.is_constant(value))
    {
        return Found::Constant(value);
    }
    match *graph.node(value) {
        Node::Symbol(symbol) if derivatives.is_response(symbol) => Found::Field(symbol),
        _ => {
            let name = derivatives.name(what, direction);
            let target = pool.intermediate(&name);
            statements.push(Statement::assignment(target, value));
            Found::Field(target)
        }
    }
}
