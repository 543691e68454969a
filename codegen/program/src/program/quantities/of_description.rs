//! Names the quantities that a description states: values, lengths and coordinates of points, angles, drivers.

use std::collections::HashMap;

use super::links::LinkName;
use super::{EQUALITY_TOLERANCE, Quantities, between, both, drivers, upper};
use crate::expr::Graph;
use crate::joint::geometry::Vector;
use crate::model::Mechanism;
use crate::pool::Pool;
use crate::system::System;

/// Largest number of points of a body whose distances have names.
const MOST_POINTS: usize = 12;

/// Quantities of a description.
#[derive(Clone, Debug, Default)]
pub struct Described {
    /// Whole terms: initial values of drivers, given positions, named values.
    pub terms: Quantities,
    /// Lengths of rods along an axis of their bodies, by the angle of the body.
    pub rods: HashMap<usize, Quantities>,
    /// Coordinates and directions on bodies, by the angle of the body.
    pub coordinates: HashMap<usize, Quantities>,
    /// All of these.
    pub general: Quantities,
}

/// Named point of a body with its coordinates, in m.
struct Place {
    name: String,
    at: [f64; 2],
}

impl Described {
    /// Returns the quantities of a system.
    pub(in crate::program) fn of(pool: &Pool, system: &System) -> Described {
        let mechanism = &system.mechanism;
        let mut described = Described::default();
        drivers::add(&mut described.terms, pool, system);
        let graph = &pool.graph;
        for constant in &mechanism.constants {
            let value = graph.constant_value(constant.value);
            if let Some(value) = value.filter(|_| graph.is_constant(constant.value)) {
                let stem = apart(upper(&constant.name), mechanism);
                let words = constant.name.clone();
                described.terms.add(["", "_VALUE"], &stem, words, value);
            }
        }
        described.general.extend(&described.terms);
        for body in 0..mechanism.bodies.len() {
            let (mut lengths, mut coordinates) = (Quantities::default(), Quantities::default());
            let (rod, links) = links(body, graph, mechanism);
            for (link, [from, to]) in &links {
                lengths.add_link(link);
                add_directions(&mut coordinates, link, *from, *to);
            }
            add_places(&mut coordinates, body, graph, mechanism);
            described.general.extend(&lengths);
            described.general.extend(&coordinates);
            let angles = angles_of(body, system);
            if angles.is_empty() {
                described.terms.extend(&coordinates);
            }
            for angle in angles {
                if let Some(rod) = rod.as_ref().filter(|_| is_along_axis(&links)) {
                    let words = format!("|{}|", rod.words);
                    let rods = described.rods.entry(angle).or_default();
                    rods.add(["", "_LENGTH"], &rod.stem, words, rod.length);
                }
                let of_angle = described.coordinates.entry(angle).or_default();
                of_angle.extend(&lengths);
                of_angle.extend(&coordinates);
            }
        }
        described
    }
}

/// Returns the unknown angle of a body, and that of the body that it follows; none of the ground.
fn angles_of(body: usize, system: &System) -> Vec<usize> {
    let first = (body > 0).then(|| system.vector_form.angle_of(body));
    let mut angles: Vec<usize> = first.into_iter().chain(angle_of(body, system)).collect();
    angles.dedup();
    angles
}

/// Returns the unknown angle that rotates a body; `None` if the body does not rotate.
fn angle_of(body: usize, system: &System) -> Option<usize> {
    let frame = system.mechanism.bodies[body].frame;
    let (leader, _) = system.vector_form.orientations.leader(frame.body);
    (leader.0 > 0).then(|| system.vector_form.angle_of(leader.0))
}

/// Returns the link of this length that rotates with an angle, or else one named after the body; `None` if no body rotates with
/// the angle.
pub(in crate::program) fn arm_of(
    angle: usize,
    length: f64,
    graph: &Graph,
    system: &System,
) -> Option<LinkName> {
    let mechanism = &system.mechanism;
    let bodies = 1..mechanism.bodies.len();
    let rotated: Vec<usize> = bodies
        .filter(|&body| angle_of(body, system) == Some(angle))
        .collect();
    for &body in &rotated {
        let (_, links) = links(body, graph, mechanism);
        let is_equal = |it: &LinkName| (it.length - length).abs() <= EQUALITY_TOLERANCE * length;
        if let Some((link, _)) = links.into_iter().find(|(link, _)| is_equal(link)) {
            return Some(link);
        }
    }
    let body = *rotated.first()?;
    Some(LinkName {
        stem: format!("{}_ARM", body_stem(body, mechanism)),
        words: format!("arm on {}", mechanism.bodies[body].name),
        length,
    })
}

/// Returns the rods of a mechanism.
pub(in crate::program) fn rods(graph: &Graph, mechanism: &Mechanism) -> Vec<LinkName> {
    let bodies = 1..mechanism.bodies.len();
    bodies
        .filter_map(|body| links(body, graph, mechanism).0)
        .collect()
}

/// Adds coordinates of the named points of a body, and their distances from its origin.
fn add_places(list: &mut Quantities, body: usize, graph: &Graph, mechanism: &Mechanism) {
    let on = &mechanism.bodies[body].name;
    for Place { name, at } in named(body, graph, mechanism) {
        let stem = format!("{}_{}", upper(&name), body_stem(body, mechanism));
        for (value, (suffix, axis)) in at.into_iter().zip([("_X", "x"), ("_Y", "y")]) {
            list.add(
                ["", suffix],
                &stem,
                format!("{axis} of {name} on {on}"),
                value,
            );
        }
        let words = format!("distance of {name} from the origin of {on}");
        list.add(["", "_DISTANCE"], &stem, words, at[0].hypot(at[1]));
    }
}

