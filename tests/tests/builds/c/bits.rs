//! Bits and failures of generated C are those of generated Rust.

use std::fs;
use std::process::Command;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Options, generate};
use linkwright_tests::c::case::Case;
use linkwright_tests::c::run::{compilers, differences, run};
use linkwright_tests::hunt::mechanism;
use linkwright_tests::pantograph::Pantograph;
use linkwright_tests::random::cases;
use linkwright_tests::{description, files};

use super::{compile, folder, run_as_cpp, write_double};
use crate::representatives::{representatives, target_of_modules};

/// Number of random mechanisms, which [`cases`] multiplies, largest number of bodies, and first seed.
const RANDOM: u64 = 4;
const MAX_BODIES: usize = 10;
const SEED: u64 = 14;

#[test]
fn frames_and_failures_have_the_bits_of_rust() {
    let named = |name: &str| Case::new(name, description::source(name), 2.0);
    let names = representatives(false);
    let names = names.iter().map(String::as_str);
    // Some have too many joints.
    let random = (0..)
        .map(|number| Source::new("found.mech", mechanism(SEED, number, MAX_BODIES).text()))
        .filter(|source| generate(source, &Options::default()).is_ok())
        .take(cases(RANDOM) as usize)
        .enumerate()
        .map(|(number, source)| Case::new(&format!("found_{number}"), source, 2.0));
    // Enough cells for a proof of its path cell by cell.
    let chain = Pantograph::new(9, 0.875).text("");
    let chain = Case::new("chain", Source::new("chain.mech", chain), 2.0);
    let cases: Vec<Case> = names.map(named).chain(random).chain([chain]).collect();
    assert!(cases.len() > 30 && !compilers().is_empty());
    let folder = folder("bits");
    let differing = differences(&folder, &target_of_modules(), &files::repository(), &cases);
    let differing = differing.unwrap_or_else(|error| panic!("{error}"));
    assert!(differing.is_empty(), "{}", differing.join("\n"));
    // Otherwise nothing would have been tested: frames, and the usual kinds of failure of such mechanisms.
    let (mut frames, mut failures) = (0, std::collections::BTreeMap::new());
    for path in files::with_extension(&folder.join("answers"), "rust") {
        let text = fs::read_to_string(&path).expect("answers");
        let mut solved = text.lines().filter(|line| line.starts_with("ok "));
        frames += solved.clone().count();
        // Each script has times that are not finite.
        assert!(!solved.any(is_at_no_time), "{}", path.display());
        let is_refused =
            |line: &str| line.starts_with("no ") && line.split(' ').nth(2) == Some("nan");
        assert!(text.lines().any(is_refused), "{}", path.display());
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
    for status in ["1", "6", "7", "8", "9", "10", "12", "13", "14"] {
        assert!(failures.contains_key(status), "no {status} in {failures:?}");
    }
}

/// True if a frame has a time, the second word of its answer, that is infinite or NaN.
fn is_at_no_time(answer: &str) -> bool {
    let time = answer.split(' ').nth(1).expect("a time");
    let bits = u64::from_str_radix(time, 16).map(f64::from_bits);
    !bits.is_ok_and(f64::is_finite)
}

/// C names the load that is not finite, by its index in its table.
#[test]
fn a_load_that_is_not_finite_is_named() {
    let place = folder("loads");
    write_double(&place, "endless_loads");
    compile(&place, &["endless_loads", "linkwright"]);
    let text = "#include \"endless_loads.h\"\n#include <cstdio>\n
int main()
{
    static EndlessLoads it;
    EndlessLoadsInputs inputs = ENDLESS_LOADS_INITIAL;
    (void)endless_loads_assemble(&it, 0.0, &inputs);
    const double times[4] = {0.5, 0.75, 0.875, 1.0};
    for (int k = 0; k < 4; k++) {
        inputs.gap.value = (k == 2) ? 0.0 : 0.25;
        const linkwright_status status = endless_loads_advance(&it, times[k], &inputs);
        if (status == LINKWRIGHT_LOAD_NOT_FINITE) {
            const char *load = ENDLESS_LOADS_LOADS[it.failure.column];
            std::printf(\"%g %s, block %d\\n\", it.failure.time, load, (int)it.failure.block);
        } else {
            std::printf(\"%d\\n\", (int)status);
        }
    }
    return 0;
}
";
    fs::write(place.join("loads.cpp"), text).expect("written");
    let printed = run_as_cpp(&place, "loads.cpp", &["endless_loads", "linkwright"]);
    let expected = "0.5 torque on crank, block 1
0
0.875 force on crank.P, block 1
1 torque on wheel, block 1
";
    assert_eq!(printed, expected);
}

/// All arguments in f32 of some magnitudes, and dense samples in f64: results equal those of `linkwright_math`.
#[test]
fn elementary_functions_have_the_bits_of_rust() {
    let place = folder("math");
    write_double(&place, "two_body");
    compile(&place, &["linkwright"]);
    let program = include_str!("../../../src/c/elementary.c");
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
