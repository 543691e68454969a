//! Each syntax code as it is printed, several errors in one file, and no errors that only follow from others.

use super::super::parse;
use super::{bad, codes};
use crate::diagnostic::{Code, Diagnostics, Severity, Source};

fn inside(text: &str) -> String {
    format!("mechanism m {{\n    {text}\n}}\n")
}

#[test]
fn unreadable_characters() {
    let expected = "\
error[K01]: unreadable character `°` (U+00B0)
 --> bad.mech:2:17
  |
2 |     const a = 30° + x²·2 − \"b\";
  |                 ^
  |
  = help: write `30deg`

error[K01]: unreadable power `²`
 --> bad.mech:2:22
  |
2 |     const a = 30° + x²·2 − \"b\";
  |                      ^
  |
  = help: write `^2`

error[K01]: unreadable character `·` (U+00B7)
 --> bad.mech:2:23
  |
2 |     const a = 30° + x²·2 − \"b\";
  |                       ^
  |
  = help: write `*`

error[K01]: unreadable character `−` (U+2212)
 --> bad.mech:2:26
  |
2 |     const a = 30° + x²·2 − \"b\";
  |                          ^
  |
  = help: write `-`

error[K01]: texts in quotes are not part of the language
 --> bad.mech:2:28
  |
2 |     const a = 30° + x²·2 − \"b\";
  |                            ^^^
  |
  = help: write names without quotes

error: 5 errors in bad.mech
";
    assert_eq!(bad(&inside("const a = 30° + x²·2 − \"b\";")), expected);
    assert_eq!(codes("\0"), vec!["K01 1:1"]);
    assert_eq!(codes(&inside("const a = 2\u{202e};")), vec!["K01 2:16"]);
}

#[test]
fn names_that_are_not_ascii() {
    let expected = "\
error[K10]: the name `π` is not ASCII
 --> bad.mech:2:17
  |
2 |     const a = 2*π;
  |                 ^ names are made of `a` to `z`, `A` to `Z`, `0` to `9` and `_`
  |
  = help: write `pi`

error: 1 error in bad.mech
";
    assert_eq!(bad(&inside("const a = 2*π;")), expected);
    assert_eq!(
        codes(&inside("drive φ(1) = 5µm;")),
        vec!["K10 2:11", "K10 2:19"]
    );
    let names = inside(
        "const 1 = 2; const _ = 3; body 01 at (0, 0); body 1.5 at (0, 0); body b1 at (0, 0) { 1: (0, 0) }",
    );
    assert_eq!(
        codes(&names),
        vec!["K10 2:11", "K10 2:24", "K10 2:36", "K10 2:55", "K10 2:90"]
    );
}

#[test]
fn unexpected_tokens() {
    let expected = "\
error[K02]: expected a formula, found `;`
 --> bad.mech:2:15
  |
2 |     const a = ;
  |               ^ expected a formula
  |
  = help: a formula is made of numbers, names, `( )`, `+ - * / ^` and functions such as `sin(t)`

error[K02]: expected `at`, found `(`
 --> bad.mech:3:12
  |
3 |     body b (0, 0) {}
  |            ^ expected `at`
  |
  = help: write `body b at (X, Y) { … }`

error: 2 errors in bad.mech
";
    assert_eq!(bad(&inside("const a = ;\n    body b (0, 0) {}")), expected);
    let drivers =
        inside("drive phi 2; drive phi(1) + 2; slide(1, 2) along A; body e at P, 1 { A }; ;");
    assert_eq!(
        codes(&drivers),
        vec!["K02 2:15", "K02 2:31", "K02 2:55", "K02 2:68", "K02 2:79"]
    );
    assert_eq!(codes("mechanism a {}\nmechanism b {} c"), vec!["K02 2:16"]);
    assert_eq!(codes("mechanism a {} x"), vec!["K02 1:16"]);
    assert_eq!(codes("hello world"), vec!["K02 1:1"]);
    assert_eq!(
        codes("mechanism { const a = ; }"),
        vec!["K02 1:11", "K02 1:23"]
    );
}

#[test]
fn missing_semicolons() {
    let expected = "\
error[K03]: missing `;`
 --> bad.mech:2:21
  |
2 |     revolute P(1, 2)
  |                     ^ expected `;`
  |
  = help: end the statement with `;`

error: 1 error in bad.mech
";
    assert_eq!(
        bad(&inside("revolute P(1, 2)\n    absolute_x(1) = 0;")),
        expected
    );
    let many = inside(
        "absolute_x(1) = 0 // not here\n    const b = 2 const c = 3;\n    body d at (0, 0)\n    const e = 4",
    );
    assert_eq!(
        codes(&many),
        vec!["K03 2:22", "K03 3:16", "K03 4:21", "K03 5:16"]
    );
}

