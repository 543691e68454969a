//! Φ_q, Φ_t and γ of every mechanism against differences of Φ, and generated code against the interpreter, at 1,000 random
//! poses, rates and times. Every tolerance is computed: Taylor remainder and rounding by `majorant`, nothing else.

use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::system::Derived;
use linkwright_tests::description;
use linkwright_tests::generated::MODULES;
use linkwright_tests::magnitude::{magnitudes, needed};
use linkwright_tests::majorant::{Line, majorants};
use linkwright_tests::random::Random;
use linkwright_tests::sample::Sample;
use linkwright_tests::solver::{Functions, Interpreted, Solvable, Solver, both};
use linkwright_tests::stencil::{Quotient, first, second};
use nalgebra::DVector;

const SAMPLES: usize = 1000;

/// Number of samples of each mechanism that only tests have.
const FEWER_SAMPLES: usize = 200;

/// Step of first differences: truncation c₅ h⁴ and rounding ε/h are about equal.
const FIRST_STEP: f64 = 1.0 / 1024.0;

/// Step of second differences: c₆ h⁴ and ε/h² are about equal.
const SECOND_STEP: f64 = 1.0 / 256.0;

/// Mechanisms whose fast laws or near poles leave no useful bound at some poses. Their errors are judged in tests of
/// their own, for the [laws of motion](../laws.rs), the [rope](../equations.rs) and [Andrews'
/// crank](../forces_by_hand.rs), which swings at 200 rad/s. Here they are judged only at poses with a bound.
const WIDE: [&str; 4] = ["andrews", "laws", "pieces", "rope"];

/// Largest error in units of its bound, and the largest bound itself.
#[derive(Clone, Copy, Debug, Default)]
struct Record {
    share: f64,
    bound: f64,
    error: f64,
    /// Number of compared entries.
    compared: usize,
    /// Number of entries without a bound, since a piece of their formula may change within the step.
    unbounded: usize,
}

impl Record {
    /// Asserts that `found` is the derivative that the quotient approximates; `rounding` is the error of `found` itself.
    fn check(&mut self, found: f64, rounding: f64, quotient: Quotient, place: impl Fn() -> String) {
        let (bound, error) = (quotient.error + rounding, (found - quotient.value).abs());
        // Infinity times zero is NaN.
        if !bound.is_finite() {
            self.unbounded += 1;
            return;
        }
        self.compared += 1;
        assert!(
            error <= bound,
            "{}: {found} and {}, {error:e} above {bound:e}",
            place(),
            quotient.value
        );
        self.bound = self.bound.max(bound);
        self.error = self.error.max(error);
        if bound > 0.0 {
            self.share = self.share.max(error / bound);
        }
    }
}

/// Expressions of a system under test.
struct Roots {
    residuals: Vec<ExprId>,
    /// Nodes of Φ, operands first.
    of_residuals: Vec<ExprId>,
    /// Nodes of Φ, Φ_q, Φ_t and γ, operands first.
    of_all: Vec<ExprId>,
}

impl Roots {
    fn of(derived: &Derived) -> Roots {
        let graph = &derived.pool.graph;
        let residuals: Vec<ExprId> = derived.system.rows.iter().map(|row| row.residual).collect();
        let mut all = residuals.clone();
        for row in &derived.system.rows {
            all.extend(row.jacobian.iter().map(|entry| entry.value));
            all.extend([row.time_derivative, row.gamma]);
        }
        Roots {
            of_residuals: needed(graph, &residuals),
            of_all: needed(graph, &all),
            residuals,
        }
    }
}

/// Every moving symbol has the slope 1, which is at least its slope along any coordinate and along t. Parameters are
/// fixed, and the interpreter holds signals.
fn ones(derived: &Derived) -> Vec<f64> {
    let mut slopes = vec![1.0; derived.pool.graph.symbol_count()];
    for parameter in &derived.system.mechanism.parameters {
        slopes[parameter.symbol.index()] = 0.0;
    }
    for input in &derived.system.mechanism.inputs {
        slopes[input.symbols[0].index()] = 0.0;
    }
    slopes
}

