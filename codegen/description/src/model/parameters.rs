//! Resolves `param` and `input` statements, and initial values of `free` ones, into symbols with a default.
//!
//! A parameter is a fixed symbol, allowed wherever a constant is; checks of its value use the default. An input varies like t,
//! and is allowed where t is. Both share the name space of the constants.

use std::collections::HashMap;

use super::dimension::Dimension;
use super::expression::Value;
use super::resolve::Resolver;
use super::{Distribution, Input, Mechanism, Parameter};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::ExprId;
use crate::syntax::{Adjustable, Constant, Name};

/// Noun for a declaration, in messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Sort {
    Parameter,
    Input,
    /// A free coordinate, which the solver supplies like an input.
    Free,
}

/// First name that became this field of the sort; never iterated.
pub(super) type Fields = HashMap<(Sort, String), Name>;

/// Number of a statement with its departures.
struct Stated {
    value: Value,
    /// Both ends of its range, in SI units; `None` if it is not limited.
    range: Option<[f64; 2]>,
    /// Distribution about the number; `None` without a tolerance.
    tolerance: Option<Distribution>,
}

impl Sort {
    fn noun(self) -> &'static str {
        match self {
            Sort::Parameter => "parameter",
            Sort::Input => "input",
            Sort::Free => "free coordinate",
        }
    }
}

impl Resolver<'_> {
    pub(super) fn add_parameter(&mut self, written: &Adjustable) {
        let Some(Stated {
            value: (nominal, dimension),
            range,
            tolerance,
        }) = self.stated(written, Sort::Parameter)
        else {
            return;
        };
        let Constant { name, docs, .. } = &written.constant;
        // The name differs from all coordinates and from other parameters.
        let symbol = self.graph.symbol(&format!("{} parameter", name.text));
        let value = self.graph.constant_value(nominal).unwrap_or(f64::NAN);
        self.graph.set_nominal(symbol, value);
        let variable = self.graph.variable(symbol);
        if let Some(duplicate) = self.declared.constants.declare(name, (variable, dimension)) {
            self.diagnostics.push(duplicate);
            return;
        }
        self.declared.parameters.push(Parameter {
            name: name.text.clone(),
            docs: docs.clone(),
            symbol,
            nominal,
            range,
            tolerance,
            dimension,
            used: false,
            span: name.span,
        });
    }

    pub(super) fn add_input(&mut self, written: &Adjustable) {
        self.add_signal(written, Sort::Input);
    }

    /// Adds a signal with its value at assembly, at rest; `None` if the name is not permitted.
    pub(super) fn add_signal(&mut self, written: &Adjustable, sort: Sort) -> Option<usize> {
        let Stated {
            value: (initial, dimension),
            range,
            ..
        } = self.stated(written, sort)?;
        let Constant { name, docs, .. } = &written.constant;
        let [value, rate, acceleration] =
            ["", "'", "''"].map(|dots| self.graph.symbol(&format!("{}{dots} input", name.text)));
        let variable = self.graph.variable(value);
        if let Some(duplicate) = self.declared.constants.declare(name, (variable, dimension)) {
            self.diagnostics.push(duplicate);
            return None;
        }
        self.declared
            .input_places
            .insert(value, self.declared.inputs.len());
        self.declared.inputs.push(Input {
            name: name.text.clone(),
            docs: docs.clone(),
            symbols: [value, rate, acceleration],
            initial,
            range,
            signal: [initial, self.graph.zero(), self.graph.zero()],
            dimension,
            used: false,
            span: name.span,
        });
        Some(self.declared.inputs.len() - 1)
    }

    /// Returns the number that a statement assigns, its range and its tolerance. A number with an error becomes one, so that the
    /// name is still declared; `None` if the name is not permitted.
    fn stated(&mut self, adjustable: &Adjustable, sort: Sort) -> Option<Stated> {
        let written = &adjustable.constant;
        let name = &written.name;
        if !self.may_be_declared(name) {
            return None;
        }
        self.tell_apart(name, sort);
        let one = Stated {
            value: (self.graph.one(), Dimension::Number),
            range: None,
            tolerance: None,
        };
        let Some((value, dimension)) = self.value(&written.value) else {
            return Some(one);
        };
        if self.graph.is_constant(value) {
            let (range, dimension) = self.limits(adjustable, (value, dimension));
            let (tolerance, dimension) = self.distribution(adjustable, (value, dimension), range);
            return Some(Stated {
                value: (value, dimension),
                range,
                tolerance,
            });
        }
        let noun = sort.noun();
        let (article, cause) = match sort {
            Sort::Parameter => ("a", self.moving(value)),
            Sort::Input => ("an", self.moving(value)),
            Sort::Free => ("a", self.moving(value)),
        };
        let what = match sort {
            Sort::Free => "start",
            Sort::Parameter | Sort::Input => "default",
        };
        let finding = match cause {
            Some(cause) => Diagnostic::error(
                Code::NotConstant,
                written.value.span,
                format!("the {what} of {article} {noun} cannot depend on {cause}"),
            )
            .label("changes with time")
            .help(match sort {
                Sort::Parameter => "declare a value that changes at run time as an `input`",
                Sort::Input => {
                    "write the value at assembly; the signal itself is supplied at run time"
                }
                Sort::Free => "write its value at t = 0; its motion follows from the forces",
            }),
            None => Diagnostic::error(
                Code::NotConstant,
                written.value.span,
                format!("the {what} of {article} {noun} cannot depend on a parameter"),
            )
            .label("expected a number")
            .help("declare a value that follows from parameters as a `const`"),
        };
        self.diagnostics.push(finding);
        Some(one)
    }

    /// Reports a name that collides with another one in printed or generated names.
    fn tell_apart(&mut self, name: &Name, sort: Sort) {
        let noun = sort.noun();
        if self.graph.find_symbol(&name.text).is_some() {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::NameNotAllowed,
                    name.span,
                    format!("`{}` is a coordinate of a body", name.text),
                )
                .label("formulas could not tell them apart")
                .help(format!("give the {noun} another name")),
            );
            return;
        }
        // Both become fields of the same inputs.
        let sort = match sort {
            Sort::Free => Sort::Input,
            Sort::Parameter | Sort::Input => sort,
        };
        let field = (sort, field_name(&name.text));
        let earlier = self
            .declared
            .fields
            .entry(field)
            .or_insert_with(|| name.clone());
        if earlier.text == name.text {
            return;
        }
        let (earlier, span) = (&earlier.text, earlier.span);
        let finding = Diagnostic::error(
            Code::NameNotAllowed,
            name.span,
            format!(
                "{noun}s `{earlier}` and `{}` differ only in case",
                name.text
            ),
        )
        .label(format!(
            "both would be `{}` in the generated code",
            field_name(&name.text)
        ))
        .also(span, "the other one")
        .help("give one of them another name");
        self.diagnostics.push(finding);
    }

    /// Returns the variable part of an expression for messages, `t` or an input; `None` if there is none.
    pub(super) fn moving(&self, value: ExprId) -> Option<String> {
        if self.graph.depends_on(value, self.formulas.time) {
            return Some("`t`".to_string());
        }
        let symbols = self.graph.symbols(value).iter();
        let places = symbols.filter_map(|symbol| self.declared.input_places.get(symbol));
        let input = &self.declared.inputs[*places.min()?];
        Some(format!("the input `{}`", input.name))
    }

    /// Notes the parameters and inputs in an expression.
    pub(super) fn mention(&mut self, value: ExprId) {
        let symbols = self.graph.symbols(value);
        let count = symbols.len();
        self.formulas.mentioned.extend(symbols.iter().copied());
        self.graph.spend(count / 4);
    }

    /// Marks the used parameters and inputs after all statements.
    pub(super) fn note_used(&mut self) {
        for parameter in &mut self.declared.parameters {
            parameter.used = self.formulas.mentioned.contains(&parameter.symbol);
        }
        for input in &mut self.declared.inputs {
            input.used = self.formulas.mentioned.contains(&input.symbols[0]);
        }
    }
}

