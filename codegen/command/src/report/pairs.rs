//! Draws one quantity of a motion against another.

use linkwright_codegen::diagnostic::nearest;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;
use linkwright_codegen::stages::units::OutputUnits;
use linkwright_solver::observable::{Named, all};
use linkwright_solver::{Observable, View};
use plotters::prelude::*;

use super::plot::{COLORS, Refused, UNITS, drawn, mesh, range};
use linkwright_page::motion::{Course, Followed};

/// Size of the picture in pixels.
const SIZE: (u32, u32) = (960, 600);

/// Two quantities, of which the second is drawn against the first.
#[derive(Clone, Debug)]
pub struct Pair([Named; 2]);

impl Pair {
    /// Returns the pairs of these columns of tables of frames.
    ///
    /// # Errors
    /// A rendered error for a name that is not a column.
    pub fn of(names: &[[String; 2]], pool: &Pool, system: &System) -> Result<Vec<Pair>, String> {
        if names.is_empty() {
            return Ok(Vec::new());
        }
        let columns = all(pool, system);
        let column = |name: &String| {
            let mut same = columns.iter().filter(|it| it.name == *name);
            same.next().cloned().ok_or_else(|| {
                let known: Vec<&str> = columns.iter().map(|it| it.name.as_str()).collect();
                let help = match nearest(name, known.iter().copied()) {
                    Some(guess) => format!("did you mean `{guess}`?"),
                    None => format!("the columns are {}", known.join(", ")),
                };
                format!("error: no column is named `{name}`\n  = help: {help}")
            })
        };
        let pairs = names
            .iter()
            .map(|[x, y]| Ok(Pair([column(x)?, column(y)?])));
        pairs.collect()
    }

    /// Stem of the picture's file: `stroke_torque`.
    pub fn stem(&self) -> String {
        let [x, y] = &self.0;
        format!("{}_{}", x.name, y.name)
    }

    /// Returns both quantities.
    pub fn observables(&self) -> [Observable; 2] {
        [self.0[0].observable, self.0[1].observable]
    }
}

/// Draws all pairs; `None` for one of which nothing changes.
///
/// # Errors
/// Errors of the drawing library.
pub fn pictures<V: View>(
    pairs: &[Pair],
    motion: &Followed<V>,
    course: &Course,
    units: &OutputUnits,
) -> Result<Vec<Option<String>>, String> {
    let pictures = pairs.iter().zip(&course.pairs).map(|(pair, path)| {
        let scales = pair.0.each_ref().map(|it| units.of(&it.unit));
        let places = path.places();
        let places: Vec<(f64, f64)> = places
            .map(|[x, y]| (scales[0].of_si(x), scales[1].of_si(y)))
            .collect();
        if places.windows(2).all(|it| it[0] == it[1]) {
            return Ok(None);
        }
        let labels = [0, 1].map(|axis| match scales[axis].name.as_str() {
            "" => pair.0[axis].name.clone(),
            unit => format!("{} ({unit})", pair.0[axis].name),
        });
        let [x, y] = &pair.0;
        let title = format!("{} against {} of {}", y.name, x.name, motion.title());
        let picture = drawn(&title, SIZE, |area| draw(area, &places, &labels));
        picture
            .map(Some)
            .map_err(|error| format!("cannot draw `{}`: {error}", pair.stem()))
    });
    pictures.collect()
}

fn draw(
    area: &super::plot::Drawing<'_>,
    places: &[(f64, f64)],
    labels: &[String; 2],
) -> Result<(), Refused> {
    let finite = || {
        places
            .iter()
            .filter(|it| it.0.is_finite() && it.1.is_finite())
    };
    let across = range(finite().map(|it| it.0), 0.0);
    let up = range(finite().map(|it| it.1), 0.0);
    let mut chart = ChartBuilder::on(area)
        .margin(8 * UNITS)
        .margin_right(24 * UNITS)
        .x_label_area_size(42 * UNITS)
        .y_label_area_size(84 * UNITS)
        .build_cartesian_2d(across.0..across.1, up.0..up.1)?;
    mesh(&mut chart, [(&labels[0], across, 11), (&labels[1], up, 11)])?;
    let stroke = COLORS[0].stroke_width(2 * UNITS);
    chart.draw_series(LineSeries::new(finite().copied(), stroke))?;
    let start = finite().next().copied();
    let radius = 4 * UNITS;
    chart.draw_series(start.map(|at| Circle::new(at, radius, COLORS[0].filled())))?;
    Ok(())
}