/// Compares Φ_q and Φ_t with first differences of Φ.
fn check_first(derived: &Derived, roots: &Roots, solver: &dyn Solver, sample: &Sample) -> Record {
    let graph = &derived.pool.graph;
    let symbols = sample.symbols(derived);
    let slopes = ones(derived);
    let line = Line {
        values: &symbols,
        slopes: &slopes,
        reach: 2.0 * FIRST_STEP,
    };
    let bounds = majorants::<6>(graph, &roots.of_residuals, &line);
    let here = Line {
        values: &symbols,
        slopes: &slopes,
        reach: 0.0,
    };
    let rounding = majorants::<1>(graph, &roots.of_all, &here);
    let functions = solver.functions(&sample.q, &sample.qd, sample.t);
    let n = sample.q.len();
    let mut record = Record::default();
    for column in 0..=n {
        let values = [-2.0, -1.0, 1.0, 2.0].map(|step| {
            let (mut q, mut t) = (sample.q.clone(), sample.t);
            let moved = if column < n { &mut q[column] } else { &mut t };
            *moved += step * FIRST_STEP;
            solver.residual(&q, t)
        });
        for (index, row) in derived.system.rows.iter().enumerate() {
            let entry = row.jacobian.iter().find(|entry| entry.coordinate == column);
            let (found, expr) = if column < n {
                (
                    functions.phi_q[(index, column)],
                    entry.map(|entry| entry.value),
                )
            } else {
                (functions.phi_t[index], Some(row.time_derivative))
            };
            // An entry that is not listed is zero without rounding.
            let entry_error = expr.map_or(0.0, |expr| rounding[expr.index()].error);
            let values = values.each_ref().map(|phi| phi[index]);
            let quotient = first(values, FIRST_STEP, &bounds[roots.residuals[index].index()]);
            record.check(found, entry_error, quotient, || {
                format!("{} Φ_q({}, {column})", solver.kind(), row.name)
            });
        }
    }
    record
}

/// Compares -γ with the second difference of Φ along the curve (q + q̇ s, t + s), on which q̈ = 0.
fn check_second(derived: &Derived, roots: &Roots, solver: &dyn Solver, sample: &Sample) -> Record {
    let graph = &derived.pool.graph;
    let symbols = sample.symbols(derived);
    let mut slopes = vec![0.0; symbols.len()];
    for (coordinate, rate) in derived.system.coordinates.iter().zip(&sample.qd) {
        slopes[coordinate.position.index()] = *rate;
    }
    slopes[derived.system.mechanism.time.index()] = 1.0;
    let line = Line {
        values: &symbols,
        slopes: &slopes,
        reach: 2.0 * SECOND_STEP,
    };
    let bounds = majorants::<7>(graph, &roots.of_residuals, &line);
    let here = Line {
        values: &symbols,
        slopes: &slopes,
        reach: 0.0,
    };
    let rounding = majorants::<1>(graph, &roots.of_all, &here);
    let gamma = solver.functions(&sample.q, &sample.qd, sample.t).gamma;
    let values = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|step| {
        let s = step * SECOND_STEP;
        let q: Vec<f64> = sample
            .q
            .iter()
            .zip(&sample.qd)
            .map(|(q, qd)| q + s * qd)
            .collect();
        solver.residual(&q, sample.t + s)
    });
    let mut record = Record::default();
    for (index, row) in derived.system.rows.iter().enumerate() {
        let values = values.each_ref().map(|phi| phi[index]);
        let quotient = second(values, SECOND_STEP, &bounds[row.residual.index()]);
        let gamma_error = rounding[row.gamma.index()].error;
        record.check(-gamma[index], gamma_error, quotient, || {
            format!("{} γ({})", solver.kind(), row.name)
        });
    }
    record
}

fn merge(into: &mut Record, record: Record) {
    into.share = into.share.max(record.share);
    into.bound = into.bound.max(record.bound);
    into.error = into.error.max(record.error);
    into.compared += record.compared;
    into.unbounded += record.unbounded;
}

fn derivatives_agree(name: &str, samples: usize) {
    for derived in description::motions(name) {
        derivatives_of_one_agree(name, &derived, samples);
    }
}

fn derivatives_of_one_agree(name: &str, derived: &Derived, samples: usize) {
    let roots = Roots::of(derived);
    let mut solvers: Vec<Box<dyn Solver>> = vec![Box::new(Interpreted::of(derived))];
    solvers.extend(
        MODULES
            .iter()
            .find(|module| module.name == name)
            .map(Solvable::solver),
    );
    for solver in solvers {
        let mut random = Random::new(2);
        let (mut slopes, mut curves) = (Record::default(), Record::default());
        for _ in 0..samples {
            let sample = Sample::random(derived, &mut random);
            merge(&mut slopes, check_first(derived, &roots, &*solver, &sample));
            merge(
                &mut curves,
                check_second(derived, &roots, &*solver, &sample),
            );
        }
        println!(
            "{name}, {}: Φ_q and Φ_t {slopes:?}, γ {curves:?}",
            solver.kind()
        );
        // Bounds wide enough to hide an error would prove nothing.
        assert!(
            slopes.bound < 1e-8 && curves.bound < 1e-5 || WIDE.contains(&name),
            "{name}: {slopes:?}, {curves:?}"
        );
        for record in [slopes, curves] {
            assert!(
                record.unbounded * 20 <= record.compared,
                "{name}: {record:?}"
            );
        }
    }
}

#[test]
fn derivatives_of_the_exam_agree_with_differences() {
    derivatives_agree("two_body", SAMPLES);
}

#[test]
fn derivatives_of_the_excavator_agree_with_differences() {
    derivatives_agree("excavator", SAMPLES);
}

