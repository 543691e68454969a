//! Motions with strong dampers, against a closed form and Lagrange's equations in short steps.

use linkwright_solver::{Method, Simulation};
use linkwright_tests::damped_chain::{DampedChain, Element};
use linkwright_tests::random::cases;
use linkwright_tests::simulated::{PENDULUM, coordinate, energy, simulation, swung};
use linkwright_tests::sled::Sled;
use linkwright_tests::stiff::{Damped, Found, options};

const END: f64 = 1.0;

/// A damper of 1e6 N·s/m takes at most ten times the evaluations of one of 10 N·s/m, and both motions are right.
#[test]
fn a_strong_damper_costs_little() {
    for damped in [Damped::Slider, Damped::Cart] {
        let [weak, strong] = [10.0, 1e6].map(|damper| damped.motion(damper, END));
        for relative in [1e-6, 1e-8, 1e-10] {
            let automatic = options(Method::Automatic, relative);
            let run = |damper, motion| {
                let comparison = damped.compared(damper, motion, END, automatic);
                comparison.expect("no end")
            };
            let runs: [Found; 2] = [run(10.0, &weak), run(1e6, &strong)];
            for it in &runs {
                assert!(it.error <= 300.0 * relative, "{damped:?} {relative} {it:?}");
            }
            let [weak, strong] = runs.map(|it| it.effort);
            assert_eq!(weak.implicit, 0, "{weak:?}");
            assert!(strong.implicit > 0, "{strong:?}");
            if relative == 1e-6 {
                assert!(
                    strong.evaluations <= 10 * weak.evaluations,
                    "{weak:?} {strong:?}"
                );
            }
        }
    }
}

/// Implicit steps alone are as right, stiff or not; explicit ones alone take as many as stability asks for.
#[test]
fn a_method_can_be_forced() {
    let damped = Damped::Cart;
    for damper in [10.0, 1e4] {
        let motion = damped.motion(damper, END);
        for relative in [1e-6, 1e-9] {
            let implicit = options(Method::Implicit, relative);
            let run = damped.compared(damper, &motion, END, implicit);
            let run = run.expect("no end");
            assert!(run.error <= 300.0 * relative, "{damper} {relative} {run:?}");
            assert_eq!(run.effort.implicit, run.effort.steps);
        }
        let explicit = damped.compared(damper, &motion, END, options(Method::Explicit, 1e-6));
        let explicit = explicit.expect("no end");
        assert!(explicit.error <= 300.0 * 1e-6, "{damper} {explicit:?}");
        assert_eq!(explicit.effort.implicit, 0);
        // No step is longer than 6.1 decay times; the decay rate is at least 1e4/3 per s.
        assert!(damper < 1e4 || explicit.effort.steps >= 540, "{explicit:?}");
    }
}

/// A pendulum without damping keeps its energy with implicit steps and follows the elliptic functions.
#[test]
fn implicit_steps_keep_the_energy() {
    let mut pendulum = simulation(PENDULUM, 5.0, options(Method::Implicit, 1e-9));
    let first = energy(&pendulum);
    for step in 1..=50 {
        let t = 0.1 * f64::from(step);
        pendulum.advance(t).expect("no end");
        let [angle, _] = swung(t);
        let [found, _] = coordinate(&pendulum, "phi_bob");
        assert!((found - angle).abs() <= 1e-6, "{t}: {found} {angle}");
        assert!((energy(&pendulum) - first).abs() <= 1e-6 * 3.0 * 9.81 * 4.0);
    }
}

/// Steps become explicit again once a fading damping no longer matters.
#[test]
fn steps_are_explicit_again_when_a_motion_is_no_longer_stiff() {
    let text = Damped::Cart.text(0.0).replace(
        "damper (ground.W, mass.P) = 0;",
        "force on mass.P = (-1e6*exp(-4*t)*rate(x(mass)), 0);",
    );
    let mut fading = simulation(&text, 8.0, options(Method::Automatic, 1e-8));
    let steps_until = |simulation: &mut Simulation, t: f64| {
        simulation.advance(t).expect("no end");
        let effort = simulation.effort();
        [effort.steps, effort.implicit]
    };
    let early = steps_until(&mut fading, 0.5);
    let middle = steps_until(&mut fading, 6.0);
    let late = steps_until(&mut fading, 8.0);
    assert!(early[1] > 0, "{early:?}");
    assert!(
        late[0] > middle[0] && late[1] == middle[1],
        "{middle:?} {late:?}"
    );
}

