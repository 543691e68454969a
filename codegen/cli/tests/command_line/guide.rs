//! The guide shows the output of the command.
//!
//! A block marked `mech` or `csv` is the file whose name in backticks begins the line above. `mech loose` marks a file
//! that is not formatted. In a block marked `console`, each line after `$` is a command; the text after `<` is its
//! input. The following lines are its output; `…` stands for lines that are left out. A picture that a page shows is
//! one that a command of the guide writes.
//!
//! After an intended change of the output, `GUIDE_UPDATE=1 cargo test -p linkwright-cli guide` writes it into the
//! pages: as many lines as before from each line after a gap on. Pictures replace those with their names. Review the
//! changes like those of a snapshot.

use std::path::{Path, PathBuf};
use std::process::Stdio;

use crate::folder::{Folder, Ran};

/// Beginnings of commands that are run: the second is for a clone.
const PROGRAMS: [&str; 2] = ["linkwright ", "cargo run --release -- "];

/// Command and the lines that it must print.
type Command<'a> = (&'a str, Vec<&'a str>);

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Pages: the one at the root, and those of the guide.
fn pages() -> Vec<PathBuf> {
    let mut pages = of_kind(&repository().join("codegen/guide"), "md");
    pages.push(repository().join("README.md"));
    pages
}

/// Files of a folder with this extension.
fn of_kind(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut paths: Vec<PathBuf> = entries
        .map(|it| it.expect("it can be read").path())
        .collect();
    paths.retain(|path| path.extension().is_some_and(|it| it == extension));
    paths.sort();
    paths
}

/// Blocks of a page: mark, text of the last line before it, and lines of each.
fn blocks(page: &str) -> Vec<(&str, &str, Vec<&str>)> {
    let mut blocks = Vec::new();
    let (mut before, mut open) = ("", None);
    for line in page.lines() {
        match (&mut open, line.strip_prefix("```")) {
            (None, Some(mark)) => open = Some((mark, before, Vec::new())),
            (None, None) if !line.is_empty() => before = line,
            (None, None) => {}
            (Some(_), Some(_)) => blocks.extend(open.take()),
            (Some((_, _, lines)), None) => lines.push(line),
        }
    }
    assert!(open.is_none(), "a block is not closed after: {before}");
    blocks
}

/// The commands of a block.
fn commands<'a>(lines: &[&'a str]) -> Vec<Command<'a>> {
    let mut commands: Vec<Command<'a>> = Vec::new();
    for line in lines {
        match (line.strip_prefix("$ "), commands.last_mut()) {
            (Some(command), _) => commands.push((command, Vec::new())),
            (None, Some((_, printed))) => printed.push(line),
            (None, None) => panic!("no command stands before: {line}"),
        }
    }
    commands
}

/// The arguments of a command, divided by spaces, but for those in single quotes.
fn arguments(command: &str) -> Vec<String> {
    let program = PROGRAMS.iter().find_map(|it| command.strip_prefix(it));
    let rest = program.unwrap_or_else(|| panic!("not a command of this program: {command}"));
    let mut arguments = Vec::new();
    for (place, part) in rest.split('\'').enumerate() {
        match place % 2 {
            0 => arguments.extend(part.split_whitespace().map(String::from)),
            _ => arguments.push(part.to_string()),
        }
    }
    arguments
}

/// The first line that is not printed, if there is one; a message for the reader.
fn difference(expected: &[&str], printed: &[&str]) -> Option<String> {
    let mut rest = printed;
    for (place, part) in expected.split(|line| *line == "…").enumerate() {
        let start = match place {
            0 => Some(0),
            _ if part.is_empty() => Some(rest.len()),
            _ => rest.windows(part.len()).position(|window| window == part),
        };
        let Some(found) = start.and_then(|start| rest.get(start..)) else {
            return Some(format!("nowhere after a gap:\n{}", part.join("\n")));
        };
        if !found.starts_with(part) {
            let mut pairs = part.iter().enumerate();
            let (at, line) = pairs.find(|(at, line)| found.get(*at) != Some(line))?;
            let instead = found.get(at).unwrap_or(&"nothing");
            return Some(format!("expected: {line}\nprinted:  {instead}"));
        }
        rest = &found[part.len()..];
    }
    let more = rest.first()?;
    Some(format!("printed beyond: {more}"))
}

/// Output with the gaps of the expected lines. The first line after a gap ends it; without that line, lines are
/// unchanged.
fn updated<'a>(expected: &[&'a str], printed: &[&'a str]) -> Vec<&'a str> {
    let (mut found, mut rest) = (Vec::new(), printed);
    let parts: Vec<&[&str]> = expected.split(|line| *line == "…").collect();
    for (place, part) in parts.iter().enumerate() {
        if place > 0 {
            found.push("…");
        }
        let start = match (place, part.first()) {
            (0, _) => Some(0),
            (_, Some(first)) => rest.iter().position(|line| line == first),
            (_, None) => None,
        };
        let Some(start) = start else {
            found.extend(part.iter());
            continue;
        };
        let end = match place + 1 == parts.len() {
            true => rest.len(),
            false => rest.len().min(start + part.len()),
        };
        found.extend(&rest[start..end]);
        rest = &rest[end..];
    }
    found
}

/// All pictures in a folder and those in it.
fn pictures(folder: &Path, found: &mut Vec<(PathBuf, Vec<u8>)>) {
    for path in of_kind(folder, "svg") {
        let bytes = std::fs::read(&path).expect("a picture");
        found.push((path, bytes));
    }
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("it can be read").path();
        if path.is_dir() {
            pictures(&path, found);
        }
    }
}

