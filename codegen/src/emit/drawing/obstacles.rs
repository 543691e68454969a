//! Cost of covering a box of the figure with a name.
//!
//! Edges and shapes are found by the cells of a grid in which they lie, so that a box is compared with its
//! neighbourhood only.

use std::collections::BTreeMap;

use super::figure::{Look, Trace};
use super::plane::{Bounds, Point, is_inside};

/// The side of a cell in pixels.
const CELL: f64 = 32.0;

/// Outlines that names avoid.
#[derive(Clone, Debug, Default)]
pub(super) struct Obstacles {
    segments: Vec<(f64, [Point; 2])>,
    /// Shapes, each with its owner and its bounds.
    fills: Vec<(usize, Bounds, Vec<Point>)>,
    /// The segments and the fills near each cell.
    cells: BTreeMap<[i64; 2], [Vec<usize>; 2]>,
    /// Occupied boxes.
    pub taken: Vec<Bounds>,
}

/// The cells that a box meets.
fn cells(bounds: &Bounds) -> impl Iterator<Item = [i64; 2]> {
    let cell = |value: f64| (value / CELL).floor() as i64;
    let [left, low] = bounds.low.map(cell);
    let [right, high] = bounds.high.map(cell);
    (left..=right).flat_map(move |column| (low..=high).map(move |row| [column, row]))
}

impl Obstacles {
    /// Adds an outline; `owner` is the outline's index for its own name.
    pub fn add(&mut self, trace: &Trace, owner: Option<usize>) {
        let weight = match trace.look {
            Look::Hatch => 0.5,
            Look::Thought | Look::Massless => 0.6,
            Look::Path => 0.7,
            Look::Part | Look::DriveHead | Look::Drive | Look::Ink | Look::AxisHead => 2.0,
            Look::Load | Look::LoadHead => 2.0,
            _ => 1.0,
        };
        for edge in trace.segments() {
            self.add_segment(weight, edge);
        }
        if !trace.is_closed {
            return;
        }
        let bounds = Bounds::of(trace.points.iter().copied());
        match (trace.look, owner) {
            (Look::Body | Look::Disc, Some(owner)) => {
                for cell in cells(&bounds) {
                    let [_, fills] = self.cells.entry(cell).or_default();
                    fills.push(self.fills.len());
                }
                self.fills.push((owner, bounds, trace.points.clone()));
            }
            // A small closed shape hides a name within as well.
            (Look::Part | Look::Ink, _) => {
                let [low, high] = [bounds.low, bounds.high];
                self.add_segment(weight, [low, high]);
                self.add_segment(weight, [[low[0], high[1]], [high[0], low[1]]]);
            }
            _ => {}
        }
    }

    /// Pieces no longer than a cell touch few cells.
    fn add_segment(&mut self, weight: f64, [a, b]: [Point; 2]) {
        let length = super::plane::distance(a, b);
        let pieces = (length / CELL).ceil().max(1.0);
        let at = |piece: f64| [0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * piece / pieces);
        for piece in 0..pieces as usize {
            let edge = [at(piece as f64), at(piece as f64 + 1.0)];
            for cell in cells(&Bounds::of(edge)) {
                let [segments, _] = self.cells.entry(cell).or_default();
                segments.push(self.segments.len());
            }
            self.segments.push((weight, edge));
        }
    }

    /// Cost of covering a box.
    pub fn cost(&self, area: &Bounds, owner: Option<usize>) -> f64 {
        let near = area.widened(1.5);
        let [mut segments, mut fills] = [Vec::new(), Vec::new()];
        for cell in cells(&near) {
            if let Some([some, shapes]) = self.cells.get(&cell) {
                segments.extend(some);
                fills.extend(shapes);
            }
        }
        for list in [&mut segments, &mut fills] {
            list.sort_unstable();
            list.dedup();
        }
        let lines = segments.into_iter().map(|at: usize| {
            let (weight, [a, b]) = self.segments[at];
            let inside = near.length_inside(a, b);
            // Crossing a line at its narrowest costs as much as touching its end.
            if inside > 0.0 {
                weight * (inside + 2.0)
            } else {
                0.0
            }
        });
        let lines: f64 = lines.sum();
        let [low, high] = [area.low, area.high];
        let samples = [
            low,
            high,
            [low[0], high[1]],
            [high[0], low[1]],
            area.center(),
        ];
        let covered = fills.into_iter().map(|at: usize| {
            let (whose, bounds, points) = &self.fills[at];
            let near = samples.iter().filter(|it| bounds.encloses(**it));
            let inside = near.filter(|it| is_inside(**it, points));
            let inside = inside.count() as f64;
            let weight = match owner {
                Some(owner) if owner == *whose => 0.0,
                Some(_) => 6.0,
                None => 1.2,
            };
            weight * inside
        });
        lines + covered.sum::<f64>()
    }
}
