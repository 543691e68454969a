//! Generated C has the bits of generated Rust, compiles without a warning, and is what its page says.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Language, Options, Scalar, generate, generate_files};
use linkwright_tests::c::case::{Case, SCALARS};
use linkwright_tests::c::run::{FLAGS, compilers, differences, run};
use linkwright_tests::hunt::mechanism;
use linkwright_tests::pantograph::Pantograph;
use linkwright_tests::{description, files};

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

/// Those in which fused operations are looked for, as different as descriptions can be: the pragma that prevents them is one for all.
const VECTORIZED: [&str; 7] = [
    "andrews",
    "cam_roller",
    "excavator",
    "forced_platform",
    "platform_3rpr",
    "sensed_crane",
    "shared_rails",
];

/// How many random mechanisms are looked at, of how many bodies, and from which seed.
const RANDOM: usize = 8;
const LARGEST: usize = 10;
const SEED: u64 = 14;

/// A folder of its own.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c").join(name);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Writes the C files of a description, called `stem`.
fn write(folder: &Path, source: &Source, stem: &str, scalar: Scalar) {
    let options = Options {
        scalar,
        ..Options::default()
    };
    let generated = generate_files(source, Language::C, stem, &options);
    let generated = generated.unwrap_or_else(|found| panic!("{}", found.render(source)));
    for file in generated.files {
        fs::write(folder.join(file.name), file.text).expect("written");
    }
}

