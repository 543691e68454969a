//! *A compiled chain and instants* → *its frames, and how often they were found by way of the tears*.

use linkwright::generated::{Conditions, Start};
use linkwright::math::Real;
use linkwright::{Blocks, Settings, Shell};

use crate::values::{Levels, assembled_from, levels};

/// A chain, and how its modules follow it.
pub struct Chain {
    /// How many cells it has.
    pub cells: usize,
    /// How many times as large as the one before it each cell is.
    pub growth: f64,
    /// In f64.
    pub double: Ways,
    /// In f32.
    pub single: Ways,
}

/// The two ways in which a chain is solved.
pub struct Ways {
    /// By way of the tears.
    pub torn: Follow,
    /// By all equations at once.
    pub dense: Follow,
}

/// What follows a chain from its drawing, which is at t = 0, to these instants (s).
pub type Follow = fn(&[f64]) -> Followed;

/// A chain that was followed.
#[derive(Clone, Debug, Default)]
pub struct Followed {
    /// The levels at each instant; `None` where it was refused.
    pub frames: Vec<Option<Levels>>,
    /// How many instants were found by way of the tears.
    pub by_tears: usize,
    /// Why instants were refused, in the order of time.
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
    let mut found = Followed::default();
    for &t in times {
        let t = B::Scalar::from_f64(t);
        found.by_tears += usize::from(tears_suffice(&shell, t, &inputs));
        let frame = match shell.advance(t, &inputs) {
            Ok(_) => Some(levels(shell.blocks(), shell.frame())),
            Err(failure) => {
                found.refused.push(failure.to_string());
                None
            }
        };
        found.frames.push(frame);
    }
    found
}

/// Whether the frame at this time is found without all equations at once: these meet no tolerance of zero without an iteration, and
/// the way by the tears asks for neither.
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
