//! Turns names of a description into identifiers of C.
//!
//! A mechanism's types, functions and constants begin with its name, and cannot collide. A field or local value gets an underscore if
//! its name is a keyword of C or C++, a macro or a function that the code calls.

use crate::emit::module::Words;
use crate::emit::rust;
use crate::model::Naming;

/// Rules for names of a description in C.
pub const NAMING: Naming = Naming {
    mechanism: |name| rust::not_a_type(name, TYPES, "C"),
    motion: rust::NAMING.motion,
    apart,
};

/// Rules for names of values in C.
pub(super) const WORDS: Words = Words {
    spelled,
    of_functions: LOCAL_VALUES,
    of_frames: &["t", "q", "qd", "qdd", "parameters"],
};

/// Keywords of C up to C23 and of C++ up to C++23.
const KEYWORDS: &[&str] = &[
    "alignas",
    "alignof",
    "and",
    "and_eq",
    "asm",
    "auto",
    "bitand",
    "bitor",
    "bool",
    "break",
    "case",
    "catch",
    "char",
    "char16_t",
    "char32_t",
    "char8_t",
    "class",
    "co_await",
    "co_return",
    "co_yield",
    "compl",
    "concept",
    "const",
    "const_cast",
    "consteval",
    "constexpr",
    "constinit",
    "continue",
    "decltype",
    "default",
    "delete",
    "do",
    "double",
    "dynamic_cast",
    "else",
    "enum",
    "explicit",
    "export",
    "extern",
    "false",
    "float",
    "for",
    "friend",
    "goto",
    "if",
    "inline",
    "int",
    "long",
    "mutable",
    "namespace",
    "new",
    "noexcept",
    "not",
    "not_eq",
    "nullptr",
    "operator",
    "or",
    "or_eq",
    "private",
    "protected",
    "public",
    "register",
    "reinterpret_cast",
    "requires",
    "restrict",
    "return",
    "short",
    "signed",
    "sizeof",
    "static",
    "static_assert",
    "static_cast",
    "struct",
    "switch",
    "template",
    "this",
    "thread_local",
    "throw",
    "true",
    "try",
    "typedef",
    "typeid",
    "typename",
    "typeof",
    "typeof_unqual",
    "union",
    "unsigned",
    "using",
    "virtual",
    "void",
    "volatile",
    "wchar_t",
    "while",
    "xor",
    "xor_eq",
];

/// Macros of the standard headers and of compilers that a value could be named like.
const MACROS: &[&str] = &[
    "I",
    "NULL",
    "EOF",
    "NAN",
    "INFINITY",
    "assert",
    "complex",
    "errno",
    "far",
    "i386",
    "imaginary",
    "interface",
    "isfinite",
    "isinf",
    "isnan",
    "isnormal",
    "linux",
    "math_errhandling",
    "near",
    "noreturn",
    "offsetof",
    "signbit",
    "small",
    "stderr",
    "stdin",
    "stdout",
    "unix",
];

/// Functions that generated code calls.
const FUNCTIONS: &[&str] = &[
    "sqrt", "sqrtf", "fabs", "fabsf", "floor", "floorf", "exp", "expf", "log", "logf", "pow",
    "powf", "memcpy", "memset",
];

/// Names in the standard headers that a mechanism's type could have.
const TYPES: &[&str] = &[
    "I", "NULL", "EOF", "NAN", "INFINITY", "FILE", "DIR", "BUFSIZ", "RAND",
];

