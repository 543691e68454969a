//! Prints the statements of functions.

use std::collections::HashSet;

use super::code::array;
use super::names::identifier;
use crate::emit::code::Code;
use crate::emit::module::documentation;
use crate::emit::module::scope::Scope;
use crate::expr::{ExprId, SymbolId};
use crate::model::field_name;
use crate::program::{Arithmetic, Function, Statement};

/// Writer of the statements of a block that concern its Newton-Raphson.
pub(super) type Iterated<'a> = &'a dyn Fn(&Statement, &mut Code);

impl Scope<'_> {
    /// Returns the statements of the function; `iterated` writes those of Newton-Raphson.
    pub(super) fn statements(&self, block: usize, iterated: Iterated<'_>) -> Code {
        let mut code = Code::default();
        let joined = self.joined_angles();
        let is_joined = |place: usize| joined.values().flatten().any(|&it| it == place);
        for (place, statement) in self.function.statements.iter().enumerate() {
            match joined.get(&place) {
                Some(places) => self.two_angles(places, &mut code),
                None if is_joined(place) => {}
                None => self.statement(statement, block, iterated, &mut code),
            }
        }
        code
    }

    /// Returns the statements of a function without Newton-Raphson.
    pub(super) fn plain_statements(&self) -> Code {
        self.statements(0, &|_, _| {})
    }

    fn statement(
        &self,
        statement: &Statement,
        block: usize,
        iterated: Iterated<'_>,
        code: &mut Code,
    ) {
        let write = |expr: &ExprId| self.value(*expr);
        match statement {
            Statement::Section(_)
            | Statement::Heading(_)
            | Statement::Note(_)
            | Statement::Shown { .. } => {
                if let Some(comment) = documentation::of_statement(statement, self.module) {
                    code.remark(&comment);
                }
            }
            Statement::Let { target, value, .. } => {
                let value = self.whole(&self.evaluation().assigned(*target, *value));
                self.assign(*target, &value, code);
            }
            Statement::SineCosine {
                sine,
                cosine,
                angle,
            } => {
                let [sine, cosine] = [sine, cosine].map(|symbol| match self.is_unnamed(*symbol) {
                    true => "_".to_string(),
                    false => self.read(*symbol),
                });
                let angle = write(angle);
                code.line(format!("let ({sine}, {cosine}) = math::sin_cos({angle});"));
            }
            Statement::Angle {
                target,
                sine,
                cosine,
            } => {
                let (sine, cosine) = (write(sine), write(cosine));
                let [at, near] = ["at", "last"].map(|frame| self.module.field(*target, frame));
                code.line(format!("{at} = angle_near({sine}, {cosine}, {near});"));
            }
            Statement::Require { value, .. } if self.is_in_lanes() => {
                code.line(format!("failed |= negative({});", write(value)));
            }
            Statement::Require { value, block } => {
                let number = self.module.block_number(*block);
                code.line(format!("required({}, {number})?;", write(value)));
            }
            Statement::Positive { length, joint } => {
                let (place, length) = (self.module.requirement_place(*joint), write(length));
                if self.is_in_lanes() {
                    code.line(format!("failed |= not_positive({length});"));
                    return;
                }
                code.open(format!("if {length} <= 0.0 {{"));
                code.line(format!("return Err(not_positive({length}, t, {place}));"));
                code.close("}");
            }
            Statement::Reach {
                excess,
                scale,
                distance,
                longest,
                shortest,
            } => {
                let [excess, scale, distance, longest, shortest] =
                    [excess, scale, distance, longest, shortest].map(write);
                self.unless(
                    &format!("exceeds_rounding({excess}, {scale})"),
                    &format!("out_of_reach({distance}, {longest}, {shortest}, t, {block})"),
                    code,
                );
            }
            Statement::Nonzero { value, scale } => {
                let [value, scale] = [value, scale].map(|expr| self.evaluation().value(*expr));
                let square = |of: &Arithmetic| {
                    let factor = match self.is_in_lanes() && !of.varies() {
                        true => self.whole(of),
                        false => self.operand(of),
                    };
                    format!("{factor} * {factor}")
                };
                self.unless(
                    &format!("exceeds_rounding({}, {})", square(&value), square(&scale)),
                    &format!(
                        "singular_divisor({}, {}, t, {block})",
                        self.written(&value),
                        self.written(&scale)
                    ),
                    code,
                );
            }
            Statement::Lookup {
                targets,
                spline,
                argument,
            } => {
                let last = targets.iter().rposition(Option::is_some).unwrap_or(0);
                let names = targets[..=last].iter().map(|target| match target {
                    Some(target) => self.read(*target),
                    None => "_".to_string(),
                });
                let mut names: Vec<String> = names.collect();
                if last < 3 {
                    names.push("..".to_string());
                }
                let lookup = self.lookup(*spline, &self.evaluation().value(*argument));
                code.line(format!("let [{}] = {lookup};", names.join(", ")));
            }
            Statement::Newton { .. } | Statement::Factorize => iterated(statement, code),
            Statement::Signal { input, found } => {
                let input = &self.module.system.mechanism.inputs[*input].name;
                let field = identifier(&field_name(input));
                let [radius, deviation] = found.map(|symbol| self.found(symbol));
                code.line(format!(
                    "let [{radius}, {deviation}] = window.signal(&before.{field}, &inputs.{field});"
                ));
            }
            Statement::Isolate {
                is_chain,
                blocks,
                found,
                bounds,
                curvatures,
                changes,
                sizes,
                jacobian,
                turns,
                turning,
                varied,
                variation,
            } => {
                let blocks: Vec<String> = blocks
                    .iter()
                    .map(|&it| self.module.block_number(it).to_string())
                    .collect();
                let vector = |values: &[ExprId]| {
                    let values: Vec<String> = values.iter().map(write).collect();
                    format!("Vector::from({})", array(&values))
                };
                for (matrix, entries) in [("jacobian", jacobian), ("turning", turning)] {
                    self.matrix(matrix, entries, code);
                }
                let found_values: Vec<String> =
                    found.iter().map(|symbol| self.found(*symbol)).collect();
                let taken = match found_values.iter().all(|name| name == "_") {
                    true => String::new(),
                    false => format!("let [{}] = ", found_values.join(", ")),
                };
                let function = if *is_chain {
                    "isolate_chain"
                } else {
                    "isolate"
                };
                code.open(format!("{taken}{function}("));
                code.line(format!("[{}],", blocks.join(", ")));
                if *is_chain {
                    code.line("window,");
                }
                code.open("Chord {");
                code.line("remainder: window.remainder,");
                code.line(format!("bounds: {},", vector(bounds)));
                code.line(format!("curvatures: {},", vector(curvatures)));
                code.line(format!("changes: {},", vector(changes)));
                code.line(format!("sizes: {},", vector(sizes)));
                code.line("jacobian: &mut jacobian,");
                let turns: Vec<String> = turns.iter().map(bool::to_string).collect();
                code.line(format!("turns: {}.into(),", array(&turns)));
                code.line(match turning[..] {
                    [] => "turning: &mut Matrix::zeros(),",
                    _ => "turning: &mut turning,",
                });
                code.close("},");
                if !is_chain {
                    self.variation(found, varied, variation, code);
                }
                code.close(")?;");
            }
            Statement::Multipliers {
                targets,
                jacobian,
                forces,
            } => {
                let rows = jacobian.chunks(forces.len());
                let rows: Vec<String> = rows.map(|row| format!("[{}]", self.values(row))).collect();
                let (rows, forces) = (rows.join(", "), self.values(forces));
                if self.is_in_lanes() {
                    code.line(format!(
                        "let (balance, singular) = multipliers([{rows}], [{forces}]);"
                    ));
                    code.line("failed |= singular;");
                } else {
                    code.line(format!(
                        "let balance = multipliers([{rows}], [{forces}], t, {block})?;"
                    ));
                }
                self.distribute(targets, "balance", code);
            }
            Statement::Friction {
                pins,
                targets,
                coefficients,
                alone,
                units,
            } => {
                let pairs = |pairs: &[[ExprId; 2]]| {
                    let pairs = pairs.iter().map(|it| format!("[{}]", self.values(it)));
                    pairs.collect::<Vec<_>>().join(", ")
                };
                let rows = units.chunks(coefficients.len());
                let rows: Vec<String> = rows.map(|row| format!("[{}]", pairs(row))).collect();
                let (rows, alone) = (rows.join(", "), pairs(alone));
                let coefficients = self.values(coefficients);
                let arguments = format!("{pins}, [{coefficients}], [{alone}], [{rows}]");
                if self.is_in_lanes() {
                    code.line(format!(
                        "let (resisting, unsettled) = friction({arguments});"
                    ));
                    code.line("failed |= unsettled;");
                } else {
                    code.line(format!(
                        "let resisting = friction({arguments}, t, {block})?;"
                    ));
                }
                self.distribute(targets, "resisting", code);
            }
            Statement::Solve {
                targets,
                right_hand_side,
            } => {
                code.line(format!(
                    "let mut response = Vector::from([{}]);",
                    self.values(right_hand_side)
                ));
                code.line("factorization.solve(&mut response);");
                self.distribute(targets, "response", code);
            }
        }
    }

    /// Writes the return of a failure if a condition is false; in lanes, those that fail are collected.
    fn unless(&self, condition: &str, failure: &str, code: &mut Code) {
        if self.is_in_lanes() {
            code.line(format!("failed |= !{condition};"));
            return;
        }
        code.open(format!("if !{condition} {{"));
        code.line(match self.is_inside() {
            true => "return None;".to_string(),
            false => format!("return Err({failure});"),
        });
        code.close("}");
    }

    /// Assigns the elements of a vector to targets.
    fn distribute(&self, targets: &[Option<SymbolId>], vector: &str, code: &mut Code) {
        for (place, target) in targets.iter().enumerate() {
            if let Some(target) = target {
                self.assign(*target, &format!("{vector}[{place}]"), code);
            }
        }
    }

    /// Writes a matrix with these entries, and zeros elsewhere; nothing without entries.
    fn matrix(&self, name: &str, entries: &[([usize; 2], ExprId)], code: &mut Code) {
        if !entries.is_empty() {
            code.line(format!("let mut {name} = Matrix::zeros();"));
        }
        for ([row, column], entry) in entries {
            code.line(format!(
                "{name}[({row}, {column})] = {};",
                self.value(*entry)
            ));
        }
    }

    /// Writes the closure that bounds the variation of the Jacobian for deviations of the unknowns from the chord.
    fn variation(
        &self,
        found: &[SymbolId],
        varied: &[[usize; 2]],
        variation: &Function,
        code: &mut Code,
    ) {
        // Linear entries do not vary, and those that rotate have their own bound.
        if varied.is_empty() {
            code.line("|_, _| {},");
            return;
        }
        let graph = &self.module.pool.graph;
        let read: HashSet<SymbolId> = variation
            .values()
            .flat_map(|expr| graph.symbols(expr))
            .copied()
            .collect();
        let arguments = found.iter().map(|symbol| match read.contains(symbol) {
            true => self.read(*symbol),
            false => "_".to_string(),
        });
        let arguments: Vec<String> = arguments.collect();
        code.open("|deviations, variation| {");
        code.line(format!("let &[{}] = deviations;", arguments.join(", ")));
        let inner = self.inner(variation);
        code.append(inner.plain_statements());
        for ([row, column], value) in varied.iter().zip(inner.results()) {
            code.line(format!("variation[({row}, {column})] = {value};"));
        }
        code.close("},");
    }

    /// Returns the name of a bound of the path; `_` if nothing reads the bound.
    fn found(&self, symbol: SymbolId) -> String {
        match self.is_wanted(symbol) {
            true => self.read(symbol),
            false => "_".to_string(),
        }
    }

    /// Writes `let name = value;`, or an assignment to a field.
    fn assign(&self, target: SymbolId, value: &str, code: &mut Code) {
        let name = self.read(target);
        code.line(match self.is_field(target) {
            true => format!("{name} = {value};"),
            false => format!("let {name} = {value};"),
        });
    }
}
