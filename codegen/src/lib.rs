//! Derives the constraint equations of planar mechanisms and writes them as specialised Rust or C.
//!
//! A description in a `.mech` file becomes a module that computes pose, velocity and acceleration without a matrix of all
//! equations. In a build script, [`build`] does everything:
//!
//! ```no_run
//! // build.rs: all `.mech` files of the folder `descriptions`
//! linkwright_codegen::build("descriptions");
//! ```
//!
//! In the crate, which depends on `linkwright`:
//!
//! ```ignore
//! linkwright::include_mechanism! {
//!     pub mod excavator;
//! }
//! ```
//!
//! An error of a description is an error of the build, at its line. [`build_with`] takes [`Options`]: single precision,
//! other elementary functions.
//!
//! Other programs call the steps: [`read`] derives the equations, [`Read::check`] verifies that they determine the
//! motion, [`generate`] returns the code in a [`Language`], [`format()`] lays a description out. Errors are
//! [`Diagnostics`] with places in the [`Source`].
//!
//! # Generated code
//!
//! The code holds two formulations. The mechanism's type runs the *solved formulation*: the equations are ordered into
//! the smallest blocks that can be solved one after another. A block becomes one function, in closed form or by
//! Newton-Raphson. Values that no `output` of the description needs are left out. The *textbook formulation* is Φ, Φ_q,
//! Φ_t and γ as functions, one dense system; mechanisms of hundreds of coordinates have none. All limits are on the page
//! `linkwright::thresholds`.

#![doc(html_root_url = "https://docs.rs/linkwright-codegen/0.1.0")]

mod cargo;
mod checks;
mod emit;
mod files;
mod lanes;
mod read;
#[doc(hidden)]
pub mod stages;

pub use cargo::{build, build_with, write_module};
pub use emit::{Language, OutputFile, Scalar};
#[doc(hidden)]
pub use linkwright_description::diagnostic;
#[doc(inline)]
pub use linkwright_description::diagnostic::{Code, Diagnostic, Diagnostics, Position, Source};
#[doc(inline)]
pub use linkwright_description::format::format;
#[doc(hidden)]
pub use read::Requests;
pub use read::{Read, read};
#[doc(inline)]
pub use system::Derived;

use checks::check_all;
use diagnostic::internal;
use emit::Form;
use linkwright_description::{
    columns, consequences, expr, force, joint, model, pool, syntax, units,
};
use linkwright_program::{
    assemblies, finiteness, modes, program, solved, structure, system, words,
};
use program::Kept;
use read::read_for;
use solved::Solved;
use structure::Shift;

/// Choices about the generated code.
///
/// By default it is a Rust module in f64, with the sines, roots and angles of `linkwright::math`.
///
/// ```
/// use linkwright_codegen::{Options, Scalar};
///
/// let options = Options { scalar: Scalar::F32, ..Options::default() };
/// # assert_eq!(options.math, None);
/// ```
///
/// # Elementary functions
///
/// A processor may have its own way to compute some of them, or a program may prefer those of the standard library. It
/// then names a type that implements `linkwright::math::Functions` with these functions; all others stay those of the
/// runtime:
/// ```ignore
/// pub struct Plain;
///
/// impl linkwright::math::Functions<f64> for Plain {
///     fn sin_cos(angle: f64) -> (f64, f64) {
///         angle.sin_cos()
///     }
/// }
/// ```
/// In `build.rs`:
/// ```no_run
/// use linkwright_codegen::Options;
///
/// let options = Options { math: Some("crate::Plain".to_string()), ..Options::default() };
/// linkwright_codegen::build_with("descriptions", &options);
/// ```
/// The bits of a frame are then those of these functions, and so are its errors.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Language of the code. A build script includes only Rust.
    pub language: Language,
    /// Scalar: f64, or f32 where the hardware has nothing else.
    pub scalar: Scalar,
    /// Path of the type whose functions Rust code calls instead of those of `linkwright::math`: `crate::Plain`; `None`
    /// for `linkwright::math`. The compiler resolves it where the code is included. Values that the runtime computes
    /// for itself, such as scales, do not use it.
    pub math: Option<String>,
    /// True if a module also solves 8 mechanisms at once, or 16 in f32, in Rust in a module `lanes`. All blocks must have closed
    /// forms, and `math` must be that of the runtime.
    pub lanes: bool,
    /// Name of the files without extension, by which a source of C includes its header; `None` for the mechanism's name.
    pub stem: Option<String>,
}

