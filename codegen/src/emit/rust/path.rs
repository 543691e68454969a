//! Writes the verification that a frame lies on the path of the last frame.

use super::code::{argument, taken_apart};
use super::docs::doc_lines;
use super::lints;
use crate::emit::code::Code;
use crate::emit::module::path_enclosures::iterated;
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{Module, documentation};
use crate::program::{Function, Path, Statement};

/// Writes the module `path_verification`: `verify_path`, `is_within` if blocks need Newton-Raphson, and `verify_nonsingular` if all
/// blocks are closed forms.
pub(super) fn path(module: &Module<'_>, code: &mut Code) {
    let Some(path) = &module.program.path else {
        return;
    };
    let (mut within, mut inside) = (Code::default(), Code::default());
    let head = doc_lines(documentation::of_path(module.program));
    head.iter()
        .for_each(|line| inside.whole(format!("//!{line}")));
    inside.gap();
    inside.line("use super::*;");
    let mut names = vec!["verify_path"];
    let verify_path = Verification {
        name: "verify_path",
        docs: &documentation::VERIFY_PATH,
        enclosures: Some(enclosures(module, path, &mut within)),
    };
    verification(module, &path.function, verify_path, &mut inside);
    if !within.is_empty() {
        names.push("is_within");
        inside.gap();
    }
    inside.append(within);
    if let Some(function) = &path.closed {
        names.push("verify_nonsingular");
        let verify_nonsingular = Verification {
            name: "verify_nonsingular",
            docs: &documentation::VERIFY_NONSINGULAR,
            enclosures: None,
        };
        verification(module, function, verify_nonsingular, &mut inside);
    }
    names.sort_unstable();
    code.gap();
    code.line(match names[..] {
        [only] => format!("use path_verification::{only};"),
        _ => format!("use path_verification::{{{}}};", names.join(", ")),
    });
    code.gap();
    code.block("mod path_verification", inside);
}

/// Function that verifies a property of a time window.
struct Verification<'a> {
    name: &'a str,
    docs: &'a [&'a str],
    /// Statements that fill the enclosures; `None` if the function takes none.
    enclosures: Option<Code>,
}

fn verification(
    module: &Module<'_>,
    function: &Function,
    verification: Verification<'_>,
    code: &mut Code,
) {
    let scope = Scope::new(module, function, Place::Path);
    let bounds = scope.plain_statements();
    let reads = scope.reads();
    let has = |test: fn(&Statement) -> bool| function.statements.iter().any(test);
    let signals = has(|it| matches!(it, Statement::Signal { .. }));
    let isolates = has(|it| matches!(it, Statement::Isolate { .. }));
    let (inputs, before) = (reads.inputs || signals, reads.before || signals);
    let fills = verification
        .enclosures
        .as_ref()
        .is_some_and(|it| !it.is_empty());
    let conditions = [
        (reads.time, "t"),
        (reads.parameters, "parameters"),
        (inputs, "inputs"),
    ];
    let conditions = taken_apart("&Conditions", "conditions", &conditions);
    let both = [
        (reads.frame || fills, "at"),
        (reads.last || fills, "last"),
        (before, "before"),
        (conditions.is_some(), "conditions"),
    ];
    let both = taken_apart("&Pair", "pair", &both);
    let has_pair = both.is_some();
    let has_enclosures = verification.enclosures.is_some();
    let mut statements = Code::default();
    both.iter()
        .chain(&conditions)
        .for_each(|taken| statements.line(taken));
    statements.append(bounds);
    statements.append(verification.enclosures.unwrap_or_default());
    statements.line("Ok(())");
    let (pair, window) = (
        argument("pair", has_pair),
        argument("window", reads.window || signals || isolates),
    );
    let enclosures = match has_enclosures {
        true => format!(", {}: &mut PathEnclosures", argument("enclosures", fills)),
        false => String::new(),
    };
    let head = format!(
        "pub(super) fn {}({pair}: &Pair<'_>, {window}: &TimeWindow{enclosures}) -> Result<(), u16>",
        verification.name
    );
    let allow = lints::of_code(&statements);
    code.function(verification.docs, allow, &head, statements);
}

/// Writes `is_within`, and returns the statements that fill the enclosures.
fn enclosures(module: &Module<'_>, path: &Path, code: &mut Code) -> Code {
    let iterated = iterated(module.program, module.system, path);
    let mut filled = Code::default();
    if iterated.is_empty() {
        return filled;
    }
    let scope = Scope::new(module, &path.function, Place::Path);
    let mut values = Vec::with_capacity(iterated.len());
    for (place, (symbol, deviation)) in iterated.iter().enumerate() {
        let [now, before] = ["at", "last"].map(|frame| module.field(*symbol, frame));
        let deviation = deviation.map_or("0.0".to_string(), |deviation| scope.read(deviation));
        filled.line(format!(
            "enclosures[{place}] = PathEnclosure::new({now}, {before}, {deviation});"
        ));
        values.push(now);
    }
    let mut statements = Code::default();
    let (count, values) = (values.len(), values.join(", "));
    statements.line(format!("let found: [Scalar; {count}] = [{values}];"));
    statements.line(
        "enclosures.iter().zip(found).all(|(enclosure, value)| enclosure.holds(value, steps))",
    );
    let docs = [documentation::IS_WITHIN];
    let head =
        "pub(super) fn is_within(at: &Frame, enclosures: &PathEnclosures, steps: Scalar) -> bool";
    code.function(docs, [], head, statements);
    filled
}
