//! Chooses the units in which a mechanism is reported.

use crate::diagnostic::{Code, Diagnostic, Diagnostics, Span};
use crate::syntax::Statement;
use crate::units::OutputUnits;

/// Returns the units of the `units` statement; `None` without one. A second statement is reported.
pub(super) fn chosen_units(
    statements: &[&Statement],
    diagnostics: &mut Diagnostics,
) -> Option<OutputUnits> {
    let mut written = statements.iter().filter_map(|it| match it {
        Statement::Units(units) => Some(units),
        _ => None,
    });
    let first = written.next()?;
    for other in written {
        diagnostics.push(repeated(first.span, other.span));
    }
    let mut chosen = OutputUnits::default();
    for name in &first.units {
        if let Err([message, help]) = chosen.choose(&name.text) {
            let finding = Diagnostic::error(Code::UnknownUnit, name.span, message);
            diagnostics.push(finding.help(help));
        }
    }
    Some(chosen)
}

fn repeated(first: Span, second: Span) -> Diagnostic {
    Diagnostic::error(Code::DuplicateName, second, "units are already chosen")
        .label("written again here")
        .also(first, "first written here")
        .help("write all units into one statement")
}
