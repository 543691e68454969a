//! Puts the elementary functions of a type in place of the runtime's.

use std::collections::HashSet;

use super::names::is_word;

/// Functions in place of those that every module imports by their names.
const ANGLES: [(&str, &[&str]); 2] = [
    (
        "angle_near",
        &[
            "",
            "#[inline]",
            "fn angle_near(sine: Scalar, cosine: Scalar, near: Scalar) -> Scalar {",
            "    math::angle_near(sine, cosine, near)",
            "}",
        ],
    ),
    (
        "two_angles_near",
        &[
            "",
            "#[inline]",
            "fn two_angles_near(sines: [Scalar; 2], cosines: [Scalar; 2], near: [Scalar; 2]) -> [Scalar; 2] {",
            "    [0, 1].map(|place| math::angle_near(sines[place], cosines[place], near[place]))",
            "}",
        ],
    ),
];

/// Lines that put the type at `path` in place of `math`, as far as the code mentions its functions:
/// `use crate::Plain as math;`. An import by name goes before the one of all names that every module begins with.
///
/// Text that is not a path becomes an error where the code is compiled, as does a path that leads nowhere.
pub(super) fn functions(path: &str, mentioned: &HashSet<&str>) -> Vec<String> {
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
        let problem = format!("the option `math` is `{path}`, which is not the path of a type");
        return vec![format!("compile_error!({problem:?});")];
    }
    let is_mentioned = |name: &str| mentioned.contains(name);
    let angles: Vec<&[&str]> = ANGLES
        .into_iter()
        .filter(|(name, _)| is_mentioned(name))
        .map(|(_, lines)| lines)
        .collect();
    let mut lines = Vec::new();
    if !angles.is_empty() || is_mentioned("math") {
        lines.push(format!("use {} as math;", names.join("::")));
    }
    lines.extend(angles.concat().into_iter().map(str::to_string));
    lines
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::functions;

    #[test]
    fn functions_are_those_that_the_code_mentions() {
        for path in ["crate::Plain", "crate :: Plain"] {
            let lines = functions(path, &HashSet::from(["math"]));
            assert_eq!(lines, ["use crate::Plain as math;"]);
        }
        let lines = functions("::other::Plain", &HashSet::from(["angle_near"]));
        assert_eq!(lines[0], "use ::other::Plain as math;");
        assert!(lines[3].starts_with("fn angle_near("), "{lines:?}");
        let lines = functions("::other::Plain", &HashSet::from(["two_angles_near"]));
        assert!(lines[3].starts_with("fn two_angles_near("), "{lines:?}");
        assert!(functions("Plain", &HashSet::new()).is_empty());
    }

    #[test]
    fn invalid_paths_are_errors_of_the_compiler() {
        for path in ["", "1", "crate::", "a b", "a; use b", "crate::fn", "::"] {
            let import = functions(path, &HashSet::from(["math"]));
            assert!(import[0].starts_with("compile_error!(\""), "{path}");
        }
    }
}
