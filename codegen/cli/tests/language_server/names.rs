//! Every name in a description has a meaning, and keeps it when it is renamed.

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::read;
use linkwright_codegen::stages::emit::{Notation, text};
use linkwright_codegen::stages::files;
use linkwright_codegen::stages::files::attach_files;
use linkwright_codegen::stages::joint::{CONSTRAINTS, DRIVERS};
use linkwright_codegen::stages::model::{
    ENDS_OF_TABLES, FUNCTIONS, LAWS, MEASURE_FUNCTIONS, UNITS,
};
use linkwright_codegen::stages::syntax::{
    AXES, BUILT_IN, CLAUSES, KEYWORDS, Kind, LEVELS, lexemes, parse,
};
use linkwright_command::language_server::names::{Names, Sort};

use crate::client::{descriptions, repository};

/// Folders of descriptions without an error.
const FOLDERS: [&str; 5] = [
    "mechanisms",
    "tests/descriptions",
    "tests/stability",
    "tests/fixtures/plans",
    "codegen/command/src/template",
];

fn sources() -> Vec<Source> {
    let mut all = Vec::new();
    for folder in FOLDERS {
        for (path, text) in descriptions(folder) {
            let source = Source::new(path.display().to_string(), text);
            all.push(attach_files(source, files::folder_of(&path)));
        }
    }
    // Examples of the language reference.
    let reference = std::fs::read_to_string(repository().join("mechanisms/README.md"));
    let reference = reference.expect("the reference");
    let blocks = reference.split("```mech\n").skip(1);
    for (number, block) in blocks.enumerate() {
        let text = block.split("```").next().unwrap_or_default();
        all.push(Source::new(format!("example {number}"), text));
    }
    all.retain(|source| read(source).is_ok());
    all
}

fn names(source: &Source) -> Names {
    let document = parse(source, &mut Diagnostics::new());
    document
        .as_ref()
        .map(|it| Names::of(it, &source.text))
        .unwrap_or_default()
}

/// Words of the language that may occur anywhere in a statement.
fn is_word_of_the_language(word: &str) -> bool {
    let kinds = CONSTRAINTS.iter().chain(DRIVERS).map(|it| it.keyword);
    let words = [FUNCTIONS, MEASURE_FUNCTIONS, LAWS, BUILT_IN, UNITS].concat();
    let mut words = words
        .into_iter()
        .chain(KEYWORDS)
        .chain(CLAUSES)
        .chain(AXES)
        .chain(LEVELS)
        .chain(ENDS_OF_TABLES)
        .chain(["mechanism", "ground"])
        .chain(kinds);
    words.any(|it| it == word)
}

#[test]
fn every_word_is_a_name_or_one_of_the_language() {
    let mut count = 0;
    for source in sources() {
        let names = names(&source);
        for lexeme in lexemes(&source.text) {
            let word = &source.text[lexeme.start..lexeme.end];
            if lexeme.kind != Kind::Word || is_word_of_the_language(word) {
                continue;
            }
            let mention = names.mention_at(lexeme.start);
            let mentioned = mention.map(|it| &source.text[it.span.range()]);
            let position = source.position(lexeme.start as u32);
            // A measure of a motor begins with the name of its driver.
            let word = word.split("_motor_").next();
            assert_eq!(mentioned, word, "{}:{}", source.name, position.line);
            count += 1;
        }
    }
    assert!(count > 2000, "only {count} names");
}

/// Equations and requested quantities of every motion, in words. Points are listed in the order of their names; points
/// with other names are ordered by their positions.
fn equations(source: &Source, is_point: bool) -> Vec<String> {
    let read = read(source).unwrap_or_else(|found| panic!("{}", found.render(source)));
    let mut all = Vec::new();
    for derived in &read.motions {
        let formula =
            |expr| text::formula(&derived.pool, &derived.system, &[], Notation::Ascii, expr);
        for row in derived.system.rows.iter().chain(&derived.system.monitored) {
            all.push(row.name.clone());
            all.push(text::formula(
                &derived.pool,
                &derived.system,
                &row.bodies,
                Notation::Ascii,
                row.residual,
            ));
        }
        let places = derived
            .system
            .outputs
            .iter()
            .map(|it| it.position.map(formula).concat());
        let mut places: Vec<String> = places.collect();
        if is_point {
            places.sort();
        }
        all.extend(places);
        let mechanism = &derived.system.mechanism;
        all.extend(mechanism.joints.iter().map(|it| it.label.clone()));
        all.extend(mechanism.constants.iter().map(|it| formula(it.value)));
        let expected = (
            &mechanism.requests,
            &mechanism.transmissions,
            &mechanism.sensitivities,
        );
        all.push(format!("{expected:?}"));
        let forces = &mechanism.forces;
        all.extend(forces.loads.iter().map(|it| it.label.clone()));
        all.push(format!("{:?}", forces.reactions));
    }
    all
}

/// Text whose words are compared irrespective of their lengths.
fn words(text: &str) -> Vec<String> {
    let is_part = |it: char| it.is_alphanumeric() || it == '_';
    let spaced: String = text
        .chars()
        .map(|it| if is_part(it) { it } else { ' ' })
        .collect();
    spaced.split_whitespace().map(str::to_lowercase).collect()
}

/// New name of everything. A point of two bodies becomes one that names both, so a name must not look like that.
const FRESH: &str = "zzfresh";

/// Renames every name of every description, one by one: the meaning is unchanged except for that name.
#[test]
fn a_renamed_description_says_the_same() {
    let mut count = 0;
    for source in sources() {
        let names = names(&source);
        let mut done: Vec<usize> = Vec::new();
        for (id, symbol) in names.symbols.iter().enumerate() {
            if done.iter().any(|&it| names.are_same(it, id)) {
                continue;
            }
            done.push(id);
            let mut renamed = source.clone();
            for place in names.mentions_of(id).iter().rev() {
                let declared = &source.text[symbol.declared.range()];
                assert_eq!(&source.text[place.range()], declared, "{}", source.name);
                renamed.text.replace_range(place.range(), FRESH);
            }
            let what = format!("{}: {:?} `{}`", source.name, symbol.sort, symbol.name);
            let is_point = matches!(symbol.sort, Sort::Point | Sort::BodyPoint);
            let [before, after] = [&source, &renamed].map(|it| equations(it, is_point));
            assert_eq!(before.len(), after.len(), "{what}");
            for (before, after) in before.iter().zip(&after) {
                let [before, after] = [words(before), words(after)];
                assert_eq!(before.len(), after.len(), "{what}");
                for (one, other) in before.iter().zip(&after) {
                    let is_same = one == other || other.contains(FRESH);
                    assert!(is_same, "{what}: {one} became {other}");
                }
            }
            count += 1;
        }
    }
    assert!(count > 1000, "only {count} names");
}
