//! Sheet with each link alone: its longest distance horizontal, its distances with dimensions.
//!
//! All links have one scale. They stand side by side in rows, each above its name.

use std::fmt::Write as _;

use super::dimension_svg::dimensions_text;
use super::dimensioning::dimensions;
use super::draft::drafted;
use super::dxf::{Inscription, Plate, Undrawable, written};
use super::figure::{Figure, Outline};
use super::label::{Label, placed};
use super::legend::legend_text;
use super::lettering::leader;
use super::letters::width;
use super::link_shapes::{LinkShape, link_shapes};
use super::measurable::measure;
use super::naming::{SIZE, around, obstacles};
use super::picture::{Options, opening, unit_of_dimensions};
use super::plane::{Bounds, Place, Point, difference, distance, sum};
use super::plate::{DEVIATION, has_curves, millimeters};
use super::pose::{Pose, Scene};
use super::stance::Stance;
use super::style::sheet;
use super::svg::{Written, layers, number, path_data};
use crate::emit::markup::escaped;
use crate::pool::Pool;
use crate::system::System;
use crate::units::OutputUnit;

/// Length of the longest link, and width of the sheet, in pixels.
const LINK_LENGTH: f64 = 420.0;
const WIDTH: f64 = 1120.0;

/// Smallest extent that decides the scale, in pixels: links may be single points.
const ALONE: f64 = 0.5;

/// Largest number of corners of a polygon that belongs to a sign.
const CORNERS_OF_SIGNS: usize = 8;

/// Room around a link, and height of the legend.
const GAP: f64 = 26.0;
const LEGEND: f64 = 40.0;

/// Draws each link alone as an SVG, with dimensions in the unit of lengths of the description or in mm; `None` without links.
pub fn links(pool: &Pool, system: &System, shown: &Pose, options: &Options) -> Option<String> {
    let scene = Scene::new(pool, system, shown, &[]);
    let unit = unit_of_dimensions(system);
    Some(LinkSheet::new(&scene, &unit, options)?.svg(system, options, &unit))
}

/// Draws each link alone as a DXF in mm, with dimensions; `None` without links.
///
/// # Errors
/// A coordinate is not finite, or so large that a double does not resolve micrometers.
pub fn links_dxf(
    pool: &Pool,
    system: &System,
    shown: &Pose,
    options: &Options,
) -> Result<Option<String>, Undrawable> {
    let deviation = DEVIATION * system.mechanism.characteristic_length;
    let scene = Scene::with_curves(pool, system, shown, &[], Some(deviation));
    scene.check()?;
    let Some(drawn) = LinkSheet::new(&scene, &millimeters(), options) else {
        return Ok(None);
    };
    let names = std::iter::once("ground").chain(drawn.names.iter().map(String::as_str));
    written(&Plate {
        figure: &drawn.figure,
        names: names.map(String::from).collect(),
        is_marked: true,
        center_lines: Vec::new(),
        inscriptions: drawn.inscriptions.clone(),
        notes: vec![drawn.caption.clone()],
        gravity: None,
        decimals: drawn.decimals,
        deviation: has_curves(&scene).then_some(deviation),
    })
    .map(Some)
}

/// Links in their positions.
#[derive(Debug)]
struct LinkSheet {
    figure: Figure,
    names: Vec<String>,
    inscriptions: Vec<Inscription>,
    caption: String,
    decimals: usize,
    /// Extent in pixels; y points upwards.
    bounds: Bounds,
}

/// Link with its dimensions and names about its own origin.
struct Panel {
    figure: Figure,
    inscriptions: Vec<Inscription>,
    bounds: Bounds,
}

