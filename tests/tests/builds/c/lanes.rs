//! Groups in C have the bits of the same mechanisms alone, and their loops are vectorized.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use linkwright_codegen::{Language, Options, Scalar, generate};
use linkwright_tests::c::case::SCALARS;
use linkwright_tests::c::groups::{Comparison, comparisons};
use linkwright_tests::c::run::{FLAGS, compilers, run, runtime_object};
use linkwright_tests::{description, files};

use super::guide::block;
use super::{compile, folder};
use crate::lanes::rocker;
use crate::representatives::representatives;

/// Compiled with full optimization for the processor of this machine as well, as different as closed forms can be.
const VECTORIZED: [&str; 8] = [
    "crane",
    "excavator",
    "excavator_tool",
    "forced_slider",
    "four_bar",
    "sensed_gears",
    "table_of_file",
    "two_body",
];

/// Files of a description with lanes; `None` if a block has no closed form.
fn written(place: &Path, name: &str, stem: &str, scalar: Scalar) -> Option<Vec<Comparison>> {
    let source = description::source(name);
    let options = Options {
        language: Language::C,
        scalar,
        lanes: true,
        stem: Some(stem.to_string()),
        ..Options::default()
    };
    let generated = generate(&source, &options).ok()?;
    for file in &generated.files {
        assert!(file.text.is_ascii(), "{}", file.name);
        files::write_if_changed(&place.join(&file.name), &file.text).expect("written");
    }
    let header = &generated.files[1].text;
    Some(comparisons(&source, header, stem, scalar))
}

/// Compiler with its options for mechanisms.
#[derive(Clone, Copy)]
struct Compiled<'a> {
    compiler: &'a str,
    options: &'a [&'a str],
}

/// Compiles descriptions with lanes and a comparison of each motion into one program, and runs it; returns the number of descriptions with
/// lanes, and the counts that the program prints.
fn compared(
    place: &Path,
    names: &[String],
    (suffix, scalar): (&str, Scalar),
    compiled: Compiled<'_>,
) -> (usize, BTreeMap<String, usize>) {
    fs::create_dir_all(place).expect("a folder");
    for (name, text) in [
        ("counted.h", include_str!("counted.h")),
        ("lanes_program.h", include_str!("lanes_program.h")),
    ] {
        files::write_if_changed(&place.join(name), text).expect("written");
    }
    let (mut calls, mut declared, mut sources) = (String::new(), String::new(), Vec::new());
    for name in names {
        let stem = format!("{name}_{suffix}");
        let Some(comparisons) = written(place, name, &stem, scalar) else {
            continue;
        };
        sources.push((stem.clone(), true));
        for Comparison { prefix, text } in comparisons {
            let comparison = format!("compare_{suffix}_{prefix}");
            let file = place.join(format!("{comparison}.c"));
            files::write_if_changed(&file, &text).expect("written");
            sources.push((comparison, false));
            let _ = writeln!(declared, "int compare_{prefix}(Counted *counted);");
            let _ = writeln!(calls, "    differences += compare_{prefix}(&counted);");
        }
    }
    let count = sources
        .iter()
        .filter(|(_, is_mechanism)| *is_mechanism)
        .count();
    let main = format!(
        "#include \"counted.h\"\n#include \"linkwright.h\"\n#include <stdio.h>\n\n{declared}\nint main(void)\n{{\n    static Counted counted;\n    int differences = 0;\n{calls}    for (int k = 0; k < 32; k++) {{\n        if (counted.by_status[k] > 0) {{\n            printf(\"%s: %d\\n\", linkwright_status_text((linkwright_status)k), counted.by_status[k]);\n        }}\n    }}\n    printf(\"not assembled: %d\\n\", counted.unassembled);\n    return (differences > 0) ? 1 : 0;\n}}\n"
    );
    files::write_if_changed(&place.join("main.c"), &main).expect("written");
    sources.push(("main".to_string(), false));
    let next = AtomicUsize::new(0);
    let compile_all = || {
        while let Some((source, is_mechanism)) = sources.get(next.fetch_add(1, Ordering::Relaxed)) {
            let mut command = Command::new(compiled.compiler);
            match is_mechanism {
                true => command.args(FLAGS).args(compiled.options),
                false => command.args(["-std=c99", "-O1"]),
            };
            command
                .args(["-c", &format!("{source}.c")])
                .current_dir(place);
            run(&mut command).unwrap_or_else(|error| panic!("{error}"));
        }
    };
    thread::scope(|scope| {
        scope.spawn(compile_all);
        scope.spawn(compile_all);
    });
    let objects = sources.iter().map(|(source, _)| format!("{source}.o"));
    let mut command = Command::new(compiled.compiler);
    command
        .args(objects)
        .arg(runtime_object(compiled.compiler))
        .args(["-lm", "-o", "compare"])
        .current_dir(place);
    run(&mut command).unwrap_or_else(|error| panic!("{error}"));
    let output = Command::new(place.join("compare"))
        .output()
        .expect("it runs");
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        output.status.success(),
        "{suffix} with {}:\n{printed}",
        compiled.compiler
    );
    let lines = printed.lines().filter_map(|line| {
        let (status, count) = line.split_once(": ")?;
        Some((status.to_string(), count.parse().ok()?))
    });
    (count, lines.collect())
}

