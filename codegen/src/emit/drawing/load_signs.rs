//! Signs of loads: coils, dashpots, arrows of forces and torques.

use std::f64::consts::PI;

use super::draft::Draft;
use super::figure::{Frame, Group, Layer, Look, Outline, Winding};
use super::link::SHORTEST;
use super::loads::Load;
use super::plane::{Point, difference, distance, heading, left_of, onward, scaled};
use super::pose::At;
use crate::force::Shape;
use crate::joint::Feature;

/// Half the width of coils and dashpots, in units.
const HALF: f64 = 7.5;

/// Distance between the middles of elements beside one another, in units.
const ELEMENT_SPACING: f64 = 20.0;

/// Length of half a winding, at least and at most, in units.
const WINDING: [f64; 2] = [5.0, 8.0];

/// Smallest and largest number of half windings of a coil.
const WINDINGS: [f64; 2] = [7.0, 21.0];

/// Straight ends of a coil, as a part of its length.
const ENDS: f64 = 0.12;

/// Length of a dashpot's cylinder for short strokes, in units.
const CYLINDER: f64 = 34.0;

/// Largest length of a cylinder, relative to the shortest length of the element.
const LONGEST_CYLINDER: f64 = 0.8;

/// Length of the arrow of the largest force, in units.
const ARROW: f64 = 46.0;

/// Radius of the arrow of a torque, and half its angle.
const TORQUE: [f64; 2] = [28.0, 0.75];

/// Length of an arrow's head, in units.
const HEAD: f64 = 8.0;

/// An element between two points, in pixels, from the left one to the right one.
#[derive(Clone, Copy)]
struct Span {
    from: At,
    to: At,
    /// Distance to the left of its line at which it is drawn.
    aside: f64,
    /// Its length in this pose, and the shortest and the longest of all.
    now: f64,
    least: f64,
    most: f64,
}