#[test]
fn missing_commas() {
    let expected = "\
error[K02]: expected `,` or `)`, found `2`
 --> bad.mech:2:17
  |
2 |     revolute P(1 2);
  |                 ^ missing `,`
  |
  = help: separate them with `,`

error: 1 error in bad.mech
";
    assert_eq!(bad(&inside("revolute P(1 2);")), expected);
    let lists = inside(
        "point A = (1, 2) B = (2, 3);\n    body b at (0, 0) { A B\n        C; D: (1, 0) E }",
    );
    assert_eq!(
        codes(&lists),
        vec!["K02 2:21", "K02 3:25", "K02 3:27", "K02 4:10", "K02 4:21"]
    );
}

#[test]
fn unbalanced_brackets() {
    let text = inside(
        "revolute P(1, 2;\n    body b at (0, 0) { A, B\n    revolute Q(1, 2);\n    const a = (1];\n    const b = 1);\n    body c at (0, 0) {} }\n    const d = ;",
    );
    let expected = "\
error[K04]: unclosed `(`
 --> bad.mech:2:20
  |
2 |     revolute P(1, 2;
  |               - `(` opened here
  |                    ^ expected `)`
  |
  = help: add the missing `)`

error[K04]: unclosed `{`
 --> bad.mech:3:28
  |
3 |     body b at (0, 0) { A, B
  |                      - `{` opened here
  |                            ^ expected `}`
  |
  = help: add the missing `}`

error[K04]: `(` closed by `]`
 --> bad.mech:5:17
  |
5 |     const a = (1];
  |               - `(` opened here
  |                 ^ expected `)`
  |
  = help: write `)` instead

error[K04]: unmatched `)`
 --> bad.mech:6:16
  |
6 |     const b = 1);
  |                ^ closes nothing
  |
  = help: remove the `)`, or add the missing `(`

error[K04]: unmatched `}`
 --> bad.mech:7:25
  |
7 |     body c at (0, 0) {} }
  |                         ^ the mechanism would end here, but more follows
  |
  = help: remove the `}`, or add the missing `{`

error[K02]: expected a formula, found `;`
 --> bad.mech:8:15
  |
8 |     const d = ;
  |               ^ expected a formula
  |
  = help: a formula is made of numbers, names, `( )`, `+ - * / ^` and functions such as `sin(t)`

error: 6 errors in bad.mech
";
    assert_eq!(bad(&text), expected);
    assert_eq!(
        codes(&inside(
            "body a at (0, 0 { A }\n    revolute (1\n    revolute (1, 2);"
        )),
        vec!["K04 2:20", "K04 3:16"]
    );
}

