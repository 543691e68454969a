//! Finds how far a drive can go each way from the design configuration while the other drivers stand still.
//!
//! The value of the drive takes the place of time: the drive follows an input, everything else keeps its value. Each way is followed to
//! its first event, which is enclosed to the last digit and then verified at decimal values on both sides.

mod digits;
mod drive;
mod ending;
mod line;
mod region;
mod way;

use linkwright_codegen::stages::structure::driven;
use linkwright_codegen::stages::system::Derived;
use linkwright_codegen::stages::units::OutputUnit;

use crate::instant::Instant;
use crate::proof::Proof;

pub use digits::Decimals;
pub use drive::Drive;
pub use ending::EndKind;
pub use region::{Curve, Region, Section};

use digits::DriveScale;
use way::{TravelWay, along};

/// Travel of a drive.
#[derive(Clone, Debug)]
pub struct Travel {
    /// Drive.
    pub drive: Drive,
    /// Value of the drive at the start, in m or rad.
    pub start: f64,
    /// Ends: with growing and with shrinking values.
    pub ends: [TravelEnd; 2],
}

/// End of travel in one direction.
#[derive(Clone, Debug)]
pub struct TravelEnd {
    /// Kind.
    pub kind: EndKind,
    /// Block of the plan, from 0; `None` without a block.
    pub block: Option<usize>,
    /// Limited measure; `None` for other ends.
    pub measure: Option<String>,
    /// Block with its state, limit, or reason, in words; empty without an end.
    pub words: String,
    /// Value of the drive in m or rad: the last one with a pose.
    pub value: f64,
    /// The value with the decimals that hold from both sides; `None` if none hold.
    pub decimals: Option<Decimals>,
    /// Number of full turns after which the pose returns; `None` for other ends.
    pub turns: Option<u32>,
    /// Pose at the value.
    pub instant: Instant,
    /// Proof of the path from the start to the decimal value; `None` if it is not requested or the drive has not moved.
    pub proof: Option<Proof>,
}

/// Reason that a drive has no travel.
#[derive(Clone, Debug)]
pub enum Immovable {
    /// The equations cannot be solved with the drive as an input.
    Unsolvable,
    /// The mechanism cannot be assembled at the start; in words.
    NotAssembled(String),
}

impl Travel {
    /// Follows a drive both ways from the assembly in the design modes at `t` (s). Decimals are those in `unit`. `see` receives the
    /// number of steps so far.
    ///
    /// # Errors
    /// The reason that the drive cannot be followed.
    pub fn new(
        derived: &Derived,
        drive: &Drive,
        t: f64,
        unit: &OutputUnit,
        proves: bool,
        mut see: impl FnMut(usize),
    ) -> Result<Travel, Immovable> {
        let driven = driven(derived, &[drive.joint], t).ok_or(Immovable::Unsolvable)?;
        let mut count = 0;
        let mut followed = |sign: f64| {
            let interpreted = along(&driven, sign).ok_or(Immovable::Unsolvable)?;
            let way = TravelWay {
                interpreted,
                is_angle: drive.is_angle,
                scale: DriveScale {
                    sign,
                    unit: 1.0 / unit.of_si(1.0),
                },
            };
            way.end(proves, &mut || {
                count += 1;
                see(count);
            })
        };
        let (start, up) = followed(1.0)?;
        let (_, down) = followed(-1.0)?;
        Ok(Travel {
            drive: drive.clone(),
            start,
            ends: [up, down],
        })
    }

    /// True if the drive turns without end: a full turn returns to the same pose.
    pub fn turns_round(&self) -> bool {
        self.ends.iter().all(|it| it.kind == EndKind::FullTurn)
    }
}
