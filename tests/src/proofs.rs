//! Checks the proven bounds of a motion at random instants, by Newton-Raphson in 384 bits.
//!
//! The check solves the textbook equations in absolute coordinates; the proof uses the solved formulation.

use linkwright::{Blocks, Shell};
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::proof::{Enclosed, Proof, Proven};
use linkwright_solver::{Check, Interpreted, Schedule, View};

use crate::magnitude::needed;
use crate::random::Random;
use crate::stability::precise::{Precise, values};
use crate::stability::truth::{Given, Truth};

/// Relative rounding of a normalized determinant in f64.
const ROUNDING: f64 = 1e-9;

/// Error of an exact number, in rad and m: coordinates at rest have bounds without width.
const EXACT_ERROR: f64 = 1e-60;

/// Verdict on one mechanism.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Proof.
    pub proof: Proof,
    /// Number of exact values that were compared with bounds.
    pub compared: usize,
    /// Sentences about the values outside their bounds.
    pub outside: Vec<String>,
    /// Smallest ratio of a bound to the located determinant; 1 without bounds.
    pub loosest: f64,
    /// Excess of the widest range, relative to the range of the frames.
    pub widest: f64,
}

/// Titles of the columns of [`Verdict::row`].
pub const TITLES: [&str; 7] = [
    "mechanism",
    "windows",
    "shortest, s",
    "determinant",
    "wider, %",
    "compared",
    "outside",
];

impl Verdict {
    /// Row of the report's table.
    pub fn row(&self, name: &str) -> [String; 7] {
        let is_proven = self.proof.proven.is_some();
        let of_proven = |text: String| if is_proven { text } else { "–".to_string() };
        [
            name.to_string(),
            self.proof.windows.to_string(),
            format!("{:.1e}", self.proof.shortest),
            of_proven(format!("{:.3}", self.loosest)),
            of_proven(format!("{:.2}", 100.0 * self.widest)),
            self.compared.to_string(),
            self.outside.len().to_string(),
        ]
    }
}

/// Proves the motion of a system over a range and looks at `instants` random times.
///
/// # Panics
/// If the mechanism does not move over the range, or exact values cannot be computed.
pub fn judged(derived: &Derived, range: [f64; 2], instants: usize) -> Verdict {
    let interpreted = Interpreted::new(derived).expect("a plan");
    let schedule = Schedule::whole(range[0], range[1], 0.01).expect("a good range");
    let check = Check::new(interpreted.clone(), &schedule, |_| {});
    let points: Vec<usize> = (0..derived.system.outputs.len()).collect();
    let proof = check.prove(&schedule, &points);
    let mut verdict = Verdict {
        compared: 0,
        outside: Vec::new(),
        loosest: 1.0,
        widest: 0.0,
        proof: proof.clone(),
    };
    let Some(proven) = &proof.proven else {
        return verdict;
    };
    for own in &proven.determinants {
        verdict.loosest = verdict.loosest.min(own.least / own.located);
    }
    let all = proven
        .coordinates
        .iter()
        .chain(proven.points.iter().flatten());
    for own in all {
        let swept = own.swept[1] - own.swept[0];
        let beyond = (own.bounds[1] - own.bounds[0]) - swept;
        // The range of a coordinate at rest is rounding alone.
        if swept > 1e-6 {
            verdict.widest = verdict.widest.max(beyond / swept);
        }
    }
    let mut random = Random::new(range[1].to_bits());
    let times = (0..instants).map(|_| random.between(range[0], range[1]));
    let mut times: Vec<f64> = times.collect();
    times.sort_by(f64::total_cmp);
    let exact = Exact::new(derived);
    let laws = interpreted.input_laws();
    let parameters = interpreted.nominal_parameters();
    let mut shell = Shell::assemble(
        interpreted.clone(),
        &parameters,
        &interpreted.drawn_pose(&parameters),
        interpreted.drawn_branches(),
        range[0],
        &laws.at(range[0]),
        Default::default(),
    )
    .expect("it is assembled");
    let measures = interpreted.measures().expect("measured subsystems");
    for t in times {
        let inputs = laws.at(t);
        shell.advance(t, &inputs).expect("it moves");
        let instant_inputs = Given {
            parameters: parameters.0.clone(),
            signals: inputs
                .0
                .iter()
                .map(|it| [it.value, it.rate, it.acceleration])
                .collect(),
            t,
        };
        exact.compare(proven, &instant_inputs, shell.frame().q(), &mut verdict);
        let samples = measures.at(shell.frame());
        for (part, [value, _]) in measures.parts().iter().zip(samples) {
            let mut bounds = proven.determinants.iter();
            let bound = bounds.find(|it| (it.block, it.part) == (part.block, part.part));
            if let Some(bound) = bound.filter(|_| !part.is_relative) {
                verdict.compared += 1;
                if value.abs() < bound.least * (1.0 - ROUNDING) {
                    verdict.outside.push(format!(
                        "t = {t}: determinant {value} of block {}",
                        bound.block + 1
                    ));
                }
            }
        }
    }
    verdict
}

/// Equations of a system and positions of its points, for exact evaluation.
struct Exact {
    truth: Truth,
    points: Vec<[ExprId; 2]>,
    order: Vec<ExprId>,
}

impl Exact {
    fn new(derived: &Derived) -> Exact {
        let points: Vec<[ExprId; 2]> = derived
            .system
            .outputs
            .iter()
            .map(|it| it.position)
            .collect();
        Exact {
            truth: Truth::new(derived),
            order: needed(&derived.pool.graph, &points.concat()),
            points,
        }
    }

    fn compare(&self, proven: &Proven, given: &Given, near: &[f64], verdict: &mut Verdict) {
        let derived = &self.truth.derived;
        let start: Vec<Precise> = near.iter().map(|&it| Precise::from_f64(it)).collect();
        let exact = self.truth.solve(given, &start).expect("an exact pose");
        let [q, ..] = exact.levels;
        let mut symbols = given.symbols(derived, Precise::from_f64);
        for (own, value) in derived.system.coordinates.iter().zip(&q) {
            symbols[own.position.index()] = value.clone();
        }
        let node_values = values(&derived.pool.graph, &self.order, &symbols);
        let points = self
            .points
            .iter()
            .flatten()
            .map(|it| &node_values[it.index()]);
        let all = proven
            .coordinates
            .iter()
            .chain(proven.points.iter().flatten());
        for (own, value) in all.zip(q.iter().chain(points)) {
            verdict.compared += 1;
            if !holds(own, value) {
                let value = value.to_f64();
                verdict
                    .outside
                    .push(format!("t = {}: {} = {value:e}", given.t, own.name));
            }
        }
    }
}

fn holds(own: &Enclosed, value: &Precise) -> bool {
    let [low, high] = own.bounds.map(Precise::from_f64);
    let [above, below] = [value.minus(&low), high.minus(value)];
    let off = Precise::from_f64(EXACT_ERROR);
    [above, below].iter().all(|it| !it.plus(&off).is_negative())
}
