//! Work is proportional to the size of a description, or ends at a bound that names a statement.
//!
//! Work is counted in the terms and factors that the stages build. Work without these is measured by the clock, as
//! the ratio of two sizes on one machine one after the other.

use std::time::Instant;

use linkwright_codegen::diagnostic::{Code, Diagnostics, Source};
use linkwright_codegen::stages::columns::{Columns, Known};
use linkwright_codegen::stages::emit::{Notation, latex, text};
use linkwright_codegen::stages::program::Kept;
use linkwright_codegen::stages::solved::Solved;
use linkwright_codegen::stages::structure::{self, Shift};
use linkwright_codegen::{Options, generate, read};
use linkwright_tests::large::{self, KINDS, Kind, MISTAKES, NESTS};
use linkwright_tests::plan::{derivation, solved};

fn source(text: String) -> Source {
    Source::new("large.mech", text)
}

/// Terms and factors that all stages up to the program read and store.
fn work(kind: &Kind, n: usize) -> usize {
    let source = source((kind.text)(n));
    let read =
        read(&source).unwrap_or_else(|errors| panic!("{}: {}", kind.name, errors.render(&source)));
    let solved = solved(read.only().expect("one motion"));
    let graph = &solved.pool().graph;
    assert_eq!(graph.excess(), None, "{}", kind.name);
    graph.work() + graph.store() + graph.node_count()
}

/// First error, which must mark a part of the text.
fn refusal(source: &Source, found: Diagnostics) -> (Code, String) {
    let rendered = found.render(source);
    let sorted = found.into_sorted();
    let span = sorted[0].primary.span;
    assert!(
        span.start < span.end && (span.end as usize) <= source.text.len(),
        "{rendered}"
    );
    let marked = &source.text[span.range()];
    (sorted[0].code, marked.to_string())
}

#[test]
fn terms_and_factors_grow_in_proportion_to_the_text() {
    for kind in KINDS {
        let [short, long] = [60, 240].map(|n| work(&kind, n));
        // Proportional work is 4-fold; a product of n factors takes n log² n, below 8-fold.
        assert!(
            long < 8 * short,
            "{}: {short} for 60 and {long} for 240",
            kind.name
        );
    }
}

/// Characters of the pages and of the module.
fn printed(kind: &Kind, n: usize) -> [usize; 3] {
    let source = source((kind.text)(n));
    let read =
        read(&source).unwrap_or_else(|errors| panic!("{}: {}", kind.name, errors.render(&source)));
    let derived = read.only().expect("one motion");
    let equations = text::inspect(&derived, Notation::Ascii);
    let derivation = derivation(derived).text(Notation::Ascii);
    let module = generate(&source, &Options::default())
        .unwrap_or_else(|errors| panic!("{}: {}", kind.name, errors.render(&source)));
    [equations, derivation, module.code().to_string()].map(|text| text.len())
}

#[test]
fn pages_and_modules_grow_in_proportion_to_the_text() {
    for kind in KINDS {
        let [short, long] = [30, 120].map(|n| printed(&kind, n));
        for (page, (short, long)) in ["inspect", "plan", "generate"]
            .iter()
            .zip(short.into_iter().zip(long))
        {
            // Proportional text is 4-fold; n log² n terms are broken into lines, below 9-fold.
            assert!(
                long < 9 * short,
                "{}, {page}: {short} for 30 and {long} for 120",
                kind.name
            );
        }
    }
}

#[test]
fn nested_formulas_are_printed_as_graphs() {
    for formula in NESTS {
        for from_parameter in [false, true] {
            let kind = |n| Source::new("large.mech", large::nest(formula, from_parameter, n));
            let length = |n| {
                let source = kind(n);
                let read = read(&source)
                    .unwrap_or_else(|errors| panic!("{formula}: {}", errors.render(&source)));
                let derived = read.only().expect("one motion");
                let equations = text::inspect(&derived, Notation::Unicode);
                let derivation = derivation(derived.clone());
                let formats = [
                    derivation.text(Notation::Ascii),
                    derivation.latex(),
                    latex::inspect(&[(&derived, Vec::new())]),
                ];
                let module = generate(&source, &Options::default())
                    .unwrap_or_else(|errors| panic!("{formula}: {}", errors.render(&source)));
                let all = formats
                    .into_iter()
                    .chain([equations, module.code().to_string()]);
                all.map(|text| text.len()).sum::<usize>()
            };
            // Each level adds a constant length; written out it would double or triple the formula.
            let [low, middle, high] = [16, 24, 32].map(length);
            assert!(
                high < 2 * middle && middle < 2 * low.max(8000),
                "{formula}: {low}, {middle}, {high}"
            );
        }
    }
}

#[test]
fn a_long_chain_of_operations_is_written_in_steps() {
    // The formatter walks a chain by recursion, on the stack of a test's thread.
    for between in [" + ", "*"] {
        let terms: Vec<String> = (1..3000).map(|k| format!("sin({k}*t)")).collect();
        let before = "mechanism long {\n    body 1 at (0, 0);\n    absolute_x(1) = 0;\n    absolute_y(1) = 0;\n";
        let law = terms.join(between);
        let source = source(format!("{before}    drive phi(1) = {law};\n}}\n"));
        match generate(&source, &Options::default()) {
            Ok(generated) => assert!(generated.code().contains("let partial = partial")),
            Err(found) => assert_eq!(refusal(&source, found).0, Code::TooMuchWork),
        }
    }
}