#[test]
fn the_end_of_the_file() {
    let expected = "\
error[K05]: the file ends inside brackets
 --> bad.mech:2:18
  |
1 | mechanism m {
  |             - `{` opened here
2 |     body a at (0,
  |               - `(` opened here
  |                  ^ expected `)`
  |
  = help: close the open brackets with `)}`

error: 1 error in bad.mech
";
    assert_eq!(bad("mechanism m {\n    body a at (0,\n\n"), expected);
    assert_eq!(codes("mechanism m {\n    const a = 1"), vec!["K05 2:16"]);
    assert_eq!(codes("mechanism m\n"), vec!["K05 1:12"]);
    assert_eq!(codes("mechanism"), vec!["K05 1:10"]);
    assert_eq!(
        codes("mechanism m {\n    const a = 1; /* never\n}\n"),
        vec!["K05 3:2"]
    );
}

#[test]
fn empty_files() {
    let expected = "\
error[K06]: the file describes no mechanism
 --> bad.mech:1:1
  |
1 | // nothing
  | ^
  |
  = help: write `mechanism NAME { … }`

error: 1 error in bad.mech
";
    assert_eq!(bad("// nothing\n"), expected);
    for text in [
        "",
        "\n\n",
        "\u{feff}",
        "//! Inner.\n",
        "/* a */",
        "/// Outer.",
    ] {
        assert_eq!(codes(text), vec!["K06 1:1"], "{text:?}");
    }
}

#[test]
fn unknown_statements() {
    let expected = "\
error[K07]: unknown statement `bdy`
 --> bad.mech:2:5
  |
2 |     bdy a at (0, 0) { A }
  |     ^^^ not a statement of this language
  |
  = help: did you mean `body`?

error: 1 error in bad.mech
";
    assert_eq!(
        bad(&inside("bdy a at (0, 0) { A }\n    drve phi(1) = 2;")),
        expected
    );
    assert_eq!(codes(&inside("fix a;")), vec!["K07 2:5"]);
    assert_eq!(
        codes("mechansim a { const b = }"),
        vec!["K07 1:1", "K02 1:25"]
    );
}

#[test]
fn expressions_of_other_languages() {
    let expected = "\
error[K08]: `**` is not an operation
 --> bad.mech:2:17
  |
2 |     const a = 2 ** 3;
  |                 ^^
  |
  = help: write a power with `^`, as in `x^2`

error[K08]: `sin` is called like a method
 --> bad.mech:3:15
  |
3 |     const b = x.sin();
  |               ^^^^^
  |
  = help: write `sin(x)`

error: 2 errors in bad.mech
";
    assert_eq!(
        bad(&inside("const a = 2 ** 3;\n    const b = x.sin();")),
        expected
    );
    for formula in [
        "2 t", "2(3)", "1e", "0x10", "(a)[1]", "(1, 2)", "{1}", "a = b", "f(a b)", "(a b)",
    ] {
        let codes_of_formula = codes(&inside(&format!("const a = {formula};")));
        assert!(
            codes_of_formula.len() == 1 && codes_of_formula[0].starts_with("K08"),
            "{formula}: {codes_of_formula:?}"
        );
    }
}

#[test]
fn deep_nesting() {
    let text = inside(&format!(
        "const a = {}1{};",
        "(".repeat(200),
        ")".repeat(200)
    ));
    let rendered = bad(&text);
    assert!(
        rendered.starts_with("error[K09]: nested more than 128 levels deep\n --> bad.mech:2:142\n"),
        "{rendered}"
    );
    assert!(
        rendered.ends_with("error: 1 error in bad.mech\n"),
        "{rendered}"
    );
}

#[test]
fn wrong_forms() {
    let expected = "\
error[K30]: expected `(X, Y)` or `(X, Y, ANGLE)`, found 1 value
 --> bad.mech:2:15
  |
2 |     body a at (0) { A: (1, 2, 3), B }
  |               ^^^
  |
  = help: write `(X, Y)` or `(X, Y, ANGLE)`

error[K30]: expected `(X, Y)`, found 3 values
 --> bad.mech:2:24
  |
2 |     body a at (0) { A: (1, 2, 3), B }
  |                        ^^^^^^^^^
  |
  = help: write `(X, Y)`

error: 2 errors in bad.mech
";
    assert_eq!(bad(&inside("body a at (0) { A: (1, 2, 3), B }")), expected);
    assert_eq!(
        codes(&inside(
            "body c at (0, 0, 1) turned 2; gear(1, 2) = 3 along A -> B;"
        )),
        vec!["K30 2:25", "K30 2:50"]
    );
}

#[test]
fn too_large_a_file() {
    let mut findings = Diagnostics::new();
    assert!(
        parse(
            &Source::new("big.mech", " ".repeat(Source::MAX_BYTES + 1)),
            &mut findings
        )
        .is_none()
    );
    assert_eq!(
        findings.iter().map(|it| it.code).collect::<Vec<_>>(),
        vec![Code::UnreadableFile]
    );
}

#[test]
fn a_comment_that_documents_nothing_is_a_warning() {
    let source = Source::new(
        "a.mech",
        "mechanism m {\n    const a = /// here\n        1;\n    /// there\n}\n",
    );
    let mut findings = Diagnostics::new();
    let document = parse(&source, &mut findings);
    assert!(document.is_some() && !findings.has_errors());
    let lines: Vec<_> = findings
        .iter()
        .map(|it| (it.severity, source.position(it.primary.span.start).line))
        .collect();
    assert_eq!(lines, vec![(Severity::Warning, 2), (Severity::Warning, 4)]);
}

#[test]
fn returns_readable_statements_with_errors() {
    let source = Source::new(
        "a.mech",
        inside(
            "const a = ;\n    const b = 2\n    body c at (0, 0) { A: 2, B }\n    revolute B(c, ground);",
        ),
    );
    let mut findings = Diagnostics::new();
    let document = parse(&source, &mut findings).expect("a document with errors");
    assert_eq!(findings.into_sorted().len(), 3);
    assert_eq!(document.mechanism.statements.len(), 3);
}
