//! Groups of mechanisms have the bits of the same mechanisms alone.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use linkwright_codegen::{Options, Scalar, generate};
use linkwright_tests::{description, files};

use crate::representatives::{representatives, target_of_modules};

/// Modules whose frames WebAssembly computes as well, with their numbers of lanes.
const HASHED: [(&str, usize); 3] = [
    ("four_bar_f64", 8),
    ("excavator_f64", 8),
    ("four_bar_f32", 16),
];

/// The package of modules with lanes: each in f64, every second one in f32 as well.
fn write(package: &Path) -> usize {
    let source = package.join("src");
    let (mut modules, mut calls, mut count) = (String::new(), String::new(), 0);
    let mut names = representatives(true);
    for name in ["four_bar", "excavator"] {
        if !names.iter().any(|it| it == name) {
            names.push(name.to_string());
        }
    }
    for (number, name) in names.iter().enumerate() {
        let described = description::source(name);
        let Ok(read) = linkwright_codegen::read(&described) else {
            continue;
        };
        let scalars = [(Scalar::F64, "f64"), (Scalar::F32, "f32")];
        for (scalar, suffix) in scalars {
            let module = format!("{name}_{suffix}");
            let is_hashed = HASHED.iter().any(|(hashed, _)| *hashed == module);
            if scalar == Scalar::F32 && number % 2 == 1 && !is_hashed {
                continue;
            }
            let options = Options {
                scalar,
                lanes: true,
                ..Options::default()
            };
            // Others have blocks of Newton-Raphson.
            let Ok(generated) = generate(&described, &options) else {
                continue;
            };
            // Frames of thousands of numbers cannot be printed.
            if !generated.code().contains("textbook!") {
                continue;
            }
            files::write_if_changed(&source.join(format!("{module}.rs")), generated.code())
                .expect("written");
            let _ = writeln!(modules, "#[allow(dead_code)]\nmod {module};");
            for derived in &read.motions {
                let motion = derived.system.mechanism.motion.as_ref();
                let path = motion.map_or(module.clone(), |it| format!("{module}::{}", it.name));
                let _ = writeln!(
                    calls,
                    "    compare::<{path}::Loops, {}>({path:?}, counted);",
                    scalar.lanes()
                );
            }
            count += 1;
        }
    }
    let path = files::package("webassembly/src/hash.rs");
    let hash = fs::read_to_string(path).expect("the function");
    files::write_if_changed(&source.join("hash.rs"), &hash).expect("written");
    for (module, lanes) in HASHED {
        let _ = writeln!(
            calls,
            "    println!(\"hash {module} {{:x}}\", hash::hash::<{module}::Loops, {lanes}>());"
        );
    }
    let text = format!(
        "#![allow(warnings)]\n{}\nfn all(counted: &mut Counted) {{\n{calls}    example::main().expect(\"poses\");\n}}\n\nmod example;\nmod hash;\n{modules}",
        include_str!("program.rs")
    );
    files::write_if_changed(&source.join("main.rs"), &text).expect("written");
    count
}

/// Angle of the rocker of `four_bar` at a time, from the law of cosines.
pub(super) fn rocker(t: f64) -> f64 {
    let crank = 40f64.to_radians() + 3.0 * t;
    let (x, y) = (0.04 * crank.cos() - 0.1, 0.04 * crank.sin());
    let distance = x.hypot(y);
    let inside =
        (0.08f64.powi(2) + distance * distance - 0.12f64.powi(2)) / (2.0 * 0.08 * distance);
    let angle = y.atan2(x) - inside.acos();
    // The rocker stays within half a turn of its design angle.
    angle + std::f64::consts::TAU * ((1.0 - angle) / std::f64::consts::TAU).round()
}

/// The program of the guide, as a module of the package.
fn write_example(package: &Path) {
    let page = files::repository().join("codegen/guide/crate.md");
    let page = fs::read_to_string(page).expect("the page");
    let section = page.split("## Eight at once").nth(1).expect("the section");
    let blocks: Vec<&str> = section.split("```rust\n").skip(1).collect();
    let [_, program, ..] = blocks[..] else {
        panic!("a build script and a program");
    };
    let program = program.split("```").next().expect("its end");
    let included = "linkwright::include_mechanism! {\n    mod four_bar;\n}\n";
    assert!(program.contains(included), "{program}");
    let program = program.replace(included, "use super::four_bar_f64 as four_bar;\n");
    let program = program.replace("fn main()", "pub fn main()");
    files::write_if_changed(&package.join("src/example.rs"), &program).expect("written");
}

#[test]
fn groups_have_the_bits_of_mechanisms_alone() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("lanes");
    fs::create_dir_all(folder.join("package/src")).expect("a folder");
    let package = folder.join("package");
    let modules = write(&package);
    write_example(&package);
    let runtime = files::repository().join("runtime");
    let manifest = format!(
        "[package]\nname = \"in_lanes\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[workspace]\n\n[profile.dev]\ndebug = false\n\n[dependencies]\nlinkwright = {{ path = {runtime:?}, features = [\"std\"] }}\n"
    );
    files::write_if_changed(&package.join("Cargo.toml"), &manifest).expect("written");
    fs::copy(
        files::repository().join("Cargo.lock"),
        package.join("Cargo.lock"),
    )
    .expect("copied");
    let output = Command::new("cargo")
        .args(["run", "--quiet", "--offline", "--target-dir"])
        .arg(target_of_modules())
        .current_dir(&package)
        .output()
        .expect("cargo runs");
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        output.status.success(),
        "{}\n{}",
        printed,
        String::from_utf8_lossy(&output.stderr)
    );
    println!("{modules} modules\n{printed}");
    // The part `webassembly` of `.ci/run` compares its hashes with this snapshot.
    let hashes = printed
        .lines()
        .filter_map(|line| line.strip_prefix("hash "));
    let hashes: Vec<&str> = hashes.collect();
    assert!(
        hashes.len() == 3 && hashes.iter().all(|it| !it.ends_with(" 0")),
        "a lane fails: {hashes:?}"
    );
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(files::package("snapshots/lanes"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!("hashes", hashes.join("\n")));
    let counts: BTreeMap<&str, usize> = printed
        .lines()
        .filter_map(|line| {
            let (name, count) = line.split_once(' ')?;
            Some((name, count.parse().ok()?))
        })
        .collect();
    // The rocker at 1 s, and at 1.07 s, from the triangle of its pins.
    let [first, last] = [1.0, 1.07].map(rocker);
    assert!(
        printed.contains(&format!("{first:.6} {last:.6}\n")),
        "{printed}"
    );
    // Otherwise nothing would have been tested: frames, and the kinds of failure of such mechanisms.
    assert!(
        modules > 30 && counts["frames"] > 20_000,
        "{modules} {counts:?}"
    );
    for kind in [
        "LoadNotFinite",
        "NotFinite",
        "NotPositive",
        "OutOfReach",
        "OutsideRange",
        "Singular",
        "StepTooLarge",
        "Undecided",
    ] {
        assert!(counts.contains_key(kind), "no {kind} in {counts:?}");
    }
}
