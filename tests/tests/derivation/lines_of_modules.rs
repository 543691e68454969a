//! Reads every generated module of Rust: the compiler's grammar accepts it, and its lines fit.

use linkwright_codegen::{Options, Scalar, generate};
use linkwright_tests::description;

/// Longest line of code, in characters.
const WIDTH: usize = 120;

/// Names and strings of so many characters may make a line longer.
const LONG: usize = 80;

/// Words of a line; a string is one.
fn longest_word(line: &str) -> usize {
    let strings = line.split('"').enumerate();
    let lengths = strings.flat_map(|(place, part)| match place % 2 {
        0 => part.split(' ').map(|it| it.chars().count()).collect(),
        _ => vec![part.chars().count()],
    });
    lengths.max().unwrap_or(0)
}

#[test]
fn modules_parse_and_their_lines_fit() {
    for name in description::whole() {
        let source = description::source(&name);
        let forms = [
            (Scalar::F64, false),
            (Scalar::F32, false),
            (Scalar::F64, true),
            (Scalar::F32, true),
        ];
        for (scalar, lanes) in forms {
            let options = Options {
                scalar,
                lanes,
                ..Options::default()
            };
            let module = match generate(&source, &options) {
                Ok(module) => module,
                // Newton-Raphson has none.
                Err(_) if lanes => continue,
                Err(errors) => panic!("{}", errors.render(&source)),
            };
            let parsed = syn::parse_file(module.code());
            assert!(parsed.is_ok(), "{name}: {:?}", parsed.err());
            let mut before = "";
            for line in module.code().lines() {
                let is_apart = !(line.contains("/// ") && before.ends_with('}'));
                assert!(is_apart, "{name}: no empty line before {line}");
                before = line;
                let is_prose = line.trim_start().starts_with("//");
                let fits = line.chars().count() <= WIDTH || longest_word(line) >= LONG;
                assert!(is_prose || fits, "{name}: {line}");
                assert_eq!(line, line.trim_end(), "{name}");
            }
        }
    }
}
