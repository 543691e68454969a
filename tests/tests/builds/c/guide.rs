//! The page about C is true, and its thresholds are those of Rust.

use std::fs;
use std::process::Command;

use linkwright_codegen::Scalar;
use linkwright_tests::c::run::run;
use linkwright_tests::{description, files};

use super::{compile, folder, write, write_double};

/// The blocks of a page, by the name in backticks before them, or else by their marks.
pub(super) fn block<'a>(page: &'a str, before: &str) -> &'a str {
    let (_, rest) = page
        .split_once(before)
        .unwrap_or_else(|| panic!("{before}"));
    let (_, rest) = rest.split_once("```").expect("a block");
    let (_, rest) = rest.split_once('\n').expect("its mark");
    rest.split_once("```").expect("its end").0
}

/// The page's program prints what the page says, and its sketch compiles as Arduino would compile it, but for the board's functions.
#[test]
fn the_guide_is_true() {
    let path = files::repository().join("codegen/guide/c.md");
    let page = fs::read_to_string(&path).expect("the page");
    let place = folder("guide");
    write_double(&place, "excavator");
    fs::write(place.join("main.c"), block(&page, "`main.c`")).expect("written");
    compile(&place, &["excavator", "linkwright", "main"]);
    let objects = ["excavator", "linkwright", "main"].map(|it| format!("{it}-gcc.o"));
    run(Command::new("gcc")
        .args(objects)
        .args(["-lm", "-o", "arm"])
        .current_dir(&place))
    .unwrap_or_else(|error| panic!("{error}"));
    let output = Command::new(place.join("arm")).output().expect("it runs");
    let printed = String::from_utf8(output.stdout).expect("text");
    let expected = block(&page, "-o arm && ./arm");
    let expected = expected
        .split_once("```text\n")
        .map_or(expected, |(_, text)| text);
    let after = page.split_once("./arm\n```\n").expect("the command").1;
    let documented = block(after, "");
    if printed != documented && std::env::var_os("GUIDE_UPDATE").is_some() {
        let updated = page.replacen(
            &format!("```text\n{documented}```"),
            &format!("```text\n{printed}```"),
            1,
        );
        fs::write(&path, updated).expect("written");
    } else {
        assert_eq!(printed, documented, "{expected}");
    }
    let sketch = folder("arm");
    write(
        &sketch,
        &description::source("four_bar"),
        "four_bar",
        Scalar::F32,
    );
    fs::write(sketch.join("arm.ino"), block(&page, "`arm.ino`")).expect("written");
    let board = "#pragma once\nstruct Port { void begin(long); void println(float); };\nextern Port Serial;\nunsigned long millis();\nvoid setup();\nvoid loop();\n";
    fs::write(sketch.join("Arduino.h"), board).expect("written");
    let cpp = [
        "-std=gnu++11",
        "-Os",
        "-Wall",
        "-Wextra",
        "-Werror",
        "-x",
        "c++",
        "-include",
        "Arduino.h",
        "-c",
        "arm.ino",
        "-o",
        "arm.o",
    ];
    run(Command::new("g++").args(cpp).current_dir(&sketch))
        .unwrap_or_else(|error| panic!("{error}"));
    for name in ["four_bar", "linkwright"] {
        let file = format!("{name}.c");
        let c = [
            "-std=gnu11",
            "-Os",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-c",
            &file,
            "-o",
            "sketch.o",
        ];
        run(Command::new("gcc").args(c).current_dir(&sketch))
            .unwrap_or_else(|error| panic!("{error}"));
    }
}

/// The number that a constant of Rust or of C is written as: a literal, or a quotient of two.
fn value(text: &str) -> Option<f64> {
    let plain = text.replace(['_', ' ', '(', ')', 'U'], "");
    let number = |it: &str| -> Option<f64> {
        let it = it.trim_end_matches("asf64").trim_end_matches('f');
        it.parse().ok()
    };
    match plain.split_once('/') {
        Some((above, below)) => Some(number(above)? / number(below)?),
        None => number(&plain),
    }
}

/// Every threshold of the C runtime that has the name of one of Rust has its value, too.
#[test]
fn thresholds_are_those_of_rust() {
    let page = files::repository().join("runtime/src/thresholds.md");
    let page = fs::read_to_string(page).expect("the page of thresholds");
    let mut rust = std::collections::BTreeMap::new();
    for line in page.lines().filter(|line| line.contains("`runtime/src/")) {
        let mut cells = line.split('|').map(|it| it.trim().trim_matches('`'));
        if let (Some(_), Some(name), Some(text)) = (cells.next(), cells.next(), cells.next()) {
            rust.entry(name.to_string())
                .or_insert_with(Vec::new)
                .extend(value(text));
        }
    }
    let place = folder("thresholds");
    write_double(&place, "two_body");
    let source = fs::read_to_string(place.join("linkwright.c")).expect("the runtime");
    let mut compared = 0;
    for line in source.lines() {
        let (name, text) = if let Some(rest) = line.strip_prefix("static const double ") {
            let Some((name, text)) = rest.split_once(" = ") else {
                continue;
            };
            (name, text.trim_end_matches(';'))
        } else if let Some((name, text)) = line
            .strip_prefix("#define ")
            .and_then(|it| it.split_once(' '))
        {
            (name, text)
        } else {
            continue;
        };
        let expected = rust.get(name).filter(|it| !it.is_empty());
        if let (Some(expected), Some(found)) = (expected, value(text)) {
            assert!(
                expected.contains(&found),
                "{name}: {expected:?} in Rust, {found} in C"
            );
            compared += 1;
        }
    }
    assert!(compared >= 20, "{compared}");
}
