//! Friction in the joints of all descriptions: both formulations agree.

use std::collections::BTreeMap;

use linkwright_codegen::diagnostic::Source;
use linkwright_solver::{Dense, Interpreted};
use linkwright_tests::description;

use super::followed;

/// Text with friction in all pins and slides that have a name of their own, and with masses; `None` if it cannot have any.
fn rubbed(text: &str) -> Option<String> {
    let begins = |word: &str| {
        let mut lines = text.lines().map(str::trim_start);
        lines.any(|line| line.split([' ', ';']).next() == Some(word))
    };
    let others = ["friction", "redundant", "free", "motion", "part", "repeat"];
    if others.into_iter().any(begins) || text.contains("pressure_angle") {
        return None;
    }
    let is_name = |name: &str| {
        name.chars()
            .all(|it| it.is_ascii_alphanumeric() || it == '_')
    };
    let (mut names, mut bodies) = (BTreeMap::new(), Vec::new());
    for line in text.lines() {
        let head = line.split('(').next().unwrap_or_default();
        let words: Vec<&str> = head.split_whitespace().collect();
        let (clause, name) = match words[..] {
            ["revolute", name] => ("0.1 radius 5mm", name),
            ["translational", name] => ("0.05 over 0.2", name),
            ["point_on_line", name] => ("0.05", name),
            ["body", name, ..] => {
                bodies.push(name.trim_end_matches('{'));
                continue;
            }
            _ => continue,
        };
        if is_name(name) && name.starts_with(|it: char| it.is_ascii_alphabetic()) {
            names.entry(name).or_insert_with(Vec::new).push(clause);
        }
    }
    names.retain(|_, clauses| clauses.windows(2).all(|it| it[0] == it[1]));
    if names.is_empty() {
        return None;
    }
    let end = text.rfind('}')?;
    let mut rubbed = text[..end].to_string();
    for (name, clauses) in names {
        rubbed.push_str(&format!("friction {name} = {};\n", clauses[0]));
    }
    if !begins("mass") {
        for body in bodies {
            rubbed.push_str(&format!("mass {body} = 2kg inertia 0.1;\n"));
        }
        rubbed.push_str("gravity = (0, -9.81);\n");
    }
    if !begins("reactions") && !begins("reaction") {
        rubbed.push_str("reactions;\n");
    }
    Some(format!("{rubbed}}}\n"))
}

#[test]
fn both_formulations_have_the_friction_of_all_descriptions() {
    let (mut compared, mut worst, mut joints) = (0, 0.0_f64, 0);
    for name in description::of_tests().iter().chain(&description::names()) {
        let source = description::source(name);
        let Some(text) = rubbed(&source.text) else {
            continue;
        };
        let source = Source { text, ..source };
        // Others have no forces, or no driver.
        let Ok(read) = linkwright_codegen::read(&source) else {
            continue;
        };
        for derived in &read.motions {
            let Some(view) = Interpreted::new(derived) else {
                continue;
            };
            let (solved, failure) = followed(&view, None, 0.5);
            let (dense, _) = followed(&Dense::new(derived), None, 0.5);
            let mut largest = 0.0_f64;
            for ((_, own), (_, other)) in solved.rows.iter().zip(&dense.rows) {
                let size = own.iter().fold(1e-3_f64, |size, it| size.max(it.abs()));
                for (own, other) in own.iter().zip(other) {
                    largest = largest.max((own - other).abs() / size);
                    compared += 1;
                }
            }
            println!(
                "{name}: {largest:e} in {} instants, {failure:?}",
                solved.rows.len()
            );
            worst = worst.max(largest);
            joints += derived.system.mechanism.forces.frictions.len();
        }
    }
    println!("{worst:e} in {compared} values of mechanisms with {joints} rubbing joints");
    assert!(worst < 1e-12 && compared > 100_000 && joints > 200);
}