/// Arguments and local values of generated functions, whose names no value of a description gets.
const LOCAL_VALUES: &[&str] = &[
    "angles",
    "at",
    "before",
    "block",
    "blocks",
    "bounds",
    "branches",
    "carried",
    "checked",
    "chord",
    "column_length",
    "column_scales",
    "completed",
    "conditions",
    "context",
    "curvatures",
    "equations",
    "errno",
    "evaluated",
    "exchanges",
    "exp",
    "fabs",
    "factorization",
    "factors",
    "failed",
    "failure",
    "far",
    "floor",
    "found",
    "frame",
    "given",
    "inputs",
    "isolation",
    "jacobian",
    "lane",
    "last",
    "last_q",
    "last_qd",
    "last_qdd",
    "last_tears",
    "lengths",
    "linux",
    "loads",
    "log",
    "measure",
    "memory",
    "near",
    "pair",
    "parameters",
    "places",
    "pow",
    "q",
    "qd",
    "qdd",
    "reals",
    "rare",
    "response",
    "row_length",
    "row_scales",
    "rows",
    "scales",
    "signal",
    "signs",
    "sizes",
    "window",
    "sqrt",
    "status",
    "steps",
    "t",
    "tearing",
    "tears",
    "terms",
    "times",
    "enclosures",
    "turning",
    "turns",
    "unix",
    "unsolved",
    "unused",
    "variation",
    "changes",
    // Functions and macros, which a value of the same name would hide.
];

/// Functions in scope of generated code, whose names no row or block gets.
const ITEMS: &[&str] = &[
    "phi",
    "phi_q",
    "phi_t",
    "gamma",
    "drawn",
    "monitored",
    "descriptor",
    "requirements",
];

/// Prefixes of local values up to the first `_`: `sin_phi1`, `shared_1`.
const PREFIXES: &[&str] = &[
    "sin",
    "cos",
    "shared",
    "argument",
    "angle",
    "exponential",
    "logarithm",
];

fn apart(name: &str, prefix: &str) -> String {
    let first_word = name.split('_').next().unwrap_or_default();
    let is_taken = PREFIXES.contains(&first_word)
        || ITEMS.contains(&name)
        || LOCAL_VALUES.contains(&name)
        || FUNCTIONS.contains(&name)
        || is_word(name)
        || !is_plain(name);
    match is_taken {
        true => format!("{prefix}_{name}"),
        false => name.to_string(),
    }
}

/// True if the name consists of ASCII letters, digits and `_`, and does not begin with a digit.
fn is_plain(name: &str) -> bool {
    let is_letter = |it: char| it.is_ascii_alphanumeric() || it == '_';
    name.chars().all(is_letter) && !name.starts_with(|it: char| it.is_ascii_digit())
}

fn is_word(name: &str) -> bool {
    KEYWORDS.contains(&name) || MACROS.contains(&name)
}

/// Returns a name as an identifier. A keyword, with or without underscores behind it, gets one more; other letters become their code
/// point.
pub(super) fn identifier(name: &str) -> String {
    let mut plain = String::with_capacity(name.len());
    for letter in name.chars() {
        match letter.is_ascii_alphanumeric() || letter == '_' {
            true => plain.push(letter),
            false => plain.push_str(&format!("u{:04x}", u32::from(letter))),
        }
    }
    match is_word(plain.trim_end_matches('_')) {
        true => plain + "_",
        false => plain,
    }
}

/// Returns a requested quantity as a name of C: `bd_square` for `|BD|^2`.
fn spelled(wish: &str) -> String {
    let name = (rust::WORDS.spelled)(wish);
    identifier(&name)
}

#[cfg(test)]
mod tests {
    use super::{apart, identifier};

    #[test]
    fn words_get_an_underscore_and_stay_apart() {
        for (name, expected) in [
            ("crank", "crank"),
            ("int", "int_"),
            ("int_", "int__"),
            ("errno", "errno_"),
            ("phi_int", "phi_int"),
            ("phi_θ", "phi_u03b8"),
            ("explicit", "explicit_"),
        ] {
            assert_eq!(identifier(name), expected);
        }
    }

    #[test]
    fn rows_do_not_hide_functions() {
        for name in ["sqrt", "q", "phi_q", "int", "I", "sin_phi1", "7"] {
            assert_eq!(apart(name, "row"), format!("row_{name}"));
        }
        assert_eq!(apart("a_x", "row"), "a_x");
    }
}
