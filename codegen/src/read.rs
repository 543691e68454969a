//! Parses and resolves a description, and derives the equations of each motion.

use crate::checks::{check, of_motions};
use crate::consequences;
use crate::diagnostic::{self, Diagnostics, Source, internal};
use crate::emit::Language;
use crate::finiteness;
use crate::model;
use crate::pool::Pool;
use crate::structure;
use crate::syntax;
use crate::system::Derived;

/// Description with derived equations.
///
/// ```
/// use linkwright_codegen::{Diagnostics, Source, read};
///
/// let text = "
///     mechanism crank {
///         point O = (0, 0);
///         body arm at O { O, A: (40mm, 0) }
///         revolute O(ground, arm);
///     }";
/// let source = Source::new("crank.mech", text);
/// let errors = read(&source).and_then(|read| read.check()).expect_err("no driver");
/// let error = errors.iter().next().expect("an error");
/// assert_eq!((error.code.name(), error.range(&source)[0].line), ("K32", 4));
/// ```
#[derive(Clone, Debug)]
pub struct Read {
    /// Equations of each motion in written order; those of the mechanism if it has no motions. Never empty.
    pub motions: Vec<Derived>,
    /// Warnings.
    pub warnings: Diagnostics,
}

impl Read {
    /// Derives the equations with sensitivities to these parameters in place of the requested ones. Unknown names are
    /// ignored.
    ///
    /// # Errors
    /// Those of [`read`].
    pub fn along(source: &Source, parameters: &[&str]) -> Result<Self, Diagnostics> {
        Read::requesting(source, Requests::along(parameters))
    }

    /// Derives the equations with these requests.
    ///
    /// # Errors
    /// Those of [`read`].
    #[doc(hidden)]
    pub fn requesting(source: &Source, requests: Requests<'_>) -> Result<Self, Diagnostics> {
        read_for(source, Language::default(), requests)
    }

    /// Checks that the equations of each motion determine every coordinate exactly once, and that the numbers of their
    /// solution are finite. Returns warnings, without those of [`Read::warnings`].
    ///
    /// # Errors
    /// Too few or too many equations, with their bodies and joints; numbers that become infinite or undefined.
    pub fn check(&self) -> Result<Diagnostics, Diagnostics> {
        let findings = self.motions.iter().map(|derived| {
            let motion = derived.system.mechanism.motion.as_ref();
            let name = motion.map_or("", |motion| motion.name.as_str());
            (name, None, check(derived).unwrap_or_else(|errors| errors))
        });
        let findings = diagnostic::merged(findings.collect());
        match findings.has_errors() {
            true => Err(findings),
            false => Ok(findings),
        }
    }

    /// Equations; `None` if there are several motions.
    pub fn only(mut self) -> Option<Derived> {
        match self.motions.len() {
            1 => self.motions.pop(),
            _ => None,
        }
    }

    /// Equations of the motion of this name.
    pub fn motion(&self, name: &str) -> Option<&Derived> {
        let named = |derived: &&Derived| {
            let motion = derived.system.mechanism.motion.as_ref();
            motion.is_some_and(|motion| motion.name == name)
        };
        self.motions.iter().find(named)
    }
}

/// Requests besides those of a description.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Requests<'a> {
    /// Parameters of sensitivities in place of the requested ones; `None` for these. Unknown names are ignored.
    pub along: Option<&'a [&'a str]>,
    /// True to add driving forces.
    pub efforts: bool,
    /// True to add the offsets of loose pins as parameters, with sensitivities to these and to all parameters with a tolerance in
    /// place of the requested ones.
    pub tolerances: bool,
}

impl<'a> Requests<'a> {
    fn along(parameters: &'a [&'a str]) -> Requests<'a> {
        Requests {
            along: Some(parameters),
            efforts: false,
            tolerances: false,
        }
    }
}

/// Derives the equations of a description, whether or not they determine the motion.
///
/// # Errors
/// Every error of the text and of its names, values and forms.
pub fn read(source: &Source) -> Result<Read, Diagnostics> {
    read_for(source, Language::default(), Requests::default())
}

/// Returns the uses of names in a document, also in one with errors, each after the use or the declaration that it refers to.
pub fn mentions(document: &syntax::Document) -> Vec<model::Mention> {
    model::mentions(document, &Language::default().conventions().naming)
}

/// Derives the equations with names for a language, and with requests.
pub(crate) fn read_for(
    source: &Source,
    language: Language,
    requests: Requests<'_>,
) -> Result<Read, Diagnostics> {
    internal::reads(source);
    let mut diagnostics = Diagnostics::new();
    let Some(document) = syntax::parse(source, &mut diagnostics) else {
        return Err(diagnostics);
    };
    let read = resolved(&document, source, language, requests, diagnostics);
    let respelled = |findings: Diagnostics| findings.respelled(&document.spellings);
    match read {
        Ok(Read { motions, warnings }) => Ok(Read {
            motions,
            warnings: respelled(warnings),
        }),
        Err(errors) => Err(respelled(errors)),
    }
}

/// Equations of a document, and all findings after earlier ones.
fn resolved(
    document: &syntax::Document,
    source: &Source,
    language: Language,
    requests: Requests<'_>,
    mut diagnostics: Diagnostics,
) -> Result<Read, Diagnostics> {
    let mut resolving = Diagnostics::new();
    let resolved = model::resolve(document, &language.conventions().naming, &mut resolving);
    if diagnostics.has_errors() {
        consequences::add_independent(resolving, document, source, &mut diagnostics);
        return Err(diagnostics);
    }
    diagnostics.extend(resolving);
    let Some(mut resolved) = resolved else {
        return Err(diagnostics);
    };
    for (pool, mechanism) in &mut resolved {
        mechanism.forces.efforts |= requests.efforts;
        if requests.tolerances {
            mechanism.offset_pins(&mut pool.graph);
            let parameters = mechanism.parameters.iter().enumerate();
            let stated = parameters.filter(|(_, it)| it.tolerance.is_some());
            mechanism.sensitivities = stated.map(|(place, _)| place).collect();
        }
        let Some(along) = requests.along else {
            continue;
        };
        let index = |name: &&str| mechanism.parameters.iter().position(|it| it.name == *name);
        let mut requested: Vec<usize> = along.iter().filter_map(index).collect();
        requested.sort_unstable();
        requested.dedup();
        mechanism.sensitivities = requested;
    }
    let released = |(mut pool, mechanism): (Pool, model::Mechanism)| {
        let _work = internal::work_at(mechanism.place());
        let system = structure::released(&mut pool, mechanism);
        Derived { pool, system }
    };
    let motions: Vec<Derived> = resolved.into_iter().map(released).collect();
    let not_finite = of_motions(&motions, |derived| {
        finiteness::of_system(&derived.pool, &derived.system)
    });
    diagnostics.extend(not_finite);
    if diagnostics.has_errors() {
        return Err(diagnostics);
    }
    Ok(Read {
        motions,
        warnings: diagnostics,
    })
}
