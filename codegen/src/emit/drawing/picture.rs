//! Composes the picture of a scene with names, a scale bar and a caption.

use std::fmt::Write as _;

use super::dimension_svg::dimensions_text;
use super::dimensioning::dimensions;
use super::draft::drafted;
use super::extras::{Gap, Traced};
use super::figure::Figure;
use super::legend::{ROW, legend_text};
use super::lettering::{Lettering, PlacedNames, lettering, names_text, placed_names};
use super::letters::width;
use super::measurable::{measurables, measure};
use super::naming::SIZE;
use super::plane::{Bounds, Point, RELATIVE_ROUNDING};
use super::pose::{Pose, Scene};
use super::style::{Themes, sheet};
use super::svg::{Written, layers, number};
use crate::emit::markup::escaped;
use crate::pool::Pool;
use crate::system::System;
use crate::units::OutputUnit;

/// Options of a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Width and height in pixels; `None` for the size that the figure needs.
    pub size: Option<[u32; 2]>,
    /// Bodies whose frames are drawn: indices into those of the mechanism, 0 for the ground.
    pub frames: Vec<usize>,
    /// Text in the lower right corner.
    pub caption: String,
    /// Pixels per metre; `None` for those with which the figure fills the picture.
    pub scale: Option<f64>,
    /// True if names lie beside their points without a search for room, as in a picture that is replaced at once.
    pub is_sketch: bool,
    /// Two points that should coincide; `None` if all do.
    pub gap: Option<Gap>,
    /// True if the picture has room for the other poses, and names refer to their points, for scripts that move it.
    pub is_moving: bool,
    /// Source of the choice between light and dark.
    pub themes: Themes,
    /// True if the distances between the points of each link are shown, in the unit of lengths of the description or in mm.
    pub has_dimensions: bool,
}

/// Largest picture without a requested size.
const LARGEST_PICTURE: Point = [760.0, 620.0];
/// Smallest picture without a requested size.
const SMALLEST_PICTURE: Point = [420.0, 220.0];

/// Margin for names around the figure.
const MARGIN: f64 = 30.0;

/// Room for dimensions around the figure.
const DIMENSIONS: f64 = 44.0;

/// Room for the scale bar with its text beside a caption.
const SCALE_BAR: f64 = 270.0;

/// Number of poses of a moving figure that decide its bounds.
const REACHED: usize = 32;

/// Draws the mechanism in a pose, with paths of points. Guides have the length that the other poses need.
pub fn draw(
    pool: &Pool,
    system: &System,
    shown: &Pose,
    others: &[Pose],
    paths: &[Traced],
    options: &Options,
) -> String {
    let scene = Scene::new(pool, system, shown, others);
    let written = match options.is_moving {
        true => Written::Moving,
        false => Written::Picture,
    };
    let unit = options.has_dimensions.then(|| unit_of_dimensions(system));
    Composition::new(system, &scene, paths, options, unit.as_ref()).text(written)
}

/// Unit of dimensions: that of lengths, or mm if none is chosen.
pub(super) fn unit_of_dimensions(system: &System) -> OutputUnit {
    let requested = system.mechanism.units.requested.clone();
    requested.unwrap_or_default().or("mm").of("m")
}

/// A picture before it is written.
#[derive(Debug)]
pub(super) struct Composition {
    pub figure: Figure,
    head: String,
    names: Vec<Lettering>,
    pub placed: PlacedNames,
    /// Text in the lower right corner.
    pub caption: String,
    /// Decimals of dimensions.
    pub decimals: usize,
    foot: String,
}

