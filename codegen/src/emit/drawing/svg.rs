//! Writes groups of outlines as SVG. Here y points downwards.

use std::fmt::Write as _;

use super::figure::{Figure, Frame, Group, Layer, Look, Outline, Part, Winding, offset_edges};
use super::keyframes::Keyframes;
use super::plane::{Place, Point};
use super::stance::Stance;
use super::style::{TINTS, class};
use crate::emit::markup::escaped;

/// Number in hundredths.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "-0" => "0".to_string(),
        text => text.to_string(),
    }
}

fn pair(point: Point) -> String {
    format!("{} {}", number(point[0]), number(-point[1]))
}

/// Transformation of a frame.
fn transform(place: Place) -> String {
    let mut text = String::new();
    if place.origin != [0.0; 2] {
        let [x, y] = place.origin;
        let _ = write!(text, "translate({} {})", number(x), number(-y));
    }
    let degrees = number(-place.angle.to_degrees().rem_euclid(360.0));
    if degrees != "0" && degrees != "-360" {
        let _ = write!(text, "rotate({degrees})");
    }
    text
}

/// Extent of a written figure.
#[derive(Clone, Copy, Debug)]
pub(super) enum Written<'a> {
    /// Existing elements, in their pose.
    Picture,
    /// All groups, also empty ones, which another motion may fill.
    Moving,
    /// Groups without elements of one pose alone.
    Motion,
    /// One pose of a motion, without elements of other poses.
    Frame,
    /// All poses of a motion, as an animation.
    Animated(&'a Keyframes),
}

/// Figure in three layers: below the bodies, the bodies, and upon them. Ids begin with `prefix`.
pub(super) fn layers(figure: &Figure, prefix: &str, written: Written<'_>) -> String {
    let groups = groups(figure, prefix, written).into_iter();
    groups.map(|(_, text)| text).collect()
}

/// Figure as groups, each with its id and its text.
pub(super) fn groups(figure: &Figure, prefix: &str, written: Written<'_>) -> Vec<(String, String)> {
    let joints = figure.joints.iter().chain(&figure.extras);
    let others: Vec<&Group> = joints.collect();
    let mut groups = Vec::new();
    let mut add = |group: &Group, layers: &[Layer], suffix: &str| {
        let id = format!("{prefix}{}{suffix}", group.id);
        // The last layer has the group's own id, and exists even if it is empty.
        let is_kept = suffix.is_empty() || matches!(written, Written::Moving | Written::Motion);
        let text = layer(figure, group, layers, &id, written);
        groups.extend(
            text.or_else(|| is_kept.then(|| empty(&id, group)))
                .map(|text| (id, text)),
        );
    };
    for group in &others {
        add(group, &[Layer::Below], "-below");
    }
    for group in &figure.bodies {
        add(group, &[Layer::Below, Layer::Upon, Layer::Above], "");
    }
    for group in &others {
        add(group, &[Layer::Upon], "-upon");
    }
    for group in &others {
        add(group, &[Layer::Above], "");
    }
    groups
}

fn empty(id: &str, group: &Group) -> String {
    let title = escaped(&group.title);
    format!("<g id=\"{}\"><title>{title}</title>\n</g>\n", escaped(id))
}

/// Some layers of a group; `None` if they are empty.
fn layer(
    figure: &Figure,
    group: &Group,
    layers: &[Layer],
    id: &str,
    written: Written<'_>,
) -> Option<String> {
    let parts = layers.iter().flat_map(|it| &group.layers[*it as usize]);
    let is_timeless = matches!(written, Written::Frame | Written::Animated(_));
    let parts = parts.filter(|part| !(is_timeless && part.frame == Frame::Still));
    let parts: Vec<&Part> = parts.collect();
    let (id, title) = (escaped(id), escaped(&group.title));
    let mut text = String::new();
    match parts[..] {
        [] => return None,
        // A body is one element, with its own transformation.
        [part] => {
            let attributes = framed(figure, part.frame, written);
            let _ = writeln!(text, "<g id=\"{id}\"{attributes}><title>{title}</title>");
            within(&mut text, figure, part, written);
        }
        _ => {
            let _ = writeln!(text, "<g id=\"{id}\"><title>{title}</title>");
            for part in parts {
                let _ = writeln!(text, "<g{}>", framed(figure, part.frame, written));
                within(&mut text, figure, part, written);
                text.push_str("</g>\n");
            }
        }
    }
    text.push_str("</g>\n");
    Some(text)
}

