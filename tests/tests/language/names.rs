//! Names of a description never hide other names of the generated code.

use std::collections::BTreeSet;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Options, generate, read};
use linkwright_tests::files;
use linkwright_tests::prose::lines;

/// The names that the `let` statement on a line binds: one, or those of a tuple.
fn bound(line: &str) -> Vec<&str> {
    let Some((pattern, _)) = line
        .trim_start()
        .strip_prefix("let ")
        .and_then(|rest| rest.split_once(" = "))
    else {
        return Vec::new();
    };
    // A structure is taken apart under the names of its fields.
    if pattern.starts_with('&') {
        return Vec::new();
    }
    let names = pattern.trim_matches(['(', ')']).split(", ");
    names.map(|name| name.trim_start_matches("mut ")).collect()
}

/// The code of a description, after a check that no function binds a name twice or one that its caller knows otherwise.
fn checked(description: &str) -> String {
    let source = Source::new("names.mech", description);
    let code = generate(&source, &Options::default())
        .unwrap_or_else(|found| panic!("{}", found.render(&source)))
        .code()
        .to_string();
    syn::parse_file(&code).unwrap_or_else(|error| panic!("the module is not Rust: {error}"));
    let mut functions = 0;
    // Free functions begin and end at the margin; methods bind nothing that a description names.
    let mut lines = code.lines();
    while lines.any(|line| line.starts_with("pub fn ") || line.starts_with("fn ")) {
        functions += 1;
        let mut names: BTreeSet<&str> = [
            "q", "qd", "t", "math", "phi", "phi_t", "gamma", "at", "last",
        ]
        .into();
        for line in lines.by_ref().take_while(|line| *line != "}") {
            for name in bound(line) {
                assert!(names.insert(name), "`{name}` is bound again in: {line}");
            }
        }
    }
    assert!(functions >= 4, "{code}");
    code
}

#[test]
fn drivers_and_joints_named_like_local_values() {
    let code = checked(
        "mechanism locals {
            point O = (0, 0);
            body 1 at (0, 0) { O, P: (1, 0) }
            body 2 at (1, 0) { P: (0, 0), Q: (0.3, 2) }
            body 3 at (1, 2) { Q: (0, 0), S: (1, 0) }
            revolute sin_phi1(ground.O, 1.O);
            revolute 7(1.P, 2.P);
            revolute q(2.Q, 3.Q);
            drive cos_phi1: phi(1) = t;
            drive math: phi(2) = sin(t);
            drive shared_1: phi(3) = exp(t);
        }",
    );
    for name in [
        "row_sin_phi1_x",
        "row_7_x",
        "row_q_y",
        "row_cos_phi1",
        "row_math",
        "row_shared_1",
    ] {
        assert!(code.contains(&format!("let {name} = ")), "{name} in {code}");
    }
}

#[test]
fn rows_of_one_joint_named_like_another() {
    let code = checked(
        "mechanism rows {
            body 1 at (0, 0) { A: (0, 0), B: (1, 0) }
            body 2 at (1, 0) { B: (0, 0), C: (1, 0) }
            body 3 at (2, 0) { C: (0, 0) }
            point A = (0, 0);
            revolute a(ground.A, 1.A);
            revolute type(1.B, 2.B);
            revolute A(2.C, 3.C);
            drive a_x: phi(1) = t;
            drive type: phi(2) = t;
            drive type_: phi(3) = t;
        }",
    );
    for name in ["a_x", "a_x_2", "a_2_x", "row_type_x", "row_type_2", "type_"] {
        assert!(code.contains(&format!("let {name} = ")), "{name} in {code}");
    }
}

/// The point P of the body `c` could be taken for a second P, `p_c_2`, which is the one of the body `c_2`. Arms of one name would be
/// one vector.
#[test]
fn points_whose_names_meet() {
    let description = "mechanism arms {
            point O = (0, 0), sin = (0.5, 0.5);
            body c_2 at (1, 1) { P: (1, 0.2), R: (3, 2) }
            body c at (0, 0) { O, P: (0.4, 1), Q: (0.4, 2) }
            body phi at (0.9, 0.1) { sin, S: (0.7, 1) }
            revolute O(ground, c);
            revolute (c_2.P, c.P);
            revolute (phi.S, c_2.R);
            revolute sin(ground, phi);
            drive phi(c) = t;
        }";
    checked(description);
    let read = read(&Source::new("names.mech", description)).expect("no errors");
    let derived = read.only().expect("one motion");
    let arms = &derived.pool.arms();
    let names: BTreeSet<&str> = arms.iter().map(|arm| arm.name.as_str()).collect();
    assert_eq!(names.len(), arms.len(), "{names:?}");
    assert!(names.contains("point_sin_phi"), "{names:?}");
}

/// The types and traits that every generated module imports, as they are written in the runtime.
fn imported() -> BTreeSet<String> {
    let path = files::repository().join("runtime/src/generated/mod.rs");
    let text = std::fs::read_to_string(path).expect("the runtime's names");
    let (_, list) = text.split_once("pub mod $name {").expect("a list");
    let list: String = lines(list).into_iter().map(|it| it.code + "\n").collect();
    let items = list
        .split(';')
        .filter(|item| item.contains("pub use") || item.contains("pub type"));
    let names = items.flat_map(|item| {
        let aliased = item.split_once("pub type ").map(|(_, rest)| rest);
        match aliased.and_then(|rest| rest.split(['<', ' ']).next()) {
            Some(name) => vec![name.to_string()],
            None => {
                // An item with another name hides only that one.
                let paths = item.split(',');
                let paths =
                    paths.map(|path| path.split_once(" as ").map_or(path, |(_, name)| name));
                let words = paths
                    .flat_map(|path| path.split(|it: char| !it.is_alphanumeric() && it != '_'));
                words.map(str::to_string).collect()
            }
        }
    });
    names
        .filter(|name| name.starts_with(|first: char| first.is_ascii_uppercase()))
        .collect()
}

/// A type of its own would hide the one that the module is written with.
#[test]
fn no_mechanism_is_named_like_what_its_module_uses() {
    let mut names = imported();
    assert!(names.len() > 15, "{names:?}");
    let reserved = [
        "Branches",
        "Coordinates",
        "Default",
        "Frame",
        "Inputs",
        "Loops",
        "None",
        "Option",
        "Pair",
        "Parameters",
        "Some",
        "Textbook",
        "PathEnclosures",
    ];
    names.extend(reserved.map(str::to_string));
    let description = |name: &str| {
        format!(
            "mechanism {name} {{
                param r = 0.1; input s = 1;
                point O = (0, 0);
                body c at (0, 0) {{ O, P: (r, 0) }}
                revolute O(ground, c);
                drive phi(c) = s;
            }}"
        )
    };
    let source = Source::new("crank.mech", description("crank"));
    assert!(
        generate(&source, &Options::default()).is_ok(),
        "only the name is wrong below"
    );
    for name in names {
        let mut written = String::new();
        for letter in name.chars() {
            if letter.is_ascii_uppercase() && !written.is_empty() {
                written.push('_');
            }
            written.push(letter.to_ascii_lowercase());
        }
        let source = Source::new("named.mech", description(&written));
        let Err(found) = generate(&source, &Options::default()) else {
            panic!("a mechanism may be named `{written}`");
        };
        let text = found.render(&source);
        assert!(
            text.contains("error[K10]") && text.contains(&format!("`{name}`")),
            "{text}"
        );
    }
}
