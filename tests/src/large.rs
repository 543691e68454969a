//! Descriptions that are large in one respect, to check that work is proportional to the length of a text and ends.
//!
//! Each kind grows in proportion to its size: formulas, nests of every function, names, points, bodies, stations,
//! tables, mistakes. The motion of such a mechanism is irrelevant.

use std::fmt::Write as _;

/// Respect in which a description is large.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// Name of the repeated items.
    pub name: &'static str,
    /// Text of this size.
    pub text: fn(usize) -> String,
}

/// Numbered parts one after the other.
fn each(n: usize, part: impl Fn(usize) -> String) -> String {
    (0..n).fold(String::new(), |mut text, k| {
        // Writing into a string cannot fail.
        let _ = writeln!(text, "    {}", part(k));
        text
    })
}

/// Numbered parts with something between them.
fn joined(n: usize, between: &str, part: impl Fn(usize) -> String) -> String {
    let parts: Vec<String> = (0..n).map(part).collect();
    parts.join(between)
}

fn mechanism(statements: &str) -> String {
    format!("mechanism large {{\n{statements}}}\n")
}

/// One body that turns by a law, with statements before it.
fn turning(before: &str, law: &str) -> String {
    let body = "    body 1 at (0, 0);\n    absolute_x(1) = 0;\n    absolute_y(1) = 0;\n";
    mechanism(&format!("{before}{body}    drive phi(1) = {law};\n"))
}

/// Constants that each follow from the one before by a formula of `@`, and a body that turns with the last.
fn nested(first: &str, formula: &str, n: usize) -> String {
    let before = format!("    {first}\n");
    let chain = each(n, |k| {
        let named = formula.replace('@', &format!("c{k}"));
        format!("const c{} = {named};", k + 1)
    });
    turning(&(before + &chain), &format!("c{n}*t"))
}

/// Every function of the language, nested in itself through constants, from a number and from a parameter.
pub const NESTS: [&str; 12] = [
    "sin(@)",
    "cos(@)",
    "tan(@/4)",
    "asin(@/4)",
    "acos(@/4)",
    "atan(@)",
    "atan2(@, 3)",
    "sqrt(@ + 1)",
    "exp(-@)",
    "ln(@ + 2)",
    "(@ + 1)^0.3",
    "sin(@)*cos(@) + @",
];

/// A nest of one function, from a constant or from a parameter.
pub fn nest(formula: &str, from_parameter: bool, n: usize) -> String {
    let first = match from_parameter {
        true => "param p = 0.3;\n    const c0 = p;",
        false => "const c0 = 0.3;",
    };
    nested(first, formula, n)
}