/// The pictures that a page shows.
fn shown(page: &str) -> Vec<&str> {
    let links = page
        .split("](")
        .skip(1)
        .filter_map(|rest| rest.split(')').next());
    links.filter(|link| link.ends_with(".svg")).collect()
}

#[test]
fn commands_print_what_the_guide_says() {
    let updates = std::env::var_os("GUIDE_UPDATE").is_some();
    let (mut ran, mut written, mut wanted) = (0, Vec::new(), Vec::new());
    let mut stale = Vec::new();
    for path in pages() {
        let page = std::fs::read_to_string(&path).expect("a page");
        let name = path.file_stem().and_then(|it| it.to_str()).expect("a name");
        let mut rewritten = page.clone();
        let folder = Folder::new(&format!("guide_{name}"), "");
        // Readers are in the repository.
        std::fs::write(folder.file("Cargo.toml"), "").expect("it can be written");
        std::fs::create_dir(folder.file("mechanisms")).expect("a folder");
        for description in of_kind(&repository().join("mechanisms"), "mech") {
            let name = description.file_name().expect("a name");
            std::fs::copy(&description, folder.file("mechanisms").join(name)).expect("a copy");
        }
        for (mark, before, lines) in blocks(&page) {
            match mark {
                "mech" | "mech loose" | "csv" => {
                    let name = before.strip_prefix('`').and_then(|it| it.split('`').next());
                    let name =
                        name.unwrap_or_else(|| panic!("{}: no name: {before}", path.display()));
                    let place = folder.file(name);
                    std::fs::create_dir_all(place.parent().expect("a folder")).expect("made");
                    std::fs::write(place, lines.join("\n") + "\n").expect("written");
                }
                "console" => {
                    for (command, expected) in commands(&lines) {
                        let (program, input) = match command.split_once(" < ") {
                            Some((program, name)) => {
                                let file = std::fs::File::open(folder.file(name));
                                (program, Stdio::from(file.expect("a file of the page")))
                            }
                            None => (command, Stdio::null()),
                        };
                        let mut run = folder.command();
                        let output = run.args(arguments(program)).stdin(input).output();
                        let result = Ran::from(output.expect("the command starts"));
                        let text = result.stdout + &result.stderr;
                        let printed: Vec<&str> = text.lines().collect();
                        ran += 1;
                        let Some(wrong) = difference(&expected, &printed) else {
                            continue;
                        };
                        assert!(updates, "{}: {command}\n{wrong}\n\n{text}", path.display());
                        let block = |lines: &[&str]| {
                            let lines = lines.iter().map(|line| format!("{line}\n"));
                            format!("$ {command}\n{}", lines.collect::<String>())
                        };
                        let renewed = updated(&expected, &printed);
                        if let Some(wrong) = difference(&renewed, &printed) {
                            stale.push(format!("{}: {command}\n{wrong}", path.display()));
                        }
                        let now = block(&renewed);
                        rewritten = rewritten.replacen(&block(&expected), &now, 1);
                    }
                }
                _ => {}
            }
        }
        if rewritten != page {
            std::fs::write(&path, rewritten).expect("a page can be written");
        }
        let place = path.parent().expect("a folder");
        let mut made = Vec::new();
        pictures(&folder.file("."), &mut made);
        for picture in shown(&page).into_iter().map(|link| place.join(link)) {
            let same = made
                .iter()
                .find(|(path, _)| path.file_name() == picture.file_name());
            if let (Some((_, bytes)), true) = (same, updates) {
                std::fs::write(&picture, bytes).expect("a picture can be written");
            }
            wanted.push(picture);
        }
        written.extend(made.into_iter().map(|(_, bytes)| bytes));
    }
    assert!(ran >= 10, "only {ran} commands were found");
    assert!(
        stale.is_empty(),
        "to be written by hand:\n{}",
        stale.join("\n\n")
    );
    for picture in wanted {
        let bytes = std::fs::read(&picture).unwrap_or_else(|error| panic!("{picture:?}: {error}"));
        assert!(written.contains(&bytes), "no command writes {picture:?}");
    }
}

#[test]
fn the_gallery_shows_every_description() {
    let page = repository().join("codegen/guide/gallery.md");
    let page = std::fs::read_to_string(page).expect("the gallery");
    let descriptions = of_kind(&repository().join("mechanisms"), "mech");
    let names: Vec<String> = descriptions
        .iter()
        .filter_map(|it| Some(it.file_stem()?.to_str()?.to_string()))
        .collect();
    assert!(names.len() >= 20, "{names:?}");
    let mut pictures = shown(&page);
    pictures.sort_unstable();
    let expected: Vec<String> = names.iter().map(|it| format!("gallery/{it}.svg")).collect();
    assert_eq!(pictures, expected);
}

#[test]
fn gaps_are_gaps_and_nothing_else_is() {
    let printed = ["a", "b", "c", "d"];
    assert_eq!(difference(&["a", "…", "c", "d"], &printed), None);
    assert_eq!(difference(&["…", "b", "…"], &printed), None);
    assert!(difference(&["a", "c", "d"], &printed).is_some());
    assert!(difference(&["a", "b", "c"], &printed).is_some());
    assert!(difference(&["…", "d", "…", "a"], &printed).is_some());
    assert!(difference(&["a", "b", "c", "d", "e"], &printed).is_some());
    assert_eq!(
        updated(&["x", "…", "c", "y"], &printed),
        ["a", "…", "c", "d"]
    );
    assert_eq!(
        updated(&["a", "…", "y", "…"], &printed),
        ["a", "…", "y", "…"]
    );
    assert_eq!(arguments("linkwright solve a.mech --set 'x = 1'").len(), 4);
}
