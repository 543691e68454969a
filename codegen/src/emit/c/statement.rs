//! Writes the statements of a function.

use super::isolation::Isolated;
use super::printer::{Printer, in_lane};
use super::tables::table_name;
use super::words::identifier;
use crate::emit::code::Code;
use crate::emit::module::documentation;
use crate::emit::module::scope::Scope;
use crate::expr::{ExprId, SymbolId};
use crate::model::field_name;
use crate::program::Statement;

/// Writer for the statements of Newton-Raphson, which need their block.
pub(super) type Iterated<'a> = &'a dyn Fn(&Statement, &mut Code);

impl Printer<'_> {
    /// Writes the statements of a function without Newton-Raphson.
    pub(super) fn plain_statements(&self, scope: &Scope<'_>, text: &mut Code) {
        self.statements(scope, 0, &|_, _| {}, text);
    }

    /// Writes the statements of a function of block number `block`.
    pub(super) fn statements(
        &self,
        scope: &Scope<'_>,
        block: usize,
        iterated: Iterated<'_>,
        text: &mut Code,
    ) {
        for statement in &scope.function.statements {
            self.statement(statement, scope, block, iterated, text);
        }
    }

    pub(super) fn statement(
        &self,
        statement: &Statement,
        scope: &Scope<'_>,
        block: usize,
        iterated: Iterated<'_>,
        text: &mut Code,
    ) {
        let write = |expr: &ExprId| self.expression(*expr, scope);
        match statement {
            Statement::Section(_)
            | Statement::Heading(_)
            | Statement::Note(_)
            | Statement::Shown { .. } => {
                if let Some(comment) = documentation::of_statement(statement, self.module) {
                    text.comment([comment]);
                }
            }
            Statement::Let { target, value, .. } => {
                let value = self.written(&scope.evaluation().assigned(*target, *value), scope);
                self.assign(*target, &value, scope, text);
            }
            Statement::SineCosine {
                sine,
                cosine,
                angle,
            } => {
                let angle = write(angle);
                let [sine, cosine] =
                    [sine, cosine].map(|symbol| self.declare(*symbol, scope, text));
                let arguments = format!("({angle}, &{sine}, &{cosine})");
                text.line(match scope.is_in_lanes() {
                    true => format!("rare |= {}{arguments};", self.lane("sin_cos")),
                    false => format!("{}{arguments};", self.runtime("sin_cos")),
                });
            }
            Statement::Lookup {
                targets,
                spline,
                argument,
            } => {
                // Each lookup has its own array, since a function may have several.
                let first = targets.iter().copied().flatten().next();
                let first = first.map_or(String::new(), |it| self.symbol(it, scope));
                let values = format!("{}_found", last_name(&first));
                let (call, table) = (self.runtime("table_at"), table_name(self, *spline));
                text.line(format!("{} {values}[4];", self.real()));
                text.line(format!("{call}({table}(), {}, {values});", write(argument)));
                for (order, target) in targets.iter().enumerate() {
                    if let Some(target) = target {
                        self.assign(*target, &format!("{values}[{order}]"), scope, text);
                    }
                }
            }
            Statement::Angle {
                target,
                sine,
                cosine,
            } => {
                let (sine, cosine) = (write(sine), write(cosine));
                let [at, near] = ["at", "last"].map(|frame| self.field(*target, frame));
                text.line(match scope.is_in_lanes() {
                    true => format!(
                        "rare |= {}({sine}, {cosine}, {}, &{});",
                        self.lane("angle_near"),
                        in_lane(&near),
                        in_lane(&at)
                    ),
                    false => {
                        let call = self.runtime("angle_near");
                        format!("{at} = {call}({sine}, {cosine}, {near});")
                    }
                });
            }
            Statement::Positive { length, joint } => {
                let (place, length) = (self.module.requirement_place(*joint), write(length));
                let (zero, failed) = (self.number(0.0), self.runtime("not_positive"));
                if scope.is_in_lanes() {
                    text.line(format!("failed |= ({length} > {zero}) ? 0U : 1U;"));
                    return;
                }
                text.open(format!("if ({length} <= {zero}) {{"));
                text.line(format!("return {failed}({length}, conditions, {place}U);"));
                text.close("}");
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
                let out_of_reach = self.runtime("fail_out_of_reach");
                let failure = format!(
                    "{out_of_reach}({distance}, {longest}, {shortest}, conditions, {block}U)"
                );
                self.exceeds_or_fails(&format!("{excess}, {scale}"), &failure, scope, text);
            }
            Statement::Nonzero { value, scale } => {
                let [factor, unit] = [value, scale].map(|it| {
                    let arithmetic = scope.evaluation().value(*it);
                    self.operand(&arithmetic, scope)
                });
                let (value, scale) = (write(value), write(scale));
                let failed = self.runtime("singular_divisor");
                let failure = format!("{failed}({value}, {scale}, conditions, {block}U)");
                let squares = format!("{factor} * {factor}, {unit} * {unit}");
                self.exceeds_or_fails(&squares, &failure, scope, text);
            }
            Statement::Newton { .. } | Statement::Factorize | Statement::Solve { .. } => {
                iterated(statement, text);
            }
            Statement::Multipliers {
                targets,
                jacobian,
                forces,
            } => {
                let order = forces.len();
                let jacobian = jacobian.iter().map(write).collect::<Vec<_>>().join(", ");
                let forces = forces.iter().map(write).collect::<Vec<_>>().join(", ");
                self.multipliers(targets, [&jacobian, &forces], (order, block), scope, text);
            }
            Statement::Friction {
                pins,
                targets,
                coefficients,
                alone,
                units,
            } => {
                let list = |values: Vec<&ExprId>| {
                    let values = values.into_iter().map(write);
                    values.collect::<Vec<_>>().join(", ")
                };
                let values = [
                    list(coefficients.iter().collect()),
                    list(alone.iter().flatten().collect()),
                    list(units.iter().flatten().collect()),
                ];
                self.friction(targets, &values, (*pins, block), scope, text);
            }
            Statement::Signal { input, found } => self.signal(*input, found, scope, text),
            Statement::Require { value, block } => {
                let number = self.module.block_number(*block);
                text.open(format!(
                    "if (!({} >= {})) {{",
                    write(value),
                    self.number(0.0)
                ));
                text.line(format!("*block = {number}U;"));
                text.line("return false;");
                text.close("}");
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
                let vector = |values: &[ExprId]| values.iter().map(write).collect();
                let matrix = |entries: &[([usize; 2], ExprId)]| {
                    let entries = entries.iter();
                    entries
                        .map(|(place, entry)| (*place, write(entry)))
                        .collect()
                };
                let isolated = Isolated {
                    is_chain: *is_chain,
                    blocks,
                    found,
                    vectors: [
                        ("bounds", vector(bounds)),
                        ("curvatures", vector(curvatures)),
                        ("changes", vector(changes)),
                        ("sizes", vector(sizes)),
                    ],
                    turns,
                    matrices: [("jacobian", matrix(jacobian)), ("turning", matrix(turning))],
                    varied,
                    variation,
                };
                self.isolation(&isolated, scope, text);
            }
        }
    }

    /// Writes the check that a value exceeds the rounding of its scale, with the failure otherwise; in lanes, those that fail are collected.
    fn exceeds_or_fails(&self, both: &str, failure: &str, scope: &Scope<'_>, text: &mut Code) {
        if scope.is_in_lanes() {
            let call = self.lane("is_rounding");
            text.line(format!("failed |= {call}({both});"));
            return;
        }
        let exceeds = self.runtime("exceeds_rounding");
        text.open(format!("if (!{exceeds}({both})) {{"));
        text.line(match scope.is_inside() {
            true => "return false;".to_string(),
            false => format!("return {failure};"),
        });
        text.close("}");
    }

    /// Writes `const double name = value;`, or an assignment to a field or to an array of all lanes.
    pub(super) fn assign(&self, target: SymbolId, value: &str, scope: &Scope<'_>, text: &mut Code) {
        let name = self.symbol(target, scope);
        match scope.is_field(target) || scope.is_shared(target) {
            true => text.line(format!("{name} = {value};")),
            false => text.line(format!("const {} {name} = {value};", self.real())),
        }
    }

    /// Returns the place that the runtime writes a value to; declares it if it is a local value.
    fn declare(&self, target: SymbolId, scope: &Scope<'_>, text: &mut Code) -> String {
        let name = self.symbol(target, scope);
        if !(scope.is_field(target) || scope.is_shared(target)) {
            text.line(format!("{} {name};", self.real()));
        }
        name
    }

    /// Writes the call that finds the multipliers of a subsystem. Each has its own arrays, since a function may have several.
    fn multipliers(
        &self,
        targets: &[Option<SymbolId>],
        [jacobian, forces]: [&str; 2],
        (order, block): (usize, usize),
        scope: &Scope<'_>,
        text: &mut Code,
    ) {
        let first = targets.iter().copied().flatten().next();
        let first = first.map_or(String::new(), |it| self.symbol(it, scope));
        let name = last_name(&first);
        let (real, call) = (self.real(), self.runtime("multipliers"));
        let (square, room) = (order * order, order * order + 3 * order);
        text.line(format!(
            "const {real} {name}_jacobian[{square}] = {{{jacobian}}};"
        ));
        text.line(format!("{real} {name}_found[{order}] = {{{forces}}};"));
        text.line(format!("{real} {name}_reals[{room}];"));
        text.line(format!("uint16_t {name}_exchanges[{order}];"));
        text.line(format!(
            "const linkwright_status {name}_status = {call}({order}U, {name}_jacobian, {name}_found, {name}_reals, {name}_exchanges, conditions, {block}U);"
        ));
        self.unless_ok(&format!("{name}_status"), scope, text);
        for (place, target) in targets.iter().enumerate() {
            if let Some(target) = target {
                self.assign(*target, &format!("{name}_found[{place}]"), scope, text);
            }
        }
    }

    /// Writes the call that finds the forces of friction. Each has its own arrays, since a function may have several.
    fn friction(
        &self,
        targets: &[Option<SymbolId>],
        values: &[String; 3],
        (pins, block): (usize, usize),
        scope: &Scope<'_>,
        text: &mut Code,
    ) {
        let first = targets.iter().copied().flatten().next();
        let first = first.map_or(String::new(), |it| self.symbol(it, scope));
        let name = last_name(&first);
        let (real, call) = (self.real(), self.runtime("friction"));
        let joints = self.runtime("friction_joints");
        let order = targets.len();
        let room = 2 * order * order + 5 * order;
        let parts = ["coefficients", "alone", "units"];
        let lengths = [order, 2 * order, 2 * order * order];
        for ((part, length), values) in parts.into_iter().zip(lengths).zip(values) {
            text.line(format!(
                "const {real} {name}_{part}[{length}] = {{{values}}};"
            ));
        }
        text.line(format!(
            "const {joints} {name}_joints = {{{order}U, {pins}U, {name}_coefficients, {name}_alone, {name}_units}};"
        ));
        text.line(format!("{real} {name}_found[{order}];"));
        text.line(format!("{real} {name}_reals[{room}];"));
        text.line(format!("uint16_t {name}_exchanges[{order}];"));
        text.line(format!(
            "const linkwright_status {name}_status = {call}(&{name}_joints, {name}_found, {name}_reals, {name}_exchanges, conditions, {block}U);"
        ));
        self.unless_ok(&format!("{name}_status"), scope, text);
        for (place, target) in targets.iter().enumerate() {
            if let Some(target) = target {
                self.assign(*target, &format!("{name}_found[{place}]"), scope, text);
            }
        }
    }

    /// Returns a status that is not OK; in lanes, those that fail are collected.
    fn unless_ok(&self, status: &str, scope: &Scope<'_>, text: &mut Code) {
        let fails = format!("({status} != LINKWRIGHT_OK)");
        if scope.is_in_lanes() {
            text.line(format!("failed |= {fails} ? 1U : 0U;"));
        } else {
            text.open(format!("if {fails} {{"));
            text.line(format!("return {status};"));
            text.close("}");
        }
    }

    /// Writes the bounds on the change of an input in the window and on its deviation from the chord.
    fn signal(&self, input: usize, found: &[SymbolId; 2], scope: &Scope<'_>, text: &mut Code) {
        let name = &self.module.system.mechanism.inputs[input].name;
        let field = identifier(&field_name(name));
        let [values, call] = [format!("{field}_found"), self.runtime("window_signal")];
        text.line(format!("{} {values}[2];", self.real()));
        text.line(format!(
            "{call}(window, &before->{field}, &inputs->{field}, {values});"
        ));
        for (place, symbol) in found.iter().enumerate() {
            if scope.is_wanted(*symbol) {
                self.assign(*symbol, &format!("{values}[{place}]"), scope, text);
            }
        }
    }
}

/// Returns the name of the field or local value that an access ends with.
fn last_name(access: &str) -> &str {
    let name = access.rsplit(['>', '.']).next().unwrap_or_default();
    name.split('[').next().unwrap_or_default()
}
