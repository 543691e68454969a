//! Derives the equations of a mechanism whose drivers follow inputs instead of their laws.

use super::released;
use crate::expr::{ExprId, Graph, Number, SymbolId};
use crate::joint::Quantity;
use crate::model::{Dimension, Input, Mechanism, Parameter};
use crate::system::Derived;

/// Name of the variable in place of t, and stems of the symbols of inputs. Descriptions cannot contain blanks in names.
const VARIABLE: &str = "travel time";
const INPUTS: [&str; 3] = ["travel input", "travel rate", "travel acceleration"];

/// Returns the equations with an input as the value of each of these drivers, indices into the joints.
///
/// Everything else that depends on t or on inputs keeps its value at `t` (s). The new inputs follow those of the description in the order
/// of the drivers, and have the values of the laws at `t`. An input that alone was the value of a driver hands on its range. `None` if a
/// joint is not a driver with a value.
pub fn driven(derived: &Derived, drivers: &[usize], t: f64) -> Option<Derived> {
    let mut mechanism = derived.system.mechanism.clone();
    let mut pool = derived.pool.without_roles();
    let graph = &mut pool.graph;
    // All that depends on t is fixed, and nothing depends on the new variable.
    graph.set_nominal(mechanism.time, t);
    mechanism.parameters.push(Parameter {
        name: "t".to_string(),
        docs: Vec::new(),
        symbol: mechanism.time,
        nominal: graph.number(Number::float(t)),
        tolerance: None,
        range: None,
        dimension: Dimension::Number,
        used: true,
        span: mechanism.span,
    });
    mechanism.time = graph.symbol(VARIABLE);
    let zero = graph.zero();
    for input in &mut mechanism.inputs {
        input.signal = [input.signal[0], zero, zero];
    }
    let signals = mechanism.inputs.iter();
    let signals = signals.flat_map(|it| it.symbols.into_iter().zip(it.signal));
    let signals: Vec<(SymbolId, _)> = signals.collect();
    for (number, &joint) in drivers.iter().enumerate() {
        let driver = mechanism.joints.get(joint)?;
        let (quantity, value) = (driver.kind.value.quantity()?, driver.operands.value?);
        let range = range_of(&mechanism, value, graph);
        let at_rest = graph.substitute(value, &signals);
        let at_rest = graph.constant_value(at_rest)?;
        let initial = graph.number(Number::float(at_rest));
        let symbols = INPUTS.map(|stem| graph.symbol(&format!("{stem} {number}")));
        let [symbol, ..] = symbols;
        let value = graph.variable(symbol);
        let driver = &mut mechanism.joints[joint];
        driver.operands.value = Some(value);
        let input = Input {
            name: driver.label.clone(),
            docs: Vec::new(),
            symbols,
            initial,
            range,
            signal: [initial, zero, zero],
            dimension: match quantity {
                Quantity::Angle => Dimension::Angle,
                Quantity::Length | Quantity::Power(_) => Dimension::LENGTH,
            },
            used: true,
            span: driver.span,
        };
        mechanism.inputs.push(input);
    }
    // Rates and forces depend on the law that is replaced.
    let measurements = &mechanism.measurements;
    let is_of_positions = |limit: usize| measurements[limit].order == 0;
    mechanism
        .limits
        .retain(|it| is_of_positions(it.measurement));
    mechanism.requests.clear();
    mechanism.transmissions.clear();
    mechanism.sensitivities.clear();
    let system = released(&mut pool, mechanism);
    pool.exceeded()
        .is_none()
        .then_some(Derived { pool, system })
}

/// Returns the range of the input that is the value; `None` for other values, and for an input without a range.
fn range_of(mechanism: &Mechanism, value: ExprId, graph: &mut Graph) -> Option<[f64; 2]> {
    let mut inputs = mechanism.inputs.iter();
    let input = inputs.find(|it| graph.variable(it.symbols[0]) == value)?;
    input.range
}
