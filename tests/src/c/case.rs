//! Cases: a description with the calls of its modules.

use std::fmt::Write as _;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Language, Options, OutputFile, Scalar, generate};

/// Both scalars, with the suffixes of their modules.
pub const SCALARS: [(&str, Scalar); 2] = [("f64", Scalar::F64), ("f32", Scalar::F32)];

/// Mechanism, or several motions of one, and the calls of each.
#[derive(Clone, Debug)]
pub struct Case {
    /// Name of files and modules.
    pub name: String,
    /// Description.
    pub source: Source,
    /// Calls, a line each: a letter and numbers, as [`script`] writes them.
    pub script: String,
}

/// Number of a call's values for inputs; every signal takes three of them in turn.
pub const INPUTS: usize = 18;

/// Calls of a motion of many small steps, of large ones, back, and beyond its range. They include assemblies in other
/// modes, from estimates with errors, and of other parameters; inputs that jump, recoveries and durations.
pub fn script(end: f64) -> String {
    let mut text = String::new();
    let mut call = |letter: char, t: f64, number: f64| {
        let _ = write!(text, "{letter} {:x} {:x}", t.to_bits(), number.to_bits());
        for place in 0..INPUTS {
            let phase = t + place as f64;
            let value = match (letter, place % 3) {
                // The inputs jump by a number, or one of them is NaN, at constant time.
                ('j', 0) => number,
                ('j', _) => 0.0,
                ('n', _) if place == 3 * number as usize => f64::NAN,
                (_, 0) => 0.03 * phase.sin(),
                (_, 1) => 0.03 * phase.cos(),
                _ => -0.03 * phase.sin(),
            };
            let _ = write!(text, " {:x}", value.to_bits());
        }
        text.push('\n');
    };
    call('a', 0.0, 0.0);
    for step in 1..=100 {
        call('v', end * f64::from(step) / 100.0, 0.0);
    }
    for (t, number) in [
        (0.7, 0.0),
        (0.1, 0.0),
        (1.0, 0.0),
        (0.3, 0.0),
        (5.0, 0.0),
        (25.0, 0.0),
        (0.2, 0.0),
    ] {
        call('v', t * end, number);
    }
    call('x', 0.5 * end, 0.0);
    // Four modes, and four of the stored assemblies.
    for mode in 0..8 {
        call('b', 0.0, f64::from(mode));
        call('v', 0.02 * end, 0.0);
        call('v', 3.0 * end, 0.0);
    }
    for off in [1e-3, 0.05, 0.4, 2.0] {
        call('e', 0.1 * end, off);
        call('v', 0.11 * end, 0.0);
    }
    for factor in [1.01, 1.2, 0.0, -1.0, 3.0] {
        call('a', 0.0, 0.0);
        call('p', 0.0, factor);
        call('v', 0.01 * end, 0.0);
        call('v', 0.02 * end, 0.0);
        call('f', 0.03 * end, factor);
    }
    for number in [0.05, 0.3, -0.2, 4.0, 0.1, -0.6, -0.9, 0.0, 1e9] {
        call('j', 0.0, number);
        call('n', 0.0, 0.0);
        call('n', 0.001, 1.0);
        call('v', 0.0, 0.0);
    }
    // Recoveries from far away, and durations.
    for part in [0.3, 0.9, 2.5, 0.05] {
        call('r', part * end, 0.0);
        call('v', (part + 0.01) * end, 0.0);
    }
    for duration in [1e-3 * end, 1e-9, 1e-9, -1e-2 * end, 2e-2 * end, f64::NAN] {
        call('d', 0.06 * end, duration);
    }
    call('v', f64::NAN, 0.0);
    call('a', 0.0, 0.0);
    call('v', f64::INFINITY, 0.0);
    call('v', 1e6, 0.0);
    text
}

impl Case {
    /// Case with the calls of [`script`] on a description.
    pub fn new(name: &str, source: Source, end: f64) -> Case {
        Case {
            name: name.to_string(),
            source,
            script: script(end),
        }
    }

    /// Files of the module in a language.
    ///
    /// # Panics
    /// If the description has errors.
    pub fn files(&self, language: Language, scalar: Scalar) -> Vec<OutputFile> {
        let options = Options {
            language,
            scalar,
            stem: Some(self.name.clone()),
            ..Options::default()
        };
        let generated = generate(&self.source, &options);
        let generated = generated.unwrap_or_else(|found| panic!("{}", found.render(&self.source)));
        generated.files
    }
}
