//! Every form of the grammar, and the shape of formulas.

use super::super::*;
use super::{EXCAVATOR, TWO_BODY, good};

/// Returns a formula with every node in parentheses and chains in `{…}`.
fn shape(expression: &Expression) -> String {
    match &expression.kind {
        ExpressionKind::Number { digits, unit } => {
            format!(
                "{digits}{}",
                unit.as_ref()
                    .map_or(String::new(), |unit| format!("'{}", unit.text))
            )
        }
        ExpressionKind::Reference(reference) => written(reference),
        ExpressionKind::Component(component) => {
            format!("{}.{}", written(&component.point), component.axis.text)
        }
        ExpressionKind::Sum(terms) => {
            let terms: Vec<String> = terms
                .iter()
                .map(|(sign, term)| {
                    format!(
                        "{}{}",
                        if *sign == Sign::Plus { '+' } else { '-' },
                        shape(term)
                    )
                })
                .collect();
            format!("{{{}}}", terms.join(" "))
        }
        ExpressionKind::Product(factors) => {
            let factors: Vec<String> = factors
                .iter()
                .map(|(operation, factor)| {
                    format!(
                        "{}{}",
                        if *operation == Operation::Times {
                            '*'
                        } else {
                            '/'
                        },
                        shape(factor)
                    )
                })
                .collect();
            format!("{{{}}}", factors.join(" "))
        }
        ExpressionKind::Negative(inner) => format!("(-{})", shape(inner)),
        ExpressionKind::Power(base, exponent) => format!("({}^{})", shape(base), shape(exponent)),
        ExpressionKind::Call {
            function,
            arguments,
        } => {
            format!(
                "{}({})",
                function.text,
                arguments.iter().map(shape).collect::<Vec<_>>().join(", ")
            )
        }
        ExpressionKind::Choice(choice) => format!(
            "[{} {:?} {} ? {} : {}]",
            shape(&choice.left),
            choice.comparison,
            shape(&choice.right),
            shape(&choice.holds),
            shape(&choice.otherwise)
        ),
        ExpressionKind::Components(parts) => {
            let parts: Vec<String> = parts.iter().map(shape).collect();
            format!("({})", parts.join(", "))
        }
    }
}

fn written(reference: &Reference) -> String {
    match &reference.body {
        Some(body) => format!("{}.{}", body.text, reference.name.text),
        None => reference.name.text.clone(),
    }
}

fn formula(text: &str) -> (String, String) {
    let whole = format!("mechanism m {{ const a = {text}; }}");
    match &good(&whole).mechanism.statements[..] {
        [Statement::Constant(constant)] => (
            shape(&constant.value),
            whole[constant.value.span.range()].to_string(),
        ),
        other => panic!("{other:?}"),
    }
}

#[test]
fn precedence() {
    for (text, expected) in [
        ("1 + 2 * 3", "{+1 +{*2 *3}}"),
        ("a - b + c - d", "{+a -b +c -d}"),
        ("a / b * c / d", "{*a /b *c /d}"),
        ("a - (b - c)", "{+a -{+b -c}}"),
        ("-x^2", "(-(x^2))"),
        ("2^-1", "(2^(-1))"),
        ("2^3^4", "(2^(3^4))"),
        ("(2^3)^4", "((2^3)^4)"),
        ("2^-x^y", "(2^(-(x^y)))"),
        ("-a * -b", "{*(-a) *(-b)}"),
        ("-a + b", "{+(-a) +b}"),
        ("--a", "(-(-a))"),
        ("+-+a", "(-a)"),
        ("a--b", "{+a -(-b)}"),
        ("f(a, -b, g(c),)", "f(a, (-b), g(c))"),
        ("f()", "f()"),
        ("f((a, b), (c))", "f((a, b), c)"),
        ("if a < b { c } else { d }", "[a Less b ? c : d]"),
        (
            "2 * (if a >= 1 { b } else if a > 0 { c }\n else {\n f(a)\n })",
            "{*2 *[a GreaterOrEqual 1 ? b : [a Greater 0 ? c : f(a)]]}",
        ),
        (
            "f(if a <= b { c } else { d }, e)",
            "f([a LessOrEqual b ? c : d], e)",
        ),
        ("c1.A + 1.P * 1 .Q - 1. R", "{+c1.A +{*1.P *1.Q} -1.R}"),
        ("2. * 1.5", "{*2. *1.5}"),
        ("30deg + 1_000.5e-3mm", "{+30'deg +1000.5e-3'mm}"),
    ] {
        assert_eq!(formula(text), (expected.to_string(), text.to_string()));
    }
}

