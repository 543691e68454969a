//! Names of a scene, and their possible positions.

use super::dimension::{Dimension, DimensionLines};
use super::extras::Gap;
use super::figure::{Figure, Frame, Look, Outline, Trace, offset_edges};
use super::label::{Anchor, Label};
use super::letters::width;
use super::obstacles::Obstacles;
use super::plane::{Bounds, Point, difference, distance, heading, hull, left_of, onward, scaled};
use super::pose::{At, Scene};

/// Size of letters in pixels.
pub(super) const SIZE: f64 = 13.0;

/// Object of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Named {
    /// A point, by its number among the points with names.
    Point(usize),
    /// A body.
    Body(usize),
    /// Gap between two points that should coincide.
    Gap,
}

/// A name with its label.
#[derive(Clone, Debug)]
pub(super) struct Name {
    pub of: Named,
    pub text: String,
    pub label: Label,
}

/// Number of directions around a point in which a name may stand.
const DIRECTIONS: usize = 16;

/// Largest number of names; more are unreadable and left out.
const NAMED: usize = 250;

/// The names of all points and of all moving bodies.
pub(super) fn names(scene: &Scene, figure: &Figure, unit: f64) -> Vec<Name> {
    let mut names: Vec<Name> = Vec::new();
    if scene.points.len() + scene.bodies.len() > NAMED {
        return names;
    }
    let mut seen: Vec<(&str, Point)> = Vec::new();
    let place = |at: At| scaled(scene.global(at), figure.scale);
    for (number, point) in scene.points.iter().enumerate() {
        let there = place(point.at);
        // Points of one name at one position look like one point.
        let mut namesakes = scene.points.iter().filter(|it| it.written == point.written);
        let text = match namesakes.all(|it| distance(place(it.at), there) < 1.0) {
            true => &point.written,
            false => &point.name,
        };
        if seen
            .iter()
            .any(|(name, it)| name == text && distance(*it, there) < 1.0)
        {
            continue;
        }
        seen.push((text, there));
        names.push(Name {
            of: Named::Point(number),
            text: text.clone(),
            label: Label {
                half: [0.5 * width(text, SIZE), 0.5 * SIZE],
                anchors: around(there, 8.5 * unit),
                owner: None,
            },
        });
    }
    for (body, carried) in scene.bodies.iter().enumerate().skip(1) {
        names.push(Name {
            of: Named::Body(body),
            text: carried.name.clone(),
            label: Label {
                half: [0.5 * width(&carried.name, SIZE) + 5.0, 0.5 * SIZE + 2.0],
                anchors: beside(figure, body, width(&carried.name, SIZE)),
                owner: Some(body),
            },
        });
    }
    names
}

/// Length of a gap, beside the line that is drawn across it.
pub(super) fn missing(gap: &Gap, figure: &Figure) -> Name {
    let [a, b] = gap.ends.map(|it| scaled(it, figure.scale));
    let half = [0.5 * width(&gap.text, SIZE), 0.5 * SIZE];
    let mut anchors = Vec::new();
    for [from, to] in [[a, b], [b, a]] {
        edge(&mut anchors, from, to);
    }
    if anchors.is_empty() {
        anchors = around(a, 10.0);
    }
    let anchor = |it: Anchor| Anchor { gap: 5.0, ..it };
    Name {
        of: Named::Gap,
        text: gap.text.clone(),
        label: Label {
            half,
            anchors: anchors.into_iter().map(anchor).collect(),
            owner: None,
        },
    }
}

/// Outlines that names avoid.
pub(super) fn obstacles(figure: &Figure) -> Obstacles {
    let mut obstacles = Obstacles::default();
    for (place, group) in figure.bodies.iter().enumerate() {
        for trace in figure.traces(group) {
            obstacles.add(&trace, Some(place + 1));
        }
    }
    for group in figure.joints.iter().chain(&figure.extras) {
        for trace in figure.traces(group) {
            obstacles.add(&trace, None);
        }
    }
    for drawn in figure.dimensions.iter().map(Dimension::lines) {
        for line in &drawn.lines {
            obstacles.add(&Trace::edge(*line), None);
        }
        let corners = drawn.text_corners();
        match drawn.text_angle == 0.0 {
            true => obstacles.taken.push(Bounds::of(corners)),
            // Boxes along the axes cover an inclined text in pieces.
            false => obstacles.taken.extend(pieces(&drawn)),
        }
    }
    obstacles
}

/// Boxes along the text of a dimension.
fn pieces(drawn: &DimensionLines) -> impl Iterator<Item = Bounds> {
    let [half, height] = drawn.text_half;
    let along = heading(drawn.text_angle);
    let count = (half / height).ceil().max(1.0);
    (0..=count as usize).map(move |piece| {
        let part = 2.0 * piece as f64 / count - 1.0;
        let center = onward(drawn.text_at, part * (half - height), along);
        Bounds::around(center, [height; 2])
    })
}

