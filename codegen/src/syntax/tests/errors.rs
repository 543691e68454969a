//! Each syntax code, as it is printed.

use super::{bad, codes};

#[test]
fn show() {
    let inside = |text: &str| format!("mechanism m {{\n    {text}\n}}\n");
    for text in [
        inside("const a = 30° + x² · π − φ(1);"),
        inside("const a = \"b\" @ 2;"),
        inside("const a = ;"),
        inside(
            "revolute P(1, 2)\n    absolute_x(1) = 0\n    const b = 2 const c = 3;\n    const d = 4",
        ),
        inside(
            "revolute P(1, 2;\n    body a at (0, 0 { A }\n    body b at (0, 0) { A, B\n    revolute Q(1, 2);",
        ),
        inside("revolute P 1, 2);\n    const a = (1];"),
        inside("body a at (0, 0) { A } }\n    const b = 1;"),
        "mechanism m {\n    body a at (0,".to_string(),
        "mechanism m {\n    const a = 1; /* never\n}".to_string(),
        "mechanism m".to_string(),
        "// nothing\n".to_string(),
        inside("bdy a at (0, 0) { A }\n    fix a;\n    drve phi(1) = 2;"),
        inside(
            "const a = 2 ** 3; const b = 2 t; const c = 2(3); const d = x.sin(); const e = 1e; const f = 0x10; const g = a[1]; const h = (1, 2); const i = a.sin(2);",
        ),
        inside("const 1 = 2; const _ = 3; body 01 at (0, 0); body 1.5 at (0, 0);"),
        inside(
            "body a at (0) { A: (1, 2, 3) B; C = (1, 2), D }\n    body b (0, 0) {}\n    body c at (0, 0, 1) turned 2;\n    body d at (0, 0)\n    body e at P, 30deg { A }",
        ),
        inside(
            "drive phi = 2; drive phi(1) + 2; gear(1, 2) = 3 along A -> B; slide(1, 2) along A; revolute P(0.5, (1));",
        ),
        "mechanism a {}\nmechanism b {}".to_string(),
        "mechanism a {} x".to_string(),
        "mechansim a { const b = }".to_string(),
        "body 1 at (0, 0) { P }\nrevolute P(1, 2)".to_string(),
        "hello world".to_string(),
        "mechanism { const a = 1; }".to_string(),
        "mechanism a const b = 1;\n point = 2; }".to_string(),
        inside(
            "point A = (1, 2) B = (2, 3);\n    const g = 5 m;\n    const x = f(a b);\n  revolute P(1 2);",
        ),
    ] {
        println!("{text}\n>>>>\n{}\n----", bad(&text));
    }
    assert!(codes("").len() == 1);
}
