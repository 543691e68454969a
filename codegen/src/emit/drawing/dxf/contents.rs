//! Contents of a drawing, and their shapes in mm.

use super::super::figure::{Element, Figure, Frame, Group, Look, Outline};
use super::super::plane::{Bounds, Point, distance, onward, scaled, sum};
use super::entity::{CAPITALS, Shape};
use super::layer::{Content, LineType, content};
use super::shapes::Placed;

/// Length of a center mark beyond its circle, in pixels.
pub(in super::super) const CENTER_MARK: f64 = 3.5;

/// Length of a center line beyond its points, in pixels.
const BEYOND: f64 = 14.0;

/// Size of letters below the figure, in pixels, and distance of their lines.
const NOTE: [f64; 2] = [13.0, 20.0];

/// Length of the arrow of gravity and of its head, in pixels.
const GRAVITY: [f64; 2] = [20.0, 8.0];

/// Text in a drawing, about its center and in pixels.
#[derive(Clone, Debug, PartialEq)]
pub(in super::super) struct Inscription {
    pub text: String,
    pub at: Point,
    /// Size of letters.
    pub size: f64,
    /// Line to the named point; `None` if the text is close to it.
    pub leader: Option<[Point; 2]>,
    /// True for letters at the axes of a frame.
    pub is_axis: bool,
    /// True for the name of a link below it.
    pub is_title: bool,
}

impl Inscription {
    /// Text at another place.
    pub fn moved(self, by: Point) -> Inscription {
        Inscription {
            at: sum(self.at, by),
            leader: self.leader.map(|ends| ends.map(|it| sum(it, by))),
            ..self
        }
    }
}

/// Contents of a drawing.
#[derive(Debug)]
pub(in super::super) struct Plate<'a> {
    pub figure: &'a Figure,
    /// Names of bodies, the ground first.
    pub names: Vec<String>,
    /// True if the figure has the center marks of pins.
    pub is_marked: bool,
    /// Center lines of links, in pixels.
    pub center_lines: Vec<[Point; 2]>,
    pub inscriptions: Vec<Inscription>,
    /// Lines of text below the figure.
    pub notes: Vec<String>,
    /// Direction of gravity, as a unit vector; `None` without gravity.
    pub gravity: Option<Point>,
    /// Decimals of dimensions.
    pub decimals: usize,
    /// Largest distance of a curve from its polyline, in m; `None` without curves.
    pub deviation: Option<f64>,
}

/// Shape of a part of the drawing.
#[derive(Clone, Debug)]
pub(super) struct Drawn {
    /// Part in messages.
    pub part: String,
    pub content: Content,
    /// Line type; `None` for that of the layer.
    pub line_type: Option<LineType>,
    pub shape: Shape,
}

impl Drawn {
    fn new(part: &str, content: Content, shape: Shape) -> Drawn {
        Drawn {
            part: part.to_string(),
            content,
            line_type: None,
            shape,
        }
    }
}

/// Shapes of all outlines, with marks at the centers of pins.
pub(super) fn outlines(plate: &Plate<'_>, factor: f64) -> Vec<Drawn> {
    let figure = plate.figure;
    let pins = pins(figure);
    let mut drawn = Vec::new();
    let bodies = figure.bodies.iter().enumerate();
    let bodies = bodies.map(|(place, group)| (Some(place + 1), group));
    let others = figure.joints.iter().chain(&figure.extras);
    for (owner, group) in bodies.chain(others.map(|group| (None, group))) {
        for part in group.parts() {
            let placed = Placed::new(figure, part.frame, factor);
            for element in &part.elements {
                // A disc has no edge: its pitch circle is drawn.
                let is_edgeless = element.look == Look::Disc;
                if is_edgeless || is_under_pin(figure, part.frame, element, &pins) {
                    continue;
                }
                let content = match is_pin(element) {
                    true => Content::Pins,
                    false => content(element.look, part.frame, owner),
                };
                let line_type = (element.look == Look::Massless).then_some(LineType::Dashed);
                drawn.extend(placed.shapes(element).into_iter().map(|shape| Drawn {
                    line_type,
                    ..Drawn::new(&group.title, content, shape)
                }));
            }
        }
    }
    for (center, radius) in pins.iter().filter(|_| !plate.is_marked) {
        for along in [[1.0, 0.0], [0.0, 1.0]] {
            let half = radius + CENTER_MARK;
            let ends = [-half, half].map(|it| scaled(onward(*center, it, along), factor));
            drawn.push(Drawn::new("a pin", Content::CenterLines, Shape::Line(ends)));
        }
    }
    for [from, to] in &plate.center_lines {
        let length = distance(*from, *to);
        let along = scaled([to[0] - from[0], to[1] - from[1]], 1.0 / length);
        let ends = [onward(*from, -BEYOND, along), onward(*to, BEYOND, along)];
        let line = Shape::Line(ends.map(|it| scaled(it, factor)));
        drawn.push(Drawn::new("a center line", Content::CenterLines, line));
    }
    drawn
}