/// Returns the links between all pins of a body with their ends, and the only one if the body is a rod.
#[expect(clippy::type_complexity, reason = "links with their ends")]
fn links(
    body: usize,
    graph: &Graph,
    mechanism: &Mechanism,
) -> (Option<LinkName>, Vec<(LinkName, [[f64; 2]; 2])>) {
    let places = pins(body, graph, mechanism);
    let is_rod = body > 0 && places.len() == 2;
    let links = pairs(&places).into_iter().map(|[from, to]| {
        let stem = match is_rod {
            true => body_stem(body, mechanism),
            false => apart(both(&from.name, &to.name), mechanism),
        };
        let link = LinkName {
            stem,
            words: between(&from.name, &to.name),
            length: (to.at[0] - from.at[0]).hypot(to.at[1] - from.at[1]),
        };
        (link, [from.at, to.at])
    });
    let links: Vec<_> = links.collect();
    let rod = links.first().map(|it| it.0.clone()).filter(|_| is_rod);
    (rod, links)
}

/// True if the first link lies along an axis of its body.
fn is_along_axis(links: &[(LinkName, [[f64; 2]; 2])]) -> bool {
    let first = links.first();
    first.is_some_and(|(_, [from, to])| from[0] == to[0] || from[1] == to[1])
}

/// Adds the direction of a line between two points: components of the unit vector, of the vector, and the angle.
fn add_directions(list: &mut Quantities, link: &LinkName, from: [f64; 2], to: [f64; 2]) {
    let LinkName {
        stem,
        words,
        length,
    } = link;
    let parts = [to[0] - from[0], to[1] - from[1]];
    let axes = [
        ("x", "_DIRECTION_X", "_X", "_X_OVER_LENGTH_SQUARED"),
        ("y", "_DIRECTION_Y", "_Y", "_Y_OVER_LENGTH_SQUARED"),
    ];
    for (part, (axis, direction, component, over)) in parts.into_iter().zip(axes) {
        let whole = format!("{axis}({words})");
        list.add(
            ["", direction],
            stem,
            format!("{whole}/|{words}|"),
            part / length,
        );
        list.add(["", component], stem, whole.clone(), part);
        let square = length * length;
        list.add(
            ["", over],
            stem,
            format!("{whole}/|{words}|^2"),
            part / square,
        );
    }
    for (opposite, sign) in [("", 1.0), ("-", -1.0)] {
        let angle = f64::atan2(sign * parts[1], sign * parts[0]);
        list.add(
            ["", "_ANGLE"],
            stem,
            format!("angle of {opposite}{words}"),
            angle,
        );
    }
}

/// True if a moving body has two pins, so that its length is that between them.
pub(super) fn is_rod(body: usize, graph: &Graph, mechanism: &Mechanism) -> bool {
    body > 0 && pins(body, graph, mechanism).len() == 2
}

/// Returns a body as part of a name: `COUPLER`, or `BODY_2` for numbered bodies.
pub(super) fn body_stem(body: usize, mechanism: &Mechanism) -> String {
    apart(upper(&mechanism.bodies[body].name), mechanism)
}

/// Returns a stem that begins no name of generated items.
fn apart(stem: String, mechanism: &Mechanism) -> String {
    let prefix = format!("{}_", mechanism.name.to_uppercase());
    let begins = |start: &str| format!("{stem}_").starts_with(start);
    let is_name = stem.starts_with(|it: char| it.is_ascii_alphabetic());
    match is_name && !["TABLE_", "LINKWRIGHT_", &prefix].into_iter().any(begins) {
        true => stem,
        false => format!("BODY_{stem}"),
    }
}

/// Returns all pairs of points; none if there are too many points.
fn pairs(places: &[Place]) -> Vec<[&Place; 2]> {
    let few = if places.len() <= MOST_POINTS {
        places
    } else {
        &[]
    };
    let pairs = few.iter().enumerate().flat_map(|(place, from)| {
        let later = few[place + 1..].iter();
        later.map(move |to| [from, to])
    });
    pairs.collect()
}

/// Returns the points of a body that joints use: named ones in written order, then the origin.
fn pins(body: usize, graph: &Graph, mechanism: &Mechanism) -> Vec<Place> {
    let joints = mechanism.joints.iter();
    let marks = joints.flat_map(|joint| &joint.operands.marks);
    let used: Vec<Vector> = marks
        .filter(|mark| mark.frame.body.0 == body)
        .map(|mark| mark.local)
        .collect();
    let marks = mechanism.bodies[body].marks.iter();
    let marks = marks.map(|mark| (mark.name.as_str(), mark.mark.local));
    let zero = graph.zero();
    let origin = ("origin", [zero, zero]);
    let marks = marks.chain((body > 0).then_some(origin));
    places(marks.filter(|(_, local)| used.contains(local)), graph)
}

/// Returns all named points of a body.
fn named(body: usize, graph: &Graph, mechanism: &Mechanism) -> Vec<Place> {
    let marks = mechanism.bodies[body].marks.iter();
    places(
        marks.map(|mark| (mark.name.as_str(), mark.mark.local)),
        graph,
    )
}

/// Returns the points with constant coordinates, each position once.
fn places<'a>(marks: impl Iterator<Item = (&'a str, Vector)>, graph: &Graph) -> Vec<Place> {
    let mut places: Vec<Place> = Vec::new();
    for (name, local) in marks {
        let [x, y] = local.map(|part| {
            let value = graph.constant_value(part);
            value.filter(|_| graph.is_constant(part))
        });
        if let (Some(x), Some(y)) = (x, y)
            && places.iter().all(|it| it.at != [x, y])
        {
            places.push(Place {
                name: name.to_string(),
                at: [x, y],
            });
        }
    }
    places
}
