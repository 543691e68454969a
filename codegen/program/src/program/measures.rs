//! Computes the quantities of `measure` statements in blocks of their own: those of the motion, and those of forces, which follow the
//! forces.

use super::block::Block;
use super::directional_derivatives::DirectionalDerivatives;
use super::forces::Forces;
use super::function::{Level, Statement};
use crate::expr::{ExprId, SymbolId};
use crate::model::{Requested, field_name};
use crate::pool::Pool;
use crate::system::System;

/// Quantity of a `measure` statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// Index into the mechanism's measurements.
    pub measurement: usize,
    /// Base of function names: `stroke`.
    pub name: String,
    /// Value, in SI units.
    pub field: SymbolId,
}

/// Levels of statements, by order of differentiation.
const LEVELS: [Level; 4] = [
    Level::Position,
    Level::Velocity,
    Level::Acceleration,
    Level::Forces,
];

/// Statements of measures, by level.
#[derive(Default)]
pub(super) struct MeasureStatements {
    pub measures: Vec<Measure>,
    sections: [Vec<Statement>; 4],
}

impl MeasureStatements {
    /// States the requested measures. If `output` statements exist, only the measures that they or limits name are requested.
    pub fn new(
        pool: &mut Pool,
        system: &System,
        derivatives: &mut DirectionalDerivatives,
    ) -> MeasureStatements {
        let mut measured = MeasureStatements::default();
        for definition in &system.measures.definitions {
            match &definition.length_of {
                Some(parts) => derivatives.fix_length(definition.symbol, parts.clone()),
                None => derivatives.fix(definition.symbol, definition.value),
            }
            let statement = Statement::assignment(definition.symbol, definition.value);
            measured.sections[definition.order].push(statement);
        }
        let mechanism = &system.mechanism;
        for (place, measurement) in mechanism.measurements.iter().enumerate() {
            let mut requests = mechanism.requests.iter();
            let is_requested = mechanism.requests.is_empty()
                || mechanism.motors.iter().any(|it| it.has(place))
                || requests.any(|it| it.quantity == Requested::Measure(place))
                || mechanism.limits.iter().any(|it| it.measurement == place);
            let Some(&value) = system.measures.values.get(place).filter(|_| is_requested) else {
                continue;
            };
            let name = field_name(&measurement.name);
            let field = pool.intermediate(&format!("measure_{name}"));
            measured.sections[measurement.order].push(Statement::assignment(field, value));
            measured.measures.push(Measure {
                measurement: place,
                name,
                field,
            });
        }
        measured
    }

    /// Returns the block of positions, rates and accelerations; `None` if it is empty.
    pub fn of_motion(&mut self) -> Option<Block> {
        self.block(0..3, "measures", "What is measured.")
    }

    /// Returns the block of forces; `None` if it is empty.
    pub fn of_forces(
        &mut self,
        forces: &Forces,
        pool: &mut Pool,
        system: &System,
    ) -> Option<Block> {
        let fields = forces.asked();
        let columns = system.measures.forces.iter();
        let columns: Vec<(SymbolId, ExprId)> = columns
            .map(|&(symbol, column)| (symbol, pool.graph.variable(fields[column])))
            .collect();
        for statement in &mut self.sections[3] {
            statement.change_values(&mut |value| pool.graph.substitute(value, &columns));
        }
        self.block(3..4, "measured_forces", "What is measured of the forces.")
    }

    fn block(&mut self, levels: std::ops::Range<usize>, name: &str, title: &str) -> Option<Block> {
        let mut statements = Vec::new();
        for level in levels {
            let section = &mut self.sections[level];
            if !section.is_empty() {
                statements.push(Statement::Section(LEVELS[level]));
                statements.append(section);
            }
        }
        let block = Block::following(name, title, statements);
        (!block.function.statements.is_empty()).then_some(block)
    }
}
