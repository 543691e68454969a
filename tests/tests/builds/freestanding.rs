//! The runtime and every generated mechanism as a static library without std: no panic path, no allocator, nothing of
//! the standard library.
//!
//! The library's panic handler calls the symbol `PANIC_PATH`, which is never defined. `nm` lists all symbols that the
//! library needs from outside as undefined.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};

use linkwright_codegen::Options;
use linkwright_codegen::stages::emit::rust::type_name;
use linkwright_tests::{description, files};

/// Functions that the compiler itself may call, also on a microcontroller: copying, filling and comparing memory.
const ALLOWED: [&str; 5] = ["memcpy", "memmove", "memset", "memcmp", "bcmp"];

/// Only one build at a time: all of them write the library to the same path.
static BUILDING: Mutex<()> = Mutex::new(());

/// Descriptions that only tests need, whose modules are in the library.
const SMALL: [&str; 5] = [
    "four_bar_given",
    "platform_given",
    "slider_given",
    "forced_platform",
    "tables",
];

/// Writes the modules that the library includes and, of the gallery, the list of them and the functions that move them; gives the folder.
fn modules() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("freestanding_modules");
    fs::create_dir_all(&folder).expect("a folder");
    let write = |name: &str, text: &str| {
        files::write_if_changed(&folder.join(name).with_extension("rs"), text).expect("written");
    };
    let gallery = description::names();
    for name in gallery.iter().map(String::as_str).chain(SMALL) {
        let source = description::source(name);
        let generated = linkwright_codegen::generate(&source, &Options::default())
            .unwrap_or_else(|found| panic!("{}", found.render(&source)));
        write(name, generated.code());
    }
    let listed = |name: &String| {
        format!("pub mod {name} {{\n    linkwright::include_mechanism!({name});\n}}\n")
    };
    write("gallery", &gallery.iter().map(listed).collect::<String>());
    let moved = description::whole().into_iter().map(|name| {
        let (module, mechanism) = (format!("gallery::{name}"), type_name(&name));
        format!(
            "/// See [`run`].\n#[unsafe(no_mangle)]\npub fn {name}(call: &mut Call<'_>) -> bool {{\n    run::<{module}::{mechanism}, {module}::Textbook, _>(call)\n}}\n"
        )
    });
    write("functions", &moved.collect::<String>());
    folder
}

/// Builds the library in release with these features and returns the path of a copy.
fn build(features: &str) -> PathBuf {
    let _building = BUILDING.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let target = folder.join("freestanding");
    let output = Command::new(env!("CARGO"))
        .args(["build", "--release", "--manifest-path"])
        .arg(files::package("freestanding/Cargo.toml"))
        .args(["--no-default-features", "--features", features])
        .arg("--target-dir")
        .arg(&target)
        .env("MODULES", modules())
        .output()
        .expect("cargo runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let copy = folder.join(format!("freestanding_{features}.a"));
    fs::copy(target.join("release/liblinkwright_freestanding.a"), &copy).expect("a copy");
    copy
}

/// The symbols that `nm` lists with this option: of all objects in the archive, or of those whose name starts with a prefix.
fn symbols(library: &Path, option: &str, object: &str) -> BTreeSet<String> {
    let output = Command::new("nm")
        .args([option, "--print-file-name"])
        .arg(library)
        .output()
        .expect("nm runs (binutils)");
    let listed = String::from_utf8(output.stdout).expect("names in UTF-8");
    let mut symbols = BTreeSet::new();
    // `archive:object:address kind symbol`
    for line in listed.lines() {
        let member = line.rsplit_once(".a:").map(|(_, member)| member);
        if member.is_some_and(|member| member.starts_with(object)) {
            symbols.extend(line.split_whitespace().last().map(str::to_string));
        }
    }
    assert!(
        !symbols.is_empty(),
        "nm lists nothing for {}",
        library.display()
    );
    symbols
}

fn is_allocator(symbol: &str) -> bool {
    let names = [
        "__rust_alloc",
        "__rust_realloc",
        "__rust_dealloc",
        "__rdl_",
        "__rg_",
        "handle_alloc_error",
    ];
    ["malloc", "calloc", "realloc", "free"].contains(&symbol)
        || names.iter().any(|name| symbol.contains(name))
}

#[test]
fn no_panic_path_and_no_allocator_survives_and_nothing_of_std_is_needed() {
    let library = build("generated");
    let undefined = symbols(&library, "--undefined-only", "");
    let defined = symbols(&library, "--defined-only", "");
    assert!(!undefined.contains("PANIC_PATH"), "a panic path survives");
    let allocators: Vec<&String> = undefined
        .union(&defined)
        .filter(|symbol| is_allocator(symbol))
        .collect();
    assert!(allocators.is_empty(), "{allocators:?}");
    // The other objects are compiler_builtins, which cargo adds to every static library.
    let undefined = symbols(&library, "--undefined-only", "linkwright_freestanding-");
    let needed: Vec<&String> = undefined
        .iter()
        .filter(|symbol| !ALLOWED.contains(&symbol.as_str()))
        .collect();
    assert!(needed.is_empty(), "the library needs {needed:?}");
    for name in description::names()
        .into_iter()
        .chain(SMALL.map(String::from))
    {
        assert!(defined.contains(&name), "{name} is not in the library");
    }
    println!("undefined: {undefined:?}");
}

#[test]
fn a_planted_panic_is_found() {
    // Without the mechanisms: the library with them has no panic path, so that the library without them has only the planted one.
    assert!(symbols(&build("planted"), "--undefined-only", "").contains("PANIC_PATH"));
}