fn is_pin(element: &Element) -> bool {
    element.look == Look::Part && matches!(element.outline, Outline::Circle(..))
}

/// Pins and rollers, each once: centers and radii in pixels.
fn pins(figure: &Figure) -> Vec<(Point, f64)> {
    let mut pins: Vec<(Point, f64)> = Vec::new();
    for part in figure.groups().flat_map(Group::parts) {
        for element in part.elements.iter().filter(|it| is_pin(it)) {
            let Outline::Circle(center, radius) = element.outline else {
                continue;
            };
            let at = Placed::new(figure, part.frame, 1.0).point(center);
            match pins.iter_mut().find(|(it, _)| distance(*it, at) < 0.1) {
                Some((_, known)) => *known = known.max(radius),
                None => pins.push((at, radius)),
            }
        }
    }
    pins
}

/// True for the dot of a point that a pin has in its center: the center mark shows it.
fn is_under_pin(figure: &Figure, frame: Frame, element: &Element, pins: &[(Point, f64)]) -> bool {
    match (element.look, &element.outline) {
        (Look::Ink, Outline::Circle(center, radius)) => {
            let at = Placed::new(figure, frame, 1.0).point(*center);
            let mut pins = pins.iter();
            pins.any(|(pin, around)| distance(*pin, at) < 0.1 && radius < around)
        }
        _ => false,
    }
}

/// Names, and the lines of text below the figure, which its bounds (mm) then include.
pub(super) fn texts(plate: &Plate<'_>, factor: f64, bounds: &mut Bounds) -> Vec<Drawn> {
    let mut drawn = Vec::new();
    let mut add = |content: Content, shape: Shape| drawn.push(Drawn::new("a text", content, shape));
    for name in &plate.inscriptions {
        let content = if name.is_axis {
            Content::Frames
        } else {
            Content::Text
        };
        let at = scaled(name.at, factor);
        let height = CAPITALS * name.size * factor;
        add(content, Shape::Text(name.text.clone(), at, height, 0.0));
        if let Some(ends) = name.leader {
            add(content, Shape::Line(ends.map(|it| scaled(it, factor))));
        }
        bounds.include(at);
    }
    let [size, row] = NOTE.map(|it| it * factor);
    let Bounds {
        low: [left, low], ..
    } = *bounds;
    let mut at = [left, low - 1.5 * row];
    if let Some(along) = plate.gravity {
        let [length, head] = GRAVITY.map(|it| it * factor);
        let from = onward([left + 0.5 * length, at[1]], -0.5 * length, along);
        let to = onward(from, length, along);
        add(Content::Loads, Shape::Line([from, to]));
        let tip = Outline::head(to, along, head).points();
        add(Content::Loads, Shape::Solid(tip));
        let beside = [left + 1.4 * length, at[1]];
        add(
            Content::Text,
            Shape::Text("g".to_string(), beside, CAPITALS * size, 0.0),
        );
        at[1] -= 1.5 * row;
    }
    for note in &plate.notes {
        add(
            Content::Text,
            Shape::Note(note.clone(), at, CAPITALS * size),
        );
        bounds.include(at);
        at[1] -= row;
    }
    drawn
}
