//! Goes from the text of a description to a mechanism that can be solved, with findings as values.

use linkwright_codegen::Read;
use linkwright_codegen::diagnostic::{Diagnostics, Source, nearest};
use linkwright_codegen::stages::model::Requested;
use linkwright_codegen::stages::structure;
use linkwright_codegen::stages::system::Derived;

use crate::interpreted::Interpreted;
use crate::open_loop::open_loop;

/// Motion of a description that can be solved.
///
/// ```
/// use linkwright::Blocks;
/// use linkwright_codegen::Source;
/// use linkwright_solver::Opened;
///
/// let text = "
///     mechanism crank {
///         param length = 40mm;
///         point O = (0, 0);
///         body arm at O { O, A: (length, 0) }
///         revolute O(ground, arm);
///         drive phi(arm) = 3*t;
///     }";
/// let mut opened = Opened::read(&Source::new("crank.mech", text), None).expect("no errors");
/// assert_eq!(opened.interpreted.nominal_parameters().0, [0.04]);
/// opened.interpreted.set("length", "length = 50mm").expect("a length");
/// assert_eq!(opened.interpreted.nominal_parameters().0, [0.05]);
/// ```
#[derive(Clone, Debug)]
pub struct Opened {
    /// Solution, block by block.
    pub interpreted: Interpreted,
    /// Quantities of `output` statements.
    #[doc(hidden)]
    pub requested: Vec<Requested>,
    /// Warnings of the description and of its solution.
    pub warnings: Diagnostics,
}

/// Reason why a description cannot be solved.
#[derive(Clone, Debug)]
pub enum Unopened {
    /// Errors of the description, or surplus and missing equations, among warnings.
    Findings(Diagnostics),
    /// The description has no motion of the requested name.
    NoMotion {
        /// Requested name.
        name: String,
        /// Names of its motions, which may be none.
        motions: Vec<String>,
    },
    /// The description has several motions, and none is requested.
    Several(Vec<String>),
    /// The equations determine the motion, but have no order in which they can be solved one block after the other.
    NoOrder,
}

impl Opened {
    /// Opens a motion of a description: the one of this name, or the only one.
    ///
    /// # Errors
    /// The description has errors, does not have this motion, or its equations cannot be solved.
    pub fn read(source: &Source, motion: Option<&str>) -> Result<Opened, Unopened> {
        Opened::by(source, motion, solvable)
    }

    /// Opens a motion as [`Opened::read`] does, also of a mechanism that [`drawable`] admits at `t` (s).
    ///
    /// # Errors
    /// Those of [`Opened::read`].
    pub fn read_to_draw(source: &Source, motion: Option<&str>, t: f64) -> Result<Opened, Unopened> {
        Opened::by(source, motion, |derived, warnings| {
            drawable(derived, t, warnings)
        })
    }

    fn by(
        source: &Source,
        motion: Option<&str>,
        interpreted: impl FnOnce(&Derived, &mut Diagnostics) -> Result<Interpreted, Unopened>,
    ) -> Result<Opened, Unopened> {
        let mut warnings = Diagnostics::new();
        let derived = determined(source, motion, &mut warnings)?;
        let requests = derived.system.mechanism.requests.iter();
        Ok(Opened {
            interpreted: interpreted(&derived, &mut warnings)?,
            requested: requests.map(|it| it.quantity).collect(),
            warnings,
        })
    }
}

/// Returns the equations of a motion if they determine it, and adds warnings.
///
/// # Errors
/// Every reason but [`Unopened::NoOrder`].
pub fn determined(
    source: &Source,
    motion: Option<&str>,
    warnings: &mut Diagnostics,
) -> Result<Derived, Unopened> {
    let mut motions = named(source, motion, warnings)?;
    if motions.len() > 1 {
        return Err(Unopened::Several(names(&motions)));
    }
    // A description has at least one motion.
    let derived = motions.remove(0);
    let Derived { pool, system } = &derived;
    let findings = structure::analyze(pool, system).respelled(&system.mechanism.spellings);
    if findings.has_errors() {
        return Err(Unopened::Findings(findings));
    }
    warnings.extend(findings);
    Ok(derived)
}

/// Returns the equations of all motions, or of the one of this name, and adds warnings.
///
/// # Errors
/// The description has errors, or does not have this motion.
pub fn named(
    source: &Source,
    motion: Option<&str>,
    warnings: &mut Diagnostics,
) -> Result<Vec<Derived>, Unopened> {
    let read = linkwright_codegen::read(source).map_err(Unopened::Findings)?;
    warnings.extend(read.warnings.clone());
    let Some(name) = motion else {
        return Ok(read.motions);
    };
    match read.motion(name) {
        Some(derived) => Ok(vec![derived.clone()]),
        None => Err(unknown(name, &read)),
    }
}

/// Returns the blocks of a motion, and adds warnings about their solution.
///
/// # Errors
/// Numbers in the blocks become infinite or undefined, or the blocks have no order of solution.
pub fn solvable(derived: &Derived, warnings: &mut Diagnostics) -> Result<Interpreted, Unopened> {
    let (interpreted, findings) = Interpreted::checked(derived).map_err(Unopened::Findings)?;
    warnings.extend(findings);
    interpreted.ok_or(Unopened::NoOrder)
}

/// Returns the blocks as [`solvable`] does; also if constant lengths cannot close at `t` (s), which a drawing shows better than a finding.
///
/// # Errors
/// Those of [`solvable`] for all other mechanisms.
pub fn drawable(
    derived: &Derived,
    t: f64,
    warnings: &mut Diagnostics,
) -> Result<Interpreted, Unopened> {
    solvable(derived, warnings).or_else(|reason| {
        let view = Interpreted::new(derived);
        view.filter(|view| open_loop(view, t).is_some())
            .ok_or(reason)
    })
}

impl Unopened {
    /// Returns the sentence and its help.
    ///
    /// # Errors
    /// The findings, each of which has a sentence and a place in the text.
    pub fn message(&self, description: &str) -> Result<(String, Option<String>), &Diagnostics> {
        let listed = |names: &[String]| {
            let quoted = names.iter().map(|it| format!("`{it}`"));
            quoted.collect::<Vec<_>>().join(", ")
        };
        Ok(match self {
            Unopened::Findings(findings) => return Err(findings),
            Unopened::NoMotion { motions, .. } if motions.is_empty() => {
                ("the mechanism has no motions".to_string(), None)
            }
            Unopened::NoMotion { name, motions } => {
                let help = match nearest(name, motions.iter().map(String::as_str)) {
                    Some(meant) => format!("did you mean `{meant}`?"),
                    None => format!("the motions are {}", listed(motions)),
                };
                (format!("no motion is named `{name}`"), Some(help))
            }
            Unopened::Several(names) => (
                format!(
                    "`{description}` has {} motions: {}",
                    names.len(),
                    listed(names)
                ),
                None,
            ),
            Unopened::NoOrder => (
                format!(
                    "the equations of `{description}` determine the motion, but no order in which they can be solved one block after the other"
                ),
                None,
            ),
        })
    }
}

fn unknown(name: &str, read: &Read) -> Unopened {
    Unopened::NoMotion {
        name: name.to_string(),
        motions: names(&read.motions),
    }
}

/// Returns the names of the motions.
pub fn names(motions: &[Derived]) -> Vec<String> {
    let motions = motions.iter();
    let named = motions.filter_map(|it| it.system.mechanism.motion.as_ref());
    named.map(|motion| motion.name.clone()).collect()
}