/// Seconds until a description of this size is read and planned, or refused.
fn seconds(kind: &Kind, n: usize) -> f64 {
    let source = source((kind.text)(n));
    let start = Instant::now();
    match read(&source) {
        Ok(read) => {
            let derived = read.only().expect("one motion");
            if !structure::analyze(&derived.pool, &derived.system).has_errors() {
                // Refusals take time too.
                let _ = Solved::of(derived, Shift::Directions, Kept::Methods);
            }
        }
        Err(found) => {
            found.render(&source);
        }
    }
    start.elapsed().as_secs_f64()
}

/// Length of the shorter text: for the longer one, a comparison of all pairs would take most of the time.
const BYTES: usize = 12_000;

#[test]
fn time_grows_in_proportion_to_the_text() {
    for kind in KINDS.iter().chain(&MISTAKES) {
        let n = 100 * BYTES / (kind.text)(100).len();
        // Four times the text takes four times as long, and sixteen times if each part is compared with every other.
        // On a busy machine a measurement may be off, so that the best of a few counts.
        let mut ratios = Vec::new();
        while ratios.len() < 5 && ratios.iter().all(|&ratio| ratio > 8.0) {
            ratios.push(seconds(kind, 4 * n) / seconds(kind, n));
        }
        assert!(
            ratios.iter().any(|&ratio| ratio <= 8.0),
            "{}: {ratios:.1?} times as long",
            kind.name
        );
    }
}

#[test]
fn every_function_is_nested_through_names_up_to_a_bound() {
    for formula in NESTS {
        for from_parameter in [false, true] {
            // Shallow nests are accepted, and walked on the stack of a test's thread.
            let shallow = source(large::nest(formula, from_parameter, 30));
            if let Err(errors) = read(&shallow) {
                panic!("{formula}: {}", errors.render(&shallow));
            }
            let deep = source(large::nest(formula, from_parameter, 2000));
            match read(&deep) {
                // Constant numbers end a nest.
                Ok(read) => {
                    let derived = read.only().expect("one motion");
                    assert!(derived.pool.graph.node_count() < 20_000, "{formula}");
                }
                Err(errors) => {
                    let (code, marked) = refusal(&deep, errors);
                    assert_eq!(code, Code::NestedTooDeeply, "{formula}");
                    assert!(!marked.contains(';'), "{marked}");
                }
            }
        }
    }
}

#[test]
fn shared_expressions_stay_shared() {
    // Written out the formula has 3^25 terms.
    let source = source(large::nest("sin(@)*cos(@) + @", true, 25));
    let read = read(&source).unwrap_or_else(|errors| panic!("{}", errors.render(&source)));
    let solved = solved(read.only().expect("one motion"));
    let nodes = solved.pool().graph.node_count();
    assert!(nodes < 2000, "{nodes}");
}

/// Checks that a description is refused, and returns the text that the first error marks.
fn refused(text: String, code: Code) -> String {
    let source = source(text);
    let errors = match generate(&source, &Options::default()) {
        Ok(_) => panic!("answered"),
        Err(found) => found,
    };
    let (first, marked) = refusal(&source, errors);
    assert_eq!(first, code);
    marked
}

#[test]
fn too_large_statements_are_refused() {
    let marked = refused(large::doubling_constants(), Code::TooMuchWork);
    assert!(marked.starts_with("const c"), "{marked}");
    let marked = refused(large::facing_one_another(300), Code::NestedTooDeeply);
    assert!(marked.starts_with("body b"), "{marked}");
    let marked = refused(large::motions(3000, 400), Code::TooMuchWork);
    assert!(marked.starts_with('m'), "{marked}");
    let marked = refused(large::transmission(700), Code::TooMuchWork);
    assert!(marked.starts_with("drive "), "{marked}");
}

#[test]
fn documented_sizes_are_not_refused() {
    let stations = KINDS
        .iter()
        .find(|kind| kind.name == "stations of a sequence");
    let points = KINDS
        .iter()
        .find(|kind| kind.name == "drawn points of one body");
    let promised = [
        (points.expect("points").text)(20_000),
        (stations.expect("stations").text)(2000),
        linkwright_tests::dyad_chain::description(1000),
    ];
    for text in promised {
        let source = source(text);
        let read = read(&source).unwrap_or_else(|errors| panic!("{}", errors.render(&source)));
        let solved = solved(read.only().expect("one motion"));
        assert_eq!(solved.pool().graph.excess(), None);
    }
}

#[test]
fn tables_are_read_in_proportion_to_their_columns() {
    let seconds = |columns: usize| {
        let names: Vec<String> = (0..columns).map(|it| format!("c{it}")).collect();
        let row = vec!["1.5"; columns].join(",");
        let text = format!("{}\n{row}\n{row}\n", names.join(","));
        let shortest = (0..3).map(|_| {
            let begun = Instant::now();
            let table = Columns::read(text.as_bytes(), Known::default()).expect("a table");
            assert_eq!(table.columns.len(), columns);
            begun.elapsed().as_secs_f64()
        });
        shortest.fold(f64::INFINITY, f64::min)
    };
    // Proportional work is 16-fold; a search for the end of the line at each cell makes it 150-fold.
    let [short, long] = [2_000, 32_000].map(seconds);
    assert!(long < 50.0 * short, "{short} s and {long} s");
}
