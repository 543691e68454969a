//! Checks that every link of the pages for users leads to a file, and to a heading in it.

use std::fs;
use std::path::{Path, PathBuf};

use linkwright_tests::files;

/// The pages of the repository, and those of the guide.
fn pages() -> Vec<PathBuf> {
    let root = files::repository();
    let mut pages = files::with_extension(&root.join("codegen/guide"), "md");
    pages.extend([root.join("README.md"), root.join("mechanisms/README.md")]);
    pages
}

/// The lines of a page outside of blocks, with their numbers.
fn text(page: &str) -> Vec<(usize, &str)> {
    let mut is_code = false;
    let lines = page.lines().enumerate().filter(|(_, line)| {
        let is_fence = line.trim_start().starts_with("```");
        is_code ^= is_fence;
        !is_fence && !is_code
    });
    lines.map(|(place, line)| (place + 1, line)).collect()
}

/// The targets of the links on a line, without those to other sites.
fn targets(line: &str) -> Vec<&str> {
    let links = line.split("](").skip(1);
    let links = links.filter_map(|rest| rest.split([')', ' ']).next());
    links.filter(|target| !target.contains("://")).collect()
}

/// The anchor of a heading: lower case, without marks, with hyphens for spaces.
fn anchor(heading: &str) -> String {
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = text
        .chars()
        .filter(|it| it.is_alphanumeric() || " -_".contains(*it));
    kept.map(|it| if it == ' ' { '-' } else { it }).collect()
}

fn anchors(page: &str) -> Vec<String> {
    let lines = text(page).into_iter().map(|(_, line)| line);
    lines
        .filter(|line| line.starts_with('#'))
        .map(anchor)
        .collect()
}

/// Fault of a link from a page.
fn problem(page: &Path, target: &str) -> Option<String> {
    let (file, heading) = target.split_once('#').unwrap_or((target, ""));
    let place = match file {
        "" => page.to_path_buf(),
        file => page.parent()?.join(file),
    };
    if !place.exists() {
        return Some(format!("{} does not exist", place.display()));
    }
    if heading.is_empty() {
        return None;
    }
    let headings = anchors(&fs::read_to_string(&place).ok()?);
    (!headings.iter().any(|it| it == heading))
        .then(|| format!("{} has no heading #{heading}", place.display()))
}

#[test]
fn every_link_leads_somewhere() {
    let mut links = 0;
    for path in pages() {
        let page = fs::read_to_string(&path).expect("a page");
        for (number, line) in text(&page) {
            for target in targets(line) {
                links += 1;
                if let Some(problem) = problem(&path, target) {
                    panic!("{}:{number}: {problem}", path.display());
                }
            }
        }
    }
    assert!(links >= 50, "only {links} links were found");
}

#[test]
fn a_link_that_leads_nowhere_is_found() {
    let page = files::repository().join("README.md");
    assert!(problem(&page, "nowhere.md").is_some());
    assert!(problem(&page, "mechanisms/README.md#nowhere").is_some());
    assert!(problem(&page, "mechanisms/README.md").is_none());
    assert_eq!(
        targets("[a](b.md#c) and ![d](e.svg \"f\") or <https://g.h>"),
        ["b.md#c", "e.svg"]
    );
    assert_eq!(
        anchor("### `unguarded`: no path, π/2"),
        "unguarded-no-path-π2"
    );
}
