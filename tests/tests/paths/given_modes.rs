//! Assembly modes are those of the design configuration for any driver: each driver becomes an input with any
//! default, a law that fits only at a late start, and a parameter.

use std::collections::BTreeMap;

use linkwright::{Blocks, Branch};
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::{Interpreted, View};
use linkwright_tests::hunt::paths::families::course;
use linkwright_tests::random::Random;
use linkwright_tests::{description, files};

/// Replacement of a law.
#[derive(Clone, Copy, Debug)]
enum Role {
    Input,
    Parameter,
    Late,
}

fn systems(text: &str) -> Result<Vec<Derived>, String> {
    let source = Source::new("given.mech", text);
    let read = linkwright_codegen::read(&source).map_err(|errors| errors.render(&source))?;
    linkwright_codegen::stages::check_all(&read.motions)
        .map_err(|errors| errors.render(&source))?;
    Ok(read.motions)
}

/// Branches of closed forms by their names. The sign of another block's determinant depends on the order of its
/// equations, which drivers may change.
fn modes(derived: &Derived) -> BTreeMap<String, Branch> {
    let blocks = Interpreted::new(derived).expect("determined");
    let drawn = blocks.drawn_branches();
    let names = blocks.mode_names().into_iter();
    names
        .filter(|it| it.is_closed)
        .map(|it| (it.name, drawn.closed[it.place]))
        .collect()
}

/// A law with t - 7 in the place of t.
fn late(law: &str) -> String {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut text = String::new();
    let mut word = String::new();
    for c in law.chars().chain([' ']) {
        if is_word(c) {
            word.push(c);
            continue;
        }
        text += match word.as_str() {
            "t" => "(t - 7)",
            other => other,
        };
        word.clear();
        text.push(c);
    }
    text
}

/// Description with a replacement of the law of its driver `place`; `None` if it has fewer drivers.
fn driven(text: &str, place: usize, role: Role, default: f64) -> Option<String> {
    let mut drivers = text.match_indices("drive ").filter(|(at, _)| {
        text[..*at]
            .rsplit('\n')
            .next()
            .is_some_and(|line| line.trim().is_empty())
    });
    let (at, _) = drivers.nth(place)?;
    let equals = at + text[at..].find('=')? + 1;
    let end = equals + text[equals..].find(';')?;
    let law = match role {
        Role::Late => late(&text[equals..end]),
        _ => " driven_so".to_string(),
    };
    let declared = match role {
        Role::Input => format!("\n    input driven_so = {default:?};"),
        Role::Parameter => format!("\n    param driven_so = {default:?};"),
        Role::Late => String::new(),
    };
    let open = text
        .find("mechanism ")
        .and_then(|at| Some(at + text[at..].find('{')?))?
        + 1;
    Some(format!(
        "{}{declared}{}{law}{}",
        &text[..open],
        &text[open..equals],
        &text[end..]
    ))
}

/// Counts tested variants, and those that the language refuses.
fn keeps_modes(name: &str, text: &str, random: &mut Random, counts: &mut [usize; 2]) {
    let Ok(before) = systems(text) else { return };
    let before: Vec<_> = before.iter().map(modes).collect();
    for place in 0.. {
        for role in [Role::Input, Role::Parameter, Role::Late] {
            let default = 10.0_f64.powf(random.between(-3.0, 3.0));
            let Some(text) = driven(text, place, role, default) else {
                return;
            };
            let after = match systems(&text) {
                Ok(after) => after,
                Err(_) => {
                    counts[1] += 1;
                    continue;
                }
            };
            counts[0] += 1;
            for (was, derived) in before.iter().zip(&after) {
                let is = modes(derived);
                assert_eq!(
                    *was, is,
                    "{name}, driver {place}, {role:?} {default}:\n{text}"
                );
            }
        }
    }
}

#[test]
fn the_modes_of_the_repository_are_the_drawn_ones_however_they_are_driven() {
    let mut random = Random::new(11);
    let mut counts = [0; 2];
    for path in files::with_extension(&files::repository().join("mechanisms"), "mech") {
        let name = files::stem(&path);
        keeps_modes(
            name,
            &description::source(name).text,
            &mut random,
            &mut counts,
        );
    }
    println!("{} variants, {} refused", counts[0], counts[1]);
    assert!(counts[0] > 60 && counts[1] * 4 < counts[0], "{counts:?}");
}

#[test]
fn the_modes_of_the_hunt_are_the_drawn_ones_however_they_are_driven() {
    let mut random = Random::new(12);
    let mut counts = [0; 2];
    for number in 0..30 {
        for family in [0, 7, 12, 13, 15, 16] {
            let name = format!("family {family}, number {number}");
            keeps_modes(
                &name,
                &course(family, 9, number).text,
                &mut random,
                &mut counts,
            );
        }
    }
    println!("{} variants, {} refused", counts[0], counts[1]);
    assert!(counts[0] > 300 && counts[1] * 4 < counts[0], "{counts:?}");
}
