//! Refuses lanes of mechanisms that cannot be solved in lanes.

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::solved::Solved;
use crate::{Language, Options};

/// Returns the errors of a module with lanes: blocks of Newton-Raphson, and choices that exclude lanes.
pub fn refused(solved: &Solved, options: &Options) -> Diagnostics {
    let mechanism = &solved.system().mechanism;
    let mut errors = Diagnostics::new();
    let excluded = match (options.language, &options.math) {
        (Language::C, _) => Some("C: compilers vectorize its loops over mechanisms"),
        (Language::Rust, Some(_)) => Some("other elementary functions than those of the runtime"),
        (Language::Rust, None) => None,
    };
    if let Some(excluded) = excluded {
        let message = format!("there are no lanes for {excluded}");
        let error = Diagnostic::error(Code::NoLanes, mechanism.place(), message);
        errors.push(
            error
                .label("requested for this")
                .help("leave out one of both options"),
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
        let help = "leave out the lanes, or describe the loop so that it has a closed form: `plan` shows which blocks have one";
        errors.push(error.label("in the loop that this closes").help(help));
    }
    errors
}
