//! The path of a module with elementary functions → the imports that put them in place of the runtime's.

use std::collections::HashSet;

use super::names::is_word;

/// What a module may take from somewhere else.
const IMPORTS: [(&str, &str); 2] = [("math", "self as math"), ("angle_near", "angle_near")];

/// `use crate::plain::{self as math, angle_near};`, as far as the code mentions these names. An import by name goes before the one
/// of all names that every module begins with.
///
/// What is no path becomes an error where the code is compiled, as a path does that leads nowhere.
pub(super) fn functions(path: &str, mentioned: &HashSet<&str>) -> Option<String> {
    let is_name = |name: &str| is_word(name) || matches!(name, "crate" | "self" | "super");
    if !path.trim_start_matches("::").split("::").all(is_name) {
        let problem = format!("the option `math` is `{path}`, which is no path of a module");
        return Some(format!("compile_error!({problem:?});"));
    }
    let used = IMPORTS.iter().filter(|(name, _)| mentioned.contains(name));
    let used: Vec<&str> = used.map(|(_, import)| *import).collect();
    match &used[..] {
        [] => None,
        ["angle_near"] => Some(format!("use {path}::angle_near;")),
        used => Some(format!("use {path}::{{{}}};", used.join(", "))),
    }
}
