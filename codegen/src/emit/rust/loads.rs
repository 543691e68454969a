//! Writes the labels of loads, and the function that finds the first load that is not finite.

use super::code::{argument, taken_apart};
use crate::emit::code::Code;
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{Module, documentation};
use crate::program::Block;

/// Name of the function that ascribes a failure to a load.
const FUNCTION: &str = "blame_load";

/// Writes the labels; nothing if no load may become infinite.
pub(super) fn labels(module: &Module<'_>, code: &mut Code) {
    let Some(loads) = &module.program.loads else {
        return;
    };
    let labels: Vec<String> = loads.labels.iter().map(|it| format!("{it:?}")).collect();
    code.gap();
    code.docs([documentation::LOADS]);
    code.line(format!(
        "pub const LOADS: [&str; {}] = [{}];",
        labels.len(),
        labels.join(", ")
    ));
}

/// Writes the function that ascribes a failure to the first load that is not finite.
pub(super) fn function(module: &Module<'_>, code: &mut Code) {
    let Some(loads) = &module.program.loads else {
        return;
    };
    let scope = Scope::new(module, &loads.function, Place::Frame);
    let (statements, results, reads) = (scope.plain_statements(), scope.results(), scope.reads());
    let read = [
        (reads.time, "t"),
        (reads.parameters, "parameters"),
        (reads.inputs, "inputs"),
    ];
    let mut inside = Code::default();
    let taken = taken_apart("&Conditions", "conditions", &read);
    taken.iter().for_each(|it| inside.line(it));
    inside.append(statements);
    let read = loads.read.iter().map(|&symbol| scope.read(symbol));
    let read: Vec<String> = read.collect();
    inside.line(format!(
        "load_not_finite(failure, &[{}], &[{}], {})",
        read.join(", "),
        results.join(", "),
        loads.block
    ));
    let head = format!(
        "fn {FUNCTION}(failure: Failure, {}: &Frame, {}: &Conditions<'_>) -> Failure",
        argument("at", !loads.read.is_empty()),
        argument("conditions", taken.is_some())
    );
    code.function([documentation::BLAMED_LOAD], ["#[cold]"], &head, inside);
}

/// Returns a failure ascribed to the load that causes it, if loads may be its cause.
pub(super) fn blamed(failure: &str, module: &Module<'_>) -> String {
    match module.program.loads {
        Some(_) => format!("{FUNCTION}({failure}, at, conditions)"),
        None => failure.to_string(),
    }
}

/// Returns the end of the call of a block that can fail: `?`. If loads may cause the failure, it is first ascribed to a load.
pub(super) fn handed_on(block: &Block, module: &Module<'_>) -> String {
    let loads = module.program.loads.as_ref();
    let loaded = loads.and_then(|loads| module.program.blocks.get(usize::from(loads.block)));
    match loaded {
        Some(loaded) if std::ptr::eq(loaded, block) => {
            format!(".map_err(|failure| {FUNCTION}(failure, at, conditions))?")
        }
        _ => "?".to_string(),
    }
}
