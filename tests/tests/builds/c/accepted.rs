//! Compilers of C and C++ take generated files as they are, and refuse what does not fit together.

use std::fs;
use std::path::Path;
use std::process::Command;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Language, Options, Scalar, generate};
use linkwright_tests::c::case::SCALARS;
use linkwright_tests::c::run::{FLAGS, compilers, run};
use linkwright_tests::description;
use linkwright_tests::random::cases;

use super::{SMALL, compile, folder, run_as_cpp, write, write_double};
use crate::representatives::representatives;

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

/// Every file is ASCII; representatives compile without a warning as C++17, and have no fused operation where the processor has them.
#[test]
fn other_compilers_take_it_and_fuse_nothing() {
    let place = folder("accepted");
    let names = description::names();
    let names = names.iter().map(String::as_str).chain(SMALL);
    let compiled = representatives(false);
    let (mut files, mut vectors) = (0, 0);
    for name in names {
        write(&place, &description::source(name), name, Scalar::F64);
        for file in [format!("{name}.c"), format!("{name}.h")] {
            let text = fs::read_to_string(place.join(&file)).expect("written");
            assert!(text.is_ascii(), "{file}");
        }
        files += 1;
    }
    for (number, name) in compiled.iter().enumerate() {
        write(&place, &description::source(name), name, Scalar::F64);
        // The text for devices of every second one.
        let functions = ["-ULINKWRIGHT_FUNCTION", "-DLINKWRIGHT_FUNCTION="];
        accepted(&place, name, functions[number % 2]);
    }
    for (number, name) in VECTORIZED.into_iter().enumerate() {
        vectors += fused_nothing(&place, name, number);
    }
    accepted(&place, "linkwright", "-ULINKWRIGHT_FUNCTION");
    accepted(&place, "linkwright", "-DLINKWRIGHT_FUNCTION=");
    // Each compiler once, as the modules have all options; more cases are all options with all compilers.
    for number in 0..(2 * cases(1) as usize).min(6) {
        vectors += fused_nothing(&place, "linkwright", number);
    }
    for file in ["linkwright.c", "linkwright.h"] {
        let text = fs::read_to_string(place.join(file)).expect("written");
        assert!(text.is_ascii(), "{file}");
    }
    println!("{files} files, {vectors} operations on vectors");
    assert!(files > 50 && compiled.len() > 30, "{files}");
    // Otherwise the code would not be for a processor with fused operations.
    assert!(vectors > 1000 || !cfg!(target_arch = "x86_64"), "{vectors}");
}

/// Compiles a file as C++17, with this option for its functions.
fn accepted(folder: &Path, name: &str, function: &str) {
    let file = format!("{name}.c");
    let mut command = Command::new("g++");
    command.args(["-std=c++17", "-x", "c++", "-fsyntax-only", function]);
    command.args(["-Wall", "-Wextra", "-Werror", &file]);
    run(command.current_dir(folder)).unwrap_or_else(|error| panic!("{error}"));
}

/// Compiles a file for processors with fused operations, of which none may be in it; the number of operations on vectors. The number of
/// the file selects the compiler and its options.
fn fused_nothing(folder: &Path, name: &str, number: usize) -> usize {
    if !cfg!(target_arch = "x86_64") {
        return 0;
    }
    let options = [
        ["-std=c99", "-O2", "-mfma"],
        ["-std=c99", "-O3", "-march=haswell"],
        ["-std=c99", "-O2", "-march=native"],
    ];
    let options = options[number % options.len()];
    let compiler = compilers()[number % compilers().len()];
    let mut command = Command::new(compiler);
    command.args(options).args(["-S", &format!("{name}.c")]);
    let listing = format!("{name}.s");
    run(command.args(["-o", &listing]).current_dir(folder))
        .unwrap_or_else(|error| panic!("{error}"));
    let text = fs::read_to_string(folder.join(listing)).expect("a listing");
    let operations = text
        .lines()
        .filter_map(|line| line.split_whitespace().next());
    let mut vectors = 0;
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
        let generated = generate(
            &source,
            &Options {
                language: Language::C,
                ..Options::default()
            },
        );
        let findings = generated.expect_err("the name is refused");
        let text = findings.render(&source);
        assert!(
            text.contains("error[K10]") && text.contains("named.mech:1:11"),
            "{text}"
        );
    }
}

#[test]
fn files_of_other_versions_and_fast_math_are_refused() {
    let place = folder("refused");
    write_double(&place, "four_bar");
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
