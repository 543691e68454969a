//! Breaks equations in LaTeX into displayed lines that fit on a page.
//!
//! A sum that is too wide continues on the next line, broken before a sign: outside all parentheses if that is early
//! enough, otherwise inside. Then the parentheses have one size, since `\left` and `\right` must stand on one line.
//! Braces are never broken.

/// Number of visible characters on a line, a remark included.
const MAX_LINE_WIDTH: usize = 105;

/// Width of the gap before a remark, in characters.
const GAP: usize = 6;

/// Shortest part into which a line is broken.
const SHORTEST: usize = 48;

/// Widest value of a choice.
const LONGEST_CHOICE: usize = 60;

/// Fraction of its width before which a line is not broken, as a divisor.
const EARLIEST: usize = 3;

/// Equation: the text left and right of its sign, and a remark, which may be empty.
#[derive(Clone, Copy, Debug)]
pub(in crate::emit) struct Line<'a> {
    pub left: &'a str,
    pub right: &'a str,
    pub note: &'a str,
}

/// Whole document, which requires only amsmath.
pub(in crate::emit) fn document(text: &str) -> String {
    format!(
        "\\documentclass[a4paper,10pt]{{article}}\n\
         \\usepackage{{amsmath}}\n\
         \\setlength{{\\textwidth}}{{17cm}}\n\
         \\setlength{{\\oddsidemargin}}{{-0.5cm}}\n\
         \\setlength{{\\textheight}}{{25cm}}\n\
         \\setlength{{\\topmargin}}{{-2cm}}\n\
         \\setlength{{\\parindent}}{{0pt}}\n\
         \\setlength{{\\parskip}}{{6pt}}\n\
         \\setcounter{{MaxMatrixCols}}{{12}}\n\
         \\allowdisplaybreaks\n\
         \\begin{{document}}\n\
         \\raggedright\n\
         {text}\
         \\end{{document}}\n"
    )
}

/// Fragment for a document with a preamble; its first lines state the requirements.
pub(in crate::emit) fn fragment(text: &str) -> String {
    format!(
        "% Needs \\usepackage{{amsmath}} in the preamble and nothing else.\n\
         % No line is wider than 17 cm in letters of 10 pt. Headings are \\section* and \\subsection*.\n\
         \\begingroup\n\
         \\setcounter{{MaxMatrixCols}}{{12}}\n\
         \\allowdisplaybreaks\n\
         \\setlength{{\\parindent}}{{0pt}}\n\
         \\setlength{{\\parskip}}{{6pt}}\n\
         \\raggedright\n\
         {text}\
         \\par\\endgroup\n"
    )
}

/// The heading of a mechanism.
pub(in crate::emit) fn title(name: &str) -> String {
    format!("\\section*{{Mechanism {name}}}\n")
}

/// Displayed equations, aligned at their signs.
pub(in crate::emit) fn displayed<'a>(equations: impl IntoIterator<Item = Line<'a>>) -> String {
    let equations: Vec<Line<'a>> = equations.into_iter().collect();
    // Remarks are a column of their own, with the width of the widest remark.
    let notes = equations.iter().filter(|it| !it.note.is_empty());
    let taken = notes.map(|it| GAP + width(it.note)).max().unwrap_or(0);
    let lines = equations.iter().map(|&Line { left, right, note }| {
        // If a sum vanishes, the sum is broken; otherwise the right side.
        let is_sum = left.contains(" + ") || left.contains(" - ");
        let sides = if right == "0" && is_sum {
            format!(
                "& {} = 0",
                broken(left, MAX_LINE_WIDTH.saturating_sub(taken))
            )
        } else {
            let room = MAX_LINE_WIDTH.saturating_sub(taken + width(left));
            format!("{left} &= {}", broken(right, room))
        };
        match note {
            "" => format!("  {sides}"),
            note => format!("  {sides} && \\text{{\\small {note}}}"),
        }
    });
    let lines: Vec<String> = lines.collect();
    format!(
        "\\begin{{align*}}\n{}\n\\end{{align*}}\n",
        lines.join(" \\\\\n")
    )
}