impl LinkSheet {
    fn new(scene: &Scene, unit_of_lengths: &OutputUnit, options: &Options) -> Option<LinkSheet> {
        let links_at = |scale: f64| {
            let (figure, unit) = drafted(scene, scale);
            (link_shapes(scene, &figure, unit), figure)
        };
        let size = scene.size.max(f64::MIN_POSITIVE);
        let (rough, _) = links_at(LINK_LENGTH / size);
        let extents = rough.iter().map(extent).fold(0.0, f64::max);
        let scale = match extents > ALONE {
            true => LINK_LENGTH / size * LINK_LENGTH / extents,
            false => LINK_LENGTH / size,
        };
        let (links, drafted) = links_at(scale);
        let place = |link: &LinkShape| Place {
            origin: [0.0; 2],
            angle: link.angle,
        };
        let measured: Vec<_> = links
            .iter()
            .map(|link| link.measurable(place(link), scale))
            .collect();
        let measure = measure(&measured, unit_of_lengths);
        let empty = Figure {
            stance: Stance::default(),
            bodies: Vec::new(),
            joints: Vec::new(),
            extras: Vec::new(),
            notes: Vec::new(),
            diameters: Vec::new(),
            ..drafted
        };
        let mut all = LinkSheet {
            figure: empty.clone(),
            names: links.iter().map(|it| it.name.clone()).collect(),
            inscriptions: Vec::new(),
            caption: options.caption.clone(),
            decimals: measure.decimals,
            bounds: Bounds::EMPTY,
        };
        all.figure.stance.places.push(Place::default());
        let panels = links.iter().zip(&measured).map(|(link, measured)| {
            let mut figure = empty.clone();
            figure.stance.places = vec![Place::default(), place(link)];
            figure.bodies = vec![link.group(1)];
            figure.dimensions = dimensions(&figure, std::slice::from_ref(measured), &measure);
            Panel::new(link, figure)
        });
        let panels: Vec<Panel> = panels.collect();
        for ((link, panel), corner) in links.iter().zip(&panels).zip(corners(&panels)) {
            let by = difference(corner, panel.bounds.low);
            let frame = all.figure.stance.places.len();
            let Place { origin, angle } = panel.figure.stance.places[1];
            all.figure.stance.places.push(Place {
                origin: sum(origin, by),
                angle,
            });
            all.figure.bodies.push(link.group(frame));
            let dimensions = panel.figure.dimensions.iter();
            all.figure
                .dimensions
                .extend(dimensions.map(|it| it.moved(by)));
            let inscriptions = panel.inscriptions.iter().cloned();
            all.inscriptions.extend(inscriptions.map(|it| it.moved(by)));
            all.bounds.include(corner);
            all.bounds.include(sum(corner, panel.bounds.size()));
        }
        if !all.figure.dimensions.is_empty() {
            all.caption += &format!(", dimensions in {}", measure.unit_name());
        }
        (!links.is_empty()).then_some(all)
    }

    fn svg(&self, system: &System, options: &Options, unit: &OutputUnit) -> String {
        let extent = self.bounds.size();
        let needed = 270.0 + width(&self.caption, SIZE);
        let size = [
            (extent[0] + 2.0 * GAP).max(needed).ceil(),
            (extent[1] + 2.0 * GAP + LEGEND).ceil(),
        ];
        let title = format!("links of {}", system.mechanism.title());
        let mut text = opening(size, &title);
        let _ = writeln!(
            text,
            "<style>\n{}</style>",
            sheet(options.themes, &self.figure)
        );
        let [width, height] = size.map(number);
        let _ = writeln!(
            text,
            "<rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>"
        );
        let origin = [GAP - self.bounds.low[0], GAP + self.bounds.high[1]];
        let [x, y] = origin.map(|it| number(it.round()));
        let _ = writeln!(
            text,
            "<g id=\"links\" data-scale=\"{}\" transform=\"translate({x} {y})\">",
            self.figure.scale
        );
        text += &layers(&self.figure, "", Written::Picture);
        text += &dimensions_text(&self.figure.dimensions);
        text.push_str("<g id=\"names\">\n");
        for name in &self.inscriptions {
            if let Some([from, to]) = name.leader {
                let line = path_data(&Outline::line(from, to));
                let _ = write!(text, "<path class=\"leader\" d=\"{line}\"/>");
            }
            let class = if name.is_title { "name" } else { "point" };
            let _ = writeln!(
                text,
                "<text class=\"{class}\" x=\"{}\" y=\"{}\">{}</text>",
                number(name.at[0]),
                number(0.35 * name.size - name.at[1]),
                escaped(&name.text)
            );
        }
        text.push_str("</g>\n</g>\n");
        let caption = (self.caption.as_str(), Some(unit));
        text += &legend_text(&self.figure, true, None, size, caption);
        text + "</svg>\n"
    }
}

