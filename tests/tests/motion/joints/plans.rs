//! Solution methods of the joints' mechanisms: all closed forms of the textbook are used.

use linkwright_tests::plan::form_names;

#[test]
fn every_joint_is_solved_as_a_person_would() {
    let two_rotations = ["RRR dyad"];
    let plans: [(&str, &[&str]); 14] = [
        ("held_at_distance", &two_rotations),
        ("ellipse_sliders", &["one angle"]),
        ("coupled_rockers", &two_rotations),
        ("pushed_apart", &two_rotations),
        ("slotted_link", &["RPR dyad"]),
        ("offset_slot", &["RPR dyad"]),
        ("rolling_pinion", &["PRP or RPP dyad"]),
        ("following", &[]),
        ("welded", &[]),
        ("driven_tip", &two_rotations),
        ("planetary", &[]),
        ("belt_drive", &[]),
        ("geared_cranks", &two_rotations),
        ("driven_coupler", &two_rotations),
    ];
    for (name, wanted) in plans {
        assert_eq!(form_names(name), wanted, "{name}");
    }
    assert_eq!(
        form_names("platform_on_cylinders"),
        ["Newton of size 1 for 4 unknowns"]
    );
    // Four angles of one loop, of which the gears tie two.
    assert_eq!(
        form_names("mirrored_cranks"),
        ["Newton of size 1 for 3 unknowns"]
    );
}
