//! Draws several poses of one mechanism as panels of one picture, all at one scale.

use std::fmt::Write as _;

use super::draft::drafted;
use super::lettering::{lettering, names_text, placed_names};
use super::naming::SIZE;
use super::picture::{Options, fitted, opening};
use super::plane::{Bounds, Point};
use super::pose::{Pose, Scene};
use super::style::{Themes, sheet as style};
use super::svg::{Written, layers, number};
use crate::emit::markup::escaped;
use crate::pool::Pool;
use crate::system::System;

/// Pose with its title.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Title.
    pub title: String,
    /// Pose.
    pub pose: Pose,
}

/// Width of the whole.
const WIDTH: f64 = 1120.0;

/// Largest width of a panel.
const WIDEST: f64 = 420.0;

/// Largest number of panels side by side.
const COLUMNS: usize = 8;

/// Largest number of columns with room for names.
const WITH_NAMES: usize = 3;

/// The height of a title.
const TITLE: f64 = 24.0;

/// Room around a figure.
const MARGIN: f64 = 12.0;

/// Draws the poses side by side, each in the middle of its panel; empty without poses.
pub fn sheet(pool: &Pool, system: &System, panels: &[Panel]) -> String {
    let scenes: Vec<Scene> = panels
        .iter()
        .map(|panel| Scene::new(pool, system, &panel.pose, &[]))
        .collect();
    let Some(first) = scenes.first() else {
        return String::new();
    };
    let columns = ((panels.len() as f64).sqrt().ceil() as usize).min(COLUMNS);
    let width = (WIDTH / columns as f64).min(WIDEST).floor();
    let has_names = columns <= WITH_NAMES;
    let margin = MARGIN + if has_names { SIZE } else { 0.0 };
    let room = [width - 2.0 * margin, width - 2.0 * margin];
    let bounds = |scale: f64| {
        let sizes = scenes.iter().map(|it| drafted(it, scale).0.bounds().size());
        let largest = sizes.fold([0.0_f64; 2], |most, it| {
            [most[0].max(it[0]), most[1].max(it[1])]
        });
        Bounds {
            low: [0.0; 2],
            high: largest,
        }
    };
    let scale = fitted(first, room, bounds);
    let needed = bounds(scale).size();
    let height = (needed[1] + 2.0 * margin + TITLE).ceil();
    let rows = panels.len().div_ceil(columns);
    let size: Point = [width * columns as f64, height * rows as f64];
    let mut text = opening(size, &format!("assemblies of {}", system.mechanism.title()));
    let _ = writeln!(
        text,
        "<style>\n{}</style>",
        style(Themes::System, &drafted(first, scale).0)
    );
    let _ = writeln!(
        text,
        "<rect class=\"paper\" width=\"{}\" height=\"{}\"/>",
        number(size[0]),
        number(size[1])
    );
    for (place, (panel, scene)) in panels.iter().zip(&scenes).enumerate() {
        let corner = [
            width * (place % columns) as f64,
            height * (place / columns) as f64,
        ];
        let (figure, unit) = drafted(scene, scale);
        let center = figure.bounds().center();
        let middle = [0.5 * width, TITLE + 0.5 * (height - TITLE)];
        let origin = [
            (corner[0] + middle[0] - center[0]).round(),
            (corner[1] + middle[1] + center[1]).round(),
        ];
        let _ = writeln!(
            text,
            "<text class=\"point\" x=\"{}\" y=\"{}\">{}</text>",
            number(corner[0] + 0.5 * width),
            number(corner[1] + 17.0),
            escaped(&panel.title)
        );
        let number_of = place + 1;
        let _ = writeln!(
            text,
            "<g id=\"assembly-{number_of}\" data-scale=\"{scale}\" transform=\"translate({} {})\">",
            number(origin[0]),
            number(origin[1])
        );
        let prefix = format!("assembly-{number_of}-");
        text += &layers(&figure, &prefix, Written::Picture);
        if has_names {
            let low = [corner[0] - origin[0], origin[1] - corner[1] - height];
            let area = Bounds {
                low: [low[0] + 3.0, low[1] + 3.0],
                high: [low[0] + width - 3.0, low[1] + height - TITLE],
            };
            let names = placed_names(scene, &figure, unit, &area, &Options::default());
            let names = lettering(scene, &figure, &names);
            text += &names_text(&names, [&figure, &figure], Written::Picture);
        }
        text.push_str("</g>\n");
    }
    text.push_str("</svg>\n");
    text
}
