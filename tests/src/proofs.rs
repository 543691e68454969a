//! *A mechanism and random instants* → *whether what is proven of its motion holds there*, by Newton-Raphson in 384 bits.
//!
//! The equations that are solved there are those of the textbook view in absolute coordinates; what proves uses the solved view.

use linkwright::{Blocks, Shell};
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::check::Check;
use linkwright_solver::interpreted::Interpreted;
use linkwright_solver::measures::Measures;
use linkwright_solver::proof::{Enclosed, Proof, Proven};
use linkwright_solver::schedule::Schedule;
use linkwright_solver::view::View;

use crate::magnitude::needed;
use crate::random::Random;
use crate::stability::precise::{Precise, values};
use crate::stability::truth::{Given, Truth};

/// The part of a normalized determinant that its value in f64 may be off.
const ROUNDING: f64 = 1e-9;

/// What an exact number may be off itself, in rad and m: coordinates that are at rest have bounds without width.
const EXACT: f64 = 1e-60;

/// What came of one mechanism.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The proof.
    pub proof: Proof,
    /// How many exact numbers were compared with bounds.
    pub compared: usize,
    /// Sentences about those that are outside.
    pub outside: Vec<String>,
    /// The smallest part of the located determinants that a bound is; 1 where there is none.
    pub loosest: f64,
    /// By which part of what frames sweep the widest range goes beyond it.
    pub widest: f64,
}

/// Proves the motion of a system over a range and looks at `instants` random times.
///
/// # Panics
/// Where the mechanism does not move over the range, or exact numbers cannot be found.
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
        // What does not move has a range of rounding alone.
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
    let measures = Measures::new(&interpreted);
    for t in times {
        let inputs = laws.at(t);
        shell.advance(t, &inputs).expect("it moves");
        let given = Given {
            parameters: parameters.0.clone(),
            signals: inputs
                .0
                .iter()
                .map(|it| [it.value, it.rate, it.acceleration])
                .collect(),
            t,
        };
        exact.compare(proven, &given, shell.frame().q(), &mut verdict);
        let samples = measures.at(shell.frame());
        for (part, [value, _]) in measures.parts().iter().zip(samples) {
            let mut bounds = proven.determinants.iter();
            let own = bounds.find(|it| (it.block, it.part) == (part.block, part.part));
            if let Some(own) = own.filter(|_| !part.is_relative) {
                verdict.compared += 1;
                if value.abs() < own.least * (1.0 - ROUNDING) {
                    verdict.outside.push(format!(
                        "t = {t}: determinant {value} of block {}",
                        own.block + 1
                    ));
                }
            }
        }
    }
    verdict
}

/// The equations of a system and the places of its points, to be evaluated exactly.
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
        let found = values(&derived.pool.graph, &self.order, &symbols);
        let points = self.points.iter().flatten().map(|it| &found[it.index()]);
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
    let off = Precise::from_f64(EXACT);
    [above, below].iter().all(|it| !it.plus(&off).is_negative())
}
