//! Hatches rectangles of a chart by slanted lines at equal distances, which neighboring rectangles share.

use plotters::prelude::*;

use super::plot::UNITS;

/// Distance of the lines of a hatching, in pixels.
const HATCH: f64 = 7.0;

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

    /// Returns the lines that hatch a rectangle. Lines of neighboring rectangles continue one another.
    pub fn hatched(
        &self,
        across: [f64; 2],
        up: [f64; 2],
    ) -> impl Iterator<Item = Vec<(f64, f64)>> + use<> {
        let ends = self.ends;
        let size = [f64::from(self.size.0), f64::from(self.size.1)];
        let pixels = move |axis: usize, at: f64| {
            let (low, high) = ends[axis];
            (at - low) / (high - low) * size[axis]
        };
        let value = move |axis: usize, at: f64| {
            let (low, high) = ends[axis];
            low + at / size[axis] * (high - low)
        };
        let [left, right] = across.map(|it| pixels(0, it));
        let [bottom, top] = up.map(|it| pixels(1, it));
        let distance = HATCH * f64::from(UNITS);
        let first = ((left + bottom) / distance).ceil() as i64;
        let last = ((right + top) / distance).floor() as i64;
        (first..=last).map(move |line| {
            let sum = line as f64 * distance;
            let [begin, end] = [left.max(sum - top), right.min(sum - bottom)];
            let point = |at: f64| (value(0, at), value(1, sum - at));
            vec![point(begin), point(end)]
        })
    }
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
        let lines: Vec<_> = surface.hatched([0.2, 0.4], [0.5, 1.0]).collect();
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
}
