//! Generated C has the bits of generated Rust, compiles without a warning, and is what its page says.

mod accepted;
mod bits;
mod device;
mod guide;
mod lanes;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Language, Options, Scalar, generate};
use linkwright_tests::c::run::{FLAGS, compilers, run, runtime_object};
use linkwright_tests::description;

/// Descriptions that only tests need: parameters, inputs, tables, laws, cams, transmissions, sensitivities, forces, single outputs, lengths
/// that must be positive, unguarded and redundant ones.
const SMALL: [&str; 39] = [
    "angle_and_slot",
    "asked",
    "both_ways",
    "cam_law",
    "cam_param",
    "cam_roller",
    "coupled_wheels",
    "crane",
    "ellipse",
    "endless_loads",
    "folding",
    "forced_linkage",
    "forced_platform",
    "forced_slider",
    "free_linkage",
    "hauled",
    "laws",
    "motion_parameters",
    "parallelogram",
    "parallelogram_unguarded",
    "pieces",
    "periodic_from_elsewhere",
    "platform_given",
    "sensed_crane",
    "sensed_gears",
    "sensed_outputs",
    "sensed_platform",
    "shared_cranks",
    "shared_rails",
    "sleeve_given",
    "sliders_given",
    "table_of_file",
    "tables",
    "three_cranks",
    "toothed_planetary",
    "torn_by_angles",
    "transmitted",
    "weighed_given",
    "winch",
];

/// A folder of its own.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c").join(name);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Writes the C files of a description, called `stem`.
fn write(folder: &Path, source: &Source, stem: &str, scalar: Scalar) {
    let options = Options {
        language: Language::C,
        scalar,
        stem: Some(stem.to_string()),
        ..Options::default()
    };
    let generated = generate(source, &options);
    let generated = generated.unwrap_or_else(|found| panic!("{}", found.render(source)));
    for file in generated.files {
        fs::write(folder.join(file.name), file.text).expect("written");
    }
}

/// Writes the C files of a description of the repository, in double precision, called after it.
fn write_double(folder: &Path, name: &str) {
    write(folder, &description::source(name), name, Scalar::F64);
}

/// Compiles files of a folder to objects with every compiler of C; the object of the runtime is shared.
fn compile(folder: &Path, names: &[&str]) {
    for compiler in compilers() {
        for name in names {
            if *name == "linkwright" {
                let object = folder.join(format!("linkwright-{compiler}.o"));
                fs::copy(runtime_object(compiler), object).expect("copied");
                continue;
            }
            let mut command = Command::new(compiler);
            command.args(FLAGS).arg("-c").arg(format!("{name}.c"));
            let object = format!("{name}-{compiler}.o");
            let compiled = run(command.args(["-o", &object]).current_dir(folder));
            compiled.unwrap_or_else(|error| panic!("{error}"));
        }
    }
}

/// Compiles a program of C++ with objects of C, and gives what it prints.
fn run_as_cpp(folder: &Path, program: &str, objects: &[&str]) -> String {
    let objects: Vec<String> = objects.iter().map(|it| format!("{it}-gcc.o")).collect();
    let mut command = Command::new("g++");
    command.args([
        "-std=c++11",
        "-Wall",
        "-Wextra",
        "-Wpedantic",
        "-Werror",
        program,
    ]);
    command
        .args(&objects)
        .args(["-lm", "-o", "program"])
        .current_dir(folder);
    run(&mut command).unwrap_or_else(|error| panic!("{error}"));
    let output = Command::new(folder.join("program"))
        .output()
        .expect("it runs");
    assert!(output.status.success(), "{output:?}");
    String::from_utf8(output.stdout).expect("text")
}
