//! Lengths that inputs or t drive: where they are not positive there is no frame, as where a description states such a length.

use std::f64::consts::FRAC_PI_2;

use linkwright::{Blocks, FailureKind, Settings, Signal};
use linkwright_solver::{Interpreted, View};
use linkwright_tests::description;
use linkwright_tests::values::assembled_with;

mod winch {
    linkwright::include_mechanism!(winch);
}

mod hauled {
    linkwright::include_mechanism!(hauled);
}

use hauled::Hauled;
use winch::{Inputs, Winch};

fn rope(length: f64) -> Inputs {
    Inputs {
        rope: Signal::constant(length),
    }
}

#[test]
fn an_input_that_makes_a_length_not_positive_is_refused() {
    let said = |figure: &str| {
        format!(
            "drive distance(ground.W, boom.H): the distance must be positive, and would be {figure}"
        )
    };
    let mut winch = Winch::assemble(2.0, &rope(0.6)).expect("the drawing assembles");
    for (length, figure) in [
        (-0.6, "-0.600"),
        (-1e-9, "-1.0e-9"),
        (-4.0, "-4.00"),
        (-0.0, "0"),
        (0.0, "0"),
    ] {
        let before = *winch.frame();
        for t in [2.0, 2.001, 7.0] {
            let failures = [
                winch.advance(t, &rope(length)).map(|_| ()),
                winch.frame_at(t, &rope(length)).map(|_| ()),
                winch.recover(t, &rope(length)).map(|_| ()),
                Winch::assemble(t, &rope(length)).map(|_| ()),
            ];
            for failure in failures {
                let failure = failure.expect_err("no length is negative");
                assert_eq!(failure.kind, FailureKind::NotPositive { value: length });
                assert_eq!(failure.time, t);
                let text = winch::describe(&failure).to_string();
                assert!(text.starts_with(&said(figure)), "{text}");
            }
        }
        assert_eq!(*winch.frame(), before);
    }
    winch.advance(2.001, &rope(0.61)).expect("within reach");
}

#[test]
fn a_law_of_time_ends_where_its_length_does() {
    // Both links from the pivot are 0.4 m long, so the triangle closes for every length up to 0.8 m.
    let mut hauled = Hauled::assemble(0.0).expect("the drawing assembles");
    let inside = hauled.frame_at(1.5).expect("0.035 m").q.phi_boom;
    // The boom is turned by the apex of an isosceles triangle; in the drawing it encloses atan(4/3) with the line to the winch.
    let half = 0.25 * 1.5_f64.cos();
    let expected = 2.0 * (half / 0.4).asin() - (4.0_f64 / 3.0).atan();
    assert!((inside - expected).abs() < 1e-12, "{inside} {expected}");
    for t in [1.6, 3.0, 4.7] {
        let failure = hauled.frame_at(t).expect_err("the length is negative");
        let value = 0.5 * t.cos();
        match failure.kind {
            FailureKind::NotPositive { value: found } => assert!((found - value).abs() < 1e-15),
            _ => panic!("{failure}"),
        }
        assert_eq!((failure.time, failure.block), (t, 0));
    }
    for t in [1.6, 3.0, 4.7] {
        let failure = hauled.advance(t).expect_err("the length is negative");
        assert!(
            matches!(failure.kind, FailureKind::NotPositive { .. }),
            "{failure}"
        );
        assert!((failure.time - FRAC_PI_2).abs() < 1e-9, "{failure}");
        assert_eq!(hauled.frame().t, 0.0);
    }
    hauled.advance(1.57).expect("4e-4 m are left");
}

#[test]
fn what_is_interpreted_refuses_them_too() {
    let interpreted = Interpreted::new(&description::system("hauled")).expect("its blocks");
    let (laws, settings) = (interpreted.input_laws(), Settings::default());
    let shell = assembled_with(interpreted.clone(), &[], 0.0, &laws.at(0.0), settings);
    let shell = shell.expect("the drawing assembles");
    let failure = shell.frame_at(3.0, &laws.at(3.0));
    let failure = failure.expect_err("the length is negative");
    let value = 0.5 * 3.0_f64.cos();
    assert!(
        matches!(failure.kind, FailureKind::NotPositive { value: found } if (found - value).abs() < 1e-15)
    );
    let said = interpreted.explained(&failure).to_string();
    assert!(
        said.starts_with("drive distance(ground.W, boom.H): the distance must be positive"),
        "{said}"
    );
}