/// Generated code of a mechanism.
#[derive(Clone, Debug)]
pub struct Generated {
    /// Name of the mechanism.
    pub name: String,
    /// Files of the language, the mechanism's own file first. A module of Rust is one file. With motions, the module
    /// contains one module for each.
    pub files: Vec<OutputFile>,
    /// Findings that are not errors.
    pub warnings: Diagnostics,
    motions: Vec<Derived>,
}

impl Generated {
    /// Text of the mechanism's own file, ending in a line break: in Rust the whole module.
    pub fn code(&self) -> &str {
        self.files.first().map_or("", |file| &file.text)
    }

    /// Page that `rustdoc` shows with the module. Its derivation is computed by this call.
    #[doc(hidden)]
    pub fn page(&self) -> Page {
        let first = self.motions.first();
        Page {
            documentation: first
                .map(|it| emit::rust::documentation(&it.system))
                .unwrap_or_default(),
            html: emit::rust::page(&self.motions),
        }
    }
}

/// Page that `rustdoc` shows with a module.
#[doc(hidden)]
#[derive(Clone, Debug)]
pub struct Page {
    /// Documentation of the mechanism in the description: lines of Markdown, of which nothing is compiled, run or
    /// resolved.
    pub documentation: Vec<String>,
    /// Picture and derivation: a block of HTML that follows the documentation.
    pub html: String,
}

/// Generates the code of a description.
///
/// ```
/// use linkwright_codegen::{Options, Source, generate};
///
/// let text = "
///     mechanism crank {
///         point O = (0, 0);
///         body arm at O { O, A: (40mm, 0) }
///         revolute O(ground, arm);
///         drive phi(arm) = 3*t;
///     }";
/// let source = Source::new("crank.mech", text);
/// match generate(&source, &Options::default()) {
///     Ok(generated) => assert_eq!(generated.files[0].name, "crank.rs"),
///     Err(errors) => panic!("{}", errors.render(&source)),
/// }
/// ```
///
/// # Errors
/// Returns all errors of the description; nothing is generated then.
pub fn generate(source: &Source, options: &Options) -> Result<Generated, Diagnostics> {
    let Read {
        motions,
        mut warnings,
    } = read_for(source, options.language, Requests::default())?;
    check_all(&motions)?;
    let range = match options.scalar {
        Scalar::F64 => finiteness::Range::F64,
        Scalar::F32 => finiteness::Range::F32,
    };
    let form = Form {
        scalar: options.scalar,
        math: options.math.as_deref(),
        has_lanes: options.lanes,
    };
    let (mut lowered, mut by_motion) = (Vec::new(), Vec::new());
    for derived in &motions {
        let mechanism = &derived.system.mechanism;
        let _work = internal::work_at(mechanism.place());
        let solved = Solved::of(derived.clone(), Shift::Directions, Kept::Requested);
        let motion = mechanism.motion.as_ref();
        let name = motion.map_or(String::new(), |motion| motion.name.clone());
        let findings = match &solved {
            Ok(solved) => {
                let (system, program) = (solved.system(), solved.program());
                let mut findings = finiteness::of_program(solved.pool(), system, program, range);
                findings.extend(modes::undecided(system, &program.blocks, &program.branches));
                if options.lanes {
                    findings.extend(lanes::refused(solved, form));
                }
                findings
            }
            Err(unplanned) => finiteness::of_unplanned(*unplanned),
        };
        by_motion.push((name, findings.respelled(&mechanism.spellings)));
        lowered.extend(solved);
    }
    let by_motion = by_motion
        .iter()
        .map(|(name, findings)| (name.as_str(), None, findings.clone()));
    let findings = diagnostic::merged(by_motion.collect());
    if findings.has_errors() {
        return Err(findings);
    }
    warnings.extend(findings);
    let name = lowered
        .first()
        .map(|solved| solved.system().mechanism.name.clone());
    let name = name.unwrap_or_default();
    let stem = options.stem.as_deref().unwrap_or(&name);
    let language = options.language;
    Ok(Generated {
        files: language.files(&lowered, stem, form),
        name,
        warnings,
        motions,
    })
}