/// Anchors around a point, preferably to the upper right.
pub(super) fn around(at: Point, gap: f64) -> Vec<Anchor> {
    let anchor = |direction: usize| {
        let angle = std::f64::consts::TAU * direction as f64 / DIRECTIONS as f64;
        let out = heading(angle);
        let dislike = (angle - std::f64::consts::FRAC_PI_4).cos();
        // The corner of a box comes nearer to a point than its side.
        let gap = gap - 4.5 * (2.0 * angle).sin().abs();
        Anchor {
            at,
            out,
            gap,
            cost: 1.0 - dislike,
        }
    };
    (0..DIRECTIONS).map(anchor).collect()
}

/// Anchors beside the shape of a body, or upon it if it is large.
fn beside(figure: &Figure, body: usize, width: f64) -> Vec<Anchor> {
    let place = figure.stance.places[body];
    let mut anchors = Vec::new();
    let upon = |at: Point, cost: f64| Anchor {
        at: place.globally(at),
        out: [0.0; 2],
        gap: 0.0,
        cost,
    };
    let group = &figure.bodies[body - 1];
    let elements = group.parts().flat_map(|part| &part.elements);
    let elements: Vec<&Outline> = elements
        .filter(|it| matches!(it.look, Look::Body | Look::Disc))
        .map(|it| &it.outline)
        .collect();
    for outline in &elements {
        match outline {
            Outline::Circle(center, radius) => {
                anchors.extend(around(place.globally(*center), radius + 3.0));
                if *radius < width.max(40.0) {
                    continue;
                }
                let inner = around(*center, 0.6 * radius);
                anchors.extend(inner.into_iter().map(|it| {
                    let at = [0, 1].map(|axis| center[axis] + it.gap * it.out[axis]);
                    upon(at, 1.0)
                }));
            }
            Outline::Ring(center, inner, outer) => {
                let center = place.globally(*center);
                anchors.extend(around(center, outer + 3.0));
                let inward = around(center, 0.0).into_iter().map(|it| Anchor {
                    at: [center[0] + inner * it.out[0], center[1] + inner * it.out[1]],
                    out: scaled(it.out, -1.0),
                    gap: 3.0,
                    cost: 1.5,
                });
                anchors.extend(inward);
            }
            Outline::Rounded(corners, radius) if corners.len() > 1 => {
                for [a, b] in offset_edges(corners, *radius) {
                    edge(&mut anchors, place.globally(a), place.globally(b));
                }
                if corners.len() > 2 {
                    let count = corners.len() as f64;
                    let sum = corners.iter().fold([0.0; 2], |sum, it| {
                        [sum[0] + it[0] / count, sum[1] + it[1] / count]
                    });
                    anchors.push(upon(sum, -1.0));
                    for corner in corners {
                        let at = [
                            0.7 * sum[0] + 0.3 * corner[0],
                            0.7 * sum[1] + 0.3 * corner[1],
                        ];
                        anchors.push(upon(at, 0.0));
                    }
                }
            }
            Outline::Rounded(corners, radius) if corners.len() == 1 => {
                anchors.extend(around(place.globally(corners[0]), radius + 3.0));
            }
            Outline::Rounded(..) | Outline::Closed(_) | Outline::Open(_) | Outline::Arc(..) => {
                let points = hull(&outline.points());
                if points.len() > 1 {
                    for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
                        edge(&mut anchors, place.globally(*a), place.globally(*b));
                    }
                }
                let bounds = super::plane::Bounds::of(points.iter().copied());
                // A name must not hide a smaller shape.
                if bounds.size()[0] > 1.5 * width && bounds.size()[1] > 4.0 * SIZE {
                    anchors.push(upon(bounds.center(), 0.0));
                }
            }
        }
    }
    if anchors.is_empty() {
        ridden(&mut anchors, figure, body);
    }
    if anchors.is_empty() {
        anchors.extend(around(place.origin, 12.0));
    }
    anchors
}

/// Anchors beside the blocks that stand for a body.
fn ridden(anchors: &mut Vec<Anchor>, figure: &Figure, body: usize) {
    let parts = figure.joints.iter().flat_map(|it| it.parts());
    for part in parts {
        let is_own = match part.frame {
            Frame::Riding(at, _) => at.body == body,
            frame => frame == Frame::Body(body),
        };
        if !is_own {
            continue;
        }
        let place = figure.stance.place(part.frame);
        let blocks = part.elements.iter().map(|it| &it.outline);
        for block in blocks.filter(|it| !matches!(it, Outline::Open(_))) {
            let points = hull(&block.points());
            for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
                edge(anchors, place.globally(*a), place.globally(*b));
            }
        }
    }
}

/// Anchors along an edge of a shape that lies to its left.
fn edge(anchors: &mut Vec<Anchor>, a: Point, b: Point) {
    let length = distance(a, b);
    if length < 3.0 {
        return;
    }
    let along = scaled(difference(b, a), 1.0 / length);
    let out = scaled(left_of(along), -1.0);
    for (share, cost) in [(0.5, 0.0), (0.36, 0.6), (0.64, 0.6), (0.2, 2.0), (0.8, 2.0)] {
        anchors.push(Anchor {
            at: [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])],
            out,
            gap: 3.0,
            // Short edges are the ends of something.
            cost: cost + if length < 20.0 { 3.0 } else { 0.0 },
        });
    }
}
