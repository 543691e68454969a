//! Generated Rust is clean in a crate that denies warnings, and where it is a module of its own also those of `clippy::pedantic`.

use std::fs;
use std::path::Path;
use std::process::Command;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Options, generate};
use linkwright_tests::c::run::run;
use linkwright_tests::{description, files};

/// Names with capitals, underscores in all places, and words that Rust reserves in part, for all that generated code spells.
const SPELLED: &str = "mechanism spelled_names {
    param Rod_Length = 30cm;
    param a__p = 10cm;
    param _p = 5cm;
    input Signal__In = 0;
    input _s = 0;
    table Way__Of = [(0, 0), (1, 0.5), (2, 1)] natural;
    point A_ = (0, 0), _b = (30cm, 0), a__B = (10cm, 5cm), Self_ = (1, 1);
    body Crank at A_ { A_, P: (Rod_Length, 0), Q__R: (a__p, _p) }
    body _rod at _b { _b, T: (0.1, 0) }
    body a__b at a__B { a__B }
    body Self at Self_ { Self_ }
    revolute A_(ground, Crank);
    revolute _b(ground, _rod);
    revolute a__B(ground, a__b);
    revolute Self__(ground.Self_, Self.Self_);
    drive Main_Turn: phi(Crank) = Signal__In + Way__Of(t);
    drive _turn: phi(_rod) = 2*t + _s;
    drive a__turn: phi(a__b) = 3*t;
    drive Self: phi(Self) = t;
    mass Crank = 1kg at P;
    mass _rod = 1kg at T;
    gravity = (0, -9.81);
    effort;
    reactions;
    energy;
    sensitivity Rod_Length;
}";

/// Loops whose modes, blocks and motions are named with capitals and double underscores.
const LOOPED: &str = "mechanism looped_names {
    point A = (0, 0), D__ = (100mm, 0);
    body Crank at (0, 0, 40deg) { A: (0, 0), B: (40mm, 0) }
    body C__oupler at (30mm, 25mm, 20deg) { B: (0, 0), C: (120mm, 0) }
    body _Rocker at (100mm, 0, 57deg) { D__: (0, 0), C: (80mm, 0) }
    revolute A(ground, Crank);
    revolute B(Crank, C__oupler);
    revolute C(C__oupler, _Rocker);
    revolute D__(ground, _Rocker);
    motion fast__one { param Pace = 3; drive phi(Crank) = 40deg + Pace*t; }
    motion slow { drive phi(Crank) = 40deg + t; }
}";

/// A mass on an axis, of which only the height counts: nothing reads the cosine of the angle.
const ON_AXIS: &str = "mechanism on_axis {
    point A = (0, 0);
    body crank at (0, 0, 40deg) { A: (0, 0), B: (0.1, 0), E: (0, 0.1) }
    revolute A(ground, crank);
    drive phi(crank) = 40deg + t;
    mass crank = 2kg at B inertia 0.1;
    gravity = (0, -9.81);
    energy;
    output phi(crank);
}";

#[test]
fn every_name_and_every_shape_is_clean() {
    let package = Path::new(env!("CARGO_TARGET_TMPDIR")).join("lints");
    let source = package.join("src");
    fs::create_dir_all(&source).expect("a folder");
    let named = [SPELLED, LOOPED, ON_AXIS].iter().enumerate();
    let named = named.map(|(place, text)| (format!("named_{place}"), Source::new("a.mech", *text)));
    // The gallery is a package of its own, with lints of its own.
    let paths = files::with_extension(&files::package("descriptions"), "mech");
    let written = paths.iter().filter_map(|path| {
        let name = path.file_stem()?.to_str()?.to_string();
        let source = description::source(&name);
        Some((name, source))
    });
    // What a user of `include_mechanism!` has, as it is documented, and what `generate` writes into a crate without pedantry.
    let (mut library, mut count) = (
        String::from(
            "//! Modules.\n#![no_std]\n#![deny(warnings, missing_docs, clippy::pedantic)]\n",
        ),
        0,
    );
    for (name, description) in named.chain(written) {
        let Ok(generated) = generate(&description, &Options::default()) else {
            assert!(!name.starts_with("named"), "{name} is generated");
            continue;
        };
        let file = source.join(format!("{name}.rs"));
        files::write_if_changed(&file, generated.code()).expect("written");
        library += &format!(
            "#[allow(clippy::pedantic, clippy::nursery)]\n/// A mechanism.\npub mod {name};\n"
        );
        count += 1;
    }
    assert!(count > 60, "{count}");
    files::write_if_changed(&source.join("lib.rs"), &library).expect("written");
    let repository = files::repository();
    let manifest = format!(
        "[package]\nname = \"clean\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[workspace]\n\n[dependencies]\nlinkwright = {{ path = {:?} }}\n",
        repository.join("runtime")
    );
    files::write_if_changed(&package.join("Cargo.toml"), &manifest).expect("written");
    fs::copy(repository.join("Cargo.lock"), package.join("Cargo.lock")).expect("a copy");
    let mut command = Command::new("cargo");
    command.args(["clippy", "--quiet", "--offline", "--target-dir"]);
    command.arg(package.join("target")).current_dir(&package);
    command.env_remove("RUSTFLAGS");
    run(&mut command).unwrap_or_else(|error| panic!("{error}"));
}
