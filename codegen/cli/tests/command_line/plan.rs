//! `linkwright plan` from the outside.

use crate::folder::{EXAM, Folder};

#[test]
fn every_format_derives_the_solution() {
    let folder = Folder::new("plan", EXAM);
    for (format, texts) in [
        (
            "text",
            ["no Newton-Raphson", "cos(phi2) = 1 - sqrt(3)*cos(phi1)/3"],
        ),
        (
            "unicode",
            ["no Newton-Raphson", "cos φ₂ = 1 − √3·cos(φ₁)/3"],
        ),
        ("latex", ["\\begin{document}", "\\cos \\varphi_{2} &= 1 - "]),
    ] {
        let ran = folder
            .run(&format!("plan a.mech --format {format}"))
            .exits_with(0);
        for text in texts {
            assert!(ran.stdout.contains(text), "{text} in {}", ran.stdout);
        }
        assert!(ran.stdout.ends_with('\n'), "{format}");
        assert_eq!(ran.stderr, "");
    }
    let text = folder.run("plan a.mech").exits_with(0).stdout;
    assert_eq!(
        text,
        folder.run("plan a.mech --format text").exits_with(0).stdout
    );
    folder.run("plan a.mech --format rust").exits_with(2);
    let help = folder.run("plan --help").exits_with(0).stdout;
    assert!(help.contains("linkwright plan mechanisms/"), "{help}");
}

#[test]
fn nothing_is_derived_where_the_motion_is_not_determined() {
    let folder = Folder::new(
        "plan_undetermined",
        EXAM.replace("absolute_x(2) = sqrt(3);", ""),
    );
    let ran = folder.run("plan a.mech").exits_with(2);
    assert_eq!(ran.stdout, "");
    assert!(ran.stderr.contains("error[K3"), "{}", ran.stderr);
}

/// Comments name the packages that a document of one's own needs; its preamble is not repeated.
#[test]
fn a_fragment_of_latex_has_no_preamble() {
    let folder = Folder::new("latex_fragment", EXAM);
    for command in ["plan", "inspect"] {
        let whole = folder.run(&format!("{command} a.mech --format latex"));
        let whole = whole.exits_with(0).stdout;
        let ran = folder.run(&format!("{command} a.mech --format latex --fragment"));
        let fragment = ran.exits_with(0).stdout;
        for word in [
            "documentclass",
            "{document}",
            "textwidth",
            "\\usepackage{amsmath}\n",
        ] {
            assert!(
                whole.contains(word) && !fragment.contains(word),
                "{word} in {fragment}"
            );
        }
        let first = fragment.lines().next().expect("a line");
        assert!(
            first.starts_with('%') && first.contains("amsmath"),
            "{first}"
        );
        let body = |text: &str, start: &str| {
            let text = text.split(start).nth(1).expect("its beginning").to_string();
            text.rsplit_once("\\end").expect("its end").0.to_string()
        };
        assert_eq!(
            body(&fragment, "\\raggedright\n\\section").trim_end_matches("\\par"),
            body(&whole, "\\raggedright\n\\section"),
            "{command}"
        );
        for other in ["", "--format unicode", "--format text"] {
            let ran = folder
                .run(&format!("{command} a.mech {other} --fragment"))
                .exits_with(2);
            assert!(ran.stderr.contains("--format latex"), "{}", ran.stderr);
        }
    }
}
