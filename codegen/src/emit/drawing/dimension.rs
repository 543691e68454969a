//! Distance between two points as a drawing shows it: extension lines, dimension line, arrowheads and text.
//!
//! Lengths are pixels, or the unit of a printer, and y points upwards. Every printer takes its lines from here.

use super::letters::width;
use super::plane::{
    Bounds, Point, RELATIVE_ROUNDING, angle_of, difference, distance, dot, heading, left_of,
    onward, scaled, sum,
};
use crate::units::OutputUnit;

/// Size of letters in pixels.
pub(super) const LETTERS: f64 = 11.0;

/// Length of an arrowhead.
pub(super) const HEAD: f64 = 7.0;

/// Distance of an extension line from its point, and its length beyond the dimension line.
pub(super) const EXTENSION: [f64; 2] = [6.0, 3.0];

/// Distance of the text from the dimension line.
pub(super) const TEXT_GAP: f64 = 2.5;

/// Length of the dimension line outside of arrowheads that point inwards.
const TAIL: f64 = 14.0;

/// Largest number of decimals that drawing programs show.
const MOST_DECIMALS: usize = 8;

/// Smallest number of decimals: workshops measure hundredths of a millimeter.
const LEAST_DECIMALS: usize = 2;

/// Number of significant digits of the shortest distance.
const DIGITS: i32 = 3;

/// Quantity that a dimension measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measured {
    /// Distance of two points.
    Distance,
    /// Diameter of a circle.
    Diameter,
}

/// Dimension in its position.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Dimension {
    /// Measured points.
    pub ends: [Point; 2],
    /// Distance of the dimension line to the left of the way from the first point to the second; negative to its right.
    pub aside: f64,
    /// Measured length, in m.
    pub length: f64,
    pub measured: Measured,
    /// Length in the unit of the drawing.
    pub text: String,
    /// Length of a pixel: 1 in a picture.
    pub unit: f64,
}

/// Lines of a dimension.
#[derive(Clone, Debug)]
pub(super) struct DimensionLines {
    /// Extension lines, then the dimension line in its pieces.
    pub lines: Vec<[Point; 2]>,
    /// Ends of the dimension line.
    pub feet: [Point; 2],
    /// Directions of the arrowheads at both ends.
    pub heads: [Point; 2],
    /// Center of the text.
    pub text_at: Point,
    /// Angle of the text, in rad, above -π/2 and at most π/2.
    pub text_angle: f64,
    /// Half the width and half the height of the text.
    pub text_half: Point,
    /// True if the text is too long for its line and continues the line.
    pub is_text_beyond: bool,
}

impl Dimension {
    /// Lines, arrowheads and position of the text.
    pub fn lines(&self) -> DimensionLines {
        let [a, b] = self.ends;
        let length = distance(a, b);
        let along = scaled(difference(b, a), 1.0 / length);
        let left = left_of(along);
        let feet = self.ends.map(|end| onward(end, self.aside, left));
        let way = self.aside.signum();
        let [gap, beyond] = EXTENSION.map(|it| it * self.unit);
        let (head, tail) = (HEAD * self.unit, TAIL * self.unit);
        let extensions = self.ends.iter().filter(|_| self.aside.abs() > gap);
        let mut lines: Vec<[Point; 2]> = extensions
            .map(|end| [gap * way, self.aside + beyond * way].map(|it| onward(*end, it, left)))
            .collect();
        lines.push(feet);
        let text_half = [
            0.5 * width(&self.text, self.letters()),
            0.5 * self.letters(),
        ];
        let text_angle = readable(angle_of(along));
        let up = left_of(heading(text_angle));
        let is_narrow = length < 2.4 * head;
        let is_text_beyond = 2.0 * text_half[0] > length - 2.0 * head;
        let mut heads = [scaled(along, -1.0), along];
        if is_narrow {
            heads.reverse();
            for (foot, along) in feet.iter().zip(heads) {
                lines.push([*foot, onward(*foot, -head - tail, along)]);
            }
        }
        let [beside, above] = match is_text_beyond {
            true if is_narrow => [0.5 * length + text_half[0] + head + tail + gap, 0.0],
            true => [0.5 * length + text_half[0] + gap, 0.0],
            false => [0.0, TEXT_GAP * self.unit + text_half[1]],
        };
        let middle = onward(feet[0], 0.5 * length + beside, along);
        DimensionLines {
            lines,
            feet,
            heads,
            text_at: onward(middle, above, up),
            text_angle,
            text_half,
            is_text_beyond,
        }
    }

    /// Dimension in another unit, of which a pixel has `factor`.
    pub fn scaled(&self, factor: f64) -> Dimension {
        Dimension {
            ends: self.ends.map(|it| scaled(it, factor)),
            aside: self.aside * factor,
            unit: self.unit * factor,
            ..self.clone()
        }
    }

    /// Dimension at another place.
    pub fn moved(&self, by: Point) -> Dimension {
        Dimension {
            ends: self.ends.map(|it| sum(it, by)),
            ..self.clone()
        }
    }

    /// Box along the axes around lines and text.
    pub fn bounds(&self) -> Bounds {
        self.lines().bounds()
    }

