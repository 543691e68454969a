//! Resolves written expressions into exact expressions in SI units, with their dimension.
//!
//! An expression contains only constants, parameters, inputs and t, and no number in it is infinite or undefined. Every error
//! is reported at the smallest part that causes it.

use super::dimension::{Dimension, unit};
use super::resolve::Resolver;
use super::synonyms::meant_unit;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::{ExprId, Node, Number, Rational};
use crate::syntax::{BUILT_IN, Expression, ExpressionKind, Name, Operation, Reference, Sign};
use crate::units::UNITS;

/// A value with its dimension.
pub(super) type Value = (ExprId, Dimension);

impl Resolver<'_> {
    /// Resolves an expression that must be independent of t and of inputs, and must fit `expected`.
    pub(super) fn constant(&mut self, written: &Expression, expected: Dimension) -> Option<ExprId> {
        let value = self.quantity(written, expected)?;
        if let Some(cause) = self.moving(value) {
            let help = if self.graph.depends_on(value, self.formulas.time) {
                "only the right-hand side of a `drive` statement may depend on `t`"
            } else {
                "use an input only where `t` may stand; declare a constant value as a `param`"
            };
            self.diagnostics.push(
                Diagnostic::error(
                    Code::NotConstant,
                    written.span,
                    format!("expected a constant, but this depends on {cause}"),
                )
                .label("changes with time")
                .help(help),
            );
            return None;
        }
        Some(value)
    }

    /// Resolves an expression of t and inputs that must fit `expected`.
    pub(super) fn quantity(&mut self, written: &Expression, expected: Dimension) -> Option<ExprId> {
        let (value, _) = self.fitting(written, expected)?;
        Some(value)
    }

    /// Resolves an expression of t and inputs that must fit `expected`, with its own dimension.
    pub(super) fn fitting(&mut self, written: &Expression, expected: Dimension) -> Option<Value> {
        let (value, found) = self.value(written)?;
        if !found.fits(expected) {
            let finding = Diagnostic::error(
                Code::WrongDimension,
                written.span,
                format!("expected {}, found {}", expected.name(), found.name()),
            )
            .label(format!("this is {}", found.name()))
            .help(match expected {
                Dimension::LENGTH => "lengths end in `m`, `cm`, `mm`, … or in no unit for meters",
                Dimension::MASS => "masses end in `kg`, `g`, `t` or in no unit for kilograms",
                Dimension::FORCE => "forces end in `N`, `kN`, `mN`, … or in no unit for newtons",
                Dimension::TORQUE => {
                    "torques end in `Nm`, `kNm`, … or in no unit for newton meters"
                }
                Dimension::INERTIA => "a moment of inertia is a mass times the square of a length: `2kg*cm^2`, or a number in kg*m^2",
                Dimension::STIFFNESS => "a stiffness is a force over a length: `5N/mm`, or a number in N/m",
                Dimension::DAMPING => "a damping is a force over a speed: `5N*s/m`, or a number in N*s/m",
                Dimension::ANGULAR_DAMPING => "a damping about a joint is a torque times a time: `5Nm*s`, or a number in N*m*s",
                Dimension::RATIO => "write a number without a unit",
                Dimension::ANGLE_PER_LENGTH => "write an angle over a length, `2*pi/5mm`, or a number in rad/m",
                Dimension::ACCELERATION => "write numbers in m/s^2, or `9.81m/s^2`",
                _ => "angles end in `deg`, `rad`, `turn` or in no unit for radians",
            });
            let finding = self.with_declarations(finding, &[written]);
            self.diagnostics.push(finding);
            return None;
        }
        self.count_plain(value, found, expected);
        Some((value, found))
    }

    /// Counts the implied SI unit of a plain number; zero has no particular unit.
    fn count_plain(&mut self, value: ExprId, found: Dimension, expected: Dimension) {
        let is_plain = matches!(found, Dimension::Number | Dimension::OfTime);
        if is_plain && value != self.graph.zero() {
            self.formulas.written_units.count(&expected.unit());
        }
    }

    /// Resolves any expression.
    pub(super) fn value(&mut self, written: &Expression) -> Option<Value> {
        let value = match &written.kind {
            ExpressionKind::Number { digits, unit } => {
                self.number(digits, unit.as_ref(), written.span)?
            }
            ExpressionKind::Reference(reference) => self.named_value(reference)?,
            ExpressionKind::Component(component) => {
                self.component_of(&component.point, &component.axis, written.span)?
            }
            ExpressionKind::Sum(terms) => self.sum(terms)?,
            ExpressionKind::Product(factors) => self.product(factors)?,
            ExpressionKind::Negative(inner) => {
                let (inner, dimension) = self.value(inner)?;
                (self.graph.negate(inner), dimension)
            }
            ExpressionKind::Power(base, exponent) => self.raised(base, exponent)?,
            ExpressionKind::Call {
                function,
                arguments,
            } => self.call(function, arguments, written.span)?,
            ExpressionKind::Choice(choice) => self.choice(choice)?,
            ExpressionKind::Components(_) => {
                self.diagnostics.push(
                    Diagnostic::error(
                        Code::OutsideGrammar,
                        written.span,
                        "expected a scalar, found a coordinate tuple",
                    )
                    .label("expected one value")
                    .help("write each component in a formula of its own"),
                );
                return None;
            }
        };
        let value = self.finite(value, written)?;
        self.shallow(value, written)
    }

    fn number(&mut self, digits: &str, suffix: Option<&Name>, span: Span) -> Option<Value> {
        let Some(number) = Number::parse(digits) else {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::OutsideGrammar,
                    span,
                    format!("`{digits}` is not a decimal number"),
                )
                .help("write numbers like `12`, `0.05` or `1.5e-3`"),
            );
            return None;
        };
        let number = self.graph.number(number);
        let Some(suffix) = suffix else {
            return Some((number, Dimension::Number));
        };
        let (factor, dimension) = self.unit(suffix)?;
        self.formulas.written_units.count(&suffix.text);
        Some((self.graph.multiply(number, factor), dimension))
    }

    /// Returns factor and dimension of a unit; `None` after an error.
    pub(super) fn unit(&mut self, suffix: &Name) -> Option<Value> {
        let factor = unit(&suffix.text, &mut self.graph);
        if factor.is_none() {
            let help = match meant_unit(&suffix.text) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => format!("the units are {}", listed(UNITS)),
            };
            self.diagnostics.push(
                Diagnostic::error(
                    Code::UnknownUnit,
                    suffix.span,
                    format!("no unit is named `{}`", suffix.text),
                )
                .label("not a unit of this language")
                .help(help),
            );
        }
        factor
    }

    fn named_value(&mut self, reference: &Reference) -> Option<Value> {
        let name = &reference.name.text;
        if reference.body.is_none() {
            if let Some(parameter) = &self.formulas.parameter
                && parameter.name.text == *name
            {
                let value = (parameter.value, parameter.dimension);
                self.note_use(&reference.name, parameter.name.span);
                return Some(value);
            }
            match name.as_str() {
                "t" => return Some((self.graph.variable(self.formulas.time), Dimension::OfTime)),
                "pi" => return Some((self.graph.pi(), Dimension::Number)),
                _ => {}
            }
            if let Some((declaration, value)) = self.declared.constants.found(name) {
                self.note_use(&reference.name, declaration);
                self.mention(value.0);
                return Some(value);
            }
        }
        if self.formulas.kinematic.is_some() {
            return self.live_name(reference);
        }
        let carrier = self.linkage.carriers.first_carrier(name);
        let is_point = reference.body.is_some()
            || self.declared.drawn.get(name).is_some()
            || carrier.is_some();
        let no_number = |what: &str| {
            Diagnostic::error(
                Code::OutsideGrammar,
                reference.span,
                format!("a {what} is not a number"),
            )
            .label(format!("this is a {what}"))
        };
        self.diagnostics.push(if is_point {
            no_number("point").help(
                "measure points: `distance(A, B)` is the length between them in the design configuration",
            )
        } else if self.declared.table_names.get(name).is_some() {
            no_number("table").help(format!("write `{name}(x)` for its value at x"))
        } else if self.angle_named(name).is_some() {
            no_number("angle that moves").help("name it in an `equation`; it has no value in the design configuration")
        } else if self.declared.body_ids.get(name).is_some() {
            no_number("body").help("name a constant, or measure points of the design configuration: `distance(A, B)`")
        } else {
            self.declared.constants.unknown(name, reference.span)
        });
        None
    }

    fn sum(&mut self, terms: &[(Sign, Expression)]) -> Option<Value> {
        // Every term is resolved even after an error, so that all errors are reported at once.
        let values: Vec<Option<Value>> = terms.iter().map(|(_, term)| self.value(term)).collect();
        let mut signed = Vec::with_capacity(terms.len());
        let mut dimension = Dimension::Number;
        let mut marked: Option<&Expression> = None;
        for ((sign, term), value) in terms.iter().zip(values) {
            let (value, found) = value?;
            if !found.fits(dimension) {
                let mut diagnostic = Diagnostic::error(
                    Code::WrongDimension,
                    term.span,
                    format!("{} cannot be added to {}", found.name(), dimension.name()),
                )
                .label(format!("this is {}", found.name()))
                .help("give both the same kind of unit, or write bare numbers for SI units");
                if let Some(other) = marked {
                    let what = format!("this is {}", dimension.name());
                    diagnostic = diagnostic.also(other.span, what);
                    diagnostic = self.with_declarations(diagnostic, &[other]);
                }
                diagnostic = self.with_declarations(diagnostic, &[term]);
                self.diagnostics.push(diagnostic);
                return None;
            }
            if !dimension.is_marked() && found.is_marked() {
                marked = Some(term);
            }
            dimension = dimension.joined(found);
            signed.push(if *sign == Sign::Minus {
                self.graph.negate(value)
            } else {
                value
            });
        }
        Some((self.graph.sum(&signed), dimension))
    }

    fn product(&mut self, factors: &[(Operation, Expression)]) -> Option<Value> {
        let mut values = Vec::with_capacity(factors.len());
        let mut is_in_units = false;
        for (at, (_, factor)) in factors.iter().enumerate() {
            let before = at.checked_sub(1).map(|before| &factors[before].1);
            let unit = before.filter(|_| is_in_units).and_then(|before| {
                (before.span.end + 1 == factor.span.start).then(|| self.further_unit(factor))?
            });
            if let (Some(_), Some(before)) = (unit, before) {
                self.part_of_unit(before);
            }
            if values.len() > at {
                is_in_units = true;
                continue;
            }
            if let Some(value) = self.named_quotient(factors, at) {
                // The denominator belongs to the unit.
                values.extend([Some(value), Some((self.graph.one(), Dimension::Number))]);
                continue;
            }
            is_in_units = unit.is_some()
                || matches!(
                    &unsigned(factor).1.kind,
                    ExpressionKind::Number { unit: Some(_), .. }
                );
            values.push(match unit {
                None => self.value(factor),
                unit => unit,
            });
        }
        let mut parts = Vec::with_capacity(factors.len());
        let mut dimension: Option<Dimension> = None;
        for ((operation, _), value) in factors.iter().zip(values) {
            let (value, found) = value?;
            let sign = if *operation == Operation::Over { -1 } else { 1 };
            dimension = Some(match dimension {
                None => found,
                Some(so_far) => so_far.times(found, sign),
            });
            let one = self.graph.one();
            parts.push(if sign < 0 {
                self.graph.divide(one, value)
            } else {
                value
            });
        }
        Some((
            self.graph.product(&parts),
            dimension.unwrap_or(Dimension::Number),
        ))
    }

    /// Removes the count of a unit that is only the first factor of another one: the N of `220N/m`.
    fn part_of_unit(&mut self, number: &Expression) {
        if let ExpressionKind::Number {
            unit: Some(unit), ..
        } = &unsigned(number).1.kind
        {
            self.formulas.written_units.forget(&unit.text);
        }
    }

    /// Resolves `30U/min`: a number with a named quotient of units, written without blanks, whose numerator alone is not a
    /// unit.
    fn named_quotient(&mut self, factors: &[(Operation, Expression)], at: usize) -> Option<Value> {
        let [(_, first), (Operation::Over, second), ..] = &factors[at..] else {
            return None;
        };
        let (sign, number) = unsigned(first);
        let (
            ExpressionKind::Number {
                digits,
                unit: Some(numerator),
            },
            ExpressionKind::Reference(Reference {
                body: None, name, ..
            }),
        ) = (&number.kind, &second.kind)
        else {
            return None;
        };
        if first.span.end + 1 != second.span.start {
            return None;
        }
        let (factor, dimension) = unit(
            &format!("{}/{}", numerator.text, name.text),
            &mut self.graph,
        )?;
        let number = self.graph.number(Number::parse(digits)?);
        let value = self.graph.multiply(number, factor);
        let value = if sign < 0 {
            self.graph.negate(value)
        } else {
            value
        };
        Some((value, dimension))
    }

    /// Resolves `s^2` in `9.81m/s^2` and `m` in `220N/m`: a unit after a quantity and its `*` or `/` without a blank. A
    /// declared value of this name takes precedence.
    fn further_unit(&mut self, written: &Expression) -> Option<Value> {
        let (name, exponent) = match &written.kind {
            ExpressionKind::Power(base, exponent) => (base.as_ref(), Some(exponent.as_ref())),
            _ => (written, None),
        };
        let ExpressionKind::Reference(Reference {
            body: None, name, ..
        }) = &name.kind
        else {
            return None;
        };
        let parameter = self.formulas.parameter.as_ref();
        let is_declared = BUILT_IN.contains(&name.text.as_str())
            || parameter.is_some_and(|it| it.name.text == name.text)
            || self.declared.constants.get(&name.text).is_some();
        if is_declared || !UNITS.contains(&name.text.as_str()) {
            return None;
        }
        let (factor, dimension) = self.unit(name)?;
        let Some(exponent) = exponent else {
            return Some((factor, dimension));
        };
        let (sign, exponent) = unsigned(exponent);
        let ExpressionKind::Number { digits, unit: None } = &exponent.kind else {
            return None;
        };
        let power = sign * digits.parse::<i32>().ok()?;
        let raised = dimension.power(power.into(), 1)?;
        let power = Rational::integer(power.into());
        Some((self.graph.power(factor, power), raised))
    }

    fn raised(&mut self, base: &Expression, exponent: &Expression) -> Option<Value> {
        let (base_value, exponent_value) = (self.value(base), self.value(exponent));
        let ((base_value, dimension), (exponent_value, exponent_dimension)) =
            (base_value?, exponent_value?);
        if !exponent_dimension.fits(Dimension::Angle) {
            self.report_argument("an exponent cannot be", exponent, exponent_dimension);
            return None;
        }
        if let Node::Number(Number::Exact {
            rational,
            radicand: 1,
        }) = *self.graph.node(exponent_value)
        {
            let (numerator, denominator) = (rational.numerator(), rational.denominator());
            let Some(raised) = dimension.power(numerator, denominator) else {
                self.report_argument("this power cannot take", base, dimension);
                return None;
            };
            return Some((self.graph.power(base_value, rational), raised));
        }
        if !dimension.fits(Dimension::Angle) {
            self.report_argument("a power with this exponent cannot take", base, dimension);
            return None;
        }
        let raised = match dimension {
            Dimension::OfTime => Dimension::OfTime,
            _ => Dimension::Number,
        };
        Some((self.graph.raise(base_value, exponent_value), raised))
    }

    pub(super) fn report_argument(&mut self, of: &str, argument: &Expression, found: Dimension) {
        let finding = Diagnostic::error(
            Code::WrongDimension,
            argument.span,
            format!("{of} {}", found.name()),
        )
        .label(format!("this is {}", found.name()))
        .help("divide by a quantity of the same unit, or write bare numbers for SI units");
        let finding = self.with_declarations(finding, &[argument]);
        self.diagnostics.push(finding);
    }
}

/// Splits off the sign: returns 1 or −1, and the operand.
fn unsigned(written: &Expression) -> (i32, &Expression) {
    match &written.kind {
        ExpressionKind::Negative(inner) => (-1, inner),
        _ => (1, written),
    }
}

/// Returns `a`, `b`, `c` in backticks.
pub(super) fn listed(words: &[&str]) -> String {
    let quoted: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    quoted.join(", ")
}