/// Compiles files of a folder to objects with every compiler of C.
fn compile(folder: &Path, names: &[&str]) {
    for compiler in compilers() {
        for name in names {
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

#[test]
fn frames_and_failures_have_the_bits_of_rust() {
    let named = |name: &str| Case::new(name, description::source(name), 2.0);
    let names = description::names();
    let names = names.iter().map(String::as_str).chain(SMALL);
    // Some have more joints than determine anything.
    let random = (0..)
        .map(|number| Source::new("found.mech", mechanism(SEED, number, LARGEST).text()))
        .filter(|source| generate(source).is_ok())
        .take(RANDOM)
        .enumerate()
        .map(|(number, source)| Case::new(&format!("found_{number}"), source, 2.0));
    // Cells enough that its path is shown cell by cell.
    let chain = Pantograph::new(9, 0.875).text("");
    let chain = Case::new("chain", Source::new("chain.mech", chain), 2.0);
    let cases: Vec<Case> = names.map(named).chain(random).chain([chain]).collect();
    assert!(cases.len() > 45 && !compilers().is_empty());
    let folder = folder("bits");
    let found = differences(&folder, &files::repository(), &cases);
    let found = found.unwrap_or_else(|error| panic!("{error}"));
    assert!(found.is_empty(), "{}", found.join("\n"));
    // Otherwise nothing would have been looked at: frames, and the kinds of failure that mechanisms like these have.
    let (mut frames, mut failures) = (0, std::collections::BTreeMap::new());
    for path in files::with_extension(&folder.join("answers"), "rust") {
        let text = fs::read_to_string(&path).expect("answers");
        frames += text.lines().filter(|line| line.starts_with("ok ")).count();
        for line in text.lines().filter(|line| line.starts_with("no ")) {
            let status = line.split(' ').nth(1).expect("a status").to_string();
            *failures.entry(status).or_insert(0) += 1;
        }
    }
    println!(
        "{} descriptions, {frames} frames, failures by status: {failures:?}",
        cases.len()
    );
    assert!(frames > 10_000, "{frames}");
    for status in ["1", "6", "7", "8", "9", "10", "12"] {
        assert!(failures.contains_key(status), "no {status} in {failures:?}");
    }
}

/// C names the load that is not finite, by its place in the table that it has of them.
#[test]
fn a_load_that_is_not_finite_is_named() {
    let place = folder("loads");
    write(
        &place,
        &description::source("endless_loads"),
        "endless_loads",
        Scalar::F64,
    );
    compile(&place, &["endless_loads", "linkwright"]);
    let text = "#include \"endless_loads.h\"\n#include <cstdio>\n
int main()
{
    static EndlessLoads it;
    EndlessLoadsInputs inputs = ENDLESS_LOADS_INITIAL;
    (void)endless_loads_assemble(&it, 0.0, &inputs);
    const double times[4] = {0.5, 0.75, 1.0, 1.25};
    for (int k = 0; k < 4; k++) {
        inputs.gap.value = (k == 3) ? 0.0 : 0.25;
        const linkwright_status status = endless_loads_advance(&it, times[k], &inputs);
        const char *load = (status == LINKWRIGHT_LOAD_NOT_FINITE) ? ENDLESS_LOADS_LOADS[it.failure.column] : \"none\";
        std::printf(\"%d %d %g %s\\n\", (int)status, (int)it.failure.block, (double)it.failure.time, load);
    }
    return 0;
}
";
    fs::write(place.join("loads.cpp"), text).expect("written");
    let printed = run_as_cpp(&place, "loads.cpp", &["endless_loads", "linkwright"]);
    let expected = "12 1 0.5 torque on crank
0 0 0.75 none
12 1 1 torque on wheel
12 1 1.25 force on crank.P
";
    assert_eq!(printed, expected);
}

/// All arguments in f32 of some sizes, and dense samples in f64: the same results as those of `linkwright_math`.
#[test]
fn elementary_functions_have_the_bits_of_rust() {
    let place = folder("math");
    write(
        &place,
        &description::source("two_body"),
        "two_body",
        Scalar::F64,
    );
    compile(&place, &["linkwright"]);
    let program = include_str!("../../src/c/elementary.c");
    fs::write(place.join("elementary.c"), program).expect("written");
    for compiler in compilers() {
        let mut command = Command::new(compiler);
        let object = format!("linkwright-{compiler}.o");
        command.args([
            "-std=c99",
            "-O2",
            "elementary.c",
            &object,
            "-lm",
            "-o",
            "elementary",
        ]);
        run(command.current_dir(&place)).unwrap_or_else(|error| panic!("{error}"));
        let output = Command::new(place.join("elementary"))
            .output()
            .expect("it runs");
        let printed = String::from_utf8(output.stdout).expect("text");
        let expected = linkwright_tests::c::elementary::digests();
        let expected = expected.map(|digest| format!("{digest:016x}\n")).concat();
        assert_eq!(printed, expected, "{compiler}");
    }
}

/// Every file is ASCII, compiles without a warning as C99 and as C++17, and has no fused operation where the processor has them.
#[test]
fn other_compilers_take_it_and_fuse_nothing() {
    let place = folder("accepted");
    let names = description::names();
    let names = names.iter().map(String::as_str).chain(SMALL);
    let (mut files, mut vectors) = (0, 0);
    for name in names {
        write(&place, &description::source(name), name, Scalar::F64);
        for file in [format!("{name}.c"), format!("{name}.h")] {
            let text = fs::read_to_string(place.join(&file)).expect("written");
            assert!(text.is_ascii(), "{file}");
        }
        accepted(&place, name);
        files += 1;
    }
    for name in VECTORIZED {
        vectors += fused_nothing(&place, name);
    }
    accepted(&place, "linkwright");
    vectors += fused_nothing(&place, "linkwright");
    for file in ["linkwright.c", "linkwright.h"] {
        let text = fs::read_to_string(place.join(file)).expect("written");
        assert!(text.is_ascii(), "{file}");
    }
    assert!(files > 50, "{files}");
    // Otherwise the code would not be for a processor with fused operations.
    assert!(vectors > 1000 || !cfg!(target_arch = "x86_64"), "{vectors}");
}

/// Compiles a file as C++17.
fn accepted(folder: &Path, name: &str) {
    let file = format!("{name}.c");
    let mut command = Command::new("g++");
    command.args(["-std=c++17", "-x", "c++", "-fsyntax-only", "-Werror", &file]);
    run(command.current_dir(folder)).unwrap_or_else(|error| panic!("{error}"));
}

/// Compiles a file for processors with fused operations, of which none may be in it; the number of operations on vectors.
fn fused_nothing(folder: &Path, name: &str) -> usize {
    if !cfg!(target_arch = "x86_64") {
        return 0;
    }
    let mut vectors = 0;
    for options in [
        ["-std=c99", "-O2", "-mfma"],
        ["-std=c99", "-O3", "-march=haswell"],
        ["-std=c99", "-O2", "-march=native"],
    ] {
        for compiler in compilers() {
            let mut command = Command::new(compiler);
            command.args(options).args(["-S", &format!("{name}.c")]);
            let listing = format!("{name}.s");
            run(command.args(["-o", &listing]).current_dir(folder))
                .unwrap_or_else(|error| panic!("{error}"));
            let text = fs::read_to_string(folder.join(listing)).expect("a listing");
            let operations = text
                .lines()
                .filter_map(|line| line.split_whitespace().next());
            for operation in operations {
                let is_fused = [
                    "vfmadd",
                    "vfmsub",
                    "vfnmadd",
                    "vfnmsub",
                    "vfmaddsub",
                    "vfmsubadd",
                ]
                .iter()
                .any(|it| operation.starts_with(it));
                assert!(!is_fused, "{name} with {compiler} {options:?}: {operation}");
                vectors += usize::from(operation.starts_with("vmul"));
            }
        }
    }
    vectors
}

/// A program of C++ in which all mechanisms of the gallery are linked, in both scalars.
#[test]
fn mechanisms_of_both_scalars_are_one_program_of_cpp() {
    let place = folder("together");
    let (mut includes, mut calls, mut objects) =
        (String::new(), String::new(), vec!["linkwright".to_string()]);
    for (name, (_, scalar)) in ["four_bar", "excavator", "platform_3rpr", "arm"]
        .into_iter()
        .zip(SCALARS.iter().cycle())
    {
        write(&place, &description::source(name), name, *scalar);
        includes += &format!("#include \"{name}.h\"\n");
        let type_name = linkwright_codegen::stages::emit::rust::type_name(name);
        calls += &format!(
            "    {{\n        static {type_name} it;\n        std::printf(\"%d\", static_cast<int>({name}_assemble(&it, 0.0)));\n        std::printf(\"%d\", static_cast<int>({name}_advance(&it, 0.1F)));\n    }}\n"
        );
        objects.push(name.to_string());
    }
    let text = format!(
        "{includes}{includes}#include <cstdio>\n\nint main()\n{{\n{calls}    return 0;\n}}\n"
    );
    fs::write(place.join("together.cpp"), text).expect("written");
    let objects: Vec<&str> = objects.iter().map(String::as_str).collect();
    compile(&place, &objects);
    assert_eq!(run_as_cpp(&place, "together.cpp", &objects), "00000000");
}

/// Words of C and C++, macros and functions of the standard headers: as bodies, points, parameters, inputs, joints, drivers, tables.
#[test]
fn hostile_names_are_compiled() {
    let place = folder("names");
    let text = "mechanism signal {
        param int = 100mm;
        param errno = 30mm;
        param I = 20mm;
        param sqrt = 250mm;
        input double = 0;
        input stdin = 0;
        point NULL = (0, 0), main = (0.3, 0), register = (0.1, 0);
        body float at (0, 0) { NULL, typedef: (errno, 0) }
        body class at (0.03, 0) { typedef: (0, 0), while: (sqrt, 0), I: (I, int) }
        body near at (0.3, 0) { main, while: (0, 0.2) }
        revolute assert(ground.NULL, float.NULL);
        revolute exp(float.typedef, class.typedef);
        revolute switch(class.while, near.while);
        revolute phi_q(ground.main, near.main);
        drive sizeof: phi(float) = double + 0*stdin;
    }";
    let source = Source::new("names.mech", text);
    for (name, scalar) in SCALARS {
        write(&place, &source, &format!("names_{name}"), scalar);
        compile(&place, &[&format!("names_{name}"), "linkwright"]);
        let program = format!(
            "#include <cerrno>\n#include <cmath>\n#include <complex.h>\n#include <csignal>\n#include <cstdio>\n#include <cassert>\n#include \"names_{name}.h\"\n\nint main()\n{{\n    static Signal it;\n    return static_cast<int>(signal_assemble(&it, 0, &SIGNAL_INITIAL));\n}}\n"
        );
        fs::write(place.join("names.cpp"), program).expect("written");
        run_as_cpp(
            &place,
            "names.cpp",
            &[&format!("names_{name}"), "linkwright"],
        );
    }
}

#[test]
fn a_type_that_c_has_already_is_refused() {
    let description = |name: &str| {
        format!(
            "mechanism {name} {{
                point O = (0, 0);
                body c at (0, 0) {{ O }}
                revolute O(ground, c);
                drive phi(c) = t;
            }}"
        )
    };
    for name in ["i", "NULL", "I"] {
        let source = Source::new("named.mech", description(name));
        let generated = generate_files(&source, Language::C, "named", &Options::default());
        let found = generated.expect_err("the name is refused");
        let text = found.render(&source);
        assert!(
            text.contains("error[K10]") && text.contains("named.mech:1:11"),
            "{text}"
        );
    }
}

#[test]
fn files_of_other_versions_and_fast_math_are_refused() {
    let place = folder("refused");
    write(
        &place,
        &description::source("four_bar"),
        "four_bar",
        Scalar::F64,
    );
    let refused = |flags: &[&str]| {
        let mut command = Command::new("gcc");
        command
            .args(FLAGS)
            .args(flags)
            .args(["-c", "four_bar.c", "-o", "four_bar.o"]);
        let error = run(command.current_dir(&place)).expect_err("it is refused");
        error.to_string()
    };
    assert!(
        refused(&["-ffast-math"]).contains("compile it without it")
            || refused(&["-ffast-math"]).contains("-ffast-math")
    );
    let header = fs::read_to_string(place.join("linkwright.h")).expect("the header");
    let version = header
        .lines()
        .find(|line| line.starts_with("#define LINKWRIGHT_VERSION "));
    let other = header.replace(
        version.expect("a version"),
        "#define LINKWRIGHT_VERSION 999999",
    );
    fs::write(place.join("linkwright.h"), other).expect("written");
    assert!(refused(&[]).contains("different generators"));
}

/// The blocks of a page, by the name in backticks before them, or else by their marks.
fn block<'a>(page: &'a str, before: &str) -> &'a str {
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
    write(
        &place,
        &description::source("excavator"),
        "excavator",
        Scalar::F64,
    );
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
    let said = block(after, "");
    if printed != said && std::env::var_os("GUIDE_UPDATE").is_some() {
        let updated = page.replacen(
            &format!("```text\n{said}```"),
            &format!("```text\n{printed}```"),
            1,
        );
        fs::write(&path, updated).expect("written");
    } else {
        assert_eq!(printed, said, "{expected}");
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
    write(
        &place,
        &description::source("two_body"),
        "two_body",
        Scalar::F64,
    );
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
