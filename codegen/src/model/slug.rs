//! A joint or driver → what its rows are named after in generated code.
//!
//! Afterwards every slug is an identifier of Rust, differs from every other slug, and neither it nor what is appended to it (`_x`,
//! `_2`) can be the name of something else in the generated functions. Deliberately unknown here: how many rows a joint has.

use std::collections::{HashMap, HashSet};

use super::Role;
use super::operands::Given;
use super::resolve::Resolver;

/// What names of rows must not be, since the generated functions have it in scope: parameters, modules, functions.
const TAKEN: &[&str] = &[
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
    "closed_form",
    "failed",
    "no_span",
    "spans",
    "nearest_turn",
    "explicit",
    "branches",
    "settings",
    "frame",
];

/// The same in mechanisms with parameters or inputs.
const TAKEN_BY_GIVEN: &[&str] = &["parameters", "inputs", "geometry"];

/// What the names of local values begin with: `sin_phi1`, `shared_1`. Words up to the first `_`.
const LOCAL: &[&str] = &[
    "sin",
    "cos",
    "shared",
    "argument",
    "angle",
    "exponential",
    "logarithm",
];

/// The name itself, or with `prefix` where it could collide with a local value, a parameter or an item, where Rust reserves it, or
/// where it begins with a digit. Names that begin with `prefix` must not be in use for anything else.
pub(crate) fn apart(name: &str, prefix: &str) -> String {
    let first_word = name.split('_').next().unwrap_or_default();
    let local = LOCAL.contains(&first_word);
    if local || TAKEN.contains(&name) || syn::parse_str::<syn::Ident>(name).is_err() {
        format!("{prefix}_{name}")
    } else {
        name.to_string()
    }
}

/// The slugs of all joints so far; only looked up.
#[derive(Clone, Debug, Default)]
pub(super) struct Slugs {
    taken: HashSet<String>,
    /// Of a base the number up to which all are taken.
    numbers: HashMap<String, usize>,
}

impl Slugs {
    /// Takes the slug of a joint.
    pub(super) fn take(&mut self, slug: &str) {
        self.taken.insert(slug.to_string());
    }

    /// The base, or with the first number from 2 on that makes it free.
    fn free(&mut self, base: String) -> String {
        if !self.taken.contains(&base) {
            return base;
        }
        let number = self.numbers.entry(base.clone()).or_insert(2);
        loop {
            let numbered = format!("{base}_{number}");
            if !self.taken.contains(&numbered) {
                return numbered;
            }
            *number += 1;
        }
    }
}

impl Resolver<'_> {
    /// A lower-case identifier for the rows of a joint.
    pub(super) fn unique_slug(&mut self, given: &Given<'_>) -> String {
        let mut words: Vec<String> = Vec::new();
        match given.name {
            Some(name) => words.push(name.text.clone()),
            None => {
                if given.role == Role::Driver {
                    words.push("drive".to_string());
                }
                words.push(given.kind.keyword().to_string());
                for operand in given.operands {
                    words.extend(operand.body.iter().map(|body| body.text.clone()));
                    words.push(operand.name.text.clone());
                }
            }
        }
        self.unique(&words.join("_"))
    }

    /// The words as a lower-case identifier that no other joint's rows are named after.
    pub(super) fn unique(&mut self, words: &str) -> String {
        let mut base = apart(&words.to_lowercase(), "row");
        if self.has_given && TAKEN_BY_GIVEN.contains(&base.as_str()) {
            base = format!("row_{base}");
        }
        self.slugs.free(base)
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
