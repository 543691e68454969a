//! The text of a mechanism of the gallery with random masses, without its drivers and what it is asked for.
//!
//! An angle has no mass: a wheel turns with it.

use linkwright_codegen::stages::system::Derived;

use super::gallery::Freed;
use crate::files;
use crate::forces::Weight;
use crate::random::Random;

/// The first words of statements that are left out.
const LEFT_OUT: [&str; 10] = [
    "drive", "mass", "spring", "damper", "force", "torque", "effort", "reaction", "energy",
    "output",
];

/// A mechanism with masses, and with free coordinates in place of its drivers.
pub(super) struct Weighed {
    freed: &'static Freed,
    /// Without what is free, and the brace at the end.
    text: String,
    /// The bodies that have masses, and these; the place of each body is that of its weight.
    bodies: Vec<String>,
    weights: Vec<Weight>,
    /// In m/s².
    pub gravity: [f64; 2],
}

impl Weighed {
    pub fn new(freed: &'static Freed, random: &mut Random) -> Weighed {
        let path = files::repository().join(format!("mechanisms/{}.mech", freed.file));
        let read = std::fs::read_to_string(path).expect("a mechanism of the gallery");
        let mut text = reduced(&read);
        text.truncate(text.rfind('}').expect("an end"));
        let declared = |kind: &str| -> Vec<String> {
            let rest = text
                .lines()
                .filter_map(|line| line.trim_start().strip_prefix(kind));
            let names = rest.map(|rest| rest.split_whitespace().next().expect("a name"));
            names.map(str::to_string).collect()
        };
        let mut bodies = declared("body ");
        let angles = declared("angle ");
        let mut wheels = String::new();
        for angle in &angles {
            let wheel = format!("{angle}_wheel");
            wheels += &format!("    body {wheel} at (0, 0);\n");
            text += &format!(
                "    absolute_x({wheel}) = 0;\n    absolute_y({wheel}) = 0;\n    equation {wheel}_turns: phi({wheel}) = {angle};\n"
            );
            bodies.push(wheel);
        }
        let begin = text.find("{\n").expect("a mechanism") + 2;
        text.insert_str(begin, &wheels);
        let mut weights = Vec::new();
        for (body, name) in bodies.iter().enumerate() {
            let weight = Weight {
                body,
                mass: random.between(0.3, 2.0),
                center: [0, 1].map(|_| random.between(-0.05, 0.05)),
                inertia: random.between(0.001, 0.02),
            };
            let ([x, y], Weight { mass, inertia, .. }) = (weight.center, &weight);
            text += &format!("    mass {name} = {mass}kg at ({x}, {y}) inertia {inertia};\n");
            weights.push(weight);
        }
        let gravity = [random.between(-3.0, 3.0), random.between(-10.0, 0.0)];
        text += &format!("    gravity = ({}, {});\n", gravity[0], gravity[1]);
        Weighed {
            freed,
            text,
            bodies,
            weights,
            gravity,
        }
    }

    /// The whole text, with the values and rates of what is free.
    pub fn started(&self, values: &[[f64; 2]]) -> String {
        let starts = values
            .iter()
            .map(|[value, rate]| format!("{value} rate {rate}"));
        self.with(starts)
    }

    /// Description whose joints keep their rank along the motion.
    pub fn regular(&self, values: &[[f64; 2]]) -> String {
        let mut text = self.started(values);
        for [joint, instead] in self.freed.regular {
            assert!(text.contains(joint), "{joint}");
            text = text.replace(joint, instead);
        }
        text
    }

    /// The whole text, where what is free has the values from which starts are looked for, or zero.
    pub fn drawn(&self) -> String {
        let values = self.freed.free.iter();
        self.with(values.map(|it| it.value.unwrap_or("0").to_string()))
    }

    fn with(&self, starts: impl Iterator<Item = String>) -> String {
        let lines = self.freed.free.iter().zip(starts).enumerate();
        let lines = lines.map(|(place, (range, start))| {
            format!("    free free{place}: {} = {start};\n", range.coordinate)
        });
        format!("{}{}}}\n", self.text, lines.collect::<String>())
    }

    /// The masses of the bodies of a system.
    pub fn weights(&self, derived: &Derived) -> Vec<Weight> {
        let weights = self.weights.iter().map(|weight| {
            let body = &self.bodies[weight.body];
            let name = match body.starts_with(|it: char| it.is_ascii_digit()) {
                true => format!("x{body}"),
                false => format!("x_{body}"),
            };
            let mut coordinates = derived.system.coordinates.iter();
            let place = coordinates.position(|it| it.name == name);
            let place = place.unwrap_or_else(|| panic!("no {name}"));
            assert!(place.is_multiple_of(3), "{name}");
            Weight {
                body: place / 3,
                ..*weight
            }
        });
        weights.collect()
    }
}

/// A text without motions, drivers, forces and what is asked for.
fn reduced(text: &str) -> String {
    let mut kept = String::new();
    let mut is_motion = false;
    for line in text.lines() {
        let first = line.trim_start();
        let word = first.split([' ', ';']).next().unwrap_or_default();
        is_motion |= word == "motion";
        if !is_motion && !LEFT_OUT.contains(&word) {
            kept += line;
            kept.push('\n');
        }
        is_motion &= first != "}";
    }
    kept
}
