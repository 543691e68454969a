//! Refuses lanes of mechanisms that cannot be solved in lanes.

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::emit::Form;
use crate::solved::Solved;

/// Returns the errors of a module with lanes: blocks of Newton-Raphson, and other elementary functions.
pub fn refused(solved: &Solved, form: Form<'_>) -> Diagnostics {
    let mechanism = &solved.system().mechanism;
    let mut errors = Diagnostics::new();
    if form.math.is_some() {
        let message = "lanes have the elementary functions of the runtime only, found others";
        let error = Diagnostic::error(Code::NoLanes, mechanism.place(), message);
        errors.push(
            error
                .label("requested for this")
                .help("leave out the lanes"),
        );
    }
    for block in &solved.program().blocks {
        let Some(first) = block.joints.first().filter(|_| block.newton.is_some()) else {
            continue;
        };
        let joint = &mechanism.joints[*first];
        let message = format!(
            "`{}` has no lanes: Newton-Raphson solves it, one mechanism at a time",
            block.name
        );
        let error = Diagnostic::error(Code::NoLanes, joint.span, message);
        let help = "leave out the lanes, or change the loop so that it has a closed form: `plan` shows which blocks have one";
        errors.push(error.label("in the loop that this closes").help(help));
    }
    errors
}
