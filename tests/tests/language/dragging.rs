//! Points of every description of the repository, dragged in its text: the changed text is read, the point is where it was dragged to,
//! and no other point has changed.

use std::fs;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::read;
use linkwright_codegen::stages::files::{attach_files, folder_of};
use linkwright_codegen::stages::system::Derived;
use linkwright_editing::{Coordinate, Description, Handle, handles, moved};
use linkwright_tests::files;
use linkwright_tests::random::Random;

/// Seed of the displacements.
const SEED: u64 = 0x6472_6167;

/// Largest displacement, as a share of the characteristic length.
const REACH: f64 = 0.01;

/// Points with their handles, and the equations; `None` if the text has errors.
fn of(source: &Source) -> Option<(Vec<Handle>, Derived)> {
    let read = read(source).ok()?;
    let derived = read.motions.into_iter().next()?;
    let description = Description::of(source.clone());
    let all = handles(&description, &derived.system.mechanism);
    Some((all, derived))
}

fn values(coordinates: &[Coordinate; 2]) -> [f64; 2] {
    coordinates.each_ref().map(|it| it.value)
}

/// Coordinates of a point in the frame of its body, as the equations have them; `None` for points that bodies carry from the drawing.
fn in_equations(handle: &Handle, derived: &Derived) -> Option<[f64; 2]> {
    let mechanism = &derived.system.mechanism;
    let is_body = |name: &str| match &handle.body {
        Some(body) => name == body,
        None => name == "ground",
    };
    let mut bodies = mechanism.bodies.iter();
    let body = bodies.find(|it| is_body(&it.name))?;
    let point = mechanism.points.iter().find(|it| it.name == handle.point)?;
    if point.mark.frame != body.frame {
        return None;
    }
    let [x, y] = point
        .mark
        .local
        .map(|it| derived.pool.graph.constant_value(it));
    Some([x?, y?])
}

/// Requires equal coordinates; the equations have exact decimals, which are rounded once, coordinates of handles twice.
fn assert_near(one: [f64; 2], other: [f64; 2], name: &str) {
    for (one, other) in one.iter().zip(other) {
        assert!(
            (one - other).abs() <= f64::EPSILON * other.abs(),
            "{one}, {other}: {name}"
        );
    }
}

#[test]
fn every_dragged_point_is_where_it_was_dragged_to() {
    let mut random = Random::new(SEED);
    let [mut dragged, mut compared, mut left] = [0; 3];
    for folder in ["../mechanisms", "descriptions"] {
        for path in files::with_extension(&files::package(folder), "mech") {
            let text = fs::read_to_string(&path).expect("a description");
            let source = Source::new(path.display().to_string(), text);
            let source = attach_files(source, folder_of(&path));
            let Some((before, derived)) = of(&source) else {
                continue;
            };
            let scale = derived.system.mechanism.characteristic_length;
            for (place, handle) in before.iter().enumerate() {
                let Ok(coordinates) = &handle.coordinates else {
                    left += 1;
                    continue;
                };
                if let Some(position) = in_equations(handle, &derived) {
                    assert_near(position, values(coordinates), &handle.point);
                }
                let target =
                    values(coordinates).map(|it| it + scale * random.between(-REACH, REACH));
                let edits = moved(&source.text, handle, target).expect("a point to drag");
                let mut changed = source.clone();
                for edit in edits.iter().rev() {
                    changed.text.replace_range(edit.span.range(), &edit.text);
                }
                let name = format!("{} of {}\n{}", handle.point, source.name, changed.text);
                let (after, derived) = of(&changed).unwrap_or_else(|| panic!("errors: {name}"));
                assert_eq!(after.len(), before.len(), "{name}");
                for (other, (one, two)) in before.iter().zip(&after).enumerate() {
                    assert_eq!((&one.point, &one.body), (&two.point, &two.body), "{name}");
                    let [one, two] = [one, two].map(|it| it.coordinates.as_ref().map(values));
                    if other != place {
                        assert_eq!(one, two, "{name}");
                    }
                }
                let position = after[place].coordinates.as_ref().map(values);
                let position = position.unwrap_or_else(|why| panic!("{why}: {name}"));
                for (value, target) in position.iter().zip(target) {
                    let step = scale * 1e-4;
                    assert!((value - target).abs() <= 0.5001 * step, "{value}: {name}");
                }
                if let Some(written) = in_equations(&after[place], &derived) {
                    assert_near(written, position, &name);
                    compared += 1;
                }
                dragged += 1;
            }
        }
    }
    println!(
        "{dragged} points are dragged, {compared} of them compared with the equations; {left} are not written as numbers"
    );
    assert!(dragged > 400 && compared > 100 && left > 50);
}
