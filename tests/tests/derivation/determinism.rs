//! Generating twice gives the same bytes: in one process, and in others, whose hash maps have other seeds.

use std::path::PathBuf;
use std::process::Command;
use std::{env, fs};

use linkwright_codegen::{Options, generate};
use linkwright_tests::{description, files};

fn code(name: &str) -> String {
    let source = description::source(name);
    match generate(&source, &Options::default()) {
        Ok(generated) => generated.code().to_string(),
        Err(errors) => panic!("{}", errors.render(&source)),
    }
}

/// Set in the processes that the second test starts: they write what they generate into this folder.
const FOLDER: &str = "LINKWRIGHT_TESTS_GENERATE_INTO";

#[test]
fn generating_twice_gives_the_same_bytes() {
    for name in description::names() {
        let code = code(&name);
        assert!(code == self::code(&name), "{name} differs");
        if let Some(folder) = env::var_os(FOLDER) {
            fs::write(PathBuf::from(folder).join(name), code).expect("a folder to write into");
        }
    }
}

#[test]
fn other_processes_generate_the_same_bytes() {
    if env::var_os(FOLDER).is_some() {
        return;
    }
    for run in 0..3 {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("determinism-{run}"));
        fs::create_dir_all(&folder).expect("a folder for the copies");
        let status = Command::new(env::current_exe().expect("the path of this test"))
            .args([
                "--exact",
                "determinism::generating_twice_gives_the_same_bytes",
            ])
            .env(FOLDER, &folder)
            .output()
            .expect("this test runs again");
        assert!(
            status.status.success(),
            "{}",
            String::from_utf8_lossy(&status.stdout)
        );
        for name in description::names() {
            let other =
                fs::read_to_string(folder.join(&name)).expect("the other process has written it");
            assert!(other == code(&name), "{name} differs in another process");
        }
    }
}

/// Neither the folder nor the file name reaches the code: a clone elsewhere gives the same bytes.
#[test]
fn the_code_does_not_depend_on_where_the_description_lies() {
    for name in description::names() {
        let mut source = description::source(&name);
        source.name = "/somewhere/else/entirely.mech".to_string();
        let moved = generate(&source, &Options::default())
            .map(|generated| generated.code().to_string())
            .unwrap_or_default();
        assert!(moved == code(&name), "{name} differs");
        let root = files::repository().display().to_string();
        assert!(
            !moved.contains(&root) && !moved.contains("/somewhere"),
            "{name} names a folder"
        );
    }
}
