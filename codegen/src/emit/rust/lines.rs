//! Lines as the formatter breaks them → lines as a person does.
//!
//! The formatter breaks at a width of its own, and then puts every element of a list on a line. Here what fits into a line is on
//! one, lists of short elements fill their lines, and sums break where the line ends. The tokens stay what they are, but for the
//! comma after a last element. What is not known to be safe to join stays as it is.

use crate::emit::lines::{filled, fits, terms};

/// Elements up to this length share a line with others.
const SHORT: usize = 36;

/// A line so deep, in several ones where it is too long and can be broken: a function's arguments or the elements of a list one below
/// the other, elements alone in lines that they fill, anything else between its terms.
pub(super) fn wrapped(content: &str, depth: usize) -> Vec<String> {
    let indented = |content: &str, depth: usize| format!("{:depth$}{content}", "");
    let whole = indented(content, depth);
    if fits(&whole) || content.starts_with("//") {
        return vec![whole];
    }
    let brackets = ["(", "["].into_iter().zip([") ", "],"]);
    for (open, close) in brackets {
        let is_it = match open {
            "(" => content.starts_with("fn ") || content.starts_with("pub fn "),
            _ => content.ends_with(close),
        };
        let (Some(start), Some(end)) = (content.find(open), content.rfind(close)) else {
            continue;
        };
        if is_it && start < end {
            let inner = elements(&content[start + 1..end]).into_iter();
            let inner = inner.flat_map(|it| wrapped(&format!("{it},"), depth + 4));
            let mut lines = vec![indented(&content[..=start], depth)];
            lines.extend(inner);
            lines.push(indented(&content[end..], depth));
            return lines;
        }
    }
    let all = elements(content);
    if content.ends_with(',') && all.len() > 1 {
        let all: Vec<String> = all.iter().map(|it| format!("{it},")).collect();
        return filled(all.iter().map(String::as_str), depth);
    }
    terms(content, depth).unwrap_or_else(|| vec![whole])
}

/// What commas outside of all brackets part.
fn elements(text: &str) -> Vec<&str> {
    let (mut found, mut start, mut open) = (Vec::new(), 0, 0_i32);
    for (place, letter) in text.char_indices() {
        match letter {
            '(' | '[' | '<' => open += 1,
            ')' | ']' | '>' => open -= 1,
            ',' if open == 0 => {
                found.push(text[start..place].trim());
                start = place + 1;
            }
            _ => {}
        }
    }
    found.push(text[start..].trim());
    found.retain(|element| !element.is_empty());
    found
}

/// Lines of code, broken anew.
pub(super) fn broken(lines: &[&str]) -> Vec<String> {
    let mut found = Vec::with_capacity(lines.len());
    let mut rest = lines;
    while let Some(first) = rest.first() {
        let depth = indentation(first);
        let belongs = |line: &&&str| {
            let own = indentation(line);
            own > depth || own == depth && line.trim_start().starts_with(['}', ']', ')'])
        };
        let count = 1 + rest[1..].iter().take_while(belongs).count();
        let (statement, others) = rest.split_at(count);
        rest = others;
        match statement.iter().any(|line| opens_or_closes_block(line)) {
            true => with_blocks(statement, depth, &mut found),
            false => found.extend(plain(statement, depth)),
        }
    }
    found
}

