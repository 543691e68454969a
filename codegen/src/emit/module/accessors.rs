//! Lists the functions that return stored fields of a frame.
//!
//! Every language offers the same functions under the same names; a language decides how several numbers are returned.

use super::Module;
use super::documentation::{of_quantity, of_sensitivity, units};
use crate::expr::SymbolId;
use crate::program::{Found, Output, Sensitivity};

/// Function that returns stored fields of a frame.
#[derive(Clone, Debug)]
pub(in crate::emit) struct Accessor {
    /// Name, such as `effort_crank`.
    pub name: String,
    pub docs: Vec<String>,
    pub shape: Shape,
    /// Values by level, then by component.
    pub levels: Vec<Vec<Found>>,
}

/// Shape of a returned value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::emit) enum Shape {
    Number,
    /// x and y.
    Pair,
    /// x and y of position, velocity and acceleration.
    PointMotion,
    /// x and y of two derivatives.
    PointSensitivity,
    /// Derivatives of all coordinates and of their rates.
    Sensitivity,
}

impl Accessor {
    /// Returns the function of one field, or of x and y.
    pub(super) fn of_fields(
        name: String,
        fields: &[SymbolId],
        line: impl Into<String>,
    ) -> Accessor {
        let values = fields.iter().map(|&it| Found::Field(it)).collect();
        Accessor::of_values(name, vec![line.into()], values)
    }

    fn of_values(name: String, docs: Vec<String>, values: Vec<Found>) -> Accessor {
        Accessor {
            name,
            docs,
            shape: match values.len() {
                1 => Shape::Number,
                _ => Shape::Pair,
            },
            levels: vec![values],
        }
    }
}

/// Returns the functions of one output.
pub(in crate::emit) fn of_output(output: &Output) -> Vec<Accessor> {
    match output {
        Output::Point { name, fields } if fields.len() == 3 => vec![Accessor {
            name: format!("point_{name}"),
            docs: vec![format!("Motion of the point {name}, in m, m/s and m/s².")],
            shape: Shape::PointMotion,
            levels: fields
                .iter()
                .map(|it| it.map(Found::Field).to_vec())
                .collect(),
        }],
        Output::Point { name, fields } => {
            let levels = [
                ("position", "Position", "m"),
                ("velocity", "Velocity", "m/s"),
            ];
            let levels = levels.into_iter().zip(fields);
            let functions = levels.map(|((suffix, level, unit), fields)| {
                let line = format!("{level} of the point {name}, in {unit}.");
                Accessor::of_fields(format!("point_{name}_{suffix}"), fields, line)
            });
            functions.collect()
        }
        Output::Coordinate {
            name,
            quantity,
            fields,
        } => {
            let levels = [
                ("", "Coordinate"),
                ("_rate", "Rate of the coordinate"),
                ("_acceleration", "Acceleration of the coordinate"),
            ];
            let levels = levels.into_iter().zip(units(*quantity)).zip(fields);
            let functions = levels.map(|(((suffix, what), unit), field)| {
                let line = format!("{what} {name}, in {unit}.");
                Accessor::of_fields(format!("{name}{suffix}"), &[*field], line)
            });
            functions.collect()
        }
    }
}

/// Returns the functions of all measures.
pub(in crate::emit) fn measures(module: &Module<'_>) -> Vec<Accessor> {
    let measures = module.program.measures.iter();
    let functions = measures.map(|measure| {
        let measurement = &module.system.mechanism.measurements[measure.measurement];
        let mut docs = vec![match measurement.unit() {
            plain if plain.is_empty() => format!("Measure {}.", measurement.name),
            unit => format!("Measure {}, in {unit}.", measurement.name),
        }];
        if !measurement.docs.is_empty() {
            docs.push(String::new());
            docs.extend(measurement.docs.iter().cloned());
        }
        Accessor {
            docs,
            ..Accessor::of_fields(format!("measure_{}", measure.name), &[measure.field], "")
        }
    });
    functions.collect()
}

/// Returns the functions of all sensitivities.
pub(in crate::emit) fn sensitivities(module: &Module<'_>) -> Vec<Accessor> {
    let all = module.program.sensitivities.iter();
    all.flat_map(|it| of_parameter(it, module)).collect()
}

fn of_parameter(sensitivity: &Sensitivity, module: &Module<'_>) -> Vec<Accessor> {
    let mut functions = Vec::new();
    if let Some(coordinates) = &sensitivity.coordinates {
        let level = |level: usize| coordinates.iter().map(|it| it[level]).collect();
        functions.push(Accessor {
            name: format!("sensitivity_{}", sensitivity.name),
            docs: of_sensitivity(sensitivity, module),
            shape: Shape::Sensitivity,
            levels: vec![level(0), level(1)],
        });
    }
    for quantity in &sensitivity.quantities {
        let mut names = of_quantity(sensitivity, quantity, module).into_iter();
        match (names.len(), &quantity.levels[..]) {
            (1, [_, _]) => functions.extend(names.next().map(|(name, line)| Accessor {
                name,
                docs: vec![line],
                shape: Shape::PointSensitivity,
                levels: quantity.levels.clone(),
            })),
            (_, levels) => functions.extend(names.zip(levels).map(|((name, line), values)| {
                Accessor::of_values(name, vec![line], values.clone())
            })),
        }
    }
    functions
}
