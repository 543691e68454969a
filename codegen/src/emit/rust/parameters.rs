//! Writes parameters and inputs: structures, requirements and the design configuration.
//!
//! A mechanism without them has neither structures nor arguments for them.

use super::code::argument;
use super::explained::block_name;
use super::names::identifier;
use super::ranges;
use crate::emit::code::Code;
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{Module, documentation};
use crate::expr::ExprId;
use crate::model::{Dimension, field_name};
use crate::program::Function;

/// Declared number: name, dimension, documentation, default and range.
type Number<'a> = (
    &'a str,
    Dimension,
    &'a Vec<String>,
    ExprId,
    Option<[f64; 2]>,
);

/// Arguments that functions of the mechanism have beside pose and time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Declared {
    /// True if the mechanism has parameters.
    pub parameters: bool,
    /// True if the mechanism has inputs.
    pub inputs: bool,
}

impl Module<'_> {
    pub(super) fn declared(&self) -> Declared {
        Declared {
            parameters: !self.system.mechanism.parameters.is_empty(),
            inputs: !self.system.mechanism.inputs.is_empty(),
        }
    }
}

impl Declared {
    /// Returns the arguments of the runtime's macros.
    pub(super) fn lines(self) -> [String; 2] {
        let line = |what: &str, is_declared: bool| match is_declared {
            true => format!("{}: {what};", what.to_lowercase()),
            false => format!("{}:;", what.to_lowercase()),
        };
        [
            line("Parameters", self.parameters),
            line("Inputs", self.inputs),
        ]
    }

    /// Returns `parameters: &Parameters` and `inputs: &Inputs`, with an underscore before a name that is not read.
    pub(super) fn arguments(self, reads_parameters: bool, reads_inputs: bool) -> Vec<String> {
        let all = [
            (
                self.parameters,
                "parameters",
                reads_parameters,
                "Parameters",
            ),
            (self.inputs, "inputs", reads_inputs, "Inputs"),
        ];
        all.into_iter()
            .filter(|(is_declared, ..)| *is_declared)
            .map(|(_, name, is_read, kind)| format!("{}: &{kind}", argument(name, is_read)))
            .collect()
    }
}

/// Writes `struct Parameters` and `struct Inputs` with their defaults, and the design configuration.
pub(super) fn structures(module: &Module<'_>, code: &mut Code) {
    let mechanism = &module.system.mechanism;
    let parameters = mechanism.parameters.iter();
    let parameters = parameters.map(|it| {
        (
            it.name.as_str(),
            it.dimension,
            &it.docs,
            it.nominal,
            it.range,
        )
    });
    structure(module, "parameters", "unless it is set", parameters, code);
    let inputs = mechanism.inputs.iter();
    let inputs = inputs.map(|it| {
        (
            it.name.as_str(),
            it.dimension,
            &it.docs,
            it.initial,
            it.range,
        )
    });
    structure(
        module,
        "inputs",
        "and at rest unless it is supplied",
        inputs,
        code,
    );
    ranges::ranges(module, code);
    drawn(module, code);
}

/// Writes a structure with a number for each declared name; nothing if there is none.
fn structure<'a>(
    module: &Module<'_>,
    kind: &str,
    default: &str,
    declared: impl ExactSizeIterator<Item = Number<'a>>,
    code: &mut Code,
) {
    if declared.len() == 0 {
        return;
    }
    code.gap();
    code.open(format!("::linkwright::generated::{kind}! {{"));
    code.open("Scalar {");
    for (name, dimension, docs, value, range) in declared {
        // Defaults were found to be finite constants when they were read.
        let value = module.pool.graph.constant_value(value).unwrap_or(0.0);
        code.docs(documentation::of_number(
            name, dimension, value, default, range, docs,
        ));
        let (field, value) = (identifier(&field_name(name)), module.number(value));
        code.line(format!("{field} = {value},"));
    }
    code.close("}");
    code.close("}");
}

/// Writes the quantities that must be positive, with their names.
pub(super) fn requirements(module: &Module<'_>, code: &mut Code) {
    let Some(requirements) = &module.program.requirements else {
        return;
    };
    let names = requirements.names.iter();
    let names: Vec<String> = names.map(|(owner, what)| block_name(owner, what)).collect();
    code.gap();
    code.docs([documentation::of_requirements(requirements)]);
    code.line(format!(
        "const REQUIREMENTS: [BlockName<'static>; {}] = [{}];",
        names.len(),
        names.join(", ")
    ));
    if requirements.limit_parameters() {
        let (head, body) = of_parameters("requirements", &requirements.function, module);
        code.function([""; 0], [], &head, body);
    }
}

/// Writes the design configuration as a function of the parameters: a value per unknown, coordinates first.
fn drawn(module: &Module<'_>, code: &mut Code) {
    if let Some(function) = &module.program.drawn {
        let (head, body) = of_parameters("drawn", function, module);
        let docs = ["Finds the design value of each coordinate and displacement."];
        code.unused_function(docs, &head, body);
    }
}

/// Returns the head and the statements of a function of the parameters.
fn of_parameters(name: &str, function: &Function, module: &Module<'_>) -> (String, Code) {
    let scope = Scope::new(module, function, Place::Coordinates);
    let (mut body, results) = (scope.plain_statements(), scope.results());
    body.line(format!("[{}]", results.join(", ")));
    let head = format!(
        "fn {name}(parameters: &Parameters) -> [Scalar; {}]",
        results.len()
    );
    (head, body)
}