/// Valid descriptions whose work is proportional to their size.
pub const KINDS: [Kind; 24] = [
    Kind {
        name: "terms of a sum",
        text: |n| turning("", &joined(n, " + ", |k| format!("sin({}*t)", k + 1))),
    },
    Kind {
        name: "terms of products",
        text: |n| {
            let term = |k| format!("sin({}*t)*cos({}*t)*t", k + 1, k + 2);
            turning("", &joined(n, " + ", term))
        },
    },
    Kind {
        name: "factors that are sines",
        text: |n| turning("", &joined(n, "*", |k| format!("sin({}*t)", k + 1))),
    },
    Kind {
        name: "factors that are sums",
        text: |n| turning("", &joined(n, "*", |k| format!("(t + {})", k + 1))),
    },
    Kind {
        name: "constants",
        text: |n| {
            let constants = each(n, |k| format!("const c{k} = {k}.5*sqrt({}) + 3;", k + 2));
            let sum = joined(n, " + ", |k| format!("c{k}"));
            turning(&constants, &format!("t + {sum}"))
        },
    },
    Kind {
        name: "parameters",
        text: |n| {
            let parameters = each(n, |k| format!("param p{k} = {k}.5;"));
            let sum = joined(n, " + ", |k| format!("p{k}"));
            turning(&parameters, &format!("({sum})*t"))
        },
    },
    Kind {
        name: "inputs",
        text: |n| {
            let inputs = each(n, |k| format!("input u{k} = {k}.5;"));
            turning(&inputs, &joined(n, " + ", |k| format!("u{k}")))
        },
    },
    Kind {
        name: "stations of a sequence",
        text: |n| {
            let stations = joined(n, ", ", |k| format!("({k}, {})", k % 2));
            turning("", &format!("sequence(t, modified_sine, {stations})"))
        },
    },
    Kind {
        name: "stations with dwells, repeated",
        text: |n| {
            let stations = joined(n, ", ", |k| format!("({k}, {})", (k / 2) % 3));
            let end = format!("({n}, 0)");
            turning(
                "",
                &format!("sequence(t, poly345, {stations}, {end}, periodic)"),
            )
        },
    },
    Kind {
        name: "rows of a table",
        text: |n| {
            let rows = joined(n, ", ", |k| format!("({k}, {})", k % 5));
            turning(&format!("    table f = [{rows}];\n"), "f(t)")
        },
    },
    Kind {
        name: "tables",
        text: |n| {
            let tables = each(n, |k| format!("table f{k} = [(0, 0), (1, {k}), (2, 1)];"));
            turning(&tables, &joined(n, " + ", |k| format!("f{k}(t)")))
        },
    },
    Kind {
        name: "drawn points of one body",
        text: |n| {
            let points = each(n, |k| format!("point P{k} = ({k}, {});", k % 7));
            let carried = joined(n, ", ", |k| format!("P{k}"));
            mechanism(&format!(
                "{points}    body b at P0 {{ {carried} }}\n    revolute P0(ground, b);\n    drive phi(b) = t;\n"
            ))
        },
    },
    Kind {
        name: "points in the frame of a body",
        text: |n| {
            let carried = joined(n, ", ", |k| format!("P{k}: ({k}, {})", k % 7));
            mechanism(&format!(
                "    point A = (0, 0);\n    body b at A {{ A, {carried} }}\n    revolute A(ground, b);\n    drive phi(b) = t;\n"
            ))
        },
    },
    Kind {
        name: "points that are asked for",
        text: |n| {
            let points = each(n, |k| format!("point P{k} = ({k}, {});", k % 7));
            let carried = joined(n, ", ", |k| format!("P{k}"));
            mechanism(&format!(
                "{points}    body b at P0 {{ {carried} }}\n    revolute P0(ground, b);\n    drive phi(b) = t;\n    output {carried};\n"
            ))
        },
    },
    Kind {
        name: "driven bodies",
        text: |n| {
            let bodies = each(n, |k| {
                format!("body b{k} at A {{ A }} revolute A(ground, b{k}); drive phi(b{k}) = {k}*t;")
            });
            mechanism(&format!("    point A = (0, 0);\n{bodies}"))
        },
    },
    Kind {
        name: "dyads",
        text: crate::dyad_chain::description,
    },
    Kind {
        name: "links of an open chain",
        text: |n| {
            let points = each(n + 1, |k| format!("point P{k} = ({k}, 0);"));
            let bodies = each(n, |k| format!("body b{k} at P{k} {{ P{k}, P{} }}", k + 1));
            let joints = each(n, |k| match k {
                0 => "revolute P0(ground, b0); drive phi(b0) = t;".to_string(),
                _ => format!(
                    "revolute P{k}(b{0}, b{k}); drive relative_angle(b{0}, b{k}) = t;",
                    k - 1
                ),
            });
            mechanism(&(points + &bodies + &joints))
        },
    },
    Kind {
        name: "bodies welded to one another, the last first",
        text: |n| {
            let bodies = each(n, |k| format!("body b{k} at A {{ A, B }}"));
            let welds = each(n - 1, |k| format!("weld (b{}, b{});", n - 2 - k, n - 1 - k));
            mechanism(&format!(
                "    point A = (0, 0), B = (1, 0);\n{bodies}{welds}    revolute A(ground, b0);\n    drive phi(b0) = t;\n"
            ))
        },
    },
    Kind {
        name: "slides",
        text: |n| {
            let slides = each(n, |k| {
                format!(
                    "point A{k} = (1, {k}), B{k} = (2, {k}); body b{k} at A{k} facing A{k} -> B{k} {{ B{k} }} translational (ground, b{k}) along A{k} -> B{k}; drive length(A{k}, B{k}) = 1 + 0.1*sin(t);"
                )
            });
            mechanism(&slides)
        },
    },
    Kind {
        name: "contacts with one curve",
        text: |n| {
            let followers = each(n, |k| {
                format!(
                    "body f{k} at (1.25, 0.1) {{ P{k}: (0, 0) }} absolute_y(f{k}) = 0.1; absolute_angle(f{k}) = 0; point_on_curve (f{k}.P{k}, rim);"
                )
            });
            mechanism(&format!(
                "    point O = (0, 0);\n    body c at O {{ O }}\n    revolute O(ground, c);\n    drive phi(c) = t;\n    curve rim(s) on c = (1.2*cos(s), sin(s));\n{followers}"
            ))
        },
    },
    Kind {
        name: "unknowns of one equation",
        text: |n| {
            let bodies = each(n, |k| format!("body b{k} at (0, 0);"));
            let held = each(n, |k| {
                let angle = match k {
                    0 => String::new(),
                    _ => format!(" equation phi(b{k}) = {k}*t;"),
                };
                format!("equation x(b{k}) = 0; equation y(b{k}) = 0;{angle}")
            });
            let sum = joined(n, " + ", |k| format!("sin(phi(b{k}))"));
            mechanism(&format!("{bodies}{held}    equation {sum} = 0;\n"))
        },
    },
    Kind {
        name: "bodies of one block",
        text: |n| {
            ring(n, |of, next| {
                format!("equation x({of}) = 0.1*{next}.P.x; equation y({of}) = 0.1*{next}.P.y;")
            })
        },
    },
    Kind {
        name: "equations that follow one another",
        text: |n| {
            let bodies = each(n, |k| {
                format!("body b{k} at A {{ A }} revolute A(ground, b{k});")
            });
            let equations = each(n - 1, |k| {
                format!("equation phi(b{}) = 2*phi(b{k}) + sin(phi(b{k}));", k + 1)
            });
            mechanism(&format!(
                "    point A = (0, 0);\n{bodies}    drive phi(b0) = t;\n{equations}"
            ))
        },
    },
    Kind {
        name: "lines of documentation",
        text: |n| each(n, |k| format!("/// line {k}")) + &turning("", "t"),
    },
];

