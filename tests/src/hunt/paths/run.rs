//! Constructs the mechanism of a family and a number, moves it, and judges every step.

use linkwright::Blocks;
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::Interpreted;
use linkwright_solver::textbook::TextbookEquations;
use nalgebra::DVector;

use super::course::Course;
use super::families::course;
use super::judge::{DOUBLE, Tolerance, Truth};
use super::schedule::schedules;
use super::stepping::{Schedule, Stepped, stepped};
use super::tally::{Outcome, Tally, View};
use super::trace::{End, Trace};
use crate::hunt::motion::hunted;
use crate::random::Random;

/// Mechanism to hunt.
pub struct Hunted {
    /// Family and number.
    pub key: (usize, u64),
    /// Course of the drivers.
    pub course: Course,
    /// Resolved description.
    pub derived: Derived,
    /// Equations.
    pub equations: TextbookEquations,
    scales: Vec<f64>,
    /// Requested schedules.
    pub schedules: Vec<Schedule>,
}

/// Slow families, and the fraction of the steps that they take.
const SLOW: ([&str; 3], f64) = (
    [
        "grown, inputs",
        "grown, inputs while time stands",
        "cam from a table",
    ],
    0.25,
);

/// Reads a description.
///
/// # Errors
/// The codes of its errors.
pub fn read(text: &str) -> Result<Derived, String> {
    let source = Source::new("hunted.mech", text);
    let codes = |errors: &linkwright_codegen::diagnostic::Diagnostics| {
        let rendered = errors.render(&source);
        let parts = rendered.split("error[").skip(1);
        let mut codes: Vec<&str> = parts.filter_map(|rest| rest.split(']').next()).collect();
        codes.sort_unstable();
        codes.dedup();
        format!("refused: {}", codes.join(" "))
    };
    let read = linkwright_codegen::read(&source).map_err(|errors| codes(&errors))?;
    let derived = hunted(read).ok_or("several motions")?;
    linkwright_codegen::stages::check(&derived).map_err(|errors| codes(&errors))?;
    Ok(derived)
}

/// Scale of every coordinate: 1 for an angle, the size for a length.
pub fn scales(derived: &Derived, size: f64) -> Vec<f64> {
    let coordinates = derived.system.coordinates.iter();
    let scale = |power: i32| if power == 0 { 1.0 } else { size };
    coordinates
        .map(|it| scale(it.quantity.power_of_length()))
        .collect()
}

/// Constructs a mechanism, with a fraction `part` of the usual number of steps; `None` if it is refused, which is
/// counted.
pub fn prepare(
    family: usize,
    seed: u64,
    number: u64,
    part: f64,
    tally: &mut Tally,
) -> Option<Hunted> {
    let course = course(family, seed, number);
    let key = (family, number);
    let derived = match read(&course.text) {
        Ok(derived) => derived,
        Err(why) => {
            tally.skip(key, why);
            return None;
        }
    };
    let part = if SLOW.0.contains(&course.family) {
        SLOW.1 * part
    } else {
        part
    };
    let mut random = Random::new(seed ^ number ^ ((family as u64) << 32));
    Some(Hunted {
        key,
        equations: TextbookEquations::new(&derived.pool, &derived.system),
        scales: scales(&derived, course.size),
        schedules: schedules(&course, &mut random, part),
        derived,
        course,
    })
}

impl Hunted {
    fn truth(&self) -> Truth<'_> {
        Truth {
            course: &self.course,
            equations: &self.equations,
            scales: &self.scales,
        }
    }

    /// Path from the pose of an assembly; `None` if it is unknown, which is counted.
    pub fn path(&self, first: &Stepped, tally: &mut Tally) -> Option<Trace> {
        let assembled = match &first.answer {
            Ok(found) => DVector::from_column_slice(found),
            Err((kind, _)) => {
                tally.skip(self.key, format!("not assembled: {kind}"));
                return None;
            }
        };
        let truth = self.truth();
        let path = match self.course.inputs.is_empty() {
            true => truth.whole(&assembled),
            false => truth.still(&assembled),
        };
        let path = path.filter(|path| path.first().pivot > 1e-6);
        if path.is_none() {
            tally.skip(self.key, "singular at the beginning".to_string());
        }
        path
    }

    /// True if the assembly is that of the design configuration.
    fn is_as_drawn(&self, blocks: &Interpreted, path: &Trace) -> bool {
        let mut drawn = blocks.drawn_pose(&blocks.nominal_parameters()).0;
        for (value, start) in drawn.iter_mut().zip(&self.course.start) {
            *value = *start;
        }
        let exact = path.first().q.iter().zip(&drawn).zip(&self.scales);
        let off = exact.map(|((a, b), scale)| (a - b).abs() / scale);
        off.fold(0.0, f64::max) < 1e-4
    }

    /// Judges the steps along the schedules.
    pub fn count(
        &self,
        view: View,
        tolerance: &Tolerance,
        path: &Trace,
        all: &[Vec<Stepped>],
        tally: &mut Tally,
    ) {
        let truth = self.truth();
        for (number, (schedule, steps)) in self.schedules.iter().zip(all).enumerate() {
            let outcomes = truth.judge(path, schedule, steps, tolerance, &|_| None);
            for (step, (outcome, size)) in steps.iter().zip(outcomes) {
                let what = format!(
                    "schedule {number}, step {} part {}, t = {}",
                    step.target, step.part, step.t
                );
                tally.add(self.key, view, size, outcome, &what);
            }
        }
    }

    /// Moves the mechanism with the interpreter and counts the outcomes. Returns the path.
    pub fn interpret(&self, tally: &mut Tally) -> Option<Trace> {
        let Some(blocks) = Interpreted::new(&self.derived) else {
            tally.skip(self.key, "no plan".to_string());
            return None;
        };
        let all: Vec<Vec<Stepped>> = self
            .schedules
            .iter()
            .map(|it| stepped(&blocks, it))
            .collect();
        let path = self.path(&all[0][0], tally)?;
        let courses = tally.courses.entry(self.key.0).or_default();
        courses[0] += 1;
        courses[1] += 1;
        courses[2] += usize::from(matches!(path.end, End::Singular(..)));
        courses[3] += usize::from(!path.crossings.is_empty());
        if self.course.is_drawn && !self.is_as_drawn(&blocks, &path) {
            let why = "another assembly than the drawn one".to_string();
            tally.add(
                self.key,
                View::Interpreted,
                None,
                Outcome::Another(why),
                "start",
            );
        }
        self.count(View::Interpreted, &DOUBLE, &path, &all, tally);
        Some(path)
    }
}
