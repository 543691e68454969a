//! Makes a page of a mechanism and its equations, as a file, or served while the description is edited.

use std::path::{Path, PathBuf};

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_solver::{Assembly, Instant, Schedule};

use super::description::{chosen, determined_with, drawable, outputs, set_all, source, warn};
use super::live::live_page;
use super::{Outcome, Problem, print, say, watch};
use crate::arguments::View;
use crate::output::{Beginning, Record, Signature};
use linkwright_page::{Live, Page, Range, checked, page};

/// Signature of a page.
const SIGNATURE: Signature = Signature {
    noun: "a page that this command has made",
    beginning: Beginning::Bytes(|start| {
        let text = String::from_utf8_lossy(start);
        text.contains(GENERATOR)
    }),
    record: Record::Inside {
        found: |start| {
            let text = String::from_utf8_lossy(start);
            let (_, after) = text.split_once(SOURCE)?;
            Some(after.split_once('"')?.0.to_string())
        },
        added: |page, record| {
            let page = String::from_utf8_lossy(page);
            let named = format!("{GENERATOR}\n{SOURCE}{record}\">");
            page.replacen(GENERATOR, &named, 1).into_bytes()
        },
    },
};

/// Element in the head of a page that marks it as an output of Linkwright.
const GENERATOR: &str = "<meta name=\"generator\" content=\"linkwright\">";

/// Beginning of the next element, which names the description.
const SOURCE: &str = "<meta name=\"linkwright-source\" content=\"";

/// Writes the page, or serves it.
///
/// # Errors
/// The description has errors, its equations do not determine the motion, an option cannot be used, or the page cannot be written.
/// An [`Outcome`] and the page report a mechanism that cannot be assembled or whose motion ends early.
pub fn run(arguments: &View) -> Result<Outcome, Problem> {
    if arguments.watch {
        return watch::run(arguments);
    }
    if let Some(path) = &arguments.out {
        check_extension(path)?;
    }
    let source =
        source(&arguments.described.file)?.reported_in(arguments.reported_in.units.clone());
    let mut made = made(arguments, &source, Live::No)?;
    if arguments.live {
        made.html = live_page(arguments, &source, made.assembly.take())?;
    }
    let path = match &arguments.out {
        Some(path) => path.clone(),
        None => PathBuf::from(format!("{}.html", made.name)),
    };
    if let Some(error) = &made.error {
        say(&format!("error: `{}` {error}", made.name));
    }
    if path == Path::new("-") {
        print(|output| output.write_all(made.html.as_bytes()))?;
    } else {
        let mut outputs = outputs(&arguments.described.file, &source, arguments.force);
        let output = outputs.file(&path, SIGNATURE)?;
        output.write(|output| output.write_all(made.html.as_bytes()))?;
        print(|output| writeln!(output, "wrote {}", path.display()))?;
    }
    Ok(match made.error {
        None => Outcome::Done,
        Some(_) => Outcome::Failed,
    })
}

/// Rejects a file with an extension other than that of a page.
fn check_extension(path: &Path) -> Result<(), Problem> {
    let Some(extension) = path.extension() else {
        return Ok(());
    };
    if ["html", "htm"]
        .iter()
        .any(|it| extension.eq_ignore_ascii_case(it))
    {
        return Ok(());
    }
    Err(Problem(format!(
        "error: cannot write `{}`: pages cannot be written as `.{}`\n  = help: name a file that ends in `.html` or `.htm`; `linkwright draw` writes pictures",
        path.display(),
        extension.display()
    )))
}

/// Page and facts about it.
pub struct Made {
    /// Contents of the file.
    pub html: String,
    /// Stem of the file's name.
    pub name: String,
    /// Label of the chosen assembly; `None` for that of the design configuration.
    pub assembly: Option<String>,
    /// Reason that the motion ends early or does not begin; `None` if it is complete.
    pub error: Option<String>,
}

/// Makes the page of a description.
///
/// # Errors
/// Errors of [`run`], except for those of writing.
pub fn made(arguments: &View, source: &Source, live: Live) -> Result<Made, Problem> {
    let mut warnings = Diagnostics::new();
    let made = made_with(arguments, source, live, &mut warnings);
    warn(&warnings, source);
    made
}

/// Difference of coordinates (m or rad) below which two assemblies are the same.
const ASSEMBLY_TOLERANCE: f64 = 1e-9;

/// True if two instants are those of one assembly.
fn is_same(one: &Instant, other: &Instant) -> bool {
    let mut pairs = one.q().iter().zip(other.q());
    pairs.all(|(one, other)| (one - other).abs() < ASSEMBLY_TOLERANCE)
}

/// Makes the page as [`made`] does, and collects warnings.
fn made_with(
    arguments: &View,
    source: &Source,
    live: Live,
    warnings: &mut Diagnostics,
) -> Result<Made, Problem> {
    let derived = determined_with(source, arguments.described.motion.as_deref(), warnings)?;
    let derived = set_all(derived, &arguments.setting.set)?;
    let (from, to, step) = (arguments.from, arguments.to, arguments.step);
    let schedule = Schedule::range(from, to, step);
    let schedule = schedule.map_err(|text| Problem(format!("error: {text}")))?;
    let view = drawable(&derived, source, schedule.start.t, warnings)?;
    let chosen = chosen(&arguments.setting.branch, &view, schedule.start.t)?;
    let check = checked(&view, &schedule);
    let assembly = chosen.as_ref().and_then(|(instant, _)| {
        let mut all = check.assemblies.found.iter();
        let same = all.find(|it| is_same(&it.instant, instant));
        same.map(Assembly::label)
    });
    let findings = match warnings.is_empty() {
        true => String::new(),
        false => warnings.render(source),
    };
    let requested = derived.system.mechanism.requests.iter();
    let (html, error) = page(
        &Page {
            check: &check,
            schedule: &schedule,
            range: Range { from, to, step },
            requested: requested.map(|it| it.quantity).collect(),
            chosen,
            label: assembly.as_deref(),
            findings: &findings,
        },
        live,
    );
    let motion = derived.system.mechanism.motion.as_ref();
    let motion = motion.map_or(String::new(), |motion| format!("_{}", motion.name));
    Ok(Made {
        html,
        assembly,
        name: format!("{}{motion}", derived.system.mechanism.name),
        error,
    })
}
