//! Keeps names of descriptions apart from names that every module has.
//!
//! All rules are here; the resolver of descriptions takes them as [`NAMING`].

use crate::diagnostic::{Code, Diagnostic};
use crate::emit::module::Words;
use crate::model::Naming;
use crate::syntax::Name;

/// Rules for names of a description.
pub const NAMING: Naming = Naming {
    mechanism: |name| not_a_type(name, TYPES, "every generated module"),
    motion: not_a_module,
    apart,
};

/// Names that the type of a mechanism cannot have: generated items, types of the runtime, and words of Rust.
const TYPES: &[&str] = &[
    "Branches",
    "Coordinates",
    "Frame",
    "Inputs",
    "Loops",
    "Pair",
    "Parameters",
    "PointSensitivity",
    "Sensitivity",
    "Textbook",
    "PathEnclosures",
    // Of the runtime.
    "BlockEquations",
    "BlockName",
    "Blocks",
    "Branch",
    "NormalizedDeterminant",
    "Chord",
    "Const",
    "FailureMessage",
    "Factorization",
    "Failure",
    "Conditions",
    "Matrix",
    "Measure",
    "Mechanism",
    "PointMotion",
    "NamedPoint",
    "Scalar",
    "Settings",
    "Shell",
    "Signal",
    "TimeWindow",
    "ValueRange",
    "Start",
    "Step",
    "Table",
    "Torn",
    "PathEnclosure",
    "Vector",
    // Of Rust.
    "Default",
    "Err",
    "None",
    "Ok",
    "Option",
    "Result",
    "Self",
    "Some",
];

/// Names in scope of generated functions, which no row or block gets: arguments, modules, functions.
const ITEMS: &[&str] = &[
    "q",
    "qd",
    "qdd",
    "t",
    "at",
    "math",
    "newton",
    "kinematics",
    "linkwright",
    "phi",
    "phi_q",
    "phi_t",
    "gamma",
    "solve",
    "fail_out_of_reach",
    "exceeds_rounding",
    "explicit",
    "branches",
    "settings",
    "frame",
    "block",
    "angle_near",
    "two_angles_near",
    "all_finite",
    "not_finite",
    "load_not_finite",
    "blame_load",
    "not_positive",
    "isolate",
    "isolate_chain",
    "required",
    "largest_length",
    "singular_divisor",
    "multipliers",
    "friction",
    "drawn",
    "describe",
    "monitored",
    "requirements",
    "characteristic_length",
    "is_within",
    "verify_path",
    "verify_nonsingular",
    "parameters",
    "inputs",
    "lanes",
    "choose",
    "less",
    "lookup",
];

/// First words of local values, up to the first `_`: `sin_phi1`, `shared_1`.
const PREFIXES: &[&str] = &[
    "sin",
    "cos",
    "shared",
    "argument",
    "angle",
    "exponential",
    "logarithm",
];

/// Arguments and local values of generated functions, whose names no value of a description gets.
const LOCAL_VALUES: &[&str] = &[
    "balance",
    "resisting",
    "unsettled",
    "singular",
    "failed",
    "lanes",
    "choose",
    "less",
    "lookup",
    "at",
    "last",
    "branches",
    "conditions",
    "t",
    "q",
    "qd",
    "qdd",
    "parameters",
    "inputs",
    "settings",
    "start",
    "factorization",
    "jacobian",
    "measure",
    "response",
    "tears",
    "equations",
    "window",
    "before",
    "enclosures",
    "turning",
    "variation",
    "pair",
    "partial",
    "deviations",
    "rows",
    "signs",
    "carried",
    "memory",
    "found",
];

/// Rules for names of Rust.
pub(in crate::emit) const WORDS: Words = Words {
    spelled,
    of_functions: LOCAL_VALUES,
    of_frames: &["t", "q", "qd", "qdd", "parameters"],
};