/// Descriptions whose blocks are closed: each in double precision, every third one in single precision as well.
#[test]
fn groups_in_c_have_the_bits_of_mechanisms_alone() {
    let names = representatives(true);
    let single: Vec<String> = names.iter().step_by(3).cloned().collect();
    let compiled = Compiled {
        compiler: compilers()[0],
        options: &["-O0"],
    };
    let (mut mechanisms, mut counts) = (0, BTreeMap::<String, usize>::new());
    for (names, scalar) in [(&names, SCALARS[0]), (&single, SCALARS[1])] {
        let place = folder(&format!("lanes/{}", scalar.0));
        let (count, printed) = compared(&place, names, scalar, compiled);
        mechanisms += count;
        for (status, count) in printed {
            *counts.entry(status).or_default() += count;
        }
    }
    println!("{mechanisms} mechanisms: {counts:?}");
    // Otherwise nothing would have been tested: frames, and the kinds of failure of such mechanisms.
    assert!(
        mechanisms > 30 && counts["solved"] > 15_000,
        "{mechanisms} {counts:?}"
    );
    assert!(counts.len() >= 10, "{counts:?}");
    assert!(
        counts.contains_key("a value is outside of its range"),
        "{counts:?}"
    );
}

/// Vectorized loops for the processor of this machine have the bits of mechanisms alone.
#[test]
fn vectorized_groups_in_c_have_the_same_bits() {
    let names = VECTORIZED.map(str::to_string);
    let native: &[&str] = match cfg!(target_arch = "x86_64") {
        true => &[
            "-O3",
            "-march=native",
            "-fno-math-errno",
            "-fno-trapping-math",
        ],
        false => &["-O3", "-fno-math-errno", "-fno-trapping-math"],
    };
    for (place, compiler) in compilers().iter().enumerate() {
        let compiled = Compiled {
            compiler,
            options: native,
        };
        let scalar = SCALARS[place % 2];
        let folder = folder(&format!("lanes/{compiler}"));
        let (count, printed) = compared(&folder, &names, scalar, compiled);
        assert_eq!(count, names.len(), "{compiler}");
        assert!(printed["solved"] > 2_000, "{compiler}: {printed:?}");
    }
}

/// Numbers of packed and of single floating-point operations in functions of lanes, by the listing of a file.
#[cfg(target_arch = "x86_64")]
fn operations(listing: &str) -> [usize; 2] {
    let mut is_in_lanes = false;
    let mut counts = [0; 2];
    for line in listing.lines() {
        if let Some((label, _)) = line.split_once(':')
            && !line.starts_with(['\t', ' ', '.', '#'])
        {
            is_in_lanes = label.contains("solve_lanes");
        }
        let operation = line.split_whitespace().next().unwrap_or_default();
        let operation = operation.strip_prefix('v').unwrap_or(operation);
        let Some(kind) = ["add", "sub", "mul", "div", "sqrt"]
            .iter()
            .find_map(|it| operation.strip_prefix(it))
        else {
            continue;
        };
        if is_in_lanes {
            match kind {
                "pd" | "ps" => counts[0] += 1,
                "sd" | "ss" => counts[1] += 1,
                _ => {}
            }
        }
    }
    counts
}

