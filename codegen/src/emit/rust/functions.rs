//! Imports elementary functions from a module of the user in place of those of the runtime.

use std::collections::HashSet;

use super::names::is_word;

/// Names of the runtime that the user's module can replace, with their imports.
const IMPORTS: [(&str, &str); 2] = [("math", "self as math"), ("angle_near", "angle_near")];

/// Returns `use crate::plain::{self as math, angle_near};` with the names that the code mentions; `None` if it mentions none. An import
/// by name takes precedence over the glob import at the head of every module.
///
/// An invalid path becomes an error of the compiler, like a path to a missing module.
pub(super) fn functions(path: &str, mentioned: &HashSet<&str>) -> Option<String> {
    // A macro gives a path with spaces between its parts.
    let names: Vec<&str> = path.split("::").map(str::trim).collect();
    let below = match &names[..] {
        ["", others @ ..] => others,
        all => all,
    };
    let is_name = |name: &&str| {
        is_word(name.trim_start_matches("r#")) || matches!(*name, "crate" | "self" | "super")
    };
    if below.is_empty() || !below.iter().all(is_name) {
        let problem = format!("the option `math` is `{path}`, which is not the path of a module");
        return Some(format!("compile_error!({problem:?});"));
    }
    let path = names.join("::");
    let used = IMPORTS.iter().filter(|(name, _)| mentioned.contains(name));
    let used: Vec<&str> = used.map(|(_, import)| *import).collect();
    match &used[..] {
        [] => None,
        ["angle_near"] => Some(format!("use {path}::angle_near;")),
        used => Some(format!("use {path}::{{{}}};", used.join(", "))),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::functions;

    #[test]
    fn imports_are_what_the_code_mentions() {
        let both = HashSet::from(["math", "angle_near"]);
        for path in ["crate::plain", "crate :: plain"] {
            let import = functions(path, &both);
            assert_eq!(
                import.as_deref(),
                Some("use crate::plain::{self as math, angle_near};")
            );
        }
        let import = functions("::other::plain", &HashSet::from(["angle_near"]));
        assert_eq!(import.as_deref(), Some("use ::other::plain::angle_near;"));
        assert_eq!(functions("plain", &HashSet::new()), None);
    }

    #[test]
    fn invalid_paths_are_errors_of_the_compiler() {
        for path in ["", "1", "crate::", "a b", "a; use b", "crate::fn", "::"] {
            let import = functions(path, &HashSet::from(["math"]));
            assert!(
                import.is_some_and(|it| it.starts_with("compile_error!(\"")),
                "{path}"
            );
        }
    }
}