/// Attributes of a frame's element: its class, its motion, and its position.
fn framed(figure: &Figure, frame: Frame, written: Written<'_>) -> String {
    let mut text = match frame {
        Frame::Body(body)
        | Frame::Riding(_, body)
        | Frame::Wound(
            _,
            Winding {
                bodies: [body, _], ..
            },
        ) if body > 0 => {
            format!(" class=\"tint-{}\"", (body - 1) % TINTS)
        }
        Frame::Toward(from, to) | Frame::Between(from, to, _) => {
            let body = from.body.max(to.body).max(1);
            format!(" class=\"tint-{}\"", (body - 1) % TINTS)
        }
        _ => String::new(),
    };
    let _ = match frame {
        Frame::Body(0) => Ok(()),
        Frame::Still => write!(text, " data-still=\"\""),
        Frame::Body(body) => write!(text, " data-body=\"{body}\""),
        Frame::Riding(at, body) => write!(
            text,
            " data-at=\"{} {}\" data-turned=\"{body}\"",
            at.body,
            pair(at.local)
        ),
        Frame::Wound(at, winding) => {
            let ([from, to], [inner, outer]) = (winding.bodies, winding.radii.map(number));
            write!(
                text,
                " data-at=\"{} {}\" data-turned=\"{from}\" data-wound=\"{to} {} {inner} {outer}\"",
                at.body,
                pair(at.local),
                number(-winding.drawn.to_degrees())
            )
        }
        Frame::Toward(from, to) => write!(
            text,
            " data-from=\"{} {}\" data-to=\"{} {}\"",
            from.body,
            pair(from.local),
            to.body,
            pair(to.local)
        ),
        Frame::Between(from, to, length) => write!(
            text,
            " data-from=\"{} {}\" data-to=\"{} {}\" data-length=\"{}\"",
            from.body,
            pair(from.local),
            to.body,
            pair(to.local),
            number(length)
        ),
        Frame::Force(at, load) => write!(
            text,
            " data-at=\"{} {}\" data-force=\"{load}\"",
            at.body,
            pair(at.local)
        ),
        Frame::Torque(at, angle, load) => write!(
            text,
            " data-at=\"{} {}\" data-torque=\"{load} {}\"",
            at.body,
            pair(at.local),
            number(-angle.to_degrees())
        ),
    };
    if matches!(written, Written::Motion) {
        return text;
    }
    let mut placed = transform(figure.stance.place(frame));
    let stretch = figure.stance.stretch(frame).map(number);
    if stretch.iter().any(|it| it != "1") {
        let _ = write!(placed, "scale({} {})", stretch[0], stretch[1]);
    }
    if !placed.is_empty() {
        let _ = write!(text, " transform=\"{placed}\"");
    }
    text
}

/// Elements of a part, in an animation with its motion.
fn within(text: &mut String, figure: &Figure, part: &Part, written: Written<'_>) {
    if let Written::Animated(keyframes) = written {
        *text += &keyframes.motion(part.frame);
    }
    match part.frame {
        Frame::Wound(..) => wound(text, figure, part, written),
        _ => elements(text, part),
    }
}