/// More than half of the arithmetic of lanes is packed, and none of it fused where the processor could.
#[cfg(target_arch = "x86_64")]
#[test]
fn loops_over_lanes_are_vectorized() {
    for compiler in compilers() {
        for name in ["four_bar", "excavator"] {
            for (suffix, scalar) in SCALARS {
                let place = folder("lanes/listings");
                let stem = format!("{name}_{suffix}");
                written(&place, name, &stem, scalar).expect("closed forms");
                let listing = format!("{stem}_{compiler}.s");
                let mut command = Command::new(compiler);
                command.args(["-std=c99", "-O3", "-mavx2", "-mfma", "-ffp-contract=off"]);
                command.args(["-fno-math-errno", "-fno-trapping-math", "-S"]);
                command.args([&format!("{stem}.c"), "-o", &listing]);
                run(command.current_dir(&place)).unwrap_or_else(|error| panic!("{error}"));
                let text = fs::read_to_string(place.join(&listing)).expect("a listing");
                let is_fused = |line: &str| {
                    ["vfm", "vfnm"]
                        .iter()
                        .any(|it| line.trim_start().starts_with(it))
                };
                assert!(!text.lines().any(is_fused), "{stem} with {compiler}");
                let [packed, single] = operations(&text);
                println!(
                    "{stem} with {compiler}: {packed} packed operations, {single} single ones"
                );
                assert!(
                    packed > single && packed > 50,
                    "{stem} with {compiler}: {packed} {single}"
                );
            }
        }
    }
}

/// The program of the page prints the angles of the rocker that the triangle of its pins has.
#[test]
fn groups_of_the_guide_are_true() {
    let path = files::repository().join("codegen/guide/c.md");
    let page = fs::read_to_string(&path).expect("the page");
    let place = folder("lanes/guide");
    written(&place, "four_bar", "four_bar", Scalar::F64).expect("closed forms");
    fs::write(place.join("lanes.c"), block(&page, "`lanes.c`")).expect("written");
    compile(&place, &["four_bar", "linkwright", "lanes"]);
    let objects = ["four_bar", "linkwright", "lanes"].map(|it| format!("{it}-gcc.o"));
    let mut command = Command::new("gcc");
    command.args(objects).args(["-lm", "-o", "lanes"]);
    run(command.current_dir(&place)).unwrap_or_else(|error| panic!("{error}"));
    let output = Command::new(place.join("lanes")).output().expect("it runs");
    let printed = String::from_utf8(output.stdout).expect("text");
    let [first, last] = [1.0, 1.07].map(rocker);
    assert_eq!(printed, format!("{first:.6} {last:.6} rad\n"));
    let after = page.split_once("./lanes\n```\n").expect("the command").1;
    let documented = format!("```text\n{printed}```");
    if std::env::var_os("GUIDE_UPDATE").is_some() {
        let updated = page.replacen(&format!("```text\n{}```", block(after, "")), &documented, 1);
        fs::write(&path, updated).expect("written");
    } else {
        assert!(after.trim_start().starts_with(&documented), "{after}");
    }
}

/// Files with lanes are C++17 without a warning, for the host and as text for devices.
#[test]
fn groups_in_c_are_cpp() {
    let place = folder("lanes/cpp");
    for name in ["four_bar", "excavator", "crane", "table_of_file"] {
        written(&place, name, name, Scalar::F64).expect("closed forms");
        for function in ["-ULINKWRIGHT_FUNCTION", "-DLINKWRIGHT_FUNCTION="] {
            let mut command = Command::new("g++");
            command.args(["-std=c++17", "-x", "c++", "-fsyntax-only", function]);
            command.args(["-Wall", "-Wextra", "-Werror", &format!("{name}.c")]);
            run(command.current_dir(&place)).unwrap_or_else(|error| panic!("{error}"));
        }
    }
}
