//! Generated C is device code of CUDA: clang compiles it to PTX, without a GPU and without CUDA's headers.
//!
//! Clang refuses calls of host functions, and host variables that a device does not see, in functions for both sides.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use linkwright_codegen::Scalar;
use linkwright_codegen::diagnostic::Source;
use linkwright_tests::c::device::{Kernel, kernels, moved};
use linkwright_tests::c::run::run;
use linkwright_tests::{description, files};

use super::guide::block;
use super::{folder, write};

/// Declarations of CUDA, for clang without CUDA's headers.
const DECLARATIONS: &str = include_str!("../../../src/c/device.h");

/// Mechanisms that move in closed form, by Newton-Raphson, through change points and along tables.
const MOVED: [&str; 4] = ["cam_dwell", "four_bar", "pantograph", "platform_3rpr"];

/// Compiles a kernel of a folder to PTX that calls only its own functions and fuses nothing.
fn ptx(folder: &Path, kernel: &str, optimization: &str) -> String {
    let listing = compiled(folder, kernel, optimization);
    let listing = listing.unwrap_or_else(|error| panic!("{error}"));
    assert!(!listing.contains(".extern"), "{kernel}: unresolved names");
    assert!(!listing.contains("fma."), "{kernel}: fused operations");
    listing
}

/// PTX of a kernel, or the errors of the compiler.
fn compiled(folder: &Path, kernel: &str, optimization: &str) -> Result<String, String> {
    fs::write(folder.join("device.h"), DECLARATIONS).expect("written");
    let mut command = Command::new("clang++");
    command
        .args(["-x", "cuda", "--cuda-device-only", "--cuda-gpu-arch=sm_70"])
        .args(["-nocudainc", "-nocudalib", "-include", "device.h"])
        .args(["-std=c++17", "-ffp-contract=off", optimization])
        .args(["-Wall", "-Wextra", "-Werror", "-S", kernel, "-o", "-"])
        .current_dir(folder);
    let output = command.output().expect("clang is installed");
    let text = |it: Vec<u8>| String::from_utf8(it).expect("text");
    let (listing, errors) = (text(output.stdout), text(output.stderr));
    match output.status.success() {
        true => Ok(listing),
        false => Err(errors),
    }
}

/// One process for each mechanism, and two at a time.
#[test]
fn every_mechanism_is_device_code() {
    let names = description::names();
    let (next, count) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let compile_all = || {
        while let Some(name) = names.get(next.fetch_add(1, Ordering::Relaxed)) {
            let (place, source) = (folder(&format!("device/{name}")), description::source(name));
            write(&place, &source, name, Scalar::F64);
            let header = fs::read_to_string(place.join(format!("{name}.h"))).expect("written");
            let written = kernels(&source, &header);
            let texts: String = written.iter().map(|it| it.text.as_str()).collect();
            let text = format!(
                "#define LINKWRIGHT_FUNCTION __host__ __device__\n#include \"linkwright.c\"\n#include \"{name}.c\"\n{texts}"
            );
            fs::write(place.join("kernel.cu"), text).expect("written");
            let listing = ptx(&place, "kernel.cu", "-O0");
            for Kernel { entry, .. } in &written {
                assert!(
                    listing.contains(&format!(".visible .entry {entry}(")),
                    "{name}"
                );
                count.fetch_add(1, Ordering::Relaxed);
            }
        }
    };
    thread::scope(|scope| {
        scope.spawn(compile_all);
        scope.spawn(compile_all);
    });
    assert!(names.len() > 20 && count.into_inner() > names.len());
}

/// The kernel of the page is compiled as it stands there.
#[test]
fn the_kernel_of_the_guide_is_device_code() {
    let path = files::repository().join("codegen/guide/device.md");
    let page = fs::read_to_string(path).expect("the page");
    let place = folder("device/guide");
    let source = Source::new("linkage.mech", block(&page, "`linkage.mech`"));
    write(&place, &source, "linkage", Scalar::F64);
    fs::write(place.join("sweep.cu"), block(&page, "`sweep.cu`")).expect("written");
    let listing = ptx(&place, "sweep.cu", "-O2");
    assert_eq!(listing.matches(".visible .entry ").count(), 1);
    assert!(listing.contains("sqrt.rn.f64") && listing.contains("div.rn.f64"));
}

/// A mistake in device code is found: a table of the host, a function of the host.
#[test]
fn code_for_the_host_alone_is_refused() {
    let place = folder("device/refused");
    for wrong in [
        "double lengths[2] = {1.0, 2.0};\n__device__ double of(int k) { return lengths[k]; }\n",
        "double twice(double x) { return 2.0 * x; }\n__device__ double of(double x) { return twice(x); }\n",
    ] {
        fs::write(place.join("wrong.cu"), wrong).expect("written");
        let error = compiled(&place, "wrong.cu", "-O0").expect_err("it is refused");
        assert!(error.contains("__host__"), "{wrong}{error}");
    }
}

/// The text for devices, compiled for the host, moves mechanisms with the bits of C99.
#[test]
fn text_for_devices_has_the_bits_of_c99() {
    for name in MOVED {
        let (place, source) = (
            folder(&format!("device/bits/{name}")),
            description::source(name),
        );
        write(&place, &source, name, Scalar::F64);
        let header = fs::read_to_string(place.join(format!("{name}.h"))).expect("written");
        fs::write(place.join("moved.c"), moved(name, &source, &header)).expect("written");
        let file = format!("{name}.c");
        let printed = |compiler: &str, options: &[&str]| {
            let mut command = Command::new(compiler);
            command.args(options).args(["-Wall", "-Wextra", "-Werror"]);
            command.args(["-x", if compiler == "g++" { "c++" } else { "c" }]);
            let command = command.args(["moved.c", &file, "linkwright.c", "-lm", "-o", "moved"]);
            run(command.current_dir(&place)).unwrap_or_else(|error| panic!("{error}"));
            let output = Command::new(place.join("moved")).output().expect("it runs");
            assert!(output.status.success(), "{name}: {output:?}");
            String::from_utf8(output.stdout).expect("text")
        };
        let plain = printed("gcc", &["-std=c99"]);
        assert!(plain.lines().count() > 100, "{name}: {plain}");
        assert_eq!(
            plain,
            printed("g++", &["-std=c++17", "-DLINKWRIGHT_FUNCTION="]),
            "{name}"
        );
    }
}
