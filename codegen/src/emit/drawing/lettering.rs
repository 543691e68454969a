//! Text of placed names that moves with its points.

use std::fmt::Write as _;

use super::extras::AXIS;
use super::figure::{Figure, Frame};
use super::label::{Placed, beside, placed};
use super::naming::{Name, Named, SIZE, missing, names, obstacles};
use super::picture::Options;
use super::plane::{Bounds, Point, difference, distance, onward, scaled};
use super::pose::{At, Entitled, Scene};
use super::stance::Stance;
use super::style::TINTS;
use super::svg::{Written, number};
use crate::emit::markup::escaped;

/// Name in its position.
#[derive(Debug)]
pub(super) struct Lettering {
    /// Attribute of its class, or nothing.
    class: String,
    /// Point of a body that it follows, in pixels; `None` if it rests.
    at: Option<At>,
    /// Attribute that names the point, or nothing.
    point: String,
    /// Leader line to the named point, or nothing.
    leader: String,
    text: String,
}

/// Positions of names and of the letters at axes.
#[derive(Debug)]
pub(super) struct PlacedNames {
    /// Names with room.
    pub names: Vec<(Name, Placed)>,
    /// Letters at the axes of bodies, with their centers.
    pub axes: Vec<(usize, Point, &'static str)>,
}

/// Finds positions for all names.
pub(super) fn placed_names(
    scene: &Scene,
    figure: &Figure,
    unit: f64,
    area: &Bounds,
    options: &Options,
) -> PlacedNames {
    let mut names = names(scene, figure, unit);
    names.extend(options.gap.iter().map(|gap| missing(gap, figure)));
    let mut obstacles = obstacles(figure);
    let mut axes = Vec::new();
    for &body in &options.frames {
        let place = figure.stance.place(Frame::Body(body));
        for (along, letter) in [([1.0, 0.0], "x"), ([0.0, 1.0], "y")] {
            let at = place.globally(onward([0.0; 2], AXIS * unit + 9.0, along));
            obstacles.taken.push(Bounds::around(at, [6.0, 7.0]));
            axes.push((body, at, letter));
        }
    }
    let boxes: Vec<_> = names.iter().map(|name| name.label.clone()).collect();
    let placed = match options.is_sketch {
        true => boxes.iter().map(beside).collect(),
        false => placed(&boxes, &obstacles, area),
    };
    let names = names.into_iter().zip(placed);
    PlacedNames {
        names: names
            .filter_map(|(name, placed)| Some((name, placed?)))
            .collect(),
        axes,
    }
}

/// Leader line from a name to the named point; `None` if the name is close to it.
pub(super) fn leader(placed: &Placed) -> Option<[Point; 2]> {
    let to = placed.leader?;
    let from = nearest(&placed.area, to);
    let length = distance(from, to);
    let part = (length - 6.0).max(0.0) / length.max(1.0);
    Some([from, onward(from, part, [to[0] - from[0], to[1] - from[1]])])
}

/// Text of names in their positions.
pub(super) fn lettering(scene: &Scene, figure: &Figure, placed: &PlacedNames) -> Vec<Lettering> {
    let mut letters = Vec::new();
    for &(body, at, letter) in &placed.axes {
        let place = figure.stance.places[body].locally(at);
        letters.push(Lettering {
            class: String::new(),
            at: Some(At { body, local: place }),
            point: String::new(),
            leader: String::new(),
            text: format!(
                "<text class=\"axis-name\" x=\"{}\" y=\"{}\">{letter}</text>",
                number(at[0]),
                number(0.35 * SIZE - at[1])
            ),
        });
    }
    for (name, placed) in &placed.names {
        let center = placed.area.center();
        let half = name.label.half;
        let tint = match name.of {
            Named::Body(body) => format!(" class=\"tint-{}\"", (body - 1) % TINTS),
            Named::Point(_) | Named::Gap => String::new(),
        };
        let mut text = String::new();
        let leader = leader(placed).map_or(String::new(), |[from, to]| {
            format!(
                "<path class=\"leader\" d=\"M{} {}L{} {}\"/>",
                number(from[0]),
                number(-from[1]),
                number(to[0]),
                number(-to[1])
            )
        });
        let class = match name.of {
            Named::Body(_) => {
                let [width, height] = scaled(half, 2.0);
                let _ = write!(
                    text,
                    "<rect class=\"tag\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{}\"/>",
                    number(center[0] - half[0]),
                    number(-center[1] - half[1]),
                    number(width),
                    number(height),
                    number(half[1])
                );
                "name"
            }
            Named::Point(_) => "point",
            Named::Gap => "gap-name",
        };
        let _ = write!(
            text,
            "<text class=\"{class}\" x=\"{}\" y=\"{}\">{}</text>",
            number(center[0]),
            number(0.35 * SIZE - center[1]),
            escaped(&name.text)
        );
        let (at, point) = followed(name, center, scene, figure);
        letters.push(Lettering {
            class: tint,
            at,
            point,
            leader,
            text,
        });
    }
    letters
}

/// Anchor that a name follows, as a point of a body in pixels, and an attribute that names it.
fn followed(name: &Name, center: Point, scene: &Scene, figure: &Figure) -> (Option<At>, String) {
    match name.of {
        Named::Point(place) => {
            let Entitled { at, name, .. } = &scene.points[place];
            let local = scaled(at.local, figure.scale);
            let point = format!(" data-point=\"{}\"", escaped(name));
            (Some(At { local, ..*at }), point)
        }
        Named::Body(body) => {
            let local = figure.stance.places[body].locally(center);
            (Some(At { body, local }), String::new())
        }
        Named::Gap => (None, String::new()),
    }
}

/// Names as text; those that follow a point have moved with it from the first figure to the second.
pub(super) fn names_text(
    names: &[Lettering],
    [composed, shown]: [&Figure; 2],
    written: Written<'_>,
) -> String {
    let mut text = String::from("<g id=\"names\">\n");
    for name in names {
        let moved = |stance: &Stance, at: At| {
            let place = |stance: &Stance| stance.places[at.body].globally(at.local);
            difference(place(stance), place(&composed.stance))
        };
        let (mut attributes, mut children) = (name.class.clone(), name.leader.clone());
        match (written, name.at) {
            (Written::Moving | Written::Motion, Some(at)) => {
                let [x, y] = [at.local[0], -at.local[1]].map(number);
                let first = composed.stance.places[at.body].globally(at.local);
                let [first_x, first_y] = [first[0], -first[1]].map(number);
                attributes += &format!(
                    " data-follows=\"{} {x} {y}\" data-first=\"{first_x} {first_y}\"{}",
                    at.body, name.point
                );
            }
            (Written::Frame, Some(at)) => {
                let [x, y] = moved(&shown.stance, at);
                // Content that turns below a name leaves its line behind.
                children.clear();
                attributes += &format!(" transform=\"translate({} {})\"", number(x), number(-y));
            }
            (Written::Animated(keyframes), Some(at)) => {
                children = keyframes.translation(|stance| moved(stance, at));
            }
            _ => {}
        }
        let _ = writeln!(text, "<g{attributes}>{children}{}</g>", name.text);
    }
    text.push_str("</g>\n");
    text
}

/// The point of a box that is nearest to another.
fn nearest(area: &Bounds, to: Point) -> Point {
    [0, 1].map(|axis| to[axis].clamp(area.low[axis], area.high[axis]))
}