/// Lines of a spiral, which its frame deforms.
fn wound(text: &mut String, figure: &Figure, part: &Part, written: Written<'_>) {
    for element in &part.elements {
        let Outline::Open(points) = &element.outline else {
            continue;
        };
        let in_pose = |stance: &Stance| {
            let points = points.iter().map(|it| stance.deformed(part.frame, *it));
            path(&points.collect::<Vec<_>>(), false)
        };
        let motion = match written {
            Written::Animated(keyframes) => keyframes.shape(in_pose),
            _ => String::new(),
        };
        let (class, line) = (class(element.look), in_pose(&figure.stance));
        let _ = match motion.is_empty() {
            true => writeln!(text, "<path class=\"{class}\" d=\"{line}\"/>"),
            false => writeln!(text, "<path class=\"{class}\" d=\"{line}\">{motion}</path>"),
        };
    }
}

/// One element for each outline, but one for all neighbouring open outlines of one style.
fn elements(text: &mut String, part: &Part) {
    let mut lines = String::new();
    let mut last: Option<Look> = None;
    let flush = |text: &mut String, lines: &mut String, look: Option<Look>| {
        if let (Some(look), false) = (look, lines.is_empty()) {
            let _ = writeln!(text, "<path class=\"{}\" d=\"{lines}\"/>", class(look));
            lines.clear();
        }
    };
    for element in &part.elements {
        let look = element.look;
        let is_line = matches!(element.outline, Outline::Open(_) | Outline::Arc(..));
        if last != Some(look) || !is_line {
            flush(text, &mut lines, last);
        }
        last = Some(look);
        match &element.outline {
            Outline::Circle(center, radius) => {
                let _ = writeln!(
                    text,
                    "<circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>",
                    class(look),
                    number(center[0]),
                    number(-center[1]),
                    number(*radius)
                );
            }
            Outline::Open(points) => {
                lines.push_str(&path(points, false));
            }
            outline @ Outline::Arc(..) => lines.push_str(&path(&outline.points(), false)),
            outline => {
                let _ = writeln!(
                    text,
                    "<path class=\"{}\" d=\"{}\"/>",
                    class(look),
                    path_data(outline)
                );
            }
        }
    }
    flush(text, &mut lines, last);
}

fn path(points: &[Point], is_closed: bool) -> String {
    let mut text = String::new();
    for (place, point) in points.iter().enumerate() {
        text.push(if place == 0 { 'M' } else { 'L' });
        text.push_str(&pair(*point));
    }
    if is_closed {
        text.push('Z');
    }
    text
}

/// Path of an outline as SVG writes it.
pub(super) fn path_data(outline: &Outline) -> String {
    match outline {
        Outline::Closed(points) => path(points, true),
        Outline::Ring(center, inner, outer) => {
            format!("{}{}", ring(*center, *outer), ring(*center, *inner))
        }
        Outline::Rounded(corners, radius) => match corners[..] {
            [] => String::new(),
            [only] => ring(only, *radius),
            _ if *radius == 0.0 => path(corners, true),
            _ => {
                let mut text = String::new();
                let radius_text = number(*radius);
                for (place, [from, to]) in offset_edges(corners, *radius).iter().enumerate() {
                    match place {
                        0 => text.push('M'),
                        // Counterclockwise while y points upwards.
                        _ => text += &format!("A{radius_text} {radius_text} 0 0 0 "),
                    }
                    text += &format!("{}L{}", pair(*from), pair(*to));
                }
                let first = offset_edges(corners, *radius)[0][0];
                text + &format!("A{radius_text} {radius_text} 0 0 0 {}Z", pair(first))
            }
        },
        Outline::Circle(center, radius) => ring(*center, *radius),
        Outline::Open(points) => path(points, false),
        Outline::Arc(..) => path(&outline.points(), false),
    }
}

fn ring(center: Point, radius: f64) -> String {
    let [left, right] = [-radius, radius].map(|it| pair([center[0] + it, center[1]]));
    let radius = number(radius);
    format!("M{left}A{radius} {radius} 0 1 0 {right}A{radius} {radius} 0 1 0 {left}Z")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_have_no_negative_zero() {
        let text = [1.0, -0.001, 2.25, -3.1, 100.0].map(number);
        assert_eq!(text, ["1", "0", "2.25", "-3.1", "100"]);
    }
}