/// Motions of a chain, whose errors are at most 20 tolerances.
fn compared(chain: DampedChain) -> [Found; 3] {
    let motion = chain.motion(2.0);
    [1e-4, 1e-6, 1e-8].map(|relative| {
        let comparison = chain.compared(&motion, 2.0, options(Method::Automatic, relative));
        let comparison = comparison.expect("no end");
        assert!(
            comparison.error <= 20.0 * relative,
            "{chain:?} {relative} {comparison:?}"
        );
        comparison
    })
}

/// Chains with these dampers, of two and of three bodies in turn; of both if more [`cases`] are requested.
fn chains(dampers: impl Iterator<Item = (Element, f64)>) -> impl Iterator<Item = DampedChain> {
    dampers.enumerate().flat_map(|(number, (element, damper))| {
        let counts = [2, 3].into_iter().cycle().skip(number % 2);
        let counts = counts.take(cases(1).min(2) as usize);
        counts.map(move |count| DampedChain {
            count,
            damper,
            element,
        })
    })
}

/// Dampers between two turning bodies make them move as one body: errors stay within tolerances for any damping.
#[test]
fn dampers_between_turning_bodies_leave_small_errors() {
    let about = [10.0, 1e3, 1e6, 1e8, 1e10].map(|damper| (Element::Joint, damper));
    let struts = [1e8, 1e10].map(|damper| (Element::Strut, damper));
    for chain in chains(about.into_iter().chain(struts)) {
        compared(chain);
    }
}

/// Torques and forces whose formulas are those of dampers act as dampers do.
#[test]
fn dampers_written_by_hand_leave_small_errors() {
    let torques = [1e5, 1e7, 1e8].map(|damper| (Element::Torques, damper));
    let forces = [1e7, 1e8].map(|damper| (Element::Forces, damper));
    for chain in chains(torques.into_iter().chain(forces)) {
        for found in compared(chain) {
            assert!(found.effort.evaluations <= 5000, "{chain:?} {found:?}");
        }
    }
}

/// The force of a strong damper is exact to rounding; tolerances near rounding do not make its step look too long.
#[test]
fn tolerances_near_rounding_are_kept() {
    for (element, damper) in [
        (Element::Joint, 1e6),
        (Element::Torques, 1e6),
        (Element::Strut, 1e8),
    ] {
        let chain = DampedChain {
            count: 2,
            damper,
            element,
        };
        let motion = chain.motion(2.0);
        for (relative, most) in [(1e-11, 10_000), (1e-12, 15_000)] {
            let run = chain.compared(&motion, 2.0, options(Method::Automatic, relative));
            let run = run.expect("no end");
            assert!(
                run.error <= 20.0 * relative && run.effort.evaluations <= most,
                "{chain:?} {relative} {run:?}"
            );
        }
    }
}

/// A drag along no coordinate takes thousands of steps; their errors do not accumulate.
#[test]
fn a_drag_that_turns_leaves_small_errors() {
    for drag in [10.0, 1e4, 1e6, 1e8] {
        for relative in [1e-4, 1e-6, 1e-8] {
            let run = Sled { drag }.compared(2.0, options(Method::Automatic, relative));
            let run = run.expect("no end");
            assert!(run.error <= 20.0 * relative, "{drag} {relative} {run:?}");
        }
    }
}

/// Steps limited by stability do not count as accurate ones: their error estimate misses the accumulated error.
#[test]
fn steps_that_stability_limits_become_implicit() {
    let chain = DampedChain {
        count: 2,
        damper: 1e3,
        element: Element::Strut,
    };
    let motion = chain.motion(2.0);
    for relative in [1e-6, 1e-7] {
        let run = chain.compared(&motion, 2.0, options(Method::Automatic, relative));
        let run = run.expect("no end");
        assert!(run.error <= 20.0 * relative, "{relative} {run:?}");
        assert!(run.effort.implicit > 0, "{run:?}");
    }
}
