//! *A scene* → *one picture with names, a scale bar and a caption*.

use std::fmt::Write as _;

use super::draft::drafted;
use super::extras::{AXIS, Gap, Traced};
use super::figure::{Figure, Frame};
use super::label::placed;
use super::legend::{ROW, legend_text};
use super::naming::{Name, Named, SIZE, missing, names, obstacles};
use super::plane::{Bounds, NEGLIGIBLE, Place, Point, distance, onward, scaled};
use super::pose::{Entitled, Pose, Scene};
use super::style::{TINTS, Themes, sheet};
use super::svg::{Written, layers, number};
use crate::emit::markup::escaped;
use crate::system::System;

/// What can be chosen about a drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Width and height in pixels; where none is given, as much as the drawing needs.
    pub size: Option<[u32; 2]>,
    /// The bodies whose frames are drawn: indices into those of the mechanism, 0 for the ground.
    pub frames: Vec<usize>,
    /// What stands in the lower right corner.
    pub caption: String,
    /// Two points that ought to coincide; `None` where all do.
    pub gap: Option<Gap>,
    /// Whether there is room for the other poses too, and names say what they follow, for whoever moves the mechanism.
    pub is_moving: bool,
    /// Who chooses between light and dark.
    pub themes: Themes,
}

/// The largest picture where no size is given.
const LARGEST: Point = [760.0, 620.0];
/// The smallest.
const SMALLEST: Point = [420.0, 220.0];

/// Room for names around the figure.
const MARGIN: f64 = 30.0;

/// In how many poses a moving figure is looked at.
const REACHED: usize = 32;

/// The mechanism in a pose, with paths of points. Guides are as long as what slides on them needs in the other poses.
pub fn draw(
    system: &System,
    shown: &Pose,
    others: &[Pose],
    paths: &[Traced],
    options: &Options,
) -> String {
    drawn(system, &Scene::new(system, shown, others), paths, options).0
}

/// A scene as text, and its figure.
pub(super) fn drawn(
    system: &System,
    scene: &Scene,
    paths: &[Traced],
    options: &Options,
) -> (String, Figure) {
    let title = system.mechanism.title();
    let notes = noted(scene);
    let legend = 12.0 + ROW * (1.0 + notes as f64);
    let room = options.size.map_or(LARGEST, |size| size.map(f64::from));
    let inner = [
        (room[0] - 2.0 * MARGIN).max(40.0),
        (room[1] - 2.0 * MARGIN - legend).max(40.0),
    ];
    let complete = |scale: f64| {
        let (mut figure, unit) = drafted(scene, scale);
        paths.iter().for_each(|path| figure.trace(path));
        for &body in &options.frames {
            figure.axes(body, &scene.bodies[body].name, unit);
        }
        options.gap.iter().for_each(|gap| figure.gap(gap));
        (figure, unit)
    };
    let bounds = |figure: &Figure| match options.is_moving {
        true => reached(figure, scene),
        false => figure.bounds(),
    };
    let scale = fitted(scene, inner, |scale| bounds(&complete(scale).0));
    let (figure, unit) = complete(scale);
    let bounds = bounds(&figure);
    let size = match options.size {
        Some(size) => size.map(f64::from),
        None => {
            let needed = bounds.size();
            [
                (needed[0] + 2.0 * MARGIN)
                    .clamp(SMALLEST[0], LARGEST[0])
                    .ceil(),
                (needed[1] + 2.0 * MARGIN + legend)
                    .clamp(SMALLEST[1], LARGEST[1])
                    .ceil(),
            ]
        }
    };
    // Where the origin is in the picture, with y upwards from its lower edge.
    let middle = [0.5 * size[0], 0.5 * (size[1] + legend)];
    let origin = [0, 1].map(|axis| (middle[axis] - bounds.center()[axis]).round());
    let area = Bounds {
        low: [4.0 - origin[0], legend - origin[1]],
        high: [size[0] - 4.0 - origin[0], size[1] - 4.0 - origin[1]],
    };
    let mut text = opening(size, &title);
    let _ = writeln!(text, "<style>\n{}</style>", sheet(options.themes));
    let _ = writeln!(
        text,
        "<rect class=\"paper\" width=\"{}\" height=\"{}\"/>",
        number(size[0]),
        number(size[1])
    );
    let _ = writeln!(
        text,
        "<g id=\"mechanism\" data-scale=\"{scale}\" transform=\"translate({} {})\">",
        number(origin[0]),
        number(size[1] - origin[1])
    );
    let written = match options.is_moving {
        true => Written::Moving,
        false => Written::Picture,
    };
    text += &layers(&figure, "", written);
    text += &labels(scene, &figure, unit, &area, options);
    text.push_str("</g>\n");
    let is_scaled = !scene.is_of_angles_alone();
    text += &legend_text(&figure, is_scaled, scene.gravity, size, &options.caption);
    text.push_str("</svg>\n");
    (text, figure)
}

/// The first tag, and what the picture is called.
pub(super) fn opening(size: Point, title: &str) -> String {
    let [width, height] = size.map(number);
    let title = escaped(title);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"linkwright\" role=\"img\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">\n<title>{title}</title>\n"
    )
}

