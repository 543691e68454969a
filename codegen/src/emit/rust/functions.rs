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
    // A macro gives a path with spaces between its parts.
    let names: Vec<&str> = path.split("::").map(str::trim).collect();
    let own = match &names[..] {
        ["", others @ ..] => others,
        all => all,
    };
    let is_name = |name: &&str| {
        is_word(name.trim_start_matches("r#")) || matches!(*name, "crate" | "self" | "super")
    };
    if own.is_empty() || !own.iter().all(is_name) {
        let problem = format!("the option `math` is `{path}`, which is no path of a module");
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
        let found = |path: &str, mentioned: &HashSet<&str>| functions(path, mentioned);
        let wanted = "use crate::plain::{self as math, angle_near};";
        for path in ["crate::plain", "crate :: plain"] {
            assert_eq!(found(path, &both).as_deref(), Some(wanted));
        }
        let one = HashSet::from(["angle_near"]);
        let wanted = "use ::other::plain::angle_near;";
        assert_eq!(found("::other::plain", &one).as_deref(), Some(wanted));
        assert_eq!(found("plain", &HashSet::new()), None);
    }

    #[test]
    fn what_is_no_path_is_an_error_of_the_compiler() {
        for path in ["", "1", "crate::", "a b", "a; use b", "crate::fn", "::"] {
            let found = functions(path, &HashSet::from(["math"]));
            assert!(
                found.is_some_and(|it| it.starts_with("compile_error!(\"")),
                "{path}"
            );
        }
    }
}