    /// Size of letters.
    pub fn letters(&self) -> f64 {
        LETTERS * self.unit
    }
}

impl DimensionLines {
    /// Box along the axes around lines and text.
    pub fn bounds(&self) -> Bounds {
        let lines = self.lines.iter().flatten().copied();
        Bounds::of(lines.chain(self.text_corners()))
    }

    /// Corners of the text.
    pub fn text_corners(&self) -> [Point; 4] {
        let along = heading(self.text_angle);
        let [x, y] = self.text_half;
        [[-x, -y], [x, -y], [x, y], [-x, y]]
            .map(|[x, y]| onward(onward(self.text_at, x, along), y, left_of(along)))
    }

    /// Distance of the text from a point.
    pub fn text_clearance(&self, point: Point) -> f64 {
        let along = heading(self.text_angle);
        let gap = difference(point, self.text_at);
        let beyond = [dot(gap, along), dot(gap, left_of(along))];
        let [x, y] = [0, 1].map(|axis| (beyond[axis].abs() - self.text_half[axis]).max(0.0));
        x.hypot(y)
    }
}

/// Angle of a text along a line that is read from below or from the right.
fn readable(angle: f64) -> f64 {
    use std::f64::consts::{FRAC_PI_2, PI};
    match angle {
        angle if angle > FRAC_PI_2 + RELATIVE_ROUNDING => angle - PI,
        angle if angle <= -FRAC_PI_2 + RELATIVE_ROUNDING => angle + PI,
        angle => angle,
    }
}

/// Unit and decimals of all dimensions of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Measure {
    unit: OutputUnit,
    pub decimals: usize,
}

impl Measure {
    /// Takes as many decimals as the shortest of these lengths (m) needs.
    pub fn of(unit: &OutputUnit, lengths: impl IntoIterator<Item = f64>) -> Measure {
        let lengths = lengths.into_iter().filter(|it| *it > 0.0);
        let shortest = unit.of_si(lengths.fold(f64::INFINITY, f64::min));
        let needed = match shortest.is_finite() && shortest > 0.0 {
            // Rounding does not cost a digit.
            true => DIGITS - 1 - (shortest.log10() + RELATIVE_ROUNDING).floor() as i32,
            false => 0,
        };
        let decimals = usize::try_from(needed).unwrap_or(0);
        Measure {
            unit: unit.clone(),
            decimals: decimals.clamp(LEAST_DECIMALS, MOST_DECIMALS),
        }
    }

    /// Text of a length in m, without zeros at its end.
    pub fn text(&self, length: f64) -> String {
        let text = format!("{:.*}", self.decimals, self.unit.of_si(length));
        let text = text.trim_end_matches('0').trim_end_matches('.');
        text.to_string()
    }

    /// Name of the unit.
    pub fn unit_name(&self) -> &str {
        &self.unit.name
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::OutputUnits;

    fn dimension(ends: [Point; 2], aside: f64) -> Dimension {
        Dimension {
            ends,
            aside,
            length: 0.12,
            measured: Measured::Distance,
            text: "120".to_string(),
            unit: 1.0,
        }
    }

    #[test]
    fn texts_are_read_from_below_or_from_the_right() {
        for (to, degrees) in [
            ([100.0, 0.0], 0.0),
            ([-100.0, 0.0], 0.0),
            ([0.0, 100.0], 90.0),
            ([0.0, -100.0], 90.0),
            ([-50.0, 50.0], -45.0),
        ] {
            let lines = dimension([[0.0; 2], to], 20.0).lines();
            assert!(
                (lines.text_angle.to_degrees() - degrees).abs() < 1e-4,
                "{to:?}"
            );
        }
    }

    #[test]
    fn arrowheads_of_a_short_distance_point_inwards() {
        let long = dimension([[0.0; 2], [100.0, 0.0]], 20.0).lines();
        assert_eq!(long.feet, [[0.0, 20.0], [100.0, 20.0]]);
        assert_eq!(long.heads, [[-1.0, 0.0], [1.0, 0.0]]);
        let short = dimension([[0.0; 2], [8.0, 0.0]], 20.0).lines();
        assert_eq!(short.heads, [[1.0, 0.0], [-1.0, 0.0]]);
        assert!(short.text_at[0] > 8.0 + HEAD);
    }

    #[test]
    fn decimals_are_those_of_the_shortest_length() {
        let millimeters = OutputUnits::listed("mm").expect("a unit").of("m");
        let measure = |lengths: &[f64]| Measure::of(&millimeters, lengths.iter().copied());
        assert_eq!(measure(&[0.12, 0.04]).text(0.12), "120");
        assert_eq!(measure(&[0.12, 0.04]).text(0.1234567), "123.46");
        assert_eq!(measure(&[0.001_234_5]).text(0.001_234_5), "1.23");
        assert_eq!(measure(&[0.3 - 0.29]).decimals, LEAST_DECIMALS);
        assert_eq!(measure(&[]).decimals, LEAST_DECIMALS);
        assert_eq!(measure(&[1e-15]).decimals, MOST_DECIMALS);
    }
}