#[test]
fn derivatives_of_the_arm_agree_with_differences() {
    derivatives_agree("arm", SAMPLES);
}

/// All without a test of their own above, so that a new description is tested from its first day.
#[test]
fn derivatives_of_all_others_agree_with_differences() {
    for name in description::names() {
        if !["two_body", "excavator", "arm"].contains(&name.as_str()) {
            derivatives_agree(&name, SAMPLES);
        }
    }
}

/// Each kind of joint and driver has one among them, most between two bodies that both move and turn. Those with
/// tables have [tests of their own](../tables/mod.rs), since the majorant of a spline is unknown here.
#[test]
fn derivatives_of_the_small_mechanisms_agree_with_differences() {
    for name in description::small() {
        if description::system(&name)
            .system
            .mechanism
            .tables
            .is_empty()
        {
            derivatives_agree(&name, FEWER_SAMPLES);
        }
    }
}

/// A solver with one wrong digit.
struct Planted(Box<dyn Solver>);

impl Solver for Planted {
    fn kind(&self) -> &'static str {
        "planted"
    }

    fn functions(&self, q: &[f64], qd: &[f64], t: f64) -> Functions {
        let mut functions = self.0.functions(q, qd, t);
        functions.phi_q[(2, 2)] += 1e-9;
        functions.gamma[2] += 1e-6;
        functions
    }

    fn residual(&self, q: &[f64], t: f64) -> DVector<f64> {
        self.0.residual(q, t)
    }

    fn assemble(&mut self, t: f64) {
        self.0.assemble(t);
    }

    fn advance(&mut self, t: f64) {
        self.0.advance(t);
    }

    fn frame(&self) -> &linkwright::Frame<f64, nalgebra::Dyn> {
        self.0.frame()
    }

    fn point(&self, name: &str) -> linkwright::PointMotion {
        self.0.point(name)
    }

    fn newton_step(&self, q: &[f64], t: f64) -> linkwright::Step<f64, nalgebra::Dyn> {
        self.0.newton_step(q, t)
    }
}

#[test]
#[should_panic(expected = "planted Φ_q(p_x, 2)")]
fn an_entry_of_the_jacobian_that_is_wrong_by_1e_9_is_found() {
    let derived = description::system("two_body");
    let [solver, _] = both("two_body");
    let sample = Sample::random(&derived, &mut Random::new(3));
    check_first(&derived, &Roots::of(&derived), &Planted(solver), &sample);
}

#[test]
#[should_panic(expected = "planted γ(p_x)")]
fn a_gamma_that_is_wrong_by_1e_6_is_found() {
    let derived = description::system("two_body");
    let [solver, _] = both("two_body");
    let sample = Sample::random(&derived, &mut Random::new(3));
    check_second(&derived, &Roots::of(&derived), &Planted(solver), &sample);
}

#[test]
fn generated_code_and_interpreter_agree_to_4_ulp_of_their_terms() {
    for module in MODULES {
        let derived = description::system(module.name);
        let graph = &derived.pool.graph;
        let roots = Roots::of(&derived);
        let [generated, interpreted] = both(module.name);
        let mut random = Random::new(4);
        let mut largest = 0.0_f64;
        for _ in 0..SAMPLES {
            let sample = Sample::random(&derived, &mut random);
            let magnitude = magnitudes(graph, &roots.of_all, &sample.symbols(&derived));
            let one = generated.functions(&sample.q, &sample.qd, sample.t);
            let other = interpreted.functions(&sample.q, &sample.qd, sample.t);
            let mut check = |what: &str, one: f64, other: f64, expr: ExprId| {
                let (error, ulp) = ((one - other).abs(), f64::EPSILON * magnitude[expr.index()]);
                assert!(
                    error <= 4.0 * ulp,
                    "{} {what}: {one} and {other}, {error:e} of {ulp:e}",
                    module.name
                );
                if ulp > 0.0 {
                    largest = largest.max(error / ulp);
                }
            };
            for (index, row) in derived.system.rows.iter().enumerate() {
                check("Φ", one.phi[index], other.phi[index], row.residual);
                check(
                    "Φ_t",
                    one.phi_t[index],
                    other.phi_t[index],
                    row.time_derivative,
                );
                check("γ", one.gamma[index], other.gamma[index], row.gamma);
                let mut zeros = one.phi_q.row(index).into_owned();
                for entry in &row.jacobian {
                    let place = (index, entry.coordinate);
                    check("Φ_q", one.phi_q[place], other.phi_q[place], entry.value);
                    zeros[entry.coordinate] = 0.0;
                }
                assert!(
                    zeros.iter().all(|zero| *zero == 0.0),
                    "{}: an entry that is not listed",
                    module.name
                );
            }
        }
        println!(
            "{}: largest difference {largest:.2} ulp of the terms",
            module.name
        );
    }
}
