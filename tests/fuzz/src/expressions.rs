//! Drives a crank by a formula of t and compares its value and rate, or accepts its refusal.
//!
//! The formula is evaluated a second time in dual numbers, each with a running bound of its error.

use arbitrary::{Result, Unstructured};
use linkwright::Equations;
use linkwright_codegen::diagnostic::Source;
use linkwright_solver::textbook::TextbookEquations;
use nalgebra::DVector;

use super::outcome::with_codes;

use linkwright::nalgebra;

/// Time of the evaluation (s).
const TIME: f64 = 0.375;

/// Bound of one rounding, with a margin for several roundings of the library.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Additional error, relative to a value: the library evaluates other formulas than this file, such as x/sqrt(1 +
/// x^2) for sin(atan(x)).
const LOST: f64 = 1e-9;

/// Magnitude below which squares are subnormal or nearly so.
const SQUARE_LIMIT: f64 = 1e-140;

/// Value and its rate, with bounds on their errors.
#[derive(Clone, Copy, Debug)]
struct Dual {
    value: f64,
    rate: f64,
    value_error: f64,
    rate_error: f64,
}

impl Dual {
    fn new(value: f64, rate: f64) -> Dual {
        Dual {
            value,
            rate,
            value_error: ROUNDING * value.abs(),
            rate_error: ROUNDING * rate.abs(),
        }
    }

    fn sum(self, other: Dual, sign: f64) -> Dual {
        let value = self.value + sign * other.value;
        let rate = self.rate + sign * other.rate;
        Dual {
            value,
            rate,
            value_error: self.value_error
                + other.value_error
                + ROUNDING * (self.value.abs() + other.value.abs()),
            rate_error: self.rate_error
                + other.rate_error
                + ROUNDING * (self.rate.abs() + other.rate.abs()),
        }
    }

    fn product(self, other: Dual) -> Dual {
        let value = self.value * other.value;
        let rate = self.rate * other.value + self.value * other.rate;
        let cross = |a: f64, ea: f64, b: f64, eb: f64| a.abs() * eb + b.abs() * ea + ea * eb;
        Dual {
            value,
            rate,
            value_error: cross(self.value, self.value_error, other.value, other.value_error)
                + ROUNDING * value.abs(),
            rate_error: cross(self.rate, self.rate_error, other.value, other.value_error)
                + cross(self.value, self.value_error, other.rate, other.rate_error)
                + ROUNDING * ((self.rate * other.value).abs() + (self.value * other.rate).abs()),
        }
    }

    /// A function with this value and these first two derivatives at the value.
    fn map(self, value: f64, slope: f64, bend: f64) -> Dual {
        let rate = slope * self.rate;
        Dual {
            value,
            rate,
            value_error: slope.abs() * self.value_error + ROUNDING * value.abs(),
            rate_error: slope.abs() * self.rate_error
                + bend.abs() * (self.rate.abs() + self.rate_error) * self.value_error
                + ROUNDING * rate.abs(),
        }
    }

    /// True if bounds are small enough for the first order in them, and no number is so small that its square loses digits.
    fn is_sure(self) -> bool {
        let small = |value: f64, error: f64| error <= 1e-6 * value.abs().max(1e-3);
        let keeps_digits = |value: f64| value == 0.0 || value.abs() > SQUARE_LIMIT;
        small(self.value, self.value_error)
            && small(self.rate, self.rate_error)
            && keeps_digits(self.value)
            && keeps_digits(self.rate)
            && self.value.abs() < 1e12
            && self.rate.abs() < 1e12
    }
}

/// Formula as text, and its value; `None` if its bounds are too wide.
struct Formula {
    text: String,
    dual: Option<Dual>,
}

fn number(input: &mut Unstructured<'_>) -> Result<Formula> {
    let digits = input.int_in_range(0..=99_999_u32)?;
    let exponent = match input.int_in_range(0..=7)? {
        0 => input.int_in_range(-330..=320)?,
        1..=3 => input.int_in_range(-6..=3)?,
        _ => -3,
    };
    let text = format!("{digits}e{exponent}");
    let value: f64 = text.parse().expect("a decimal number");
    let is_normal = value == 0.0 || value.is_normal();
    Ok(Formula {
        dual: is_normal.then(|| Dual::new(value, 0.0)),
        text,
    })
}