/// Ring of n bodies with interdependent angles, which are solved together.
pub fn ring(n: usize, held: fn(&str, &str) -> String) -> String {
    let bodies = each(n, |k| format!("body b{k} at (0, 0) {{ P: (1, 0) }}"));
    let equations = each(n, |k| {
        let [of, next] = [k, (k + 1) % n].map(|k| format!("b{k}"));
        let held = held(&of, &next);
        format!("{held} equation phi({of}) + 0.1*sin(phi({next})) = {k}*t + 0.3;")
    });
    mechanism(&(bodies + &equations))
}

/// Invalid descriptions of any size, refused in proportional time.
pub const MISTAKES: [Kind; 7] = [
    Kind {
        name: "unknown names",
        text: |n| turning(&each(n, |k| format!("const c{k} = d{k};")), "t"),
    },
    Kind {
        name: "unknown names in one formula",
        text: |n| {
            let constants = each(n, |k| format!("const c{k} = {k};"));
            turning(&constants, &joined(n, " + ", |k| format!("d{k}")))
        },
    },
    Kind {
        name: "names declared twice on one line",
        text: |n| mechanism(&joined(n, " ", |k| format!("const c = {k};"))),
    },
    Kind {
        name: "open brackets",
        text: |n| mechanism(&"(".repeat(n)),
    },
    Kind {
        name: "missing semicolons",
        text: |n| mechanism(&each(n, |k| format!("const c{k} = 1"))),
    },
    Kind {
        name: "joints that say the same",
        text: |n| {
            mechanism(&format!(
                "    body 1 at (0, 0);\n{}",
                each(n, |_| "absolute_x(1) = 0;".to_string())
            ))
        },
    },
    Kind {
        name: "joints of points that no body has",
        text: |n| {
            let points = each(n, |k| format!("point P{k} = ({k}, 0);"));
            let joints = each(n, |k| format!("revolute Q{k}(ground, b);"));
            mechanism(&format!("{points}    body b at P0 {{ P0 }}\n{joints}"))
        },
    },
];

/// Constant whose number of terms doubles with each of few statements.
pub fn doubling_constants() -> String {
    const PRIMES: [u32; 20] = [
        2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71,
    ];
    let chain = each(PRIMES.len(), |k| {
        format!("const c{} = c{k}*sqrt({}) + c{k};", k + 1, PRIMES[k])
    });
    turning(
        &format!("    const c0 = 1;\n{chain}"),
        &format!("c{}*t", PRIMES.len()),
    )
}

/// Bodies each of which faces a point of the one before.
pub fn facing_one_another(n: usize) -> String {
    let bodies = each(n, |k| {
        let toward = match k {
            0 => "P1".to_string(),
            _ => format!("b{}.Q", k - 1),
        };
        format!(
            "body b{k} at P0 facing P0 -> {toward} {{ P0, Q: (1.1, 0.3) }} revolute P0(ground, b{k}); drive phi(b{k}) = t;"
        )
    });
    mechanism(&format!(
        "    const a = 0.7;\n    point P0 = (0, 0), P1 = (cos(a), sin(a));\n{bodies}"
    ))
}

/// Mechanism with m motions and n points.
pub fn motions(n: usize, m: usize) -> String {
    let points = each(n, |k| format!("point P{k} = ({k}, {});", k % 7));
    let motions = each(m, |k| format!("motion m{k} {{ drive phi(b) = {k}*t; }}"));
    mechanism(&format!(
        "{points}    body b at P0 {{ P0 }}\n    revolute P0(ground, b);\n{motions}"
    ))
}

/// Mechanism with n drivers and their transmission to one body.
pub fn transmission(n: usize) -> String {
    let text = (KINDS[16].text)(n);
    let statements = text.trim_end().trim_end_matches('}');
    format!("{statements}    transmission phi(b{});\n}}\n", n - 1)
}