/// Returns warnings of the parameters, inputs and tables that no motion uses.
pub(super) fn unused<'a>(mechanisms: impl Iterator<Item = &'a Mechanism>) -> Vec<Diagnostic> {
    let declared = |mechanism: &Mechanism| -> Vec<(&'static str, String, Span, bool)> {
        let parameters = mechanism
            .parameters
            .iter()
            .map(|own| (Sort::Parameter.noun(), own.name.clone(), own.span, own.used));
        let inputs = mechanism
            .inputs
            .iter()
            .map(|own| (Sort::Input.noun(), own.name.clone(), own.span, own.used));
        let tables = mechanism
            .tables
            .iter()
            .map(|own| ("table", own.name.clone(), own.span, own.used));
        parameters.chain(inputs).chain(tables).collect()
    };
    let mut candidates: Vec<(&'static str, String, Span, bool)> = Vec::new();
    let mut places: HashMap<Span, usize> = HashMap::new();
    for (noun, name, span, used) in mechanisms.flat_map(declared) {
        match places.get(&span) {
            Some(&earlier) => candidates[earlier].3 |= used,
            None => {
                places.insert(span, candidates.len());
                candidates.push((noun, name, span, used));
            }
        }
    }
    candidates
        .into_iter()
        .filter(|(.., used)| !used)
        .map(|(noun, name, span, _)| {
            let message = format!("the {noun} `{name}` is not used");
            Diagnostic::warning(Code::UnusedName, span, message)
                .help("use it in a statement below, or remove it")
        })
        .collect()
}

/// Returns the field of the generated structure: the name in lower case.
pub fn field_name(name: &str) -> String {
    name.to_lowercase()
}