fn formula(input: &mut Unstructured<'_>, depth: usize) -> Result<Formula> {
    let kinds = if depth == 0 { 3 } else { 13 };
    let kind = input.int_in_range(0..=kinds - 1)?;
    let mut part = || formula(input, depth.saturating_sub(1));
    let binary = |one: &Formula, other: &Formula, f: fn(Dual, Dual) -> Dual| {
        one.dual.zip(other.dual).map(|(a, b)| f(a, b))
    };
    Ok(match kind {
        0 => number(input)?,
        1 => Formula {
            text: "t".to_string(),
            dual: Some(Dual {
                value_error: 0.0,
                rate_error: 0.0,
                ..Dual::new(TIME, 1.0)
            }),
        },
        2 => Formula {
            text: "pi".to_string(),
            dual: Some(Dual::new(std::f64::consts::PI, 0.0)),
        },
        3 | 4 => {
            let (one, other) = (part()?, part()?);
            let sign = if kind == 3 { '+' } else { '-' };
            Formula {
                text: format!("({} {sign} {})", one.text, other.text),
                dual: if kind == 3 {
                    binary(&one, &other, |a, b| a.sum(b, 1.0))
                } else {
                    binary(&one, &other, |a, b| a.sum(b, -1.0))
                },
            }
        }
        5 => {
            let (one, other) = (part()?, part()?);
            Formula {
                text: format!("({}*{})", one.text, other.text),
                dual: binary(&one, &other, Dual::product),
            }
        }
        6 => {
            let (one, other) = (part()?, part()?);
            Formula {
                text: format!("({}/{})", one.text, other.text),
                dual: binary(&one, &other, |a, b| {
                    let x = b.value;
                    a.product(b.map(1.0 / x, -1.0 / (x * x), 2.0 / (x * x * x)))
                }),
            }
        }
        _ => {
            let inner = part()?;
            let of = |name: &str, f: fn(f64) -> [f64; 3]| Formula {
                text: format!("{name}({})", inner.text),
                dual: inner.dual.map(|x| {
                    let [value, slope, bend] = f(x.value);
                    x.map(value, slope, bend)
                }),
            };
            match kind {
                7 => of("sin", |x| [x.sin(), x.cos(), -x.sin()]),
                8 => of("cos", |x| [x.cos(), -x.sin(), -x.cos()]),
                9 => of("exp", |x| [x.exp(), x.exp(), x.exp()]),
                10 => of("ln", |x| [x.ln(), 1.0 / x, -1.0 / (x * x)]),
                11 => of("sqrt", |x| {
                    let root = x.sqrt();
                    [root, 0.5 / root, -0.25 / (x * root)]
                }),
                _ => of("atan", |x| {
                    let square = 1.0 + x * x;
                    [x.atan(), 1.0 / square, -2.0 * x / (square * square)]
                }),
            }
        }
    })
    .map(|formula| Formula {
        dual: formula.dual.filter(|dual| dual.is_sure()),
        ..formula
    })
}

/// Drives a crank by the formula, and compares value and rate; returns codes, or the functions of the formula.
///
/// # Panics
/// If the library does, or if a value is wrong.
pub fn run(bytes: &[u8]) -> String {
    let answer = attempt(&mut Unstructured::new(bytes));
    answer.unwrap_or_else(|it| it.to_string())
}

fn attempt(input: &mut Unstructured<'_>) -> Result<String> {
    let formula = formula(input, 5)?;
    let text = format!(
        "mechanism fuzzed {{
    body 1 at (0, 0);
    absolute_x(1) = 0;
    absolute_y(1) = 0;
    drive phi(1) = {};
}}",
        formula.text
    );
    let source = Source::new("fuzzed.mech", text);
    let derived = match linkwright_codegen::read(&source) {
        Ok(read) => read.only().expect("one motion"),
        Err(findings) => {
            assert!(!findings.render(&source).is_empty());
            return Ok(with_codes("refused", &findings));
        }
    };
    let equations = TextbookEquations::new(&derived.pool, &derived.system);
    let q = DVector::zeros(3);
    let (mut phi, mut rates) = (DVector::zeros(3), DVector::zeros(3));
    equations.residual(&q, TIME, &mut phi);
    equations.time_derivative(&q, TIME, &mut rates);
    let Some(dual) = formula.dual else {
        return Ok("not sure".to_string());
    };
    let off = (-phi[2] - dual.value).abs();
    let within = off <= dual.value_error + LOST * dual.value.abs();
    assert!(within, "value {} and {dual:?}\n{}", -phi[2], source.text);
    let off = (-rates[2] - dual.rate).abs();
    let within = off <= dual.rate_error + LOST * dual.rate.abs();
    assert!(within, "rate {} and {dual:?}\n{}", -rates[2], source.text);
    let functions = ["sin", "cos", "exp", "ln", "sqrt", "atan", "/"];
    let names = functions.into_iter();
    let names: Vec<&str> = names.filter(|it| formula.text.contains(it)).collect();
    Ok(format!("compared {}", names.join(" ")))
}
