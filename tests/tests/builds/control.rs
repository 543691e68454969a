//! The controller of the guide in C prints the output of its page; the checks of the repository run the one in Rust,
//! with equal output.

use std::fs;
use std::path::Path;
use std::process::Command;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Language, Options, generate};
use linkwright_tests::c::run::{FLAGS, compilers, run, runtime_object};
use linkwright_tests::files;

/// The block after a line.
fn block<'a>(page: &'a str, line: &str) -> &'a str {
    let (_, rest) = page.split_once(line).expect("the line");
    let (_, rest) = rest.split_once("\n```").expect("a block");
    let (_, rest) = rest.split_once('\n').expect("its mark");
    rest.split_once("```").expect("its end").0
}

#[test]
fn the_controller_in_c_prints_what_its_page_says() {
    let page =
        fs::read_to_string(files::repository().join("codegen/guide/control.md")).expect("the page");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("control");
    fs::create_dir_all(&folder).expect("a folder");
    let source = Source::new("loader.mech", block(&page, "`descriptions/loader.mech`"));
    let options = Options {
        language: Language::C,
        ..Options::default()
    };
    let generated = generate(&source, &options);
    let generated = generated.unwrap_or_else(|found| panic!("{}", found.render(&source)));
    for file in generated.files {
        fs::write(folder.join(file.name), file.text).expect("written");
    }
    fs::write(folder.join("main.c"), block(&page, "`main.c`")).expect("written");
    let counted = |line: &&str| line.contains("sines, angles and roots");
    let printed_block = block(&page, "`cargo run` with `--release` prints");
    let printed_block: Vec<&str> = printed_block
        .lines()
        .filter(|line| !counted(line))
        .collect();
    assert!(printed_block.len() > 10 && !compilers().is_empty());
    for compiler in compilers() {
        let mut command = Command::new(compiler);
        command.args(&FLAGS[..5]).arg("-Werror");
        command
            .args(["main.c", "loader.c"])
            .arg(runtime_object(compiler));
        command.args(["-lm", "-o", "controller"]);
        run(command.current_dir(&folder)).unwrap_or_else(|error| panic!("{error}"));
        let output = Command::new(folder.join("controller"))
            .output()
            .expect("it runs");
        let printed = String::from_utf8(output.stdout).expect("text");
        assert_eq!(
            printed.lines().collect::<Vec<_>>(),
            printed_block,
            "{compiler}"
        );
    }
}
