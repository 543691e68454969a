//! Lists the files that a text names. The caller loads them before the text is parsed.

use super::scan::{self, Kind};

/// Returns the paths that a description names, relative to it, without duplicates and in source order. Paths that are not
/// relative are omitted; resolving the table reports them.
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

/// Removes the quotes.
pub(super) fn unquoted(text: &str) -> &str {
    let inside = text.strip_prefix('"').unwrap_or(text);
    inside.strip_suffix('"').unwrap_or(inside)
}

/// True if a path is independent of the location of the description.
pub(crate) fn is_relative(path: &str) -> bool {
    let is_refused = |it: char| matches!(it, '\\' | ':') || it.is_control();
    !path.is_empty() && !path.starts_with('/') && !path.contains(is_refused)
}

/// True if a relative path leaves its starting folder.
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
