//! Pantographs whose last cell is driven, and their descriptions, by the number and growth of the cells.
//!
//! A cell is two bars, u and v, that cross at a pin M; the next cell begins at the ends of both. The half bars around
//! such an end are equal, so that they are the sides of a rhombus, and all bars u are parallel, and all bars v. The
//! first cell stands on the ground and the last one is driven. So every bar except for one of the last cell depends
//! on all others.
//!
//! Every number of the description, except for the angles of the design configuration, is one of f32, and so are
//! their sums. The mechanism is the same in f64 and in f32, and only its solution is rounded.
//!
//! The file imports nothing, because it is compiled in two places: here, and in the build script that generates the
//! modules.

use std::fmt::Write as _;

/// Amplitude of the position of the last cell (m), as the sine of t.
pub const SWING: f64 = 0.019_531_25;
/// Amplitude of half the last cell's opening (m), as the sine of 2 t.
pub const OPENING: f64 = 0.000_976_562_5;

/// Cosine of the angle between a bar and the axis in the design configuration.
const COSINE: f64 = 0.875;

/// Largest number of binary digits of half a bar, so that sums of all of them are numbers of f32.
const BINARY_DIGITS: i32 = 12;

/// Numbers of a description.
#[derive(Clone, Debug)]
pub struct Pantograph {
    /// Half a bar of each cell (m), and of the one that would follow.
    pub halves: Vec<f64>,
    /// Position of the driven pin of the last cell (m).
    pub middle: f64,
    /// Position of the driven end of its bar v (m).
    pub end: f64,
}

impl Pantograph {
    /// Chain of cells in which each is larger than the one before by the factor `growth`, to three digits.
    pub fn new(cells: usize, growth: f64) -> Pantograph {
        let mut half = 0.5;
        let mut halves = vec![half];
        for _ in 0..cells {
            half *= growth;
            halves.push(shortened(half));
        }
        let all: f64 = halves.iter().sum();
        let (first, last) = (halves[0], halves[cells]);
        let end = COSINE * (2.0 * all - first - last);
        Pantograph {
            middle: end - COSINE * last,
            end,
            halves,
        }
    }

    /// Description, with these statements before all others.
    pub fn text(&self, statements: &str) -> String {
        let (angle, sine) = (COSINE.acos(), (1.0 - COSINE * COSINE).sqrt());
        let axis = self.halves[0] * sine;
        let mut bodies = format!("mechanism pantograph {{ {statements}\n point G = (0, 0);\n");
        let mut joints = String::new();
        let mut x = 0.0;
        for (cell, pair) in self.halves.windows(2).enumerate() {
            let (half, length) = (pair[0], pair[0] + pair[1]);
            for (name, side) in [("u", -1.0), ("v", 1.0)] {
                let (y, angle) = (axis + side * half * sine, -side * angle);
                // Writing into a string cannot fail.
                let _ = writeln!(
                    bodies,
                    " body {name}{cell} at ({x}, {y}, {angle}) {{ A: (0, 0), M: ({half}, 0), B: ({length}, 0) }}"
                );
            }
            let _ = writeln!(joints, " revolute M(u{cell}, v{cell});");
            if cell > 0 {
                let before = cell - 1;
                let _ = writeln!(
                    joints,
                    " revolute (v{before}.B, u{cell}.A);\n revolute (u{before}.B, v{cell}.A);"
                );
            }
            x += COSINE * length;
        }
        let last = self.halves.len() - 2;
        let Pantograph { middle, end, .. } = self;
        format!(
            "{bodies}{joints} revolute (ground.G, u0.A);\n drive u{last}.M.x = {middle} + {SWING}*sin(t);\n \
             drive v{last}.B.x = {end} + {SWING}*sin(t) + {OPENING}*sin(2*t);\n}}\n"
        )
    }
}

/// Nearest number of few digits.
fn shortened(value: f64) -> f64 {
    let unit = 2_f64.powi(value.log2().floor() as i32 + 1 - BINARY_DIGITS);
    (value / unit).round() * unit
}
