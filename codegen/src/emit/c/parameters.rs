//! Writes parameters and inputs: structures, defaults, accessors and checks.

use super::comment::quoted;
use super::constants::Constant;
use super::printer::Printer;
use super::words::identifier;
use crate::emit::code::Code;
use crate::emit::module::documentation;
use crate::emit::module::scope::{Place, Scope};
use crate::expr::ExprId;
use crate::model::{Dimension, field_name};

/// Arguments that functions of the mechanism have beside pose and time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Declared {
    /// True if the mechanism has parameters.
    pub parameters: bool,
    /// True if the mechanism has inputs.
    pub inputs: bool,
}

/// Declared number: name, dimension, documentation, range and default.
type Number<'a> = (
    &'a str,
    Dimension,
    &'a Vec<String>,
    Option<[f64; 2]>,
    ExprId,
);

impl Printer<'_> {
    pub(super) fn declared(&self) -> Declared {
        Declared {
            parameters: !self.module.system.mechanism.parameters.is_empty(),
            inputs: !self.module.system.mechanism.inputs.is_empty(),
        }
    }

    fn parameters(&self) -> Vec<Number<'_>> {
        let parameters = self.module.system.mechanism.parameters.iter();
        parameters
            .map(|it| {
                (
                    it.name.as_str(),
                    it.dimension,
                    &it.docs,
                    it.range,
                    it.nominal,
                )
            })
            .collect()
    }

    fn inputs(&self) -> Vec<Number<'_>> {
        let inputs = self.module.system.mechanism.inputs.iter();
        inputs
            .map(|it| {
                (
                    it.name.as_str(),
                    it.dimension,
                    &it.docs,
                    it.range,
                    it.initial,
                )
            })
            .collect()
    }

    fn default(&self, value: ExprId) -> f64 {
        // Defaults were found to be finite constants when they were read.
        let graph = &self.module.pool.graph;
        graph.constant_value(value).unwrap_or(0.0)
    }
}

/// Declares the structure of the parameters and the constant with their defaults.
pub(super) fn parameters(printer: &Printer<'_>, text: &mut Code) {
    if printer.declared().parameters {
        let fields = printer.parameters();
        structure(
            printer,
            "Parameters",
            "Values that can be changed at run time.",
            printer.real(),
            "unless it is set",
            &fields,
            text,
        );
        text.gap();
        text.comment(["Values of the description."]);
        Constant::new(printer.type_of("Parameters"), printer.constant("NOMINAL")).declare(text);
    }
}

/// The structure with the inputs.
pub(super) fn inputs(printer: &Printer<'_>, text: &mut Code) {
    if printer.declared().inputs {
        let (fields, signal) = (printer.inputs(), printer.runtime("signal"));
        let title =
            "Signals that move the mechanism, each with value, rate and acceleration at one time.";
        structure(
            printer,
            "Inputs",
            title,
            &signal,
            "and at rest unless it is supplied",
            &fields,
            text,
        );
    }
}

