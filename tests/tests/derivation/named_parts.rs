//! Long choices on the printed pages: written once under a name, and the page with its names equals the rows.

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::emit::{Notation, latex, text};
use linkwright_codegen::stages::expr::{ExprId, Tape};
use linkwright_codegen::stages::system::{Derived, Row};
use linkwright_tests::files;
use linkwright_tests::plan::{derivation, report};
use linkwright_tests::printed::{Values, value};
use linkwright_tests::random::Random;

/// Heading of the page with the expression of its rows.
type Printed = (&'static str, fn(&Row) -> ExprId);

const PAGES: [&str; 4] = [
    "../mechanisms/cam_dwell",
    "descriptions/laws",
    "descriptions/pieces",
    "descriptions/cam_law",
];

fn read(name: &str, text: String) -> Derived {
    let source = Source::new(name.to_string(), text);
    let read = linkwright_codegen::read(&source);
    let read = read.unwrap_or_else(|found| panic!("{}", found.render(&source)));
    read.only().expect("one motion")
}

fn system(name: &str) -> Derived {
    let path = files::package(&format!("{name}.mech"));
    read(name, std::fs::read_to_string(&path).expect("a description"))
}

fn evaluated(derived: &Derived, expr: ExprId, symbols: &[f64]) -> f64 {
    let mut result = [0.0];
    let tape = Tape::new(&derived.pool.graph, &[expr]);
    tape.evaluate(symbols, &mut Vec::new(), &mut result);
    result[0]
}

/// Lines below a heading, without their indentation; a wide choice is one line.
fn section(page: &str, heading: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let below = page
        .lines()
        .skip_while(|line| *line != heading)
        .skip(1)
        .take_while(|line| !line.is_empty());
    for line in below.map(str::trim) {
        match lines.last_mut() {
            Some(begun) if line.starts_with("else ") => *begun = format!("{begun} {line}"),
            _ => lines.push(line.to_string()),
        }
    }
    lines
}

/// Φ, Φ_t and γ as printed, with the definitions of the page below them, at random values against the expressions
/// themselves.
#[test]
fn the_printed_rows_with_their_names_are_the_rows() {
    let mut random = Random::new(7);
    for name in PAGES {
        let derived = system(name);
        let page = text::inspect(&derived, Notation::Ascii);
        let definitions = section(&page, "where");
        assert!(!definitions.is_empty(), "{page}");
        for _ in 0..40 {
            let mut symbols = vec![0.0; derived.pool.graph.symbol_count()];
            let mut values = Values::new();
            let unknowns = derived.system.vector_form.unknowns.iter();
            let named = unknowns.flat_map(|own| {
                let rate = format!("{}'", own.name);
                [(own.position, own.name.clone()), (own.rate, rate)]
            });
            let time = (derived.system.mechanism.time, "t".to_string());
            for (symbol, printed) in named.chain([time]) {
                symbols[symbol.index()] = random.between(-7.0, 7.0);
                values.insert(printed, symbols[symbol.index()]);
            }
            for line in &definitions {
                let (left, right) = line.split_once(" = ").expect("a definition");
                let defined = value(right, &values);
                let defined = defined.unwrap_or_else(|| panic!("{name}: {line} has no value"));
                assert!(
                    values.insert(left.to_string(), defined).is_none(),
                    "{left} twice"
                );
            }
            let mut compared = 0;
            let parts: [Printed; 3] = [
                ("Phi(q, t) = 0", |row| row.residual),
                ("Phi_t", |row| row.time_derivative),
                ("gamma", |row| row.gamma),
            ];
            for (heading, of) in parts {
                for line in section(&page, heading) {
                    let Some(number) = line
                        .split(' ')
                        .next()
                        .and_then(|it| it.parse::<usize>().ok())
                    else {
                        continue;
                    };
                    let formula = line.rsplit("  ").next().expect("a formula").trim();
                    let row = &derived.system.rows[number - 1];
                    let exact = evaluated(&derived, of(row), &symbols);
                    let evaluated = value(formula, &values);
                    let evaluated =
                        evaluated.unwrap_or_else(|| panic!("{name}: {formula} has no value"));
                    // The terms of γ are products of two rates below 7 with lengths below a few meters.
                    assert!(
                        (evaluated - exact).abs() <= 1e-12 * (1.0 + exact.abs()),
                        "{name}: {formula} is {evaluated}, not {exact}"
                    );
                    compared += 1;
                }
            }
            assert!(compared > derived.system.rows.len(), "{page}");
        }
    }
}

/// Every long choice stands at its definition and nowhere else, on all pages.
#[test]
fn a_long_choice_is_written_once() {
    for name in PAGES {
        let derived = system(name);
        let inspected = text::inspect(&derived, Notation::Ascii);
        let derived = derivation(derived).text(Notation::Ascii);
        for page in [inspected, derived] {
            let mut defined = Vec::new();
            for line in page.lines().map(str::trim) {
                if let Some((left, _)) = line.split_once(" = if ") {
                    defined.push(left.to_string());
                    continue;
                }
                let longest = line
                    .match_indices("(if ")
                    .map(|(at, _)| line[at..].find("})").map_or(line.len(), |end| end + 2));
                assert!(longest.max().unwrap_or(0) <= 77, "{name}: {line}");
            }
            let words = page.split(|it: char| !it.is_alphanumeric() && it != '_');
            for word in words.filter(|it| it.starts_with("piece_")) {
                assert!(
                    defined.iter().any(|it| it == word),
                    "{word} is not defined\n{page}"
                );
            }
            let mut once = defined.clone();
            once.sort();
            once.dedup();
            assert_eq!(once.len(), defined.len(), "{page}");
            assert!(page.matches("floor(").count() <= 1, "{name}: {page}");
        }
    }
}

#[test]
fn the_typeset_pages_are_balanced() {
    for name in PAGES {
        let derived = system(name);
        let inspected = latex::inspect(&[(&derived, Vec::new())]);
        let derived = derivation(derived).latex();
        for page in [inspected, derived] {
            assert!(page.contains("\\begin{cases}"), "{name} has no choice");
            let mut open: Vec<&str> = Vec::new();
            for (at, _) in page.match_indices('\\') {
                let rest = &page[at + 1..];
                if let Some(begun) = rest.strip_prefix("begin{") {
                    open.push(begun.split('}').next().expect("an environment"));
                } else if let Some(ended) = rest.strip_prefix("end{") {
                    assert_eq!(open.pop(), ended.split('}').next(), "{name}");
                } else if rest.starts_with("left") && !rest.starts_with("left\\lfloor") {
                    open.push("left");
                } else if rest.starts_with("right") && !rest.starts_with("right\\rfloor") {
                    assert_eq!(open.pop(), Some("left"), "{name}");
                }
            }
            assert!(open.is_empty(), "{name}: {open:?}");
            let braces = page.replace("\\{", "").replace("\\}", "");
            let count = |brace| braces.matches(brace).count();
            assert_eq!(count('{'), count('}'), "{name}");
        }
    }
}

/// A page without a long choice has no names.
#[test]
fn a_short_choice_stays_in_its_place() {
    let short = read(
        "short",
        "mechanism short { body 1 at (0, 0); absolute_x(1) = 0; absolute_y(1) = 0; drive phi(1) = step(t, 1s, 0, 3s, 8); }"
            .to_string(),
    );
    let page = text::inspect(&short, Notation::Ascii);
    assert!(page.contains(
        "phi1 - (if t < 1 { 0 } else if t < 3 { 6*(1 - t)^2 + 2*(1 - t)^3 } else { 8 })"
    ));
    assert!(
        !page.contains("piece_") && !page.contains("where"),
        "{page}"
    );
}

/// A sequence of any number of stations has one sine and one cosine for position, velocity and acceleration.
#[test]
fn a_sequence_asks_first_and_computes_one_sine() {
    for stations in [2_usize, 3, 8] {
        let pairs: Vec<String> = (0..stations)
            .map(|place| format!("({place}s, {}mm)", [0, 10, 10, 30][place % 4]))
            .collect();
        let text = format!(
            "mechanism stations {{ body 1 at (0, 0) {{ O: (0, 0) }} absolute_y(1) = 0; drive x(1.O) = sequence(t, cycloidal, {}); \
             drive phi(1) = 0; }}",
            pairs.join(", ")
        );
        let report = report(&read("stations", text));
        let sines: usize = report.operations.iter().map(|level| level.sines).sum();
        assert_eq!(sines, 2, "with {stations} stations");
    }
}
