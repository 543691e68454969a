//! Counts how often calibration finds lengths within their intervals, on mechanisms with known lengths and known
//! noise.
//!
//! The mechanisms are those of the repository, with parameters in place of lengths. Noise is normal (Box and Muller
//! 1958) and reproducible: every trial has a seed of its own.

use std::f64::consts::TAU;

use linkwright_calibrate::{Calibrator, Column, Fit, Measurements, Unfit};
use linkwright_codegen::diagnostic::Source;
use linkwright_solver::Observable;
use linkwright_solver::View as _;
use linkwright_solver::observable::{Named, all};

use crate::files;
use crate::random::Random;

/// Standard deviation of a measured coordinate of a point: 0.1 mm on mechanisms of decimetres, 1 mm on those of
/// metres.
const NOISE: [f64; 2] = [1e-4, 1e-3];

/// Largest relative error of a parameter at the start of a trial.
const OFF: f64 = 0.02;

/// First of the seeds of all trials.
pub const SEED: u64 = 0xca1b;

/// A mechanism whose lengths are fitted.
pub struct Study {
    /// Name in reports.
    pub name: &'static str,
    /// Description of the measurement.
    pub measured: &'static str,
    calibrator: Calibrator,
    times: Vec<f64>,
    observables: Vec<Observable>,
    solved: Vec<Vec<f64>>,
    truth: Vec<f64>,
    /// True if lengths differ from trial to trial.
    varies: bool,
    noise: f64,
}

/// Numbers of estimates within their standard deviations, by parameter.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Coverage {
    /// Number of trials.
    pub trials: u32,
    /// Number of failed trials.
    pub failed: u32,
    /// Names of the parameters.
    pub names: Vec<String>,
    /// Number of intervals of 95 % that held the truth.
    pub held: Vec<u32>,
    /// Number of trusted fits.
    pub trusted: u32,
    /// Numbers of estimates within one standard deviation of the truth, and within three.
    pub within: Vec<[u32; 2]>,
    /// Sums of the errors, of their squares, and of the squared deviations.
    pub sums: Vec<[f64; 3]>,
    /// Number of solved motions.
    pub evaluations: usize,
}

/// Description of the repository with some of its text replaced.
///
/// # Panics
/// If a text to replace is missing.
pub fn replaced(name: &str, replacements: &[(&str, &str)]) -> String {
    let path = files::repository().join(format!("mechanisms/{name}.mech"));
    let mut text = std::fs::read_to_string(path).expect("a description");
    for (from, to) in replacements {
        assert!(text.contains(from), "{name} has no {from}");
        text = text.replacen(from, to, 1);
    }
    text
}

/// The four-bar with its four lengths as parameters.
pub fn four_bar_text() -> String {
    replaced(
        "four_bar",
        &[
            (
                "mechanism four_bar {",
                "mechanism four_bar {\n    param G = 100mm;\n    param L2 = 40mm;\n    param L3 = 120mm;\n    param L4 = 80mm;",
            ),
            ("D = (100mm, 0)", "D = (G, 0)"),
            ("at (100mm, 0, 57deg)", "at (G, 0, 57deg)"),
            ("B: (40mm, 0)", "B: (L2, 0)"),
            ("C: (120mm, 0)", "C: (L3, 0)"),
            ("C: (80mm, 0)", "C: (L4, 0)"),
        ],
    )
}

/// The platform with the mean lengths of its legs and the width of its base as parameters.
pub fn platform_text() -> String {
    replaced(
        "platform_3rpr",
        &[
            (
                "mechanism platform_3rpr {",
                "mechanism platform_3rpr {\n    param width = 1.6;\n    param leg1 = 0.776;\n    param leg2 = 0.794;\n    param leg3 = 0.737;",
            ),
            ("B = (0.8, -0.5)", "B = (width - 0.8, -0.5)"),
            ("distance(A, P) +", "leg1 +"),
            ("distance(B, Q) +", "leg2 +"),
            ("distance(C, R) -", "leg3 -"),
        ],
    )
}

