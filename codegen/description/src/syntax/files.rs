//! *Text → the files that it names.* Whoever reads a description asks for them before it is parsed.

use super::scan::{self, Kind};

/// The paths of the files that a description names, relative to it, each once in written order. What is no relative path is left
/// out: it is reported where the table is resolved.
pub fn named_files(text: &str) -> Vec<String> {
    let lexemes = scan::scan(text).lexemes;
    let texts = lexemes.iter().filter(|lexeme| lexeme.kind == Kind::Text);
    let mut paths: Vec<String> = Vec::new();
    for lexeme in texts {
        let path = unquoted(&text[lexeme.start..lexeme.end]);
        if is_relative(path) && !paths.iter().any(|known| known == path) {
            paths.push(path.to_string());
        }
    }
    paths
}

/// What stands between the quotes.
pub(super) fn unquoted(text: &str) -> &str {
    let inside = text.strip_prefix('"').unwrap_or(text);
    inside.strip_suffix('"').unwrap_or(inside)
}

/// Whether a path means the same file wherever the description is copied together with it.
pub(crate) fn is_relative(path: &str) -> bool {
    let is_refused = |it: char| matches!(it, '\\' | ':') || it.is_control();
    !path.is_empty() && !path.starts_with('/') && !path.contains(is_refused)
}

/// Whether a relative path leads out of the folder that it starts in.
pub(crate) fn leaves_folder(path: &str) -> bool {
    let mut depth = 0;
    path.split('/').any(|part| {
        depth += match part {
            "" | "." => 0,
            ".." => -1,
            _ => 1,
        };
        depth < 0
    })
}

#[cfg(test)]
mod tests {
    use super::{is_relative, leaves_folder, named_files};

    #[test]
    fn a_path_leaves_its_folder_upwards() {
        for inside in [
            "a.csv",
            "./a.csv",
            "a/../b.csv",
            "a//b/../../c.csv",
            "..a/b",
        ] {
            assert!(is_relative(inside) && !leaves_folder(inside), "{inside}");
        }
        for outside in ["../a.csv", "a/../../b.csv", "./..//a.csv", ".."] {
            assert!(is_relative(outside) && leaves_folder(outside), "{outside}");
        }
        assert!(!is_relative("a\nb"));
    }

    #[test]
    fn only_tables_name_files() {
        let text = r#"
            // table none = "comment.csv";
            table lift = "lift.csv" in (deg, mm);
            table same = "lift.csv"; table other = "data/other.csv" periodic;
            point "quoted.csv" = (0, 0);
            table absolute = "/etc/passwd"; table drive = "C:lift.csv"; table empty = "";
            table open = "open.csv
        "#;
        assert_eq!(named_files(text), ["lift.csv", "data/other.csv"]);
        assert!(named_files("\u{feff}table a = \"").is_empty());
    }
}
