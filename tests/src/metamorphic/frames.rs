//! Motion of a mechanism in both formulations, with a bound on the rounding of each value.

use std::cell::LazyCell;
use std::rc::Rc;

use linkwright::{Blocks, Failure, Frame, Settings};
use linkwright_codegen::stages::program::Kept;
use linkwright_codegen::stages::solved::Solved;
use linkwright_codegen::stages::structure::Shift;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::Interpreted;
use linkwright_solver::textbook::TextbookEquations;
use nalgebra::Dyn;

use crate::stability::sample::named;
use crate::stability::truth::{Given, Levels, Truth};
use crate::stability::verdict::Scalar;
use crate::values::{assembled_from, levels};

/// Times (s); the mechanism is assembled at the first and moved to the others.
pub const TIMES: [f64; 4] = [0.0, 0.01, 0.02, 0.03];

/// Name of the formulation that is assembled with least squares first.
pub const FROM_AFAR: &str = "textbook from afar";

/// Values of q, q̇ and q̈ with the bounds of their errors.
pub struct Instant {
    /// The values.
    pub values: Levels<f64>,
    bounds: LazyCell<Levels<f64>, Box<dyn FnOnce() -> Levels<f64>>>,
}

impl Instant {
    /// Bounds on the errors of the values. They take longer than the motion, and are computed on request.
    pub fn bounds(&self) -> &Levels<f64> {
        &self.bounds
    }
}

/// Motion of a formulation: an instant for each time, up to the first failure.
pub type Moved = Vec<Result<Instant, String>>;

/// Motion in each formulation, with its name.
pub fn motions(derived: &Derived) -> Vec<(&'static str, Moved)> {
    let judge = Rc::new(Judge {
        truth: Truth::new(derived),
        given: given(derived),
        length: derived.system.characteristic_length(&derived.pool),
    });
    let mut all = textbook(derived, &judge);
    all.push(("solved", solved(derived, &judge)));
    all
}

/// Steps of the plan that solve for something by more than a division, as kinds with their numbers. A coefficient has
/// a division of its own only if it is not a number. The number of tearing variables depends on the order in which
/// sequences are tried. Neither changes the solution.
pub fn plan(derived: &Derived) -> Vec<(String, usize)> {
    let Ok(solved) = Solved::of(derived.clone(), Shift::Efforts, Kept::Methods) else {
        return Vec::new();
    };
    let forms = solved.program().forms.iter();
    let names = forms.flatten().map(|form| match form.modes() {
        Some(_) => form.name(),
        None => format!("Newton of {} unknowns", form.unknowns().len()),
    });
    let mut names: Vec<String> = names.filter(|name| name != "linear").collect();
    names.sort();
    let mut counted: Vec<(String, usize)> = Vec::new();
    for name in names {
        match counted.last_mut() {
            Some((last, count)) if *last == name => *count += 1,
            _ => counted.push((name, 1)),
        }
    }
    counted
}

/// True if the rounding of the residuals at a pose exceeds the tolerance to which they must be solved.
pub fn is_rounded_away(derived: &Derived, t: f64, q: &[f64]) -> bool {
    let instant_inputs = Given {
        t,
        ..given(derived)
    };
    let tolerance = Settings::<f64>::default().tolerance;
    Truth::new(derived).rounding(&instant_inputs, q, Scalar::F64) > tolerance
}

struct Judge {
    truth: Truth,
    given: Given,
    length: f64,
}

impl Judge {
    fn instant(self: &Rc<Self>, t: f64, values: Levels<f64>) -> Result<Instant, String> {
        let instant_inputs = Given {
            t,
            ..self.given.clone()
        };
        let exact = self.truth.around(&instant_inputs, values.clone());
        let exact = exact.ok_or("no bound: the Jacobian has no inverse")?;
        let judge = Rc::clone(self);
        let bounds = move || {
            let truth = &judge.truth;
            truth.bounds_around(&instant_inputs, &exact, judge.length)
        };
        Ok(Instant {
            values,
            bounds: LazyCell::new(Box::new(bounds)),
        })
    }
}

/// Default parameters and signals.
fn given(derived: &Derived) -> Given {
    let mechanism = &derived.system.mechanism;
    let value = |id| {
        let value = derived.pool.graph.constant_value(id);
        value.expect("a constant")
    };
    Given {
        parameters: mechanism
            .parameters
            .iter()
            .map(|it| value(it.nominal))
            .collect(),
        signals: mechanism
            .inputs
            .iter()
            .map(|it| [value(it.initial), 0.0, 0.0])
            .collect(),
        t: 0.0,
    }
}

fn textbook(derived: &Derived, judge: &Rc<Judge>) -> Vec<(&'static str, Moved)> {
    let interpreter = TextbookEquations::new(&derived.pool, &derived.system);
    let settings = Settings::default();
    let instant = |found: Result<Frame<f64, Dyn>, Failure<f64>>| {
        let frame = found.map_err(|failure| named(failure.kind).to_string())?;
        let values = [&frame.q, &frame.qd, &frame.qdd].map(|it| it.as_slice().to_vec());
        Ok((judge.instant(frame.t, values)?, frame))
    };
    let estimate = interpreter.estimate();
    let mut moved = Vec::new();
    let mut last: Option<Frame<f64, Dyn>> = None;
    for t in TIMES {
        let solved = match &last {
            None => Frame::assemble(&interpreter, estimate, t, &settings),
            Some(frame) => frame.advance(&interpreter, t, &settings),
        };
        match instant(solved) {
            Ok((instant, frame)) => {
                moved.push(Ok(instant));
                last = Some(frame);
            }
            Err(kind) => {
                moved.push(Err(kind));
                break;
            }
        }
    }
    let afar =
        Frame::assemble_from_rough_estimate(&interpreter, estimate, None, TIMES[0], &settings);
    vec![
        ("textbook", moved),
        (FROM_AFAR, vec![instant(afar).map(|it| it.0)]),
    ]
}

fn solved(derived: &Derived, judge: &Rc<Judge>) -> Moved {
    let Some(blocks) = Interpreted::new(derived) else {
        return vec![Err("no plan".to_string())];
    };
    let instant =
        |t: f64, frame: &<Interpreted as Blocks>::Frame| judge.instant(t, levels(&blocks, frame));
    let failed = |failure: Failure<f64>| vec![Err(named(failure.kind).to_string())];
    let mut shell = match assembled_from(blocks.clone(), &[], TIMES[0], Settings::default()) {
        Ok(shell) => shell,
        Err(failure) => return failed(failure),
    };
    let mut moved = vec![instant(TIMES[0], shell.frame())];
    let inputs = blocks.initial_inputs();
    for t in &TIMES[1..] {
        match shell.advance(*t, &inputs) {
            Ok(frame) => moved.push(instant(*t, frame)),
            Err(failure) => {
                moved.extend(failed(failure));
                break;
            }
        }
    }
    moved
}
