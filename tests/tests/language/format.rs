//! Formats every description of the repository and thousands of random ones: the meaning is unchanged, every comment
//! kept, and formatting again changes nothing. The descriptions of the repository are formatted. The suite `fuzz`
//! formats mutations of all of them.

use std::fs;
use std::path::{Path, PathBuf};

use linkwright_codegen::diagnostic::Source;
use linkwright_tests::files;
use linkwright_tests::hunt::mechanism;
use linkwright_tests::hunt::paths::families::{FAMILIES, course};
use linkwright_tests::hunt::run::MAX_BODIES;
use linkwright_tests::random::Random;

use crate::targets::format;

/// Seed of all random texts.
const SEED: u64 = 0x666f_726d;

fn read(path: &Path) -> Source {
    let text = fs::read_to_string(path).unwrap_or_default();
    Source::new(path.display().to_string(), text)
}

fn all(extension: &str) -> Vec<PathBuf> {
    // Without build products.
    files::below(&files::repository(), extension, &["target", ".git"])
}

/// The descriptions of the reference and of the guide.
fn of_pages() -> Vec<Source> {
    let mut sources = Vec::new();
    for page in all("md") {
        let text = fs::read_to_string(&page).expect("a page");
        let blocks = text.split("\n```mech\n").skip(1);
        let blocks = blocks.filter_map(|it| Some(it.split_once("\n```")?.0));
        sources.extend(blocks.map(|it| Source::new(page.display().to_string(), format!("{it}\n"))));
    }
    sources
}

#[test]
fn every_description_keeps_its_meaning_and_its_comments() {
    let files = all("mech");
    let read_without_error = files.iter().filter(|it| format::run(&read(it))).count();
    println!("{read_without_error} of {} files can be read", files.len());
    // Most of the others are cases of errors.
    assert!(files.len() > 250 && read_without_error > 200);
    let blocks = of_pages();
    let read_without_error = blocks.iter().filter(|it| format::run(it)).count();
    println!(
        "{read_without_error} of {} blocks can be read",
        blocks.len()
    );
    assert!(blocks.len() > 80 && read_without_error > 70);
}

#[test]
fn descriptions_of_the_repository_are_formatted() {
    for folder in ["../mechanisms", "descriptions", "stability"] {
        for path in files::with_extension(&files::package(folder), "mech") {
            let source = read(&path);
            let formatted = linkwright_codegen::format(&source).expect("a description");
            assert_eq!(formatted, source.text, "{}", path.display());
        }
    }
    for source in of_pages() {
        if let Ok(formatted) = linkwright_codegen::format(&source) {
            assert_eq!(formatted, source.text, "{}", source.name);
        }
    }
}

#[test]
fn formatted_random_mechanisms_keep_their_meaning() {
    for number in 0..100 {
        let text = mechanism(SEED, number, MAX_BODIES).text();
        assert!(format::run(&Source::new("grown.mech", text)));
    }
    for (family, (name, _)) in FAMILIES.iter().enumerate() {
        for number in 0..5 {
            let text = course(family, SEED, number).text;
            assert!(format::run(&Source::new(*name, text)));
        }
    }
}

/// White space and comments that may stand between any two words and marks.
const BETWEEN: [&str; 14] = [
    " ",
    "  ",
    "     ",
    "\n",
    "\n ",
    "\n\n\n",
    "\t",
    "\r\n",
    " // a // b /* c\n",
    "\n// alone  \n",
    " /* d */ ",
    "/* e /* f */\n  g */",
    "/**/",
    "\n\n/* h */",
];

/// Text with the blanks between its words and marks replaced at random.
fn shaken(text: &str, random: &mut Random) -> String {
    let mut shaken = String::new();
    let (mut last, mut is_comment) = (' ', false);
    let mut characters = text.chars().peekable();
    while let Some(next) = characters.next() {
        is_comment |= next == '/' && characters.peek() == Some(&'/');
        let is_pair = matches!((last, next), ('-', '>') | ('<' | '>', '=') | ('/', '/'));
        let is_edge = !is_comment
            && !is_pair
            && next != '.'
            && last != '.'
            && (next == ' '
                || last == ' '
                || ",;(){}[]=+-*/^<>:".contains(next)
                || ",;(){}[]=+-*/^<>:".contains(last));
        if is_edge && random.bits().is_multiple_of(4) {
            let number = random.bits() as usize % BETWEEN.len();
            // Comments begin and end only where they are complete.
            let is_safe = last != '/' && next != '/' && last != '*' && next != '*';
            shaken.push_str(if is_safe { BETWEEN[number] } else { " " });
        }
        shaken.push(next);
        is_comment &= next != '\n';
        last = next;
    }
    shaken
}

#[test]
fn any_white_space_and_comment_may_stand_anywhere() {
    println!("seed {SEED:#x}");
    let mut random = Random::new(SEED);
    let mut formatted = 0;
    let folders = ["../mechanisms", "descriptions"];
    let files = folders.map(|it| files::with_extension(&files::package(it), "mech"));
    for path in files.iter().flatten() {
        let text = fs::read_to_string(path).expect("a description");
        // A table that is read from a file needs that file only for its meaning.
        for _ in 0..20 {
            let shaken = shaken(&text, &mut random);
            formatted += usize::from(format::run(&Source::new("shaken.mech", shaken)));
        }
    }
    println!("{formatted} shaken descriptions can be read");
    assert!(formatted > 1000);
}