/// Calibrator of these parameters of a description, and its observable quantities.
///
/// # Panics
/// If the description has errors.
pub fn calibrator(text: &str, parameters: &[&str], step: f64) -> (Calibrator, Vec<Named>) {
    let source = Source::new("study.mech", text);
    let read = linkwright_codegen::Read::along(&source, parameters);
    let read = read.unwrap_or_else(|found| panic!("{}", found.render(&source)));
    let derived = read.only().expect("one motion");
    let calibrator = Calibrator::new(&derived, step).expect("its blocks can be ordered");
    (calibrator, all(&derived.pool, &derived.system))
}

/// Observables of the quantities with these names.
///
/// # Panics
/// If a name is unknown.
pub fn observables(quantities: &[Named], names: &[&str]) -> Vec<Observable> {
    let named = |name: &&str| quantities.iter().find(|it| it.name == **name);
    let all = names.iter().map(|name| {
        named(name)
            .unwrap_or_else(|| panic!("no {name}"))
            .observable
    });
    all.collect()
}

impl Study {
    fn new(
        name: &'static str,
        measured: &'static str,
        text: &str,
        parameters: &[&str],
        columns: &[&str],
        times: Vec<f64>,
        noise: f64,
    ) -> Study {
        let (calibrator, quantities) = calibrator(text, parameters, 0.25);
        let observables = observables(&quantities, columns);
        let truth = calibrator.nominal();
        let solved = calibrator
            .solved(&observables, &times, &truth)
            .expect("it moves");
        Study {
            name,
            measured,
            calibrator,
            times,
            observables,
            solved,
            truth,
            varies: false,
            noise,
        }
    }

    /// The four-bar, whose coupler point is measured 40 times in one turn of the crank.
    pub fn four_bar() -> Study {
        let times = (0..40)
            .map(|step| f64::from(step) / 40.0 * TAU / 3.0)
            .collect();
        Study::new(
            "four_bar",
            "P of the coupler at 40 times in one turn of the crank, x and y, each with 0.1 mm of noise",
            &four_bar_text(),
            &["G", "L2", "L3", "L4"],
            &["P_x", "P_y"],
            times,
            NOISE[0],
        )
    }

    /// The four-bar, whose coupler point is measured so often that neighboring rows are rounded alike.
    pub fn slow() -> Study {
        let times = (0..400).map(|row| f64::from(row) / 1200.0).collect();
        let measured = "P of the coupler at 400 times while the crank turns by 1 rad, x and y, each with 0.1 mm of noise; lengths differ by up to 2 % from trial to trial";
        let slow = Study::new(
            "four_bar, slowly",
            measured,
            &four_bar_text(),
            &["L2", "L3"],
            &["P_x", "P_y"],
            times,
            NOISE[0],
        );
        Study {
            varies: true,
            ..slow
        }
    }

    /// The platform, of which two corners are measured 50 times.
    pub fn platform() -> Study {
        let times = (0..50).map(|step| f64::from(step) / 50.0 * TAU).collect();
        Study::new(
            "platform_3rpr",
            "Q and R of the platform at 50 times in one period, x and y, each with 1 mm of noise",
            &platform_text(),
            &["width", "leg1", "leg2", "leg3"],
            &["Q_x", "Q_y", "R_x", "R_y"],
            times,
            NOISE[1],
        )
    }

    /// Fit to points with the noise of a seed from a start with errors, and the true lengths. Points are rounded to
    /// `steps` standard deviations of the noise; 0 keeps them.
    ///
    /// # Errors
    /// Those of the fit.
    pub fn trial(&self, seed: u64, steps: f64) -> Result<(Vec<f64>, Fit), Unfit> {
        let mut random = Random::new(seed);
        let mut off = |it: &f64| it * (1.0 + random.between(-OFF, OFF));
        let (truth, solved) = match self.varies {
            true => {
                let truth: Vec<f64> = self.truth.iter().map(&mut off).collect();
                let solved = self
                    .calibrator
                    .solved(&self.observables, &self.times, &truth);
                (truth, solved.map_err(Unfit::Unsolved)?)
            }
            false => (self.truth.clone(), self.solved.clone()),
        };
        let step = steps * self.noise;
        let rounded = |it: f64| match step > 0.0 {
            true => (it / step).round() * step,
            false => it,
        };
        let columns = self
            .observables
            .iter()
            .zip(&solved)
            .map(|(observable, solved)| Column {
                observable: *observable,
                values: solved
                    .iter()
                    .map(|it| Some(rounded(it + self.noise * normal(&mut random))))
                    .collect(),
                deviation: None,
                rounding: (step > 0.0).then_some(step),
                group: 0,
            });
        let measured = Measurements {
            columns: columns.collect(),
            times: self.times.clone(),
        };
        let off = |it: &f64| it * (1.0 + random.between(-OFF, OFF));
        let start: Vec<f64> = self.truth.iter().map(off).collect();
        Ok((truth, self.calibrator.fit(&measured, &start)?))
    }

