//! Selects the modes and the pose of an assembly from texts like `phi2=other` or `loop_p=c`.

use linkwright::{Blocks, Branch, Failure};
use linkwright_codegen::diagnostic::nearest;

use crate::instant::Instant;
use crate::interpreted::{Interpreted, State};
use crate::known_poses::{self, KnownPoses};
use crate::number::time;
use crate::search::Sought;
use crate::supplied::{ModeName, Modes};
use crate::view::View;

/// Requested modes of some loops; the others have those of the design configuration.
///
/// ```
/// use linkwright::Blocks;
/// use linkwright_codegen::{Source, read};
/// use linkwright_solver::{Interpreted, ModeSelection};
///
/// let text = "
///     mechanism four_bar {
///         point A = (0, 0), D = (100mm, 0);
///         body crank   at (0, 0, 40deg)       { A: (0, 0), B: (40mm, 0) }
///         body coupler at (30mm, 25mm, 20deg) { B: (0, 0), C: (120mm, 0) }
///         body rocker  at (100mm, 0, 57deg)   { D: (0, 0), C: (80mm, 0) }
///         revolute A(ground, crank);
///         revolute B(crank, coupler);
///         revolute C(coupler, rocker);
///         revolute D(ground, rocker);
///         drive phi(crank) = 40deg + 3*t;
///     }";
/// let read = read(&Source::new("four_bar.mech", text)).expect("no errors");
/// let blocks = Interpreted::new(&read.motions[0]).expect("the equations determine the motion");
/// let text = "phi_coupler_phi_rocker=other".to_string();
/// let selection = ModeSelection::read(&blocks, &[text]).expect("a loop with two modes");
/// let (instant, modes) = selection.assembled(&blocks, 0.0).expect("both modes exist");
/// assert_eq!(modes.closed, blocks.drawn_branches().closed.iter().map(|it| it.opposite()).collect::<Vec<_>>());
/// // C lies on the other side of BD: the rocker points down.
/// assert!(instant.q()[8].sin() < 0.0);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ModeSelection(Vec<(ModeName, Wish)>);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wish {
    Mode(Sought),
    /// Pose with this letter, of a loop without a closed form.
    Pose(char),
}

impl Wish {
    /// Returns the sign of a closed form, which is `drawn` in the design configuration.
    fn sign(self, drawn: Branch) -> Branch {
        match self {
            Wish::Mode(Sought::Sign(sign)) => sign,
            Wish::Mode(Sought::Other) => drawn.opposite(),
            Wish::Mode(Sought::Near) | Wish::Pose(_) => drawn,
        }
    }
}

/// Reason that a mechanism cannot be assembled as requested.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unassembled {
    /// A block cannot be solved.
    Failed(Failure),
    /// The block of this index has fewer poses.
    NoPose {
        /// Requested letter.
        letter: char,
        /// Index of the block.
        block: usize,
        /// Number of known poses.
        known: usize,
        /// True if no further poses exist.
        are_all: bool,
        /// Time (s).
        t: f64,
    },
}

impl Unassembled {
    /// Returns the reason as a sentence.
    pub fn explained(&self, interpreted: &Interpreted) -> String {
        match *self {
            Unassembled::Failed(failure) => {
                let cause = interpreted.reported(&failure);
                match failure.kind.rejects_values() {
                    true => cause,
                    false => format!("{cause}, at t = {} s", time(failure.time)),
                }
            }
            Unassembled::NoPose {
                letter,
                block,
                known,
                are_all,
                t,
            } => {
                let name = &interpreted.compiled().solved.program().blocks[block].name;
                let (t, least) = (time(t), if are_all { "" } else { "at least " });
                let plural = if known == 1 { "" } else { "s" };
                format!(
                    "`{name}` has {least}{known} pose{plural} at t = {t} s, none of them `{letter}`; a check lists them"
                )
            }
        }
    }
}