/// Value of a choice, on several lines if it is wide.
pub(super) fn chosen(value: &str) -> String {
    match width(value) <= LONGEST_CHOICE {
        true => value.to_string(),
        false => format!(
            "\\begin{{aligned}} &{} \\end{{aligned}}",
            broken(value, LONGEST_CHOICE)
        ),
    }
}

/// True if formulas fit beside one another as the row of a matrix that amsmath sets.
pub(super) fn fit_in_a_row<'a>(entries: impl Iterator<Item = &'a str>) -> bool {
    let widths = entries.map(|entry| width(entry) + 2);
    widths.sum::<usize>() <= MAX_LINE_WIDTH
}

/// Breaks a sum that exceeds `room` into several lines.
fn broken(formula: &str, room: usize) -> String {
    let room = room.max(SHORTEST);
    if width(formula) <= room {
        return formula.to_string();
    }
    let parts: Vec<&str> = formula.split(' ').collect();
    let breaks = breaks(&parts, room);
    let is_inside = breaks.iter().any(|it| it.depth > 0);
    let mut text = String::with_capacity(formula.len());
    let mut next = breaks.iter().map(|it| it.place).peekable();
    for (place, part) in parts.iter().enumerate() {
        if place > 0 {
            text.push(' ');
        }
        if next.next_if_eq(&place).is_some() {
            text.push_str("\\\\\n  &\\quad ");
        }
        text.push_str(part);
    }
    match is_inside {
        true => text
            .replace("\\left(", "\\bigl(")
            .replace("\\right)", "\\bigr)"),
        false => text,
    }
}

/// Position at which a formula can be broken: before a sign.
#[derive(Clone, Copy, Debug)]
struct Break {
    place: usize,
    /// Number of open parentheses.
    depth: usize,
    /// Width before it.
    before: usize,
}

/// Breaks of a formula so that no line is wider than `room`, as far as positions permit.
fn breaks(parts: &[&str], room: usize) -> Vec<Break> {
    let mut possible = Vec::new();
    let (mut parentheses, mut others, mut before) = (0_usize, 0_i32, 0);
    for (place, part) in parts.iter().enumerate() {
        if place > 0 && matches!(*part, "+" | "-") && others == 0 {
            possible.push(Break {
                place,
                depth: parentheses,
                before,
            });
        }
        before += shown(part) + 1;
        parentheses =
            (parentheses + part.matches('(').count()).saturating_sub(part.matches(')').count());
        others += part.matches('{').count() as i32 - part.matches('}').count() as i32;
        others += i32::from(part.contains("\\begin")) - i32::from(part.contains("\\end"));
    }
    let total = before;
    let mut breaks: Vec<Break> = Vec::new();
    loop {
        let start = breaks.last().map_or(0, |it| it.before);
        if total - start <= room {
            return breaks;
        }
        let ahead = |least: usize| possible.partition_point(|it| it.before < start + least);
        let fitting = &possible[ahead(room / EARLIEST)..ahead(room + 1)];
        // The shallowest one, and of those the last one; if none is early enough, the next one.
        let best = fitting
            .iter()
            .min_by_key(|it| (it.depth, usize::MAX - it.before));
        match best.or_else(|| possible.get(ahead(1))) {
            Some(next) => breaks.push(*next),
            None => return breaks,
        }
    }
}

/// Approximate number of visible characters of a line.
pub(super) fn width(text: &str) -> usize {
    text.split(' ').map(|part| shown(part) + 1).sum()
}

/// Approximate number of visible characters of a part: a command counts as one, braces and index marks as none.
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

    #[test]
    fn a_long_factor_is_broken_inside_its_parentheses() {
        let term = "\\frac{1 + x}{2} 1234567890";
        let factor = format!("x \\left({}\\right)", [term; 8].join(" + "));
        let text = broken(&factor, 60);
        assert!(
            text.lines().count() > 2 && text.lines().all(|it| width(it) <= 64),
            "{text}"
        );
        assert!(text.contains("\\bigl(") && text.contains("\\bigr)") && !text.contains("\\left("));
        assert_eq!(
            text.matches("\\frac{1 + x}{2}").count(),
            8,
            "fractions stay whole"
        );
    }
}
