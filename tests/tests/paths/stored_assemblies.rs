//! The assemblies that generated modules store: they are those that the solver proves to be all, under the same labels, and each is the
//! one that is found when it is asked for, in generated code and by its letter.

use std::f64::consts::TAU;

use linkwright_solver::assemblies::assemblies;
use linkwright_solver::{Assemblies, Interpreted, ModeSelection, View};
use linkwright_tests::description::{motions, written};

/// Descriptions in the middle of the code, each with its text.
macro_rules! described {
    ($($name:ident: { $($text:tt)* })*) => {$(
        mod $name {
            linkwright_macros::mechanism! { pub $($text)* }
            pub const TEXT: &str = stringify!($($text)*);
        }
    )*};
}

described! {
    six: {
        mechanism six {
            point A = (-0.35, 0.35), B = (0.14, 0.15), C = (-0.99, -0.85);
            body platform at (0.25490278778833248, 0.76949078446582015, -2.358515217542195) {
                P: (0.6, 0.6), Q: (-0.78, -0.77), R: (0.36, 0.74)
            }
            drive distance(ground.A, platform.P) = 0.74;
            drive distance(ground.B, platform.Q) = 1.72;
            drive distance(ground.C, platform.R) = 1.73;
        }
    }
    butterfly: {
        mechanism butterfly {
            point A = (0, 0), B = (6.17, 0), C = (-0.21, 1.94), D = (1.4, 0.48), E = (2.69, 3.37);
            point F = (5.84, 3.17), G = (5.37, 1.82), H = (3.63, 1.03), I = (4.67, -1.09), J = (4.13, 2.05);
            body acd at A { A, C, D }
            body ce at C { C, E }
            body efg at E { E, F, G }
            body bfj at B { B, F, J }
            body dhi at D { D, H, I }
            body gh at G { G, H }
            body ij at I { I, J }
            revolute A(ground, acd);
            revolute B(ground, bfj);
            revolute C(acd, ce);
            revolute D(acd, dhi);
            revolute E(ce, efg);
            revolute F(efg, bfj);
            revolute G(efg, gh);
            revolute H(dhi, gh);
            revolute I(dhi, ij);
            revolute J(bfj, ij);
            drive phi(acd) = 0.1*sin(t);
        }
    }
    carried: {
        mechanism carried {
            point O = (0, 0), K = (0.1, 0), L = (0.3, 0.4), U = (0.5, 0);
            point A = (0.45, 0.1), B = (1.4, 0.1), C = (0.9, 1.5);
            body crank at O { O, K }
            body coupler at K { K, L, A }
            body rocker at U { U, L }
            body platform at (0.8, 0.7, 0.2) { P: (-0.2, -0.1), Q: (0.25, -0.15), R: (0, 0.3) }
            revolute O(ground, crank);
            revolute K(crank, coupler);
            revolute L(coupler, rocker);
            revolute U(ground, rocker);
            drive phi(crank) = t;
            drive distance(coupler.A, platform.P) = 0.9;
            drive distance(ground.B, platform.Q) = 0.8;
            drive distance(ground.C, platform.R) = 0.9;
        }
    }
}

fn is_turned_wholly(angle: f64) -> bool {
    (angle - TAU * (angle / TAU).round()).abs() < 1e-11
}

/// Whether two poses differ by whole turns of bodies at most.
fn is_same(one: &[f64], other: &[f64]) -> bool {
    let pairs = one.iter().zip(other).enumerate();
    one.len() == other.len()
        && pairs.into_iter().all(|(place, (a, b))| match place % 3 {
            2 => is_turned_wholly(a - b),
            _ => (a - b).abs() < 1e-11,
        })
}

/// What is stored is what is proven, and the poses are those that are found with them.
fn compare(all: &Assemblies, labels: &[&str], poses: &[Vec<f64>]) {
    assert!(all.proven && all.undecided.is_empty());
    let proven = all.found.iter().map(|it| it.label());
    let mut proven: Vec<String> = proven.collect();
    proven.sort();
    let mut stored = labels.to_vec();
    stored.sort();
    assert_eq!(proven, stored);
    for (label, pose) in labels.iter().zip(poses) {
        let own = all.found.iter().find(|it| it.label() == *label);
        let own = own.expect("a label of the solver").instant.q();
        assert!(is_same(own, pose), "{label}: {own:?} {pose:?}");
    }
}

