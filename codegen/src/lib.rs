//! Derives the constraint equations of a planar mechanism and writes them as specialised Rust.
//!
//! `Source → Document → Mechanism → System → SolvedPlan → Program → Rust`: each arrow is one function of one module, and each module
//! imports only those named before it. [`generate_with`] names all stages; [`stages`] shows what stands between them. Expressions
//! stand apart, in a [`stages::pool::Pool`] that each stage adds to.
//! The modules up to `Mechanism` are in the internal package `linkwright-description`, those up to `Program` in `linkwright-program`.
//!
//! The generated code holds two views of a mechanism. Its type runs the *solved view*: the equations are ordered into the
//! smallest blocks that can be solved one after another ([`stages::structure::SolvedPlan`]), and each block becomes one function, in
//! closed form where it has one (linear, one angle, two rotations, a rotation and a slide, a turning slide, two slides) and by
//! Newton-Raphson otherwise. What no `output` of the description needs is left out; [`report`] says what is left. The *textbook
//! view* is Φ, Φ_q, Φ_t and γ as functions, to be solved as one dense system; mechanisms of hundreds of coordinates have none. Every
//! limit stands in `linkwright::thresholds`.
//!
//! In a build script, [`build`] does everything:
//! ```no_run
//! linkwright_codegen::build("descriptions");
//! ```
//! and [`build_with`] does it in single precision:
//! ```no_run
//! use linkwright_codegen::{Options, Scalar};
//! let options = Options { scalar: Scalar::F32, ..Options::default() };
//! linkwright_codegen::build_with("descriptions", &options);
//! ```

#![doc(html_root_url = "https://docs.rs/linkwright-codegen/0.1.0")]

mod cargo;
mod checks;
mod emit;
mod files;
mod read;
pub mod stages;

pub use cargo::{attach_files, build, build_with, write_module};
pub use checks::{check, check_all, findings, findings_of_derivation, report};
pub use emit::{Language, OutputFile, Scalar};
#[doc(inline)]
pub use linkwright_description::diagnostic;
#[doc(inline)]
pub use linkwright_description::format::format;
#[doc(inline)]
pub use program::{Operations, Report};
pub use read::{Read, read, read_along};
#[doc(inline)]
pub use system::{Derived, System};

use diagnostic::{Diagnostics, Source, internal};
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

/// What can be chosen about the generated code.
///
/// Without a choice the code is in f64, and sines, roots and angles are those of `linkwright::math`. A processor that has its own
/// way to compute some of them, or a program that prefers the standard library's, names a module with functions of the same
/// names, which takes over all others from there:
/// ```ignore
/// mod plain {
///     pub use linkwright::math::*;
///
///     pub fn sin_cos(angle: f64) -> (f64, f64) {
///         angle.sin_cos()
///     }
/// }
/// ```
/// In `build.rs`:
/// ```no_run
/// use linkwright_codegen::Options;
///
/// let options = Options { math: Some("crate::plain"), ..Options::default() };
/// linkwright_codegen::build_with("descriptions", &options);
/// ```
/// The bits of a frame are then those of these functions, and so are its errors. `angle_near` of `linkwright::math` does not call
/// `atan2`, so whoever replaces the arctangent replaces both, the one by `nearest_turn(atan2(sine, cosine), near)`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The scalar: f64, or f32 where the hardware has nothing else.
    pub scalar: Scalar,
    /// The path of the module whose functions the code calls instead of those of `linkwright::math`, such as `crate::plain`. It is
    /// resolved where the code is included, by the compiler; what the runtime computes for itself, such as scales, stays its own.
    pub math: Option<&'static str>,
}

/// The Rust source of a mechanism.
#[derive(Clone, Debug)]
pub struct Generated {
    /// The mechanism's name.
    pub name: String,
    /// The module's source, ending in a line break; of a mechanism with motions it holds one module for each.
    pub code: String,
    /// What should be looked at although it is no error.
    pub warnings: Diagnostics,
}

impl Generated {
    fn of(files: GeneratedFiles) -> Generated {
        let code = files.files.into_iter().next().map(|file| file.text);
        Generated {
            name: files.name,
            code: code.unwrap_or_default(),
            warnings: files.warnings,
        }
    }
}

