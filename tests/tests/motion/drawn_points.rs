//! A drawn point that no body carries, named alone, is the one that the ground carries: in every statement that takes a point.

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::read;
use linkwright_codegen::stages::check;
use linkwright_codegen::stages::emit::{Notation, text};

/// A crank with a statement about the drawn point S; `{S}` stands where the point is named.
fn crank(statement: &str, point: &str) -> String {
    let statement = statement.replace("{S}", point);
    format!(
        "mechanism case {{
            point A = (0, 0), S = (0, 1);
            body 1 at A {{ A, P: (0.5, 0), Q: (1, 0.5) }}
            body 2 at (0.3, 0.2) {{ R: (0.1, 0.2) }}
            revolute A(ground, 1);
            {statement}
        }}"
    )
}

/// The equations as text, with the point under one name and without the widths of columns.
fn equations(description: &str) -> Vec<String> {
    let source = Source::new("case.mech", description);
    let read = read(&source).unwrap_or_else(|found| panic!("{}", found.render(&source)));
    let derived = read.only().expect("one motion");
    let page = text::inspect(&derived, Notation::Ascii).replace("ground.S", "S");
    page.split_whitespace().map(str::to_string).collect()
}

#[test]
fn a_point_that_no_body_carries_is_one_of_the_ground() {
    for statement in [
        "drive distance({S}, 1.P) = 1.2;",
        "drive distance(1.P, {S}) = 1.2;",
        "drive relative_x(1.P, {S}) = t;",
        "drive relative_y({S}, 1.P) = t;",
        "relative_x ({S}, 1.P) = 0.1;",
        "relative_distance ({S}, 1.P) = 1.2;",
        "absolute_distance (1.P, {S}) = 1.2;",
        "revolute ({S}, 2.R);",
        "revolute (2.R, {S});",
        "revolute_revolute (1.P, {S}) = 1.2;",
        "point_on_line ({S}, 1) along P -> Q;",
        "revolute_translational (1, {S}) along P -> Q;",
        "equation distance({S}, 1.P) = 1.2;",
        "curve rim(s) on 2 = (0.1*cos(s), 0.2*sin(s)); point_on_curve touch({S}, rim);",
    ] {
        let [alone, with_ground] = ["S", "ground.S"].map(|name| equations(&crank(statement, name)));
        assert_eq!(alone, with_ground, "{statement}");
        assert!(alone.len() > 50, "{statement}");
    }
}

#[test]
fn a_body_of_the_same_name_is_meant_first() {
    let of = |point: &str| {
        let text = format!(
            "mechanism case {{
                point A = (0, 0), S = (3, 3);
                body S at A {{ A, P: (1, 0) }}
                body 1 at (2, 0) {{ B: (1, 0) }}
                revolute A(ground, S);
                drive phi(S) = t;
                drive distance({point}, 1.B) = 2;
                relative_angle (S, 1) = 0;
                drive y(1) = 0;
            }}"
        );
        let source = Source::new("case.mech", text.as_str());
        let derived = read(&source).ok().and_then(|read| read.only());
        let derived = derived.expect("a good description");
        check(&derived).expect("as many equations as coordinates");
        text::inspect(&derived, Notation::Ascii)
    };
    // The origin of the body S is where A is; the drawn point is named with the ground.
    let body = of("S");
    let row = body.lines().find(|line| line.contains("drive distance"));
    assert!(row.is_some_and(|row| row.contains("x_S")), "{body}");
    let ground = of("ground.S");
    let row = ground.lines().find(|line| line.contains("drive distance"));
    assert!(row.is_some_and(|row| !row.contains("x_S")), "{ground}");
}