/// Assembles a generated mechanism on all of its stored assemblies, and compares them.
macro_rules! stored {
    ($module:path, $type:ident, $system:expr) => {{
        use $module as module;
        let all = assemblies(&Interpreted::new(&$system).expect("a plan"), 0.0);
        let poses = module::Branches::ASSEMBLIES.map(|branches| {
            let assembled = module::$type::assemble_on(branches, 0.0).expect("an assembly");
            // From here on only its signs are known.
            assert_eq!(assembled.branches().assembly, None);
            let signs = module::Branches {
                assembly: None,
                ..branches
            };
            assert_eq!(assembled.branches(), signs);
            assembled.frame().q.to_array().to_vec()
        });
        for (label, branches) in module::Branches::LABELS
            .iter()
            .zip(module::Branches::ASSEMBLIES)
        {
            assert_eq!(module::Branches::labelled(label), Some(branches));
        }
        assert_eq!(module::Branches::labelled("?"), None);
        compare(&all, &module::Branches::LABELS, &poses);
        all.found.len()
    }};
}

#[test]
fn stored_assemblies_are_those_that_are_proven() {
    assert_eq!(stored!(six::six, Six, written(six::TEXT)), 6);
    assert_eq!(
        stored!(butterfly::butterfly, Butterfly, written(butterfly::TEXT)),
        8
    );
    let gallery = |name: &str| motions(name).remove(0);
    let platform = gallery("platform_3rpr");
    stored!(linkwright_mechanisms::platform_3rpr, Platform3rpr, platform);
    let stephenson = gallery("stephenson");
    assert_eq!(
        stored!(linkwright_mechanisms::stephenson, Stephenson, stephenson),
        4
    );
    let wishbone = gallery("double_wishbone");
    stored!(
        linkwright_mechanisms::double_wishbone,
        DoubleWishbone,
        wishbone
    );
}

/// Which assemblies of the platform there are depends on the mode of the four-bar that carries one of its legs.
#[test]
fn signs_of_loops_before_are_part_of_what_is_stored() {
    let found = stored!(carried::carried, Carried, written(carried::TEXT));
    let labels = carried::carried::Branches::LABELS;
    assert_eq!(found, 4);
    for sign in ["+", "-"] {
        assert!(
            labels.iter().any(|label| label.starts_with(sign)),
            "{labels:?}"
        );
    }
}

/// `--branch` reads these wishes.
#[test]
fn every_assembly_is_found_by_its_letter() {
    for (text, count) in [(six::TEXT, 6), (butterfly::TEXT, 8)] {
        let interpreted = Interpreted::new(&written(text)).expect("a plan");
        let all = assemblies(&interpreted, 0.0);
        assert_eq!(all.found.len(), count);
        let names = interpreted.mode_names();
        let [only] = &names[..] else {
            panic!("one loop: {names:?}")
        };
        for own in &all.found {
            let wish = format!("{}={}", only.name, own.label());
            let wishes = ModeSelection::read(&interpreted, &[wish]).expect("a wish");
            let (instant, _) = wishes.assembled(&interpreted, 0.0).expect("a pose");
            assert!(is_same(instant.q(), own.instant.q()), "{}", own.label());
        }
    }
}

/// At another time the letter leads to the pose that has moved on from it, as long as that is near.
#[test]
fn a_stored_assembly_is_where_the_motion_begins() {
    use linkwright_mechanisms::stephenson::{Branches, Stephenson};
    for branches in Branches::ASSEMBLIES {
        let mut followed = Stephenson::assemble_on(branches, 0.0).expect("an assembly");
        for step in 1..=10 {
            let t = 0.001 * f64::from(step);
            followed.advance(t).expect("a regular pose");
        }
        let there = Stephenson::assemble_on(branches, 0.01).expect("an assembly");
        let (one, other) = (followed.frame().q.to_array(), there.frame().q.to_array());
        assert!(is_same(&one, &other), "{one:?} {other:?}");
    }
}
