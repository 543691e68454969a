//! Tests formatting as a whole, from text to text.

use super::format;
use crate::diagnostic::Source;

fn formatted(text: &str) -> String {
    let once = format(&Source::new("any.mech", text));
    let once = once.unwrap_or_else(|found| panic!("{:?}\n{text}", found.into_sorted()));
    let twice = format(&Source::new("again.mech", once.as_str()));
    let twice = twice.unwrap_or_else(|found| panic!("{:?}\n{once}", found.into_sorted()));
    assert_eq!(twice, once, "formatting again changes it");
    once
}

/// Puts statements into a mechanism.
fn inside(statements: &str) -> String {
    let written = formatted(&format!("mechanism m {{\n{statements}\n}}\n"));
    let lines = written
        .strip_prefix("mechanism m {\n")
        .and_then(|it| it.strip_suffix("}\n"));
    lines.expect("a mechanism").to_string()
}

#[test]
fn a_statement_has_lines_of_its_own() {
    let written = formatted(
        "mechanism   m{ // open\nconst a=1;const b=2; /* of b */ /* too */ body 1 at (0,0){}body 2 at (0,0){A:(1,2)}; // of 2\n\
         motion x{drive phi(1)=t;}motion y{}\n\n}\n// end",
    );
    let expected = "\
mechanism m { // open
    const a = 1;
    const b = 2; /* of b */ /* too */
    body 1 at (0, 0) {}
    body 2 at (0, 0) { A: (1, 2) }; // of 2
    motion x {
        drive phi(1) = t;
    }
    motion y {}
}
// end
";
    assert_eq!(written, expected);
}

#[test]
fn formulas_are_written_as_in_a_textbook() {
    let written = inside(
        "const a=-1+ - 2*( 3 - -4 )^ -2/ 2;const b = f( 1.P . x,- 3)-sin (2);\nconst k=if t<=1s{-2} else if -t > 2s  { 3+to -1 }else{- 4};\n\
         equation (a)=3; equation -x=y; external_gear(1,2)=(1)/ 2  pressure_angle -20deg;internal_gear g (1,2)=a pressure_angle(a);spring about(1,2)=-(3) free -2 preload(3);curve r( s from -1 to - 2 ) on 1=polar -(s);",
    );
    let expected = "    const a = -1 + -2*(3 - -4)^-2/2;
    const b = f(1.P.x, -3) - sin(2);
    const k = if t <= 1s { -2 } else if -t > 2s { 3 + to - 1 } else { -4 };
    equation (a) = 3;
    equation -x = y;
    external_gear (1, 2) = (1)/2 pressure_angle -20deg;
    internal_gear g(1, 2) = a pressure_angle (a);
    spring about (1, 2) = -(3) free -2 preload (3);
    curve r(s from -1 to -2) on 1 = polar -(s);
";
    assert_eq!(written, expected);
}

#[test]
fn ranges_are_written_between_blanks_and_stay_in_columns() {
    let written = inside(
        "param rod=120mm   from 80mm to  -(2*80mm) ;\ninput a = -1 from - 2 to+2;\nparam from = 3 from from to to;\nparam crank = 20mm from  10mm to 30mm;\nparam r=5mm from   1mm to  9mm;",
    );
    let expected = "    param rod = 120mm from 80mm to -(2*80mm);
    input a = -1 from -2 to +2;
    param from = 3 from from to to;
    param crank = 20mm from 10mm to 30mm;
    param r = 5mm from 1mm to 9mm;
";
    assert_eq!(written, expected);
    let aligned = "    param rod   = 120mm from 80mm  to 160mm;\n    param crank =  40mm from 5.5mm to  60mm;\n";
    assert_eq!(inside(aligned), aligned);
}

#[test]
fn a_joint_without_a_name_stands_apart_from_several_operands() {
    let written = inside(
        "translational(1,2)along A->B;\nabsolute_x (1)=0;\nrevolute 1 ( ground,a );\nredundant weld(1 ,2);\nredundant revolute Q (1, 2);",
    );
    let expected = "    translational (1, 2) along A -> B;
    absolute_x(1) = 0;
    revolute 1(ground, a);
    redundant weld (1, 2);
    redundant revolute Q(1, 2);
";
    assert_eq!(written, expected);
}

#[test]
fn columns_by_hand_stay_columns() {
    let written = inside(
        "
  const long = 1;     // one
  const s    = 22;    // two
  const x    =  3;

  body crank   at A            { A, B }
  /// Between.
  body coupler at (0.3,1.1)  { B, C, E }
  body longest_of_all at  (0.3, 1.1) { B }
  body rocker  at D            { C, D }",
    );
    let expected = "    const long = 1;     // one
    const s    = 22;    // two
    const x    =  3;

    body crank   at A            { A, B }
    /// Between.
    body coupler at (0.3, 1.1)   { B, C, E }
    body longest_of_all at (0.3, 1.1) { B }
    body rocker  at D            { C, D }
";
    assert_eq!(written, expected);
}

#[test]
fn statements_of_different_kinds_have_no_columns_in_common() {
    let written =
        inside(" point A=(0,0),   D = (1, 2);\n body crank at    A { A }\n body x     at D { D }");
    let expected = "    point A = (0, 0), D = (1, 2);
    body crank at A { A }
    body x     at D { D }
";
    assert_eq!(written, expected);
}

#[test]
fn keeps_continuations_aligned() {
    let written = inside(
        "
 point A = (0,0), B = (1, 2),
       C = (10, 20),
       D = (3, 4);
 const a = 1
 + 2;
 table lift = [
   (  0deg,  1mm),
   ( 10deg, 22mm),
 (5deg,      3mm),
 ];
 const c = if a < 1 {
 f(1,
 2)
 } else { 3 };",
    );
    let expected = "    point A = (0, 0), B = (1, 2),
          C = (10, 20),
          D = (3, 4);
    const a = 1
        + 2;
    table lift = [
        (  0deg,  1mm),
        ( 10deg, 22mm),
        (5deg, 3mm),
    ];
    const c = if a < 1 {
        f(1,
            2)
    } else { 3 };
";
    assert_eq!(written, expected);
}

#[test]
fn one_of_several_blank_lines_stays_and_none_at_an_edge() {
    let written = formatted(
        "\n\n//! Text.\n\n\n/// More.\nmechanism m {\n\n\n    const a = 1;\t \n\n\n    // Comment.\n    const b = 1;\n\n}\n\n\n",
    );
    let expected = "//! Text.\n\n/// More.\nmechanism m {\n    const a = 1;\n\n    // Comment.\n    const b = 1;\n}\n";
    assert_eq!(written, expected);
}

#[test]
fn line_ends_are_those_of_the_first_line() {
    assert_eq!(
        formatted("\u{feff}mechanism m {\r\n/* a\r\n  b */ const a=1;\n}"),
        "mechanism m {\r\n    /* a\r\n  b */ const a = 1;\r\n}\r\n"
    );
    assert_eq!(
        formatted("mechanism m {\nconst a=1; // x\r\n}"),
        "mechanism m {\n    const a = 1; // x\n}\n"
    );
}

#[test]
fn rejects_unreadable_text() {
    for text in [
        "",
        "// Nothing.",
        "mechanism m { const a = ; }",
        "mechanism m {",
    ] {
        let refused = format(&Source::new("bad.mech", text));
        assert!(refused.is_err_and(|found| found.has_errors()), "{text:?}");
    }
}