fn structure(
    printer: &Printer<'_>,
    kind: &str,
    title: &str,
    field_type: &str,
    default: &str,
    fields: &[Number<'_>],
    text: &mut Code,
) {
    let structure = printer.type_of(kind);
    text.gap();
    text.comment([title]);
    text.open(format!("typedef struct {structure} {{"));
    for (name, dimension, docs, range, value) in fields {
        let value = printer.default(*value);
        text.comment(documentation::of_number(
            name, *dimension, value, default, *range, docs,
        ));
        text.line(format!("{field_type} {};", identifier(&field_name(name))));
    }
    text.close(format!("}} {structure};"));
}

/// Defines the defaults of the parameters.
pub(super) fn nominal(printer: &Printer<'_>, text: &mut Code) {
    if !printer.declared().parameters {
        return;
    }
    let values = printer.parameters().into_iter();
    let values = values.map(|(.., value)| printer.number(printer.default(value)));
    let values: Vec<String> = values.collect();
    Constant::new(printer.type_of("Parameters"), printer.constant("NOMINAL")).define(&values, text);
}

/// Defines the initial inputs.
pub(super) fn initial(printer: &Printer<'_>, text: &mut Code) {
    let zero = printer.number(0.0);
    let values = printer.inputs().into_iter().map(|(.., value)| {
        let value = printer.number(printer.default(value));
        format!("{{{value}, {zero}, {zero}}}")
    });
    let values: Vec<String> = values.collect();
    Constant::new(printer.type_of("Inputs"), printer.constant("INITIAL")).define(&values, text);
}

/// Writes the functions by which the runtime reads inputs and checks that parameters and inputs are finite.
pub(super) fn accessors(printer: &Printer<'_>, text: &mut Code) {
    let declared = printer.declared();
    let (real, finite) = (printer.real(), printer.runtime("all_finite"));
    if declared.parameters {
        let (function, structure) = (
            printer.own("parameters_are_finite"),
            printer.type_of("Parameters"),
        );
        let fields = printer.parameters();
        let values = fields
            .iter()
            .map(|(name, ..)| format!("parameters->{}", identifier(&field_name(name))));
        let values: Vec<String> = values.collect();
        text.gap();
        text.line(format!(
            "LINKWRIGHT_FUNCTION static bool {function}(const void *given)"
        ));
        text.open("{");
        text.line(format!(
            "const {structure} *const parameters = (const {structure} *)given;"
        ));
        text.line(printer.array("checked", &values));
        text.line(format!("return {finite}(checked, {}U);", values.len()));
        text.close("}");
    }
    if declared.inputs {
        let (structure, signal) = (printer.type_of("Inputs"), printer.runtime("signal"));
        let fields: Vec<String> = printer
            .inputs()
            .iter()
            .map(|(name, ..)| identifier(&field_name(name)))
            .collect();
        for (name, constant) in [("read_signal", "const "), ("signal", "")] {
            let function = printer.own(name);
            text.gap();
            text.line(format!(
                "LINKWRIGHT_FUNCTION static {constant}{signal} *{function}({constant}void *given, uint16_t index)"
            ));
            text.open("{");
            text.line(format!(
                "{constant}{structure} *const inputs = ({constant}{structure} *)given;"
            ));
            text.line(format!(
                "{constant}{signal} *found = &inputs->{};",
                fields[0]
            ));
            if fields.len() > 1 {
                text.line("switch (index) {");
                for (index, field) in fields.iter().enumerate().skip(1) {
                    text.open(format!("case {index}U:"));
                    text.line(format!("found = &inputs->{field};"));
                    text.line("break;");
                    text.end();
                }
                text.open("default:");
                text.line("break;");
                text.end();
                text.line("}");
            } else {
                text.line("(void)index;");
            }
            text.line("return found;");
            text.close("}");
        }
        let function = printer.own("inputs_are_finite");
        text.gap();
        text.line(format!(
            "LINKWRIGHT_FUNCTION static bool {function}(const void *given)"
        ));
        text.open("{");
        text.line("bool are_finite = true;");
        text.open(format!(
            "for (uint16_t k = 0U; k < {}U; k++) {{",
            fields.len()
        ));
        text.line(format!(
            "const {signal} *const found = {}(given, k);",
            printer.own("read_signal")
        ));
        text.line(format!(
            "const {real} checked[3] = {{found->value, found->rate, found->acceleration}};"
        ));
        text.line(format!("are_finite = are_finite && {finite}(checked, 3U);"));
        text.close("}");
        text.line("return are_finite;");
        text.close("}");
    }
}

/// Writes the check of quantities that must stay positive for all parameters.
pub(super) fn requirements(printer: &Printer<'_>, text: &mut Code) {
    let Some(requirements) = &printer.module.program.requirements else {
        return;
    };
    if !requirements.limit_parameters() {
        return;
    }
    let (function, structure) = (printer.own("not_positive"), printer.type_of("Parameters"));
    let scope = Scope::new(printer.module, &requirements.function, Place::Coordinates);
    text.gap();
    text.comment([
        "Finds the first value that parameters leave not positive; returns false if there is none.",
    ]);
    let real = printer.real();
    text.line(format!(
        "LINKWRIGHT_FUNCTION static bool {function}(const void *given, uint16_t *place, {real} *value)"
    ));
    text.open("{");
    text.line(format!(
        "const {structure} *const parameters = (const {structure} *)given;"
    ));
    printer.plain_statements(&scope, text);
    let results = printer.results(&scope);
    text.line(printer.array("checked", &results));
    let first = printer.runtime("first_not_positive");
    text.line(format!(
        "return {first}(checked, {}U, place, value);",
        results.len()
    ));
    text.close("}");
}

/// Names of the quantities that must be positive; `None` without requirements.
pub(super) fn requirement_names(printer: &Printer<'_>) -> Option<Vec<[String; 2]>> {
    let requirements = printer.module.program.requirements.as_ref()?;
    let names = requirements.names.iter();
    Some(
        names
            .map(|(owner, what)| [quoted(owner), quoted(what)])
            .collect(),
    )
}

/// Writes the function that computes the design configuration from the parameters: a value per unknown, coordinates first.
pub(super) fn drawn(printer: &Printer<'_>, text: &mut Code) {
    let Some(function) = &printer.module.program.drawn else {
        return;
    };
    let (real, structure) = (printer.real(), printer.type_of("Parameters"));
    let scope = Scope::new(printer.module, function, Place::Coordinates);
    text.gap();
    text.comment(["Finds the design value of each coordinate and displacement."]);
    text.line(format!(
        "LINKWRIGHT_FUNCTION static void {}(const {structure} *parameters, {real} found[{}])",
        printer.own("drawn"),
        function.results.len()
    ));
    text.open("{");
    if !scope.reads().parameters {
        text.line("(void)parameters;");
    }
    printer.plain_statements(&scope, text);
    for (place, result) in printer.results(&scope).iter().enumerate() {
        text.line(format!("found[{place}] = {result};"));
    }
    text.close("}");
}
