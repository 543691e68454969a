//! `mechanism!` in the package of a user: the module is the one that a build script generates, and errors are in
//! their places.
//!
//! The package `fixtures/macros` is copied before it is built, with the lock file of the workspace. Nothing is
//! downloaded and the repository stays unchanged.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use linkwright::{Blocks, Mechanism, Settings};
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Options, generate};
use linkwright_tests::values::{assembled_from, levels, numbers};
use linkwright_tests::{description, files, user_package};
use serde_json::Value;

/// Some descriptions of the repository, each in the macro.
mod in_code {
    include!(concat!(env!("OUT_DIR"), "/in_code.rs"));
}

/// Copies the package under another name, with this library.
fn copy(name: &str, library: &str) -> PathBuf {
    let to = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let from = files::package("fixtures/macros");
    let repository = files::repository();
    let repository = repository.to_str().expect("a path in UTF-8");
    for file in [
        "Cargo.toml",
        "src/lib.rs",
        "src/way.csv",
        "shown/Cargo.toml",
        "shown/src/lib.rs",
        "printed/Cargo.toml",
        "printed/src/main.rs",
    ] {
        let source = match file {
            "src/lib.rs" => from.join("src").join(library),
            _ => from.join(file),
        };
        let text = fs::read_to_string(source).expect("a file of the package");
        // Cargo tells packages of one target folder apart by their names, not by their paths.
        let text = text.replace("name = \"in-code\"", &format!("name = \"{name}\""));
        let text = text.replace("../../../../..", repository);
        let text = text.replace("../../..", repository);
        let target = to.join(file);
        fs::create_dir_all(target.parent().expect("a folder")).expect("a folder for the copy");
        fs::write(target, text).expect("the copy is writable");
    }
    fs::copy(
        files::repository().join("Cargo.lock"),
        to.join("Cargo.lock"),
    )
    .expect("the copy is writable");
    to
}

/// Runs cargo in a package, with a command of several words.
fn cargo(package: &Path, command: &str) -> Output {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("built");
    user_package::cargo(package, &target, command)
}

/// Messages of the compiler about a package: line, beginning of the message, marked text, in the order of the lines.
/// Checks that helps are given.
fn said(package: &Path, level: &str) -> Vec<(u64, String, String)> {
    let output = cargo(package, "check --message-format=json");
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    let mut messages = Vec::new();
    for line in printed.lines() {
        let record: Value = serde_json::from_str(line).expect("cargo prints JSON");
        let message = &record["message"];
        if record["reason"] != "compiler-message" || message["level"] != level {
            continue;
        }
        let [span] = message["spans"].as_array().expect("spans").as_slice() else {
            continue;
        };
        let marked = &span["text"][0];
        let number = |value: &Value| usize::try_from(value.as_u64().expect("a number"));
        let place = |name: &str| number(&marked[name]).expect("a column") - 1;
        let text: Vec<char> = marked["text"].as_str().expect("a line").chars().collect();
        let text: String = text[place("highlight_start")..place("highlight_end")]
            .iter()
            .collect();
        messages.push((
            span["line_start"].as_u64().expect("a line"),
            message["message"].as_str().expect("words").to_string(),
            text,
        ));
    }
    messages.sort();
    messages
}

/// Messages that a library of the package expects with `//~`: line, beginning of the message, marked text.
fn expected(library: &str) -> Vec<(u64, String, String)> {
    let text = fs::read_to_string(files::package("fixtures/macros/src").join(library));
    let text = text.expect("the library");
    let mut messages = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let Some((code, expected)) = line.split_once("//~ ") else {
            continue;
        };
        let (message, marked) = expected.split_once(" | ").expect("a marked text");
        // A line without code stands for the one before, which a note there would change.
        let number = if code.trim().is_empty() {
            number - 1
        } else {
            number
        };
        messages.push((number, message.to_string(), marked.to_string()));
    }
    messages.sort();
    messages
}

/// Compares messages with the expected ones.
fn assert_said(library: &str, found: &[(u64, String, String)]) {
    let expected = expected(library);
    let is_as_expected = found.len() == expected.len()
        && found.iter().zip(&expected).all(|(found, expected)| {
            found.0 == expected.0 && found.1.starts_with(&expected.1) && found.2 == expected.2
        });
    assert!(is_as_expected, "{found:#?}\ninstead of\n{expected:#?}");
}

#[test]
fn good_descriptions_compile_without_a_warning_and_move() {
    let package = copy("in-code", "lib.rs");
    for command in ["test", "clippy --all-targets", "doc --no-deps"] {
        let output = cargo(&package, command);
        let printed = String::from_utf8_lossy(&output.stderr).into_owned();
        let tests = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(output.status.success(), "{command}: {printed}{tests}");
        assert!(!printed.contains("warning"), "{command}: {printed}");
        // The one in the library, and the one in its documentation.
        if command == "test" {
            assert_eq!(tests.matches("1 passed").count(), 2, "{tests}");
        }
    }
    let pages = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("built/doc/in_code");
    let page = fs::read_to_string(pages.join("four_bar/index.html")).expect("the page");
    for text in [
        "Crank, coupler and rocker.",
        "<svg ",
        "How its motion is found: ",
    ] {
        assert!(page.contains(text), "{text} is missing in {page}");
    }
    let page = fs::read_to_string(pages.join("first/index.html")).expect("the page");
    assert!(page.contains("One.") && page.contains("Two."), "{page}");
}

