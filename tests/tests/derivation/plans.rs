//! Plans of every described mechanism are those of a textbook solution.

use linkwright_codegen::stages::program::Kept;
use linkwright_codegen::stages::solved::Solved;
use linkwright_codegen::stages::structure::Shift;
use linkwright_tests::description;
use linkwright_tests::plan::form_names;

/// Blocks and their kinds. The slider of the slider-crank moves along a fixed axis, so that its rod has an equation
/// of its own. The choice of the bodies' frames has no influence: the excavator is described twice.
#[test]
fn every_mechanism_is_solved_as_a_person_would() {
    let two_rotations = "RRR dyad";
    let plans: [(&str, Vec<&str>); 21] = [
        ("andrews", vec![two_rotations; 3]),
        ("arm", vec![two_rotations; 4]),
        ("cam_dwell", vec!["Newton of size 1"]),
        ("disc_cam", vec!["Newton of size 1"]),
        ("double_wishbone", vec!["Newton of size 1 for 3 unknowns"]),
        ("excavator", vec![two_rotations; 4]),
        ("excavator_pins", vec![two_rotations; 4]),
        ("four_bar", vec![two_rotations]),
        ("inverted_slider_crank", vec!["RPR dyad"]),
        ("jansen", vec![two_rotations; 3]),
        ("pantograph", vec![two_rotations; 2]),
        ("peaucellier", vec![two_rotations; 3]),
        ("planetary_gear", vec![]),
        ("platform_3rpr", vec!["Newton of size 1 for 4 unknowns"]),
        ("quick_return", vec!["RPR dyad", "one angle"]),
        ("rack_steering", vec![two_rotations; 2]),
        ("scissor", vec![two_rotations; 6]),
        ("scotch_yoke", vec![]),
        ("slider_crank", vec!["one angle"]),
        ("stephenson", vec!["Newton of size 1 for 4 unknowns"]),
        ("two_body", vec!["one angle"]),
    ];
    let names: Vec<&str> = plans.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, description::whole());
    let mut wrong = Vec::new();
    for (name, wanted) in plans {
        let methods = form_names(name);
        if methods != wanted {
            wrong.push(format!("{name}: {methods:?} instead of {wanted:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Both shifts give one plan exactly if they apply alike, so that nothing needs to be planned for each of them.
#[test]
fn shifts_that_apply_alike_give_one_plan() {
    let mut counts = [0, 0];
    let names = [description::names(), description::small()].concat();
    for derived in names.iter().flat_map(|name| description::motions(name)) {
        let shifts = [Shift::Directions, Shift::Efforts];
        let [coded, printed] = shifts.map(|shift| {
            let solved = Solved::of(derived.clone(), shift, Kept::Methods);
            solved.expect("a plan").plan().clone()
        });
        let [for_code, for_print] = shifts.map(|shift| shift.applies(&derived.system));
        let is_one = coded == printed;
        assert_eq!(
            is_one,
            for_code == for_print,
            "{}",
            derived.system.mechanism.title()
        );
        counts[usize::from(is_one)] += 1;
    }
    assert!(counts.iter().all(|&count| count > 0), "{counts:?}");
}
