//! Compiled chains, with functions that follow them and count the frames solved by tearing.

use linkwright::generated::{Conditions, Start};
use linkwright::math::Real;
use linkwright::{Blocks, Settings, Shell};

use crate::values::{Levels, assembled_from, levels};

/// Chain with the functions that follow it.
pub struct Chain {
    /// Number of cells.
    pub cells: usize,
    /// Ratio of the size of each cell to that of the one before.
    pub growth: f64,
    /// In f64.
    pub double: Ways,
    /// In f32.
    pub single: Ways,
}

/// Functions for the two solution methods.
pub struct Ways {
    /// By tearing.
    pub torn: Follow,
    /// By all equations at once.
    pub dense: Follow,
}

/// Function that follows a chain from its design configuration, which is at t = 0, to these instants (s).
pub type Follow = fn(&[f64]) -> Followed;

/// Chain that was followed.
#[derive(Clone, Debug, Default)]
pub struct Followed {
    /// Levels at each instant; `None` if it was refused.
    pub frames: Vec<Option<Levels>>,
    /// Number of instants solved by tearing.
    pub by_tears: usize,
    /// Reasons of refused instants, in the order of time.
    pub refused: Vec<String>,
}

fn followed<B>(times: &[f64]) -> Followed
where
    B: Blocks + Default,
    Settings<B::Scalar>: Default,
{
    let assembled = assembled_from(B::default(), &[], 0.0, Settings::default());
    let mut shell = assembled.unwrap_or_else(|failure| panic!("{failure}"));
    let inputs = shell.blocks().initial_inputs();
    let mut followed = Followed::default();
    for &t in times {
        let t = B::Scalar::from_f64(t);
        followed.by_tears += usize::from(tears_suffice(&shell, t, &inputs));
        let frame = match shell.advance(t, &inputs) {
            Ok(_) => Some(levels(shell.blocks(), shell.frame())),
            Err(failure) => {
                followed.refused.push(failure.to_string());
                None
            }
        };
        followed.frames.push(frame);
    }
    followed
}

/// True if the frame at this time needs tearing only. All equations at once cannot meet a tolerance of zero without
/// an iteration; tearing needs neither.
fn tears_suffice<B: Blocks>(shell: &Shell<B>, t: B::Scalar, inputs: &B::Inputs) -> bool
where
    Settings<B::Scalar>: Default,
{
    let settings = Settings {
        tolerance: B::Scalar::ZERO,
        iterations: 0,
        ..Settings::default()
    };
    let conditions = Conditions {
        t,
        start: Start::LastFrame,
        parameters: shell.parameters(),
        inputs,
        settings: &settings,
    };
    let (mut at, mut branches) = (shell.frame().clone(), shell.branches().clone());
    let solved = shell
        .blocks()
        .solve(&mut at, shell.frame(), &mut branches, &conditions);
    solved.is_ok()
}

include!(concat!(env!("OUT_DIR"), "/chains.rs"));