/// What `rustdoc` shows with a module.
#[derive(Clone, Debug)]
pub struct Page {
    /// What the description says of the mechanism: lines of Markdown of which nothing is compiled, run or resolved.
    pub documentation: Vec<String>,
    /// The drawing and the derivation, a block of HTML that follows the documentation.
    pub html: String,
}

/// The files that a mechanism becomes in a language.
#[derive(Clone, Debug)]
pub struct GeneratedFiles {
    /// The mechanism's name.
    pub name: String,
    /// The mechanism's own file first.
    pub files: Vec<OutputFile>,
    /// What should be looked at although it is no error.
    pub warnings: Diagnostics,
}

/// Writes the Rust module of a description.
///
/// # Errors
/// Every error of the description; nothing is written then.
pub fn generate(source: &Source) -> Result<Generated, Diagnostics> {
    generate_with(source, &Options::default())
}

/// Writes the Rust module of a description as the options say.
///
/// # Errors
/// Every error of the description; nothing is written then.
pub fn generate_with(source: &Source, options: &Options) -> Result<Generated, Diagnostics> {
    let files = generate_files(source, Language::Rust, "", options)?;
    Ok(Generated::of(files))
}

/// The same with what `rustdoc` is to show with the module.
///
/// # Errors
/// Every error of the description; nothing is written then.
pub fn generate_with_page(
    source: &Source,
    options: &Options,
) -> Result<(Generated, Page), Diagnostics> {
    let read = read(source)?;
    check_all(&read.motions)?;
    let first = read.motions.first();
    let page = Page {
        documentation: first
            .map(|it| emit::rust::documentation(&it.system))
            .unwrap_or_default(),
        html: emit::rust::page(&read.motions),
    };
    let files = files_of(read, Language::Rust, "", options)?;
    Ok((Generated::of(files), page))
}

/// Writes the files of a description in a language, as the options say. The first file is called `stem`, and by what the language
/// appends.
///
/// # Errors
/// Every error of the description; nothing is written then.
pub fn generate_files(
    source: &Source,
    language: Language,
    stem: &str,
    options: &Options,
) -> Result<GeneratedFiles, Diagnostics> {
    let read = read_for(source, language, None)?;
    check_all(&read.motions)?;
    files_of(read, language, stem, options)
}

fn files_of(
    read: Read,
    language: Language,
    stem: &str,
    options: &Options,
) -> Result<GeneratedFiles, Diagnostics> {
    let Read {
        motions,
        mut warnings,
    } = read;
    let range = match options.scalar {
        Scalar::F64 => finiteness::Range::F64,
        Scalar::F32 => finiteness::Range::F32,
    };
    let (mut lowered, mut found) = (Vec::new(), Vec::new());
    for Derived { mut pool, system } in motions {
        let _work = internal::work_at(system.mechanism.place());
        let plan = structure::plan(&mut pool, &system, Shift::Directions).ok();
        let program = plan
            .as_ref()
            .map(|plan| program::lower(&mut pool, &system, plan, Kept::Requested));
        let motion = system.mechanism.motion.as_ref();
        let name = motion.map_or(String::new(), |motion| motion.name.clone());
        let mut own = finiteness::of_program(&pool, &system, program.as_ref(), range);
        own.extend(
            program
                .iter()
                .flat_map(|it| modes::undecided(&system, &it.blocks, &it.branches)),
        );
        found.push((name, own.respelled(&system.mechanism.spellings)));
        if let (Some(plan), Some(program)) = (plan, program) {
            lowered.push(Solved {
                derived: Derived { pool, system },
                plan,
                program,
            });
        }
    }
    let found = found
        .iter()
        .map(|(name, found)| (name.as_str(), None, found.clone()));
    let found = diagnostic::merged(found.collect());
    if found.has_errors() {
        return Err(found);
    }
    warnings.extend(found);
    let name = lowered
        .first()
        .map(|solved| solved.derived.system.mechanism.name.clone());
    Ok(GeneratedFiles {
        name: name.unwrap_or_default(),
        files: language.files(&lowered, stem, options.scalar, options.math),
        warnings,
    })
}
