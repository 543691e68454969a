//! Composes a drawing for workshops: the picture of a pose with dimensions, as a DXF in mm.

use super::draft::corners;
use super::dxf::{Inscription, Plate, Undrawable, written};
use super::extras::Traced;
use super::figure::Figure;
use super::lettering::{PlacedNames, leader};
use super::measurable::rods;
use super::naming::SIZE;
use super::picture::{Composition, Options};
use super::plane::{Point, RELATIVE_ROUNDING, hull, scaled};
use super::pose::{Pose, Scene};
use crate::pool::Pool;
use crate::system::System;
use crate::units::{OutputUnit, OutputUnits};

/// Largest distance of a curve from its polyline, relative to the characteristic length: 1 µm for 100 mm.
pub(super) const DEVIATION: f64 = 1e-5;

/// Draws the mechanism in a pose as a DXF in mm, with dimensions and with paths of points.
///
/// Guides have the length that the other poses need. Curves are polylines within a hundred-thousandth of the characteristic length.
///
/// # Errors
/// A coordinate is not finite, or so large that a double does not resolve micrometers.
pub fn dxf(
    pool: &Pool,
    system: &System,
    shown: &Pose,
    others: &[Pose],
    paths: &[Traced],
    options: &Options,
) -> Result<String, Undrawable> {
    let deviation = DEVIATION * system.mechanism.characteristic_length;
    let scene = Scene::with_curves(pool, system, shown, others, Some(deviation));
    scene.check()?;
    let composition = Composition::new(system, &scene, paths, options, Some(&millimeters()));
    let figure = &composition.figure;
    let gravity = scene.gravity.map(|[x, y]| {
        let size = x.hypot(y);
        match size > RELATIVE_ROUNDING {
            true => [x / size, y / size],
            false => [0.0, -1.0],
        }
    });
    let notes = std::iter::once(composition.caption.clone());
    written(&Plate {
        figure,
        names: scene.bodies.iter().map(|it| it.name.clone()).collect(),
        is_marked: false,
        center_lines: center_lines(&scene, figure),
        inscriptions: inscriptions(&composition.placed),
        notes: notes.chain(figure.notes.iter().cloned()).collect(),
        gravity,
        decimals: composition.decimals,
        deviation: has_curves(&scene).then_some(deviation),
    })
}

/// Unit of a DXF.
pub(super) fn millimeters() -> OutputUnit {
    OutputUnits::default().or("mm").of("m")
}

/// True if a joint has a curve.
pub(super) fn has_curves(scene: &Scene) -> bool {
    scene.signs.iter().any(|it| it.curve.is_some())
}

fn inscriptions(placed: &PlacedNames) -> Vec<Inscription> {
    let axes = placed.axes.iter().map(|(_, at, letter)| Inscription {
        text: letter.to_string(),
        at: *at,
        size: SIZE,
        leader: None,
        is_axis: true,
        is_title: false,
    });
    let names = placed.names.iter().map(|(name, it)| Inscription {
        text: name.text.clone(),
        at: it.area.center(),
        size: SIZE,
        leader: leader(it),
        is_axis: false,
        is_title: false,
    });
    axes.chain(names).collect()
}

/// Lines between the ends of all links whose points lie on a line, in pixels.
fn center_lines(scene: &Scene, figure: &Figure) -> Vec<[Point; 2]> {
    let corners = corners(scene, figure.scale);
    let bodies = scene.bodies.iter().zip(&corners).zip(&figure.stance.places);
    let bodies = bodies.skip(1).filter(|((body, _), _)| !body.is_dial);
    let links = bodies.filter_map(|((_, corners), place)| match hull(corners)[..] {
        [from, to] => Some([from, to].map(|it| place.globally(it))),
        _ => None,
    });
    let without_body = rods(scene)
        .map(|(sign, _)| [0, 1].map(|end| scaled(scene.global(sign.marks[end]), figure.scale)));
    links.chain(without_body).collect()
}
