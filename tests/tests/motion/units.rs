//! Units that are products, quotients and powers of units.

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::{Options, generate};

/// A spring and gravity in these units, below a declaration.
fn sprung(declared: &str, stiffness: &str, gravity: &str) -> Source {
    let text = format!(
        "mechanism sprung {{
            {declared}
            point O = (0, 0), W = (0, 1);
            body arm at O {{ O, P: (0.5, 0) }}
            mass arm = 2kg;
            gravity = (0, -{gravity});
            revolute O(ground, arm);
            spring (ground.W, arm.P) = {stiffness} free 0.1;
            drive phi(arm) = t;
            effort;
        }}"
    );
    Source::new("sprung.mech", text)
}

fn generated(source: &Source) -> Result<String, Diagnostics> {
    generate(source, &Options::default()).map(|it| it.code().to_string())
}

#[test]
fn units_are_joined_without_blanks() {
    let same = |[stiffness, gravity]: [&str; 2]| {
        let source = sprung("", stiffness, gravity);
        generated(&source).unwrap_or_else(|errors| panic!("{}", errors.render(&source)))
    };
    let plain = same(["4500", "9.81"]);
    for written in [
        ["4.5N/mm", "9.81m/s^2"],
        ["4.5N/1mm", "981cm/s^2"],
        ["4500kg/s^2", "9.81N/kg"],
        ["4500Nm/m^2", "9.81m*Hz^2"],
        ["4.5kN*m/m^2", "9.81m*s^-2"],
        ["2*2250N/m", "9.81kg*m/s^2/kg"],
    ] {
        assert_eq!(same(written), plain, "{written:?}");
    }
}

#[test]
fn declared_names_are_not_units() {
    let source = sprung("const mm = 1mm/2;", "2.25N/mm", "9.81");
    let plain = sprung("", "4500", "9.81");
    assert_eq!(
        generated(&source).map_err(|errors| errors.render(&source)),
        generated(&plain).map_err(|errors| errors.render(&plain))
    );
    // t is the time, not a ton, and no constant.
    for (stiffness, what) in [
        ("4.5N/t", "this depends on `t`"),
        ("4.5N / mm", "no constant is named `mm`"),
        ("4.5/mm", "no constant is named `mm`"),
    ] {
        let source = sprung("", stiffness, "9.81");
        let errors = generated(&source).expect_err(stiffness).render(&source);
        assert!(errors.contains(what), "{stiffness}: {errors}");
    }
}