#[test]
fn every_statement_of_the_seeds() {
    let document = good(TWO_BODY);
    assert_eq!(document.docs, vec!["ME 451 midterm, problem B."]);
    assert_eq!(document.mechanism.name.text, "two_body");
    assert_eq!(document.mechanism.statements.len(), 7);
    let Statement::Body(body) = &document.mechanism.statements[0] else {
        panic!("a body")
    };
    assert_eq!(body.name.text, "1");
    let Orientation::Angle(angle) = &body.orientation else {
        panic!("an angle")
    };
    assert_eq!(shape(angle), "30'deg");
    let Statement::Joint(joint) = &document.mechanism.statements[4] else {
        panic!("a joint")
    };
    assert_eq!(joint.kind.text, "revolute");
    assert_eq!(joint.name.as_ref().map(|it| it.text.as_str()), Some("P"));
    assert_eq!(
        joint.operands.iter().map(written).collect::<Vec<_>>(),
        vec!["1", "2"]
    );
    assert_eq!(&TWO_BODY[joint.span.range()], "revolute P(1, 2);");

    let document = good(EXCAVATOR);
    let statements = &document.mechanism.statements;
    let Statement::Points(points) = &statements[2] else {
        panic!("points")
    };
    assert_eq!(
        points
            .points
            .iter()
            .map(|it| it.name.text.as_str())
            .collect::<Vec<_>>(),
        vec!["M", "L", "B"]
    );
    let Statement::Body(carrier) = &statements[3] else {
        panic!("a body")
    };
    assert_eq!(carrier.orientation, Orientation::Aligned);
    assert!(
        carrier
            .members
            .iter()
            .all(|it| matches!(it, Member::Carried { .. }))
    );
    let Statement::Body(facing) = &statements[4] else {
        panic!("a body")
    };
    let Orientation::Facing(direction) = &facing.orientation else {
        panic!("a direction")
    };
    assert_eq!(
        (written(&direction.from), written(&direction.to)),
        ("N".to_string(), "M".to_string())
    );
    let Statement::Body(turned) = &statements[5] else {
        panic!("a body")
    };
    assert!(matches!(
        (&turned.origin, &turned.orientation),
        (Origin::Point(_), Orientation::Angle(_))
    ));
    let Statement::Joint(slide) = &statements[8] else {
        panic!("a joint")
    };
    assert_eq!(
        slide.along.as_ref().map(|it| written(&it.from)),
        Some("c8.N".to_string())
    );
    let Statement::Drive(drive) = &statements[9] else {
        panic!("a driver")
    };
    assert_eq!(drive.docs, vec!["Extends the boom."]);
    assert_eq!(
        (drive.quantity.text.as_str(), drive.name.is_none()),
        ("length", true)
    );
    let Statement::Drive(named) = &statements[10] else {
        panic!("a driver")
    };
    assert_eq!(named.name.as_ref().map(|it| it.text.as_str()), Some("boom"));
    assert_eq!(written(&named.operands[1]), "1.M");
}

#[test]
fn forms_that_the_seeds_do_not_have() {
    let document = good(
        "//! File.\n//! More.\n\n/// Outer.\nmechanism m {\n    //! Inner.\n    /** A block\n     * of lines. */\n    const g = 9.81;\n\
         \x20   body a at (1, 2) turned g {\n        /// The tip.\n        P: (1, 0),\n        Q,\n    };\n    body b at (0, 0) {}\n\
         \x20   body c at (0, 0)\n        facing P -> Q;\n    gear(a, b, c.P,) along P -> Q = 2 pressure_angle 20deg;\n    const type = 1; absolute_x(1.P) = 1;\n}",
    );
    assert_eq!(document.docs, vec!["File.", "More."]);
    assert_eq!(document.mechanism.docs, vec!["Outer.", "Inner."]);
    let [
        Statement::Constant(constant),
        Statement::Body(body),
        _,
        _,
        Statement::Joint(gear),
        _,
        Statement::Joint(x),
    ] = &document.mechanism.statements[..]
    else {
        panic!("{document:?}")
    };
    assert_eq!(constant.docs, vec!["A block", "of lines."]);
    let [Member::Local { docs, .. }, Member::Carried { .. }] = &body.members[..] else {
        panic!("{body:?}")
    };
    assert_eq!(docs, &vec!["The tip."]);
    assert!(
        gear.name.is_none()
            && gear.along.is_some()
            && gear.value.is_some()
            && gear.pressure_angle.is_some()
            && gear.operands.len() == 3
    );
    assert_eq!(written(&x.operands[0]), "1.P");
}
