//! Removes from scripts and style sheets what only their authors need.

/// Separators of a style sheet with and without spaces.
const DENSE: [(&str, &str); 7] = [
    ("; }", "}"),
    (" { ", "{"),
    (": ", ":"),
    ("; ", ";"),
    (", ", ","),
    (" > ", ">"),
    ("\n", ""),
];

/// Removes indentation and lines of comments. No line of a script or a style sheet depends on its indentation.
pub fn compact(text: &str) -> String {
    let lines = text.lines().map(str::trim_start);
    let kept =
        lines.filter(|line| !line.is_empty() && !line.starts_with("//") && !line.starts_with("/*"));
    kept.map(|line| format!("{line}\n")).collect()
}

/// Removes the spaces of a style sheet that only its authors need.
pub fn dense(style: &str) -> String {
    let mut style = style.to_string();
    for (spaced, dense) in DENSE {
        style = style.replace(spaced, dense);
    }
    style
}
