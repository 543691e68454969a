//! A derivation → a LaTeX document.

use super::document::{DisplayedEquation, Document, Item, OutlineLine};

/// So many visible characters fit on a line, a remark included.
const LONGEST: usize = 105;

/// No line is broken into parts shorter than these.
const SHORTEST: usize = 48;

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
                Item::Paragraph(words) => text.push_str(&format!("\n{words}\n")),
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
                "{} & \\raggedright {} & {} & \\raggedright {} \\tabularnewline\n",
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

fn displayed(equations: &[DisplayedEquation]) -> String {
    let lines: Vec<String> = equations
        .iter()
        .map(|equation| {
            let (left, right) = (&equation.left, &equation.right);
            let taken = width(&equation.note);
            // Where a sum vanishes, the sum is broken; otherwise what it is equal to.
            let is_sum = left.contains(" + ") || left.contains(" - ");
            let sides = if right == "0" && is_sum {
                format!("& {} = 0", broken(left, LONGEST.saturating_sub(taken)))
            } else {
                let room = LONGEST.saturating_sub(taken + width(left));
                format!("{left} &= {}", broken(right, room))
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

/// A sum that needs more than `room` on several lines, broken before signs outside all brackets.
fn broken(formula: &str, room: usize) -> String {
    let room = room.max(SHORTEST);
    if width(formula) <= room {
        return formula.to_string();
    }
    let parts: Vec<&str> = formula.split(' ').collect();
    let mut text = String::with_capacity(formula.len());
    let (mut depth, mut length) = (0_i32, 0);
    for (at, part) in parts.iter().enumerate() {
        let sign = matches!(*part, "+" | "-");
        if at > 0 {
            text.push(' ');
        }
        if sign && depth == 0 && length > room / 2 {
            text.push_str("\\\\\n  &\\quad ");
            length = 0;
        }
        text.push_str(part);
        length += shown(part) + 1;
        let opened = part.matches(['(', '{']).count();
        let closed = part.matches([')', '}']).count();
        depth += opened as i32 - closed as i32;
        depth += i32::from(part.contains("\\begin")) - i32::from(part.contains("\\end"));
    }
    text
}

/// About how many characters of a line are seen.
fn width(text: &str) -> usize {
    text.split(' ').map(|part| shown(part) + 1).sum()
}

/// About how many characters of a part of a formula are seen: a command counts as one, braces and index marks as none.
fn shown(part: &str) -> usize {
    if part.starts_with("\\begin") || part.starts_with("\\end") {
        return 0;
    }
    let mut command = false;
    let seen = part.chars().filter(|&character| {
        let goes_on = command && character.is_ascii_alphabetic();
        command = character == '\\' || goes_on;
        !goes_on && !matches!(character, '{' | '}' | '_' | '^')
    });
    seen.count()
}

#[cfg(test)]
mod tests {
    use super::{broken, shown, width};

    #[test]
    fn only_what_is_seen_takes_room() {
        assert_eq!(shown("\\dot{\\varphi}_{\\mathrm{c10}}"), 6);
        assert_eq!(shown("0.5"), 3);
        assert_eq!(width("\\begin{pmatrix} 1 \\end{pmatrix}"), 4);
    }

    #[test]
    fn long_sums_are_broken_before_signs_outside_brackets() {
        assert_eq!(broken("a + b", 50), "a + b");
        let term = "\\left(1234567890 + 1234567890\\right)";
        let sum = [term; 5].join(" - ");
        let lines: Vec<String> = broken(&sum, 60).lines().map(str::to_string).collect();
        assert_eq!(lines.len(), 3);
        assert!(lines[1].trim_start().starts_with("&\\quad - \\left("));
        assert_eq!(lines.concat().matches("12345").count(), 10);
    }
}