fn indentation(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

fn opens_or_closes_block(line: &str) -> bool {
    let content = line.trim_start();
    content.ends_with('{')
        || content.starts_with('}')
        || content.starts_with("//")
        || content.starts_with('#')
}

/// A statement or item with blocks in it: what stands before a block is joined where it fits, what stands in it is broken anew.
fn with_blocks(statement: &[&str], depth: usize, found: &mut Vec<String>) {
    let mut rest = statement;
    while let Some(first) = rest.first() {
        if indentation(first) > depth {
            let inner = rest
                .iter()
                .take_while(|line| indentation(line) > depth)
                .count();
            found.extend(broken(&rest[..inner]));
            rest = &rest[inner..];
            continue;
        }
        let next = rest[1..].iter().position(|line| indentation(line) == depth);
        let head = &rest[..next.map_or(1, |next| next + 2)];
        let opens = head.last().is_some_and(|line| line.ends_with('{'));
        let is_plain = |lines: &[&str]| !lines.iter().any(|line| opens_or_closes_block(line));
        let is_head = opens && is_plain(&head[..head.len() - 1]);
        let line = is_head.then(|| joined(head)).flatten();
        match line.filter(|line| fits(line)) {
            Some(line) => {
                found.push(line);
                rest = &rest[head.len()..];
            }
            None => {
                found.push(first.to_string());
                rest = &rest[1..];
            }
        }
    }
}

/// A statement without blocks.
fn plain(statement: &[&str], depth: usize) -> Vec<String> {
    let unchanged = || statement.iter().map(|line| line.to_string()).collect();
    let [first, inner @ .., last] = statement else {
        return unchanged();
    };
    let Some(whole) = joined(statement) else {
        return unchanged();
    };
    if fits(&whole) {
        return vec![whole];
    }
    let opens = first.ends_with(['(', '[']);
    if !(opens && indentation(last) == depth && inner.iter().all(|line| indentation(line) > depth))
    {
        return terms(&whole, depth).unwrap_or_else(unchanged);
    }
    let elements = broken(inner);
    let is_short = |line: &String| line.trim().len() <= SHORT && indentation(line) == depth + 4;
    let elements = match first.ends_with('[') && elements.iter().all(is_short) {
        true => filled(elements.iter().map(|line| line.trim()), depth + 4),
        false => elements,
    };
    [first.to_string()]
        .into_iter()
        .chain(elements)
        .chain([last.to_string()])
        .collect()
}

/// The lines as one; `None` where joining them could change what they mean.
fn joined(lines: &[&str]) -> Option<String> {
    let mut whole = lines.first()?.to_string();
    for line in &lines[1..] {
        let content = line.trim_start();
        let closes = content.starts_with([')', ']']);
        if closes && whole.ends_with(',') {
            whole.pop();
        }
        if whole.ends_with('|') || content.starts_with('|') {
            return None;
        }
        if !(closes || whole.ends_with(['(', '['])) {
            whole.push(' ');
        }
        whole.push_str(content);
    }
    Some(whole)
}

#[cfg(test)]
mod tests {
    use super::broken;

    fn anew(source: &str) -> String {
        broken(&source.lines().collect::<Vec<_>>()).join("\n")
    }

    #[test]
    fn what_fits_into_a_line_is_on_one() {
        let source = "fn f(\n    a: A,\n    b: B,\n) -> C {\n    return Err(\n        no(\n            1.0,\n            2.0,\n        ),\n    );\n}";
        assert_eq!(
            anew(source),
            "fn f(a: A, b: B) -> C {\n    return Err(no(1.0, 2.0));\n}"
        );
    }

    #[test]
    fn short_elements_fill_their_lines() {
        let list = |elements: &str| format!("let x = [\n{elements}];");
        let apart = "    1.25,\n".repeat(40);
        let [full, rest] = [19, 2].map(|count| format!("    {}\n", vec!["1.25,"; count].join(" ")));
        assert_eq!(anew(&list(&apart)), list(&format!("{full}{full}{rest}")));
    }

    #[test]
    fn a_sum_breaks_outside_of_brackets() {
        let term = "alpha * (beta - gamma)";
        let apart = format!("let x = {term}{}", format!("\n    + {term}").repeat(5));
        let line = format!("let x = {term}{}", format!(" + {term}").repeat(3));
        let last = format!("    + {term} + {term};");
        assert_eq!(anew(&format!("{apart};")), format!("{line}\n{last}"));
    }
}