impl Draft<'_> {
    /// Draws all loads.
    pub fn loads(&mut self) {
        let scene = self.scene;
        let spans: Vec<Option<Span>> = (0..scene.loads.len()).map(|it| self.span(it)).collect();
        for span in spans.iter().flatten().filter(|it| it.aside != 0.0) {
            // Supports stand on a free side.
            let line = self.beside(*span);
            self.lines.push(line);
        }
        for (place, load) in scene.loads.iter().enumerate() {
            let mut group = Group::new(format!("load-{}", place + 1), load.label.clone());
            match (load.shape, &load.marks[..]) {
                (Shape::Spring | Shape::Damper, &[from, to]) => {
                    match (load.shape, spans[place]) {
                        (Shape::Spring, Some(span)) => self.coil(span, &mut group),
                        (_, Some(span)) => self.dashpot(span, &mut group),
                        _ => {}
                    }
                    self.end(from, &mut group);
                    self.end(to, &mut group);
                }
                (Shape::TorsionSpring | Shape::TorsionDamper, &[a, b]) => {
                    let [a, b] = [a.body, b.body];
                    let center = self.pin_between(a, b).unwrap_or_else(|| self.pivot(b));
                    match load.shape {
                        Shape::TorsionSpring => {
                            self.spiral(center, [a, b], load.drawn, &mut group);
                        }
                        _ => self.ring(Frame::Riding(center, a), &mut group),
                    }
                }
                (Shape::Force, &[at]) => self.force(place, self.pixels(at), &mut group),
                (Shape::Torque, &[at]) => self.torque(place, at.body, &mut group),
                _ => {}
            }
            self.figure.extras.push(group);
        }
    }

    /// A support or a pin at the end of an element.
    fn end(&mut self, at: At, group: &mut Group) {
        if at.body == 0 {
            self.support(self.global(at), group);
        }
        self.hole(at, group);
    }

    /// The line along which an element is drawn, in pixels.
    fn beside(&self, span: Span) -> [Point; 2] {
        let ends = [span.from, span.to];
        let [a, b] = ends.map(|it| self.figure.stance.places[it.body].globally(it.local));
        let length = distance(a, b).max(1.0);
        let out = left_of(scaled(difference(b, a), 1.0 / length));
        [a, b].map(|end| onward(end, span.aside, out))
    }

    /// Line along which an element between two points is drawn: beside others that have the same ends.
    fn span(&self, place: usize) -> Option<Span> {
        let scene = self.scene;
        let is_line = |load: &Load| matches!(load.shape, Shape::Spring | Shape::Damper);
        let &[from, to] = &scene.loads[place].marks[..] else {
            return None;
        };
        if !is_line(&scene.loads[place]) {
            return None;
        }
        let [a, b] = [from, to].map(|it| self.global(it));
        let is_backward = (b[0], b[1]) < (a[0], a[1]);
        let [from, to] = if is_backward { [to, from] } else { [from, to] };
        let is_same = |ends: &[At]| match ends {
            [i, j, ..] => {
                let [i, j] = [*i, *j].map(|it| self.global(it));
                let is_near = |p: Point, q: Point| distance(p, q) < 1.0;
                (is_near(i, a) && is_near(j, b)) || (is_near(i, b) && is_near(j, a))
            }
            _ => false,
        };
        let loads = scene.loads.iter().enumerate();
        let beside = loads.filter(|(_, load)| is_line(load) && is_same(&load.marks));
        let rank = beside.filter(|(number, _)| *number < place).count();
        let is_taken = scene.signs.iter().any(|sign| {
            matches!(sign.feature, Feature::Slide | Feature::Link) && is_same(&sign.marks)
        });
        let steps = match is_taken {
            // On both sides of the existing ones.
            true => {
                let out = (rank / 2 + 1) as f64;
                if rank.is_multiple_of(2) { out } else { -out }
            }
            // Above the first one: below there may be a guide.
            false => rank as f64,
        };
        let lengths = scene.motion.iter().map(|places| {
            let [a, b] = [from, to].map(|it| places[it.body].globally(it.local));
            distance(a, b) * self.figure.scale
        });
        let lengths: Vec<f64> = lengths.collect();
        Some(Span {
            from: self.pixels(from),
            to: self.pixels(to),
            aside: steps * ELEMENT_SPACING * self.unit,
            now: lengths[0],
            least: lengths.iter().copied().fold(f64::INFINITY, f64::min),
            most: lengths.iter().copied().fold(0.0, f64::max),
        })
    }

    /// Draws a coil with the length of the distance between its ends.
    fn coil(&self, span: Span, group: &mut Group) {
        let length = span.now.max(SHORTEST);
        let half = HALF * self.unit;
        let room = (1.0 - 2.0 * ENDS) * length;
        let [shortest, longest] = scaled(WINDING, self.unit);
        let windings = (room / shortest).round().clamp(WINDINGS[0], WINDINGS[1]);
        let wound = room.min(windings * longest);
        let start = 0.5 * (length - wound);
        let mut points = jog(span.aside, 0.0).to_vec();
        points.push([start, span.aside]);
        for winding in 0..windings as usize {
            let along = start + wound * (winding as f64 + 0.5) / windings;
            let side = if winding.is_multiple_of(2) { 1.0 } else { -1.0 };
            points.push([along, span.aside + side * half]);
        }
        points.push([start + wound, span.aside]);
        points.extend(jog(span.aside, length).into_iter().rev());
        let frame = Frame::Between(span.from, span.to, length);
        group.add(Layer::Upon, frame, Look::Element, Outline::Open(points));
    }

    /// A cylinder that is held at one end, and a piston that is held at the other.
    fn dashpot(&self, span: Span, group: &mut Group) {
        let half = HALF * self.unit;
        let stroke = span.most - span.least + half;
        let cylinder = (CYLINDER * self.unit).min(0.5 * span.least).max(stroke);
        if cylinder <= LONGEST_CYLINDER * span.least {
            let start = 0.5 * (span.least - cylinder);
            // In the middle of its stroke the piston is in the middle of the cylinder.
            let rod = 0.5 * (span.least + span.most) - start - 0.5 * cylinder;
            let frame = Frame::Toward(span.from, span.to);
            self.cylinder_of_dashpot(frame, span.aside, [start, cylinder], group);
            let frame = Frame::Toward(span.to, span.from);
            self.piston(frame, -span.aside, [0.0, rod], group);
            return;
        }
        // No cylinder suits both lengths: the sign is stretched as a whole.
        let length = span.now.max(SHORTEST);
        let frame = Frame::Between(span.from, span.to, length);
        let (start, cylinder) = (0.3 * length, 0.4 * length);
        self.cylinder_of_dashpot(frame, span.aside, [start, cylinder], group);
        self.piston(frame, span.aside, [length, start + 0.5 * cylinder], group);
    }

    fn cylinder_of_dashpot(
        &self,
        frame: Frame,
        aside: f64,
        [start, length]: [f64; 2],
        group: &mut Group,
    ) {
        let half = HALF * self.unit;
        let mut lead = jog(aside, 0.0).to_vec();
        lead.push([start, aside]);
        let end = start + length;
        let wall = vec![
            [end, aside + half],
            [start, aside + half],
            [start, aside - half],
            [end, aside - half],
        ];
        for line in [lead, wall] {
            group.add(Layer::Upon, frame, Look::Element, Outline::Open(line));
        }
    }

    fn piston(&self, frame: Frame, aside: f64, [from, to]: [f64; 2], group: &mut Group) {
        let half = (HALF - 1.5) * self.unit;
        let mut rod = jog(aside, from).to_vec();
        rod.push([to, aside]);
        let plate = vec![[to, aside + half], [to, aside - half]];
        for line in [rod, plate] {
            group.add(Layer::Upon, frame, Look::Element, Outline::Open(line));
        }
    }

    /// Draws a spring about a joint. Its inner end turns with the first body, and its outer end with the second one.
    /// In the design configuration one and a half turns lie between.
    fn spiral(&self, center: At, bodies: [usize; 2], drawn: f64, group: &mut Group) {
        let (turns, steps) = (1.5, 24);
        let radii = [5.0, 15.0].map(|it| it * self.unit);
        let frame = Frame::Wound(
            center,
            Winding {
                bodies,
                drawn,
                radii,
            },
        );
        let [inner, outer] = radii;
        let points = (0..=steps).map(|step| {
            let part = f64::from(step) / f64::from(steps);
            let radius = inner + (outer - inner) * part;
            scaled(heading(2.0 * PI * turns * part), radius)
        });
        let spiral = Outline::Open(points.collect());
        group.add(Layer::Above, frame, Look::Element, spiral);
    }

    /// A dashpot about a joint.
    fn ring(&self, frame: Frame, group: &mut Group) {
        let [radius, half] = [20.0, 4.0].map(|it| it * self.unit);
        let [lead, wall, plate, end] = [1.7, 2.3, 3.1, 3.9];
        let arc = |radius: f64, from: f64, to: f64| Outline::Arc([0.0; 2], radius, [from, to]);
        let across = |angle: f64, half: f64| {
            let out = heading(angle);
            Outline::line(scaled(out, radius - half), scaled(out, radius + half))
        };
        for line in [
            arc(radius, lead, wall),
            across(wall, half),
            arc(radius - half, wall, end),
            arc(radius + half, wall, end),
            across(plate, half - 1.2 * self.unit),
            arc(radius, plate, end + 0.6),
        ] {
            group.add(Layer::Above, frame, Look::Element, line);
        }
    }

    /// An arrow that begins at the point on which a force acts.
    fn force(&self, place: usize, at: At, group: &mut Group) {
        let frame = Frame::Force(at, place);
        let length = ARROW * self.unit;
        let size = HEAD * self.unit;
        let shaft = Outline::line([0.0; 2], [length - 0.7 * size, 0.0]);
        group.add(Layer::Above, frame, Look::Load, shaft);
        let head = Outline::head([length, 0.0], [1.0, 0.0], size);
        group.add(Layer::Above, frame, Look::LoadHead, head);
    }

    /// Draws an arc about the pin of a body, on the side opposite to the body.
    fn torque(&self, place: usize, body: usize, group: &mut Group) {
        let center = self.pivot(body);
        let frame = Frame::Torque(center, self.facing(center) + PI, place);
        let [radius, half] = TORQUE;
        let radius = radius * self.unit;
        let arc = Outline::Arc([0.0; 2], radius, [-half, half]);
        group.add(Layer::Above, frame, Look::Load, arc);
        let size = HEAD * self.unit;
        let lean = size / radius;
        let tip = scaled(heading(half + 0.8 * lean), radius);
        let along = left_of(heading(half + 0.4 * lean));
        let head = Outline::head(tip, along, size);
        group.add(Layer::Above, frame, Look::LoadHead, head);
    }
}

/// From a point of the line between the ends of an element to the element beside the line.
fn jog(aside: f64, along: f64) -> [Point; 2] {
    [[along, 0.0], [along, aside]]
}
