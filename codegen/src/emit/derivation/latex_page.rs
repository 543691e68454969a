//! A derivation → a LaTeX document.

use super::document::{Document, Equation, Item, OutlineLine};

/// A right-hand side with more characters of source than these is broken before a sign.
const LONGEST: usize = 150;

/// The whole document; it needs amsmath and nothing else.
pub(super) fn page(document: &Document) -> String {
    let mut text = format!(
        "\\documentclass[a4paper,10pt]{{article}}\n\
         \\usepackage{{amsmath}}\n\
         \\setlength{{\\textwidth}}{{17cm}}\n\
         \\setlength{{\\oddsidemargin}}{{-0.5cm}}\n\
         \\setlength{{\\textheight}}{{25cm}}\n\
         \\setlength{{\\topmargin}}{{-2cm}}\n\
         \\setlength{{\\parindent}}{{0pt}}\n\
         \\setlength{{\\parskip}}{{6pt}}\n\
         \\allowdisplaybreaks\n\
         \\begin{{document}}\n\
         \\section*{{Mechanism {}}}\n{}\n\n{}",
        document.name,
        document.summary,
        outline(&document.outline)
    );
    for section in &document.sections {
        text.push_str(&format!("\n\\subsection*{{{}}}\n", section.heading));
        for item in &section.items {
            match item {
                Item::Paragraph(words) => text.push_str(&format!("{words}\n")),
                Item::Equations(equations) => text.push_str(&displayed(equations)),
            }
        }
    }
    text.push_str("\\end{document}\n");
    text
}

fn outline(lines: &[OutlineLine]) -> String {
    let rows: Vec<String> = lines
        .iter()
        .map(|line| {
            format!(
                "{} & {} & {} & {} \\\\\n",
                line.block, line.unknowns, line.method, line.joints
            )
        })
        .collect();
    format!(
        "{{\\small\n\\begin{{tabular}}{{lp{{6.5cm}}lp{{5.5cm}}}}\n\
         block & unknowns & method & joints \\\\ \\hline\n{}\\end{{tabular}}}}\n",
        rows.concat()
    )
}

fn displayed(equations: &[Equation]) -> String {
    let lines: Vec<String> = equations
        .iter()
        .map(|equation| {
            // Where zero stands on the right, what is broken is the left.
            let sides = if equation.right == "0" {
                format!("& {} = 0", broken(&equation.left))
            } else {
                format!("{} &= {}", equation.left, broken(&equation.right))
            };
            if equation.note.is_empty() {
                format!("  {sides}")
            } else {
                format!("  {sides} && \\text{{\\small {}}}", equation.note)
            }
        })
        .collect();
    format!(
        "\\begin{{align*}}\n{}\n\\end{{align*}}\n",
        lines.join(" \\\\\n")
    )
}

/// A long sum on several lines, broken before signs outside all brackets.
fn broken(formula: &str) -> String {
    if formula.len() <= LONGEST {
        return formula.to_string();
    }
    let mut text = String::with_capacity(formula.len());
    let (mut depth, mut length) = (0_i32, 0);
    let parts: Vec<&str> = formula.split(' ').collect();
    for (at, part) in parts.iter().enumerate() {
        let sign = matches!(*part, "+" | "-");
        if at > 0 {
            text.push(' ');
        }
        if sign && depth == 0 && length > LONGEST / 2 {
            text.push_str("\\\\\n  &\\quad ");
            length = 0;
        }
        text.push_str(part);
        length += part.len() + 1;
        let opened = part.matches(['(', '{']).count() + part.matches("\\begin").count();
        let closed = part.matches([')', '}']).count() + part.matches("\\end").count();
        depth += opened as i32 - closed as i32;
    }
    text
}
