//! Heads of invocations: attributes, visibility and options.

use crate::expansion::expand;

const CRANK: &str = "mechanism crank {
    /// The arm.
    body 1 at (0, 0) { A: (1, 0) }
    absolute_x(1) = 0;
    absolute_y(1) = 0;
    drive phi(1) = t;
}";

/// Expansion as text.
fn expanded(head: &str, description: &str) -> String {
    let input = format!("{head}\n{description}").parse().expect("tokens");
    expand(input).to_string()
}

/// Errors without their locations.
fn errors(head: &str, description: &str) -> Vec<String> {
    let text = expanded(head, description);
    let parts = text.split(":: core :: compile_error ! {").skip(1);
    parts.map(|part| part.trim().to_string()).collect()
}

#[test]
fn attributes_and_visibility_are_those_of_the_module() {
    let text = expanded("/// Words.\n#[cfg(test)] pub(crate)", CRANK);
    let head = text.split("use :: linkwright").next().unwrap_or_default();
    assert!(head.starts_with("# [doc = \" Words.\"]"), "{head}");
    assert!(head.contains("# [cfg (test)]"), "{head}");
    assert!(head.ends_with("pub (crate) mod crank { "), "{head}");
    let text = expanded("", CRANK);
    assert!(text.contains("] mod crank {"), "{text}");
    assert!(text.starts_with("# [doc = \" The mechanism `crank`.\"]"));
    let walker = "pub mechanism walker { part leg = crank; }";
    let text = expanded("", &format!("{CRANK}\n/// Both.\n{walker}"));
    assert!(text.contains("] pub mod walker {"), "{text}");
    assert!(text.starts_with("# [doc = \" Both.\"]"), "{text}");
    let errors_of_several = errors("pub", &format!("{CRANK}\n{walker}"));
    assert!(!errors_of_several.is_empty(), "{errors_of_several:?}");
    let text = expanded("pub", &CRANK.replace("crank", "type"));
    assert!(text.contains("pub mod r#type {"), "{text}");
    let text = expanded("pub", &CRANK.replace("crank", "BigCrank"));
    assert!(text.contains("non_snake_case"), "{text}");
}

#[test]
fn options_choose_scalar_and_functions() {
    let uses = |head: &str| {
        let text = expanded(head, CRANK);
        let start = text.find("use ::").expect("a module");
        text[start..]
            .split(';')
            .next()
            .unwrap_or_default()
            .replace(' ', "")
    };
    assert_eq!(uses(""), "use::linkwright::generated::double::*");
    assert_eq!(
        uses("#![scalar(f64)]"),
        "use::linkwright::generated::double::*"
    );
    assert_eq!(
        uses("#![scalar(f32)]"),
        "use::linkwright::generated::single::*"
    );
    let text = expanded("#![math(crate::Plain)]", CRANK);
    assert!(text.contains("use crate :: Plain as math"), "{text}");
}

#[test]
fn options_that_do_not_exist_are_errors() {
    for (head, expected) in [
        ("#![scalar(f16)]", "the scalar `f16` is neither"),
        ("#![scalar]", "unknown option"),
        ("#![speed(f32)]", "unknown option"),
        ("#![scalar(f32)] #![scalar(f32)]", "`scalar` is given twice"),
        ("#![math(1)]", "which is not the path of a type"),
    ] {
        let expansion = expanded(head, CRANK);
        assert!(expansion.contains("compile_error"), "{head}: {expansion}");
        assert!(expansion.contains(expected), "{head}: {expansion}");
    }
    // Together with those of the description.
    let both_errors = errors("#![scalar(f16)]", &CRANK.replace("= t", "= s"));
    assert_eq!(both_errors.len(), 2, "{both_errors:?}");
    assert!(both_errors[1].contains("K11: "), "{both_errors:?}");
}

#[test]
fn errors_say_code_cause_and_help() {
    assert_eq!(
        errors("", &CRANK.replace("= t", "= sine(t)")),
        [
            "\"K13: unknown function `sine`\\nnot a function of this language\\nhelp: did you mean `sin`?\" }"
        ]
    );
    let error_texts = errors("", "");
    assert!(error_texts[0].contains("K06: "), "{error_texts:?}");
    let error_texts = errors("", &CRANK.replace("crank", "super"));
    assert!(
        error_texts[0].contains("Rust reserves this word"),
        "{error_texts:?}"
    );
}

#[test]
fn warnings_are_deprecated_constants() {
    let text = expanded("", &CRANK.replace("= t;", "= t; /// nothing"));
    let expected = "# [deprecated (note = \"this comment documents nothing\\nhelp: write `//` for a comment that is not documentation\")] const K02 : () = () ; K02";
    assert!(text.contains(expected), "{text}");
    // Beside errors as well.
    let text = expanded("", &CRANK.replace("= t;", "= s; /// nothing"));
    assert!(text.contains(expected) && text.contains("K11: "), "{text}");
}