/// Words that Rust reserves in any edition, except for `gen`, which older ones do not.
const RESERVED: &[&str] = &[
    "_", "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue",
    "crate", "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "if", "impl",
    "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
    "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// Returns the type of a mechanism: `TwoBody` for `two_body`.
pub fn type_name(mechanism: &str) -> String {
    let words = mechanism.split('_').filter(|word| !word.is_empty());
    words
        .map(|word| {
            // A name that is not ASCII has been reported, but comes here too.
            let mut rest = word.chars();
            let first = rest.next().map(|it| it.to_ascii_uppercase());
            first.into_iter().chain(rest).collect::<String>()
        })
        .collect()
}

/// Returns the error of a mechanism without a valid name for its type, or with one of `types`, which `owner` has already.
pub(in crate::emit) fn not_a_type(name: &Name, types: &[&str], owner: &str) -> Option<Diagnostic> {
    let (text, type_name) = (&name.text, type_name(&name.text));
    let problem = if !type_name.starts_with(|first: char| first.is_ascii_alphabetic()) {
        format!("`{text}` is not a name for a type")
    } else if types.contains(&type_name.as_str()) {
        format!("`{text}` would become the type `{type_name}`, which {owner} has already")
    } else {
        return None;
    };
    let finding = Diagnostic::error(Code::NameNotAllowed, name.span, problem);
    Some(finding.help("give the mechanism another name"))
}

fn not_a_module(name: &Name) -> Option<Diagnostic> {
    let text = name.text.as_str();
    let snake_case = text
        .chars()
        .all(|letter| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '_');
    let problem = if !snake_case {
        "a module of Rust is named in lower case, with `_` between words"
    } else if !is_word(text) {
        "Rust reserves this word"
    } else {
        return None;
    };
    let finding = Diagnostic::error(
        Code::NameNotAllowed,
        name.span,
        format!("`{text}` is not a name for a module"),
    )
    .label(problem);
    let lower = text.to_ascii_lowercase();
    Some(if !snake_case && lower.is_ascii() {
        finding.help(format!("write `{lower}`"))
    } else {
        finding.help("give the motion another name")
    })
}

fn apart(name: &str, prefix: &str) -> String {
    let first_word = name.split('_').next().unwrap_or_default();
    let is_taken = PREFIXES.contains(&first_word) || ITEMS.contains(&name);
    match is_taken || !is_word(name) {
        true => format!("{prefix}_{name}"),
        false => name.to_string(),
    }
}

/// Returns a name as an identifier; words that Rust reserves get an underscore.
pub(super) fn identifier(name: &str) -> String {
    match is_word(name) && name != "gen" {
        true => name.to_string(),
        false => format!("{name}_"),
    }
}

/// True if the name is an identifier that Rust does not reserve.
pub(super) fn is_word(name: &str) -> bool {
    let is_letter = |letter: char| letter.is_alphabetic() || letter == '_';
    name.starts_with(is_letter)
        && name.chars().all(|it| is_letter(it) || it.is_numeric())
        && !RESERVED.contains(&name)
}

/// Returns a requested quantity as a name of Rust: `bd_square` for `|BD|^2`.
fn spelled(wish: &str) -> String {
    let plain = wish.replace('|', "").replace("^2", "_square");
    let spelled = plain.to_lowercase();
    // A coordinate keeps its capitals, as its field does.
    let is_function = ["sin_", "cos_"]
        .iter()
        .any(|start| plain.starts_with(start));
    let name = if is_function { plain } else { spelled };
    match name.starts_with(|first: char| first.is_ascii_digit()) {
        true => format!("_{name}"),
        false => name,
    }
}

#[cfg(test)]
mod tests {
    use super::apart;

    #[test]
    fn names_in_use_are_kept_apart() {
        for name in [
            "p",
            "absolute_x_1",
            "drive_phi_1",
            "crank",
            "sine",
            "phi_1",
            "_a",
        ] {
            assert_eq!(apart(name, "row"), name);
        }
        for name in [
            "sin_phi1",
            "cos",
            "shared_1",
            "angle",
            "argument_2",
            "q",
            "t",
            "math",
            "phi_q",
            "gamma",
            "7",
            "type",
            "self",
            "fn",
        ] {
            assert_eq!(apart(name, "row"), format!("row_{name}"));
        }
    }
}