impl ModeSelection {
    /// Reads `LOOP=positive`, `LOOP=negative`, `LOOP=other`, or of a loop without a closed form the letter of a pose, as `check` lists it.
    ///
    /// # Errors
    /// A sentence: a text cannot be read, or does not name a loop.
    pub fn read(interpreted: &Interpreted, texts: &[String]) -> Result<ModeSelection, String> {
        let known = interpreted.mode_names();
        let mut selected: Vec<(ModeName, Wish)> = Vec::new();
        for text in texts {
            let Some((name, mode)) = text.split_once('=') else {
                return Err(format!(
                    "`{text}` is not of the form LOOP=positive, LOOP=negative, LOOP=other or LOOP=c"
                ));
            };
            let Some(own) = known.iter().find(|it| it.name == name) else {
                return Err(unknown(name, &known));
            };
            let modes = ["positive", "negative", "other"];
            let mut letters = mode.chars();
            let wish = match (mode, letters.next(), letters.next()) {
                ("positive", ..) => Wish::Mode(Sought::Sign(Branch::Positive)),
                ("negative", ..) => Wish::Mode(Sought::Sign(Branch::Negative)),
                ("other", ..) => Wish::Mode(Sought::Other),
                (_, Some(letter @ 'a'..='z'), None) if !own.is_closed => Wish::Pose(letter),
                (_, Some('a'..='z'), None) => {
                    return Err(format!(
                        "`{name}` has a closed form, whose modes are: {}",
                        modes.join(", ")
                    ));
                }
                _ => {
                    return Err(format!(
                        "no assembly mode is named `{mode}`{}\n  the modes are: {}",
                        guess(mode, modes.into_iter()),
                        modes.join(", ")
                    ));
                }
            };
            if selected.iter().any(|(taken, _)| taken == own) {
                return Err(format!("the mode of `{name}` is chosen twice"));
            }
            selected.push((own.clone(), wish));
        }
        Ok(ModeSelection(selected))
    }

    /// Returns all modes, for any values of the parameters; `None` if a loop without a closed form is selected, whose pose must be found.
    pub fn closed(&self, interpreted: &Interpreted) -> Option<Modes> {
        let mut modes = interpreted.drawn_branches();
        for (name, wish) in &self.0 {
            if !name.is_closed {
                return None;
            }
            let mode = &mut modes.closed[name.place];
            *mode = wish.sign(*mode);
        }
        Some(modes)
    }

    /// Assembles the mechanism at time `t` (s) as requested, block by block, with its nominal parameters and inputs.
    ///
    /// # Errors
    /// The first block without the requested pose. A block that cannot be solved is reported with [`WrongBranch`](linkwright::FailureKind::WrongBranch) if no
    /// pose of the requested mode was found.
    pub fn assembled(
        &self,
        interpreted: &Interpreted,
        t: f64,
    ) -> Result<(Instant, Modes), Unassembled> {
        let mut modes = interpreted.drawn_branches();
        for (name, wish) in self.0.iter().filter(|(name, _)| name.is_closed) {
            let mode = &mut modes.closed[name.place];
            *mode = wish.sign(*mode);
        }
        let mut state = interpreted.before_assembly(t);
        for (index, block) in interpreted.compiled().blocks.iter().enumerate() {
            let mut selections = self.0.iter();
            let requested =
                selections.find(|(name, _)| !name.is_closed && name.place == block.iterated);
            let sought = match requested.filter(|_| block.newton.is_some()) {
                None => Sought::Near,
                Some((_, Wish::Mode(sought))) => *sought,
                Some((_, Wish::Pose(letter))) => {
                    (state, modes) = lettered(interpreted, index, *letter, &state, &modes)?;
                    continue;
                }
            };
            let assembled = interpreted.assemble_block(index, &mut state, &mut modes, sought);
            assembled.map_err(|failure| {
                let block = u16::try_from(index).unwrap_or(u16::MAX);
                Unassembled::Failed(failure.in_block(block))
            })?;
        }
        Ok((interpreted.instant(&state), modes))
    }
}

/// Returns the pose of a block with a letter.
fn lettered(
    interpreted: &Interpreted,
    block: usize,
    letter: char,
    state: &State,
    modes: &Modes,
) -> Result<(State, Modes), Unassembled> {
    let KnownPoses { poses, are_all, .. } = interpreted.known_poses(block, modes, state);
    let place = (0..poses.len()).find(|&place| known_poses::letter(place) == Some(letter));
    let pose = place.and_then(|place| poses.get(place));
    pose.cloned().ok_or(Unassembled::NoPose {
        letter,
        block,
        known: poses.len(),
        are_all,
        t: state.t,
    })
}

fn unknown(name: &str, known: &[ModeName]) -> String {
    let names: Vec<&str> = known.iter().map(|it| it.name.as_str()).collect();
    let list = match names.as_slice() {
        [] => "every loop has only one assembly mode".to_string(),
        names => format!("the loops with several modes are: {}", names.join(", ")),
    };
    format!(
        "no loop is named `{name}`{}\n  {list}",
        guess(name, names.iter().copied())
    )
}

fn guess<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    nearest(name, known).map_or(String::new(), |guess| format!("; did you mean `{guess}`?"))
}