/// Around the figure in the poses that the drawing is made for, as many of them as tell how far it comes.
fn reached(figure: &Figure, scene: &Scene) -> Bounds {
    let every = scene.motion.len().div_ceil(REACHED).max(1);
    let poses = scene.motion.iter().zip(&scene.arrows);
    let corners = poses.step_by(every).flat_map(|(places, arrows)| {
        let places = places.iter().map(|place| Place {
            origin: scaled(place.origin, figure.scale),
            angle: place.angle,
        });
        let bounds = figure.moved(places.collect(), arrows.clone()).bounds();
        [bounds.low, bounds.high]
    });
    Bounds::of(corners)
}

/// How many notes the legend has.
fn noted(scene: &Scene) -> usize {
    let signs = scene.signs.iter();
    signs
        .filter(|it| it.feature == crate::joint::Feature::Written)
        .count()
}

/// The pixels per metre with which a figure fills a room. Signs do not grow with the scale, so it is approached in steps.
pub(super) fn fitted(scene: &Scene, room: Point, bounds: impl Fn(f64) -> Bounds) -> f64 {
    let places = scene.bodies.iter().flat_map(|body| {
        let origin = std::iter::once(body.place.origin);
        origin.chain(body.points.iter().map(|it| body.place.globally(*it)))
    });
    let extent = Bounds::of(places.skip(1)).size();
    let extent = extent[0].max(extent[1]);
    let least = room[0].min(room[1]);
    let most = match extent > NEGLIGIBLE * scene.size {
        true => 4.0 * room[0].max(room[1]) / extent,
        false => 0.4 * least / scene.size,
    };
    let mut scale = 0.5 * least / extent.max(scene.size * NEGLIGIBLE).max(f64::MIN_POSITIVE);
    scale = scale.min(most);
    for _ in 0..12 {
        let size = bounds(scale).size();
        let factor = [0, 1]
            .map(|axis| room[axis] / size[axis].max(1.0))
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        scale = (scale * factor).min(most);
    }
    scale
}

/// The names where they stand.
pub(super) fn labels(
    scene: &Scene,
    figure: &Figure,
    unit: f64,
    area: &Bounds,
    options: &Options,
) -> String {
    let mut names = names(scene, figure, unit);
    names.extend(options.gap.iter().map(|gap| missing(gap, figure)));
    let mut obstacles = obstacles(figure);
    let mut text = String::from("<g id=\"names\">\n");
    for &body in &options.frames {
        let place = figure.place(Frame::Body(body));
        for (along, letter) in [([1.0, 0.0], "x"), ([0.0, 1.0], "y")] {
            let at = place.globally(onward([0.0; 2], AXIS * unit + 9.0, along));
            obstacles.taken.push(Bounds::around(at, [6.0, 7.0]));
            let _ = writeln!(
                text,
                "<text class=\"axis-name\" x=\"{}\" y=\"{}\">{letter}</text>",
                number(at[0]),
                number(0.35 * SIZE - at[1])
            );
        }
    }
    let boxes: Vec<_> = names.iter().map(|name| name.label.clone()).collect();
    let placed = placed(&boxes, &obstacles, area);
    for (name, placed) in names.iter().zip(&placed) {
        let Some(placed) = placed else { continue };
        let center = placed.area.center();
        let half = name.label.half;
        let tint = match name.of {
            Named::Body(body) => format!(" class=\"tint-{}\"", (body - 1) % TINTS),
            Named::Point(_) | Named::Gap => String::new(),
        };
        let follows = match options.is_moving {
            true => followed(name, center, scene, figure),
            false => String::new(),
        };
        let _ = write!(text, "<g{tint}{follows}>");
        if let Some(to) = placed.leader {
            let from = nearest(&placed.area, to);
            let length = distance(from, to);
            let to = onward(
                from,
                (length - 6.0).max(0.0) / length.max(1.0),
                [to[0] - from[0], to[1] - from[1]],
            );
            let _ = write!(
                text,
                "<path class=\"leader\" d=\"M{} {}L{} {}\"/>",
                number(from[0]),
                number(-from[1]),
                number(to[0]),
                number(-to[1])
            );
        }
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
        let _ = writeln!(
            text,
            "<text class=\"{class}\" x=\"{}\" y=\"{}\">{}</text></g>",
            number(center[0]),
            number(0.35 * SIZE - center[1]),
            escaped(&name.text)
        );
    }
    text.push_str("</g>\n");
    text
}

/// What a name follows: a point of a body, in pixels of its frame with y downwards.
fn followed(name: &Name, center: Point, scene: &Scene, figure: &Figure) -> String {
    let (body, [x, y], point) = match name.of {
        Named::Point(place) => {
            let Entitled { at, name, .. } = &scene.points[place];
            let point = format!(" data-point=\"{}\"", escaped(name));
            (at.body, scaled(at.local, figure.scale), point)
        }
        Named::Body(body) => (body, figure.places[body].locally(center), String::new()),
        Named::Gap => return String::new(),
    };
    let [x, y] = [x, -y].map(number);
    format!(" data-follows=\"{body} {x} {y}\"{point}")
}

/// The point of a box that is nearest to another.
fn nearest(area: &Bounds, to: Point) -> Point {
    [0, 1].map(|axis| to[axis].clamp(area.low[axis], area.high[axis]))
}