impl Composition {
    /// Finds a scale and positions for all names, and for dimensions in a unit if there is one.
    pub fn new(
        system: &System,
        scene: &Scene,
        paths: &[Traced],
        options: &Options,
        unit_of_dimensions: Option<&OutputUnit>,
    ) -> Composition {
        let title = system.mechanism.title();
        let notes = noted(scene);
        let legend = 12.0 + ROW * (1.0 + notes as f64);
        let room = options
            .size
            .map_or(LARGEST_PICTURE, |size| size.map(f64::from));
        let margin = MARGIN
            + match unit_of_dimensions {
                Some(_) => DIMENSIONS,
                None => 0.0,
            };
        let inner = [
            (room[0] - 2.0 * margin).max(40.0),
            (room[1] - 2.0 * margin - legend).max(40.0),
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
        let fitted = || fitted(scene, inner, |scale| bounds(&complete(scale).0));
        let scale = options.scale.unwrap_or_else(fitted);
        let (mut figure, unit) = complete(scale);
        let (mut caption, mut decimals) = (options.caption.clone(), 0);
        if let Some(unit) = unit_of_dimensions {
            let links = measurables(scene, &figure);
            let measure = measure(&links, unit);
            decimals = measure.decimals;
            figure.dimensions = dimensions(&figure, &links, &measure);
            if !figure.dimensions.is_empty() {
                caption += &format!(", dimensions in {}", measure.unit_name());
            }
        }
        let bounds = bounds(&figure);
        let size = match options.size {
            Some(size) => size.map(f64::from),
            None => {
                let needed = bounds.size();
                // A unit of dimensions must not be left out.
                let words = match figure.dimensions.is_empty() {
                    true => 0.0,
                    false => SCALE_BAR + width(&caption, SIZE),
                };
                [
                    (needed[0] + 2.0 * MARGIN)
                        .max(words)
                        .clamp(SMALLEST_PICTURE[0], LARGEST_PICTURE[0])
                        .ceil(),
                    (needed[1] + 2.0 * MARGIN + legend)
                        .clamp(SMALLEST_PICTURE[1], LARGEST_PICTURE[1])
                        .ceil(),
                ]
            }
        };
        // Position of the origin in the picture, with y upwards from its lower edge.
        let middle = [0.5 * size[0], 0.5 * (size[1] + legend)];
        let origin = [0, 1].map(|axis| (middle[axis] - bounds.center()[axis]).round());
        let area = Bounds {
            low: [4.0 - origin[0], legend - origin[1]],
            high: [size[0] - 4.0 - origin[0], size[1] - 4.0 - origin[1]],
        };
        let mut text = opening(size, &title);
        let _ = writeln!(text, "<style>\n{}</style>", sheet(options.themes, &figure));
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
        let is_scaled = !scene.is_of_angles_alone();
        let requested = system.mechanism.units.requested.as_ref();
        let unit_of_lengths = requested.and_then(|it| it.of_lengths());
        let words_of_dimensions = caption.clone();
        let caption = (caption.as_str(), unit_of_lengths);
        let legend = legend_text(&figure, is_scaled, scene.gravity, size, caption);
        let placed = placed_names(scene, &figure, unit, &area, options);
        Composition {
            head: text,
            names: lettering(scene, &figure, &placed),
            placed,
            caption: words_of_dimensions,
            decimals,
            foot: format!("</g>\n{legend}</svg>\n"),
            figure,
        }
    }

    /// The picture as it was composed.
    pub fn text(&self, written: Written<'_>) -> String {
        self.text_of(&self.figure, written)
    }

    /// Returns the text with the figure in another pose.
    pub fn text_of(&self, figure: &Figure, written: Written<'_>) -> String {
        let layers = layers(figure, "", written) + &dimensions_text(&figure.dimensions);
        let names = names_text(&self.names, [&self.figure, figure], written);
        format!("{}{layers}{names}{}", self.head, self.foot)
    }
}

/// First tag, with the title of the picture.
pub(super) fn opening(size: Point, title: &str) -> String {
    let [width, height] = size.map(number);
    let title = escaped(title);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"linkwright\" role=\"img\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">\n<title>{title}</title>\n"
    )
}

/// Bounds of the figure over a sample of its poses.
fn reached(figure: &Figure, scene: &Scene) -> Bounds {
    let every = scene.motion.len().div_ceil(REACHED).max(1);
    let poses = (0..scene.motion.len()).step_by(every);
    let corners = poses.flat_map(|pose| {
        let bounds = figure.moved(scene.stance(pose, figure.scale)).bounds();
        [bounds.low, bounds.high]
    });
    Bounds::of(corners)
}

/// Number of notes in the legend.
fn noted(scene: &Scene) -> usize {
    let signs = scene.signs.iter();
    signs
        .filter(|it| it.feature == crate::joint::Feature::Written)
        .count()
}

/// Pixels per metre with which a figure fills an area. Signs do not grow with the scale, so that it is approached in
/// steps.
pub(super) fn fitted(scene: &Scene, room: Point, bounds: impl Fn(f64) -> Bounds) -> f64 {
    let places = scene.bodies.iter().flat_map(|body| {
        let origin = std::iter::once(body.place.origin);
        origin.chain(body.points.iter().map(|it| body.place.globally(*it)))
    });
    let extent = Bounds::of(places.skip(1)).size();
    let extent = extent[0].max(extent[1]);
    let least = room[0].min(room[1]);
    let most = match extent > RELATIVE_ROUNDING * scene.size {
        true => 4.0 * room[0].max(room[1]) / extent,
        false => 0.4 * least / scene.size,
    };
    let mut scale = 0.5 * least
        / extent
            .max(scene.size * RELATIVE_ROUNDING)
            .max(f64::MIN_POSITIVE);
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
