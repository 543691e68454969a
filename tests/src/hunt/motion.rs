//! Writes the drivers of a mechanism as one of several motions with parameters of their own.
//!
//! Every motion starts from the pose of the construction, so each is a mechanism that can be assembled; only the hunted one moves as
//! constructed. In the others the same drivers are written with other numbers.

use std::fmt::Write as _;

use linkwright_codegen::Read;
use linkwright_codegen::stages::system::Derived;

use super::joint::Joint;
use super::mechanism::Mechanism;
use super::periodic::Periodic;

/// Name of the motion that is hunted.
pub const HUNTED: &str = "hunted";

/// Parameter of the mechanism, which all motions use.
const SHARED: (&str, f64) = ("shared", 0.5);

/// Values of the parameters of the hunted motion, and of those of another one under the same names.
const FACTORS: [f64; 2] = [4.0, -3.0];

/// Part of its law that a driver writes beside its factors.
const INSIDE: f64 = 1.0 / (FACTORS[0] * SHARED.1);

/// Motions beside the hunted one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Motions {
    /// Number of motions before it.
    pub before: usize,
    /// Number of motions behind it.
    pub after: usize,
    /// True if the parameters of all motions have the same names.
    pub are_alike: bool,
}

/// Statements of a driver in a motion: its parameters in their order, and the driver.
fn driven(joint: &Joint, mechanism: &Mechanism, number: usize, motion: Option<usize>) -> String {
    let (quantity, base, law) = joint.driver(mechanism).expect("a driver");
    let is_alike = mechanism.motions.is_some_and(|it| it.are_alike);
    let parameter_name = |word: &str| match motion {
        Some(motion) if !is_alike => format!("{word}{number}of{motion}"),
        _ => format!("{word}{number}"),
    };
    let names = [parameter_name("base"), parameter_name("factor")];
    // In another motion each name has the meaning of the other one.
    let ([first, second], factor) = match motion {
        None => ([&names[0], &names[1]], FACTORS[0]),
        Some(_) => ([&names[1], &names[0]], FACTORS[1]),
    };
    let law = law.scaled(INSIDE).text(0.0);
    format!(
        "        param {first} = {base:?};
        param {second} = {factor:?};
        drive {quantity} = {first} + {second}*{}*({law});\n",
        SHARED.0
    )
}

impl Motions {
    /// A table as drivers in motions read it.
    pub fn inside(self, table: &Periodic) -> Periodic {
        table.scaled(INSIDE)
    }

    /// The parameter of the mechanism, and all motions.
    pub fn text(self, mechanism: &Mechanism, drivers: &[Joint]) -> String {
        let mut text = format!("    param {} = {:?};\n", SHARED.0, SHARED.1);
        for number in 0..=self.before + self.after {
            let motion = (number != self.before).then_some(number);
            let name = motion.map_or(HUNTED.to_string(), |it| format!("other{it}"));
            let _ = writeln!(text, "    motion {name} {{");
            for (place, driver) in drivers.iter().enumerate() {
                text += &driven(driver, mechanism, place, motion);
            }
            text += "    }\n";
        }
        text
    }
}

/// The motion that is hunted, or the only one.
pub fn hunted(read: Read) -> Option<Derived> {
    match read.motion(HUNTED) {
        Some(derived) => Some(derived.clone()),
        None => read.only(),
    }
}