/// Largest distance of two points of a link, largest diameter, or largest side of a curve, in pixels.
fn extent(link: &LinkShape) -> f64 {
    let points = link.points.iter();
    let distances = points.flat_map(|a| link.points.iter().map(move |b| distance(*a, *b)));
    let diameters = link.circles.iter().map(|(_, radius)| 2.0 * radius);
    let curves = link
        .elements
        .iter()
        .filter_map(|(_, _, outline)| match outline {
            // Signs have fewer corners.
            Outline::Closed(points) | Outline::Open(points) if points.len() > CORNERS_OF_SIGNS => {
                let [width, height] = Bounds::of(points.iter().copied()).size();
                Some(width.max(height))
            }
            _ => None,
        });
    distances.chain(diameters).chain(curves).fold(0.0, f64::max)
}

/// Lower left corners of panels in rows, from the upper left.
fn corners(panels: &[Panel]) -> Vec<Point> {
    let mut rows: Vec<Vec<Point>> = Vec::new();
    let mut right = f64::INFINITY;
    for panel in panels {
        let size = panel.bounds.size();
        if right + size[0] > WIDTH {
            rows.push(Vec::new());
            right = 0.0;
        }
        if let Some(row) = rows.last_mut() {
            row.push(size);
        }
        right += size[0] + GAP;
    }
    let mut top = 0.0;
    let mut corners = Vec::new();
    for row in rows {
        let height = row.iter().fold(0.0, |most: f64, it| most.max(it[1]));
        let mut left = 0.0;
        for size in row {
            corners.push([left, top - height]);
            left += size[0] + GAP;
        }
        top -= height + GAP;
    }
    corners
}

impl Panel {
    /// Places the names of points beside a link, and its own name below.
    fn new(link: &LinkShape, figure: Figure) -> Panel {
        let place = figure.stance.places[1];
        let mut named: Vec<(Point, &String)> = Vec::new();
        for (at, name) in &link.names {
            let is_known =
                |(it, other): &(Point, &String)| *other == name && distance(*it, *at) < 1.0;
            if !named.iter().any(is_known) {
                named.push((*at, name));
            }
        }
        let labels: Vec<Label> = named
            .iter()
            .map(|(at, name)| Label {
                half: [0.5 * width(name, SIZE), 0.5 * SIZE],
                anchors: around(place.globally(*at), 8.5),
                owner: None,
            })
            .collect();
        let mut bounds = figure.bounds();
        let area = bounds.widened(2.0 * SIZE);
        let places = placed(&labels, &obstacles(&figure), &area);
        let mut inscriptions = Vec::new();
        for ((_, name), it) in named.iter().zip(places) {
            let Some(it) = it else { continue };
            bounds.include(it.area.low);
            bounds.include(it.area.high);
            inscriptions.push(Inscription {
                text: name.to_string(),
                at: it.area.center(),
                size: SIZE,
                leader: leader(&it),
                is_axis: false,
                is_title: false,
            });
        }
        let half = 0.5 * width(&link.name, SIZE);
        let at = [bounds.center()[0], bounds.low[1] - SIZE];
        bounds.include([at[0] - half, at[1] - 0.5 * SIZE]);
        bounds.include([at[0] + half, at[1] - 0.5 * SIZE]);
        inscriptions.push(Inscription {
            text: link.name.clone(),
            at,
            size: SIZE,
            leader: None,
            is_axis: false,
            is_title: true,
        });
        Panel {
            figure,
            inscriptions,
            bounds,
        }
    }
}
