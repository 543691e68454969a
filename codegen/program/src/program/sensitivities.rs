//! What `sensitivity` statements ask for → a last block that computes what of it belongs to no other block.
//!
//! The derivatives of unknowns are found where the unknowns are; those of points follow from them here. Where `output`
//! statements say what is wanted, nothing else is differentiated.

use super::block::Block;
use super::directional_derivatives::DirectionalDerivatives;
use super::function::{Level, Statement};
use super::outputs::highest_levels;
use super::transmissions::described;
use crate::expr::{ExprId, Node, SymbolId};
use crate::joint::Quantity;
use crate::model::{Request, Requested};
use crate::system::{Cause, System};

/// A derivative along a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Found {
    /// A field of the frame.
    Field(SymbolId),
    /// A number: what is always the same.
    Constant(f64),
}

/// How the motion depends on one parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    /// An index into the mechanism's parameters.
    pub parameter: usize,
    /// What it is called in generated code: `l2`.
    pub name: String,
    /// The derivatives of every coordinate and its rate; nothing where `output` says what is wanted.
    pub coordinates: Option<Vec<[Found; 2]>>,
    /// Those of points, and of the coordinates that `output` names.
    pub quantities: Vec<SensitiveQuantity>,
}

/// A point or a coordinate with its derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct SensitiveQuantity {
    /// `k`, `phi_c1`: what its functions are named after.
    pub name: String,
    /// `the point K`, `the coordinate phi_c1`.
    pub what: String,
    /// What its components are measured in: x and y of a point, or the coordinate itself.
    pub components: Vec<Quantity>,
    /// By level, position and velocity as far as they are wanted, then by component.
    pub levels: Vec<Vec<Found>>,
}

impl Sensitivity {
    /// The fields of all derivatives.
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

/// The sensitivities that are asked for, and the block that computes those of points; `None` where there are none.
pub(super) fn sensitivities(
    system: &mut System,
    derivatives: &mut DirectionalDerivatives,
) -> Option<(Vec<Sensitivity>, Block)> {
    if system.mechanism.sensitivities.is_empty() {
        return None;
    }
    let whole = system.mechanism.requests.is_empty();
    let requests: Vec<Request> = if whole {
        let points = (0..system.mechanism.points.len()).map(Requested::Point);
        points
            .map(|quantity| Request { quantity, level: 1 })
            .collect()
    } else {
        highest_levels(&system.mechanism.requests)
    };
    let mut statements = Vec::new();
    let mut found = Vec::new();
    for direction in 0..system.directions.len() {
        let Cause::Parameter(parameter) = system.directions[direction].cause else {
            continue;
        };
        let coordinates = whole.then(|| {
            (0..system.coordinates.len())
                .map(|unknown| {
                    let levels = of_unknown(unknown, direction, derivatives, system);
                    levels.map(|value| {
                        kept(value, "", direction, derivatives, &mut statements, system)
                    })
                })
                .collect()
        });
        let mut quantities: Vec<SensitiveQuantity> = requests
            .iter()
            .map(|request| {
                let about = described(request.quantity, system);
                SensitiveQuantity {
                    name: about.name,
                    what: about.what,
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
                    Requested::Point(place) => {
                        let position = system.vector_form.points[place];
                        let along = position.map(|part| derivatives.along(part, direction, system));
                        let graph = &mut system.mechanism.graph;
                        match level {
                            0 => along.to_vec(),
                            _ => along
                                .map(|part| system.vector_form.rate(part, graph))
                                .to_vec(),
                        }
                    }
                    Requested::Coordinate(unknown) => {
                        vec![of_unknown(unknown, direction, derivatives, system)[level]]
                    }
                };
                let suffix = ["", "_rate"][level];
                let components = values.into_iter().zip(["_x", "_y"]);
                let components = components.map(|(value, axis)| {
                    let what = format!("point_{}{axis}{suffix}", quantity.name);
                    kept(
                        value,
                        &what,
                        direction,
                        derivatives,
                        &mut statements,
                        system,
                    )
                });
                quantity.levels.push(components.collect());
            }
        }
        found.push(Sensitivity {
            parameter,
            name: system.directions[direction].name.clone(),
            coordinates,
            quantities,
        });
    }
    let title = "How what is asked for depends on parameters.";
    let block = Block::following("sensitivity", title, statements);
    Some((found, block))
}

/// The derivatives of an unknown and of its rate: symbols or constants.
fn of_unknown(
    unknown: usize,
    direction: usize,
    derivatives: &DirectionalDerivatives,
    system: &System,
) -> [ExprId; 2] {
    [
        derivatives.of_unknown(unknown, direction, system),
        derivatives.rate_of_unknown(unknown, direction, system),
    ]
}

/// A value as the frame keeps it; what has no name yet becomes a field of its own.
fn kept(
    value: ExprId,
    what: &str,
    direction: usize,
    derivatives: &mut DirectionalDerivatives,
    statements: &mut Vec<Statement>,
    system: &mut System,
) -> Found {
    let graph = &system.mechanism.graph;
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
            let target = system.intermediate(&name);
            statements.push(Statement::assignment(target, value));
            Found::Field(target)
        }
    }
}