    /// Coverage of the truth by the intervals of the fits.
    pub fn coverage(&self, trials: u32, steps: f64) -> Coverage {
        let names = self.calibrator.names().to_vec();
        let mut coverage = Coverage {
            held: vec![0; names.len()],
            within: vec![[0; 2]; names.len()],
            sums: vec![[0.0; 3]; names.len()],
            names,
            trials,
            ..Coverage::default()
        };
        for trial in 0..trials {
            // Seeds of neighbouring trials are independent.
            let seed = Random::new(SEED + u64::from(trial)).bits();
            let Ok((truth, fit)) = self.trial(seed, steps) else {
                coverage.failed += 1;
                continue;
            };
            coverage.evaluations += fit.evaluations;
            coverage.trusted += u32::from(fit.is_trusted());
            for (place, truth) in truth.iter().enumerate() {
                let error = fit.values[place] - truth;
                let deviation = fit.deviations[place].unwrap_or(0.0);
                let holds =
                    fit.intervals[place].is_some_and(|it| it[0] <= *truth && *truth <= it[1]);
                coverage.held[place] += u32::from(holds);
                for (count, times) in coverage.within[place].iter_mut().zip([1.0, 3.0]) {
                    *count += u32::from(error.abs() <= times * deviation);
                }
                for (sum, term) in coverage.sums[place].iter_mut().zip([
                    error,
                    error * error,
                    deviation * deviation,
                ]) {
                    *sum += term;
                }
            }
        }
        coverage
    }

    /// Number of blocks that are solved by the mechanism.
    pub fn blocks(&self) -> usize {
        self.calibrator.view().plan().blocks.len()
    }

    /// Name of the mechanism.
    pub fn title(&self) -> String {
        self.calibrator.view().system().mechanism.title()
    }
}

/// Sample of the standard normal distribution.
pub fn normal(random: &mut Random) -> f64 {
    // Never zero, which has no logarithm.
    let radius = (-2.0 * (1.0 - random.between(0.0, 1.0)).ln()).sqrt();
    radius * random.between(0.0, TAU).cos()
}

impl Coverage {
    /// Shares of the estimates of a parameter within one standard deviation, and within three.
    pub fn shares(&self, place: usize) -> [f64; 2] {
        self.within[place].map(|count| f64::from(count) / f64::from(self.trials))
    }

    /// Share of the intervals of 95 % that hold a parameter.
    pub fn held(&self, place: usize) -> f64 {
        f64::from(self.held[place]) / f64::from(self.trials)
    }

    /// Table of a report.
    pub fn table(&self) -> String {
        let mut text = "| parameter | in 95 % interval | within 1 σ | within 3 σ | mean error | rms error | rms σ |\n|---|---|---|---|---|---|---|\n".to_string();
        for (place, name) in self.names.iter().enumerate() {
            let [one, three] = self.shares(place).map(|it| 100.0 * it);
            let count = f64::from(self.trials);
            let [mean, square, deviation] = self.sums[place].map(|it| it / count);
            let (square, deviation) = (square.sqrt(), deviation.sqrt());
            let held = 100.0 * self.held(place);
            text += &format!(
                "| {name} | {held:.2} % | {one:.2} % | {three:.2} % | {mean:+.1e} | {square:.3e} | {deviation:.3e} |\n"
            );
        }
        text
    }
}
