//! Hatches rectangles of a chart by slanted lines at equal distances, which neighboring rectangles share.

use std::collections::BTreeMap;

use plotters::prelude::*;

use super::plot::UNITS;

/// Distance of the lines of a hatching, in pixels.
const HATCH: f64 = 7.0;

/// Length in units of the picture that the drawing library rounds to nothing.
const ROUNDED: f64 = 0.5;

/// Drawn area of a chart.
pub(super) struct Surface {
    /// Ends of both axes.
    pub ends: [(f64, f64); 2],
    /// Width and height in units of the picture.
    pub size: (u32, u32),
}

impl Surface {
    /// Returns the width and the height of a pixel.
    pub fn pixel(&self) -> [f64; 2] {
        let size = [self.size.0, self.size.1];
        [0, 1].map(|axis| {
            let (low, high) = self.ends[axis];
            (high - low) * f64::from(UNITS) / f64::from(size[axis])
        })
    }

    /// Returns the lines that hatch some rectangles, each given by its ends across and up. Where a line leaves one rectangle and enters
    /// another, it continues.
    pub fn hatched(&self, rectangles: &[[[f64; 2]; 2]]) -> Vec<Vec<(f64, f64)>> {
        let pixels = |axis: usize, at: f64| {
            let (low, high) = self.ends[axis];
            (at - low) / (high - low) * self.length(axis)
        };
        let value = |axis: usize, at: f64| {
            let (low, high) = self.ends[axis];
            low + at / self.length(axis) * (high - low)
        };
        let distance = HATCH * f64::from(UNITS);
        // On a line, the sum of both coordinates is this multiple of the distance; across, it has some pieces.
        let mut pieces: BTreeMap<i64, Vec<[f64; 2]>> = BTreeMap::new();
        for [across, up] in rectangles {
            let [left, right] = across.map(|it| pixels(0, it));
            let [bottom, top] = up.map(|it| pixels(1, it));
            let first = ((left + bottom) / distance).ceil() as i64;
            let last = ((right + top) / distance).floor() as i64;
            for line in first..=last {
                let sum = line as f64 * distance;
                let piece = [left.max(sum - top), right.min(sum - bottom)];
                pieces.entry(line).or_default().push(piece);
            }
        }
        let lines = pieces.into_iter().flat_map(|(line, pieces)| {
            let sum = line as f64 * distance;
            let point = move |at: f64| (value(0, at), value(1, sum - at));
            let joined = joined(pieces).into_iter();
            joined.map(move |[begin, end]| vec![point(begin), point(end)])
        });
        lines.collect()
    }

    /// Returns the width or the height in units of the picture.
    fn length(&self, axis: usize) -> f64 {
        f64::from([self.size.0, self.size.1][axis])
    }
}

/// Joins pieces that meet, and leaves out those that are shorter than the drawing library tells apart.
fn joined(mut pieces: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    pieces.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut joined: Vec<[f64; 2]> = Vec::with_capacity(pieces.len());
    for [begin, end] in pieces {
        match joined.last_mut() {
            Some(last) if begin - last[1] < ROUNDED => last[1] = last[1].max(end),
            _ => joined.push([begin, end]),
        }
    }
    joined.retain(|[begin, end]| end - begin >= ROUNDED);
    joined
}

/// Returns a line of a hatching.
pub(super) fn hatching(line: Vec<(f64, f64)>) -> PathElement<(f64, f64)> {
    PathElement::new(line, BLACK.mix(0.55).stroke_width(UNITS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_a_hatching_end_at_the_edges() {
        let surface = Surface {
            ends: [(0.0, 1.0), (0.0, 1.0)],
            size: (1000, 500),
        };
        let lines = surface.hatched(&[[[0.2, 0.4], [0.5, 1.0]]]);
        assert!(lines.len() > 10, "{}", lines.len());
        for (x, y) in lines.into_iter().flatten() {
            let is_at = |value: f64, edge: f64| (value - edge).abs() < 1e-9;
            assert!(
                (0.2 - 1e-9..=0.4 + 1e-9).contains(&x) && (0.5 - 1e-9..=1.0 + 1e-9).contains(&y)
            );
            assert!(
                is_at(x, 0.2) || is_at(x, 0.4) || is_at(y, 0.5) || is_at(y, 1.0),
                "{x} {y}"
            );
        }
    }

    #[test]
    fn lines_continue_from_one_rectangle_into_the_next() {
        let surface = Surface {
            ends: [(0.0, 1.0), (0.0, 1.0)],
            size: (1000, 500),
        };
        let length =
            |lines: &[Vec<(f64, f64)>]| -> f64 { lines.iter().map(|it| it[1].0 - it[0].0).sum() };
        let parts = [0.1, 0.3, 0.7, 0.9];
        let cells: Vec<[[f64; 2]; 2]> = parts
            .windows(2)
            .flat_map(|across| parts.windows(2).map(move |up| [across, up]))
            .map(|sides| sides.map(|it| [it[0], it[1]]))
            .collect();
        let (whole, divided) = (
            surface.hatched(&[[[0.1, 0.9], [0.1, 0.9]]]),
            surface.hatched(&cells),
        );
        assert_eq!(divided.len(), whole.len());
        assert!((length(&divided) - length(&whole)).abs() < 1e-9);
        // Around a hole, lines are interrupted.
        let ring = [&cells[..4], &cells[5..]].concat();
        let hole = surface.hatched(&cells[4..5]);
        let around = surface.hatched(&ring);
        assert!(around.len() > whole.len());
        assert!((length(&around) + length(&hole) - length(&whole)).abs() < 1e-2);
    }
}