#[test]
fn every_error_is_at_its_token() {
    let messages = said(&copy("in-code-wrong", "wrong.rs"), "error");
    assert_said("wrong.rs", &messages);
    for (_, message, _) in &messages {
        let is_coded = message.starts_with('K');
        assert!(!is_coded || message.contains("\nhelp: "), "{message}");
    }
    // Other places are named by their lines.
    let (_, twice, _) = &messages[0];
    assert!(
        twice.contains("\nfirst declared here: src/lib.rs:5:15"),
        "{twice}"
    );
}

#[test]
fn every_warning_is_at_its_token() {
    let package = copy("in-code-warned", "warned.rs");
    fs::copy(package.join("src/way.csv"), package.join("way.csv")).expect("a copy");
    assert_said("warned.rs", &said(&package, "warning"));
}

/// Cargo builds again when the file of a table changes.
#[test]
fn a_table_that_changes_is_read_again() {
    let package = copy("in-code-table", "lib.rs");
    let points = package.join("src/way.csv");
    let build = |content: &str| {
        fs::write(&points, content).expect("the table is writable");
        let output = cargo(&package, "build");
        (
            output.status.success(),
            String::from_utf8_lossy(&output.stderr).into_owned(),
        )
    };
    let good = fs::read_to_string(&points).expect("the table");
    let (built, printed) = build(&good);
    assert!(built, "{printed}");
    let (built, printed) = build(&good.replace("1, 2", "1, wrong"));
    assert!(!built && printed.contains("wrong"), "{printed}");
    let (built, printed) = build(&good.replace("1, 2", "1, 3"));
    assert!(built, "{printed}");
}

/// Every description of the repository as the compiler hands it to the macro.
#[test]
fn the_compilers_tokens_say_what_the_text_says() {
    let package = copy("in-code-printed", "lib.rs");
    let names = description::names();
    let texts = names.iter().map(|name| {
        let text = description::source(name).text;
        format!("shown::shown! {{\n{text}\n}},\n")
    });
    let texts = format!("[{}]", texts.collect::<String>());
    fs::write(package.join("printed/src/descriptions.rs"), texts).expect("the copy is writable");
    let output = cargo(&package, "run --package printed");
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{message}");
    let texts: Vec<&str> = printed.split_terminator('\0').collect();
    assert_eq!(texts.len(), names.len());
    for (name, text) in names.iter().zip(texts) {
        let source = description::source(name);
        let rebuilt = Source {
            text: text.to_string(),
            ..source.clone()
        };
        let code = |source: &Source| match generate(source, &Options::default()) {
            Ok(generated) => generated.code().to_string(),
            Err(errors) => panic!("{}", errors.render(source)),
        };
        assert!(code(&rebuilt) == code(&source), "{name}: {text}");
        // Each line except for comments is in its place.
        let start = source.text.lines().position(|line| !line.is_empty());
        let written = source.text.lines().skip(start.unwrap_or(0));
        for (line, rebuilt) in written.zip(text.lines()) {
            assert!(
                line.starts_with(rebuilt.trim_end()),
                "{name}: {line}\n{rebuilt}"
            );
        }
    }
}

/// All levels at some instants, bit by bit.
fn bits<M>() -> Vec<u64>
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>,
{
    let blocks = M::Blocks::default();
    let drawn = numbers(&blocks.drawn_pose(&blocks.nominal_parameters()));
    let mut shell = assembled_from(blocks, &drawn, 0.0, Settings::default()).expect("a pose");
    let mut all_bits = Vec::new();
    for step in 0..=20 {
        let t = f64::from(step) / 100.0;
        let inputs = shell.blocks().initial_inputs();
        shell.advance(t, &inputs).expect("a frame");
        let [q, qd, qdd] = levels(shell.blocks(), shell.frame());
        all_bits.extend(q.into_iter().chain(qd).chain(qdd).map(f64::to_bits));
    }
    all_bits
}

#[test]
fn a_mechanism_in_code_moves_as_the_one_of_a_build_script() {
    macro_rules! same {
        ($($module:ident::$mechanism:ident),+) => {$({
            let generated = bits::<linkwright_mechanisms::$module::$mechanism>();
            assert!(generated.len() > 100);
            assert_eq!(bits::<in_code::$module::$mechanism>(), generated, stringify!($module));
        })+};
    }
    same!(
        four_bar::FourBar,
        excavator::Excavator,
        cam_dwell::CamDwell,
        rack_steering::RackSteering,
        platform_3rpr::Platform3rpr,
        jansen::Jansen
    );
}
