//! Escapes prose as Markdown in which `rustdoc` finds no test, item or tag.
//!
//! `cargo test` would run a block of code as a test. So blocks that stand alone become plain text, and all others, in lists and quotes,
//! become paragraphs. Brackets and tags such as `<T>` are escaped; an address becomes a link. Paragraphs, lists, quotes, emphasis, code
//! within a line and links to the web are kept.
//!
//! Each line is escaped alone, since code within a line ends in that line. Nothing left open in another line can swallow an escape. The
//! rules are those of CommonMark 0.31.2 (<https://spec.commonmark.org/0.31.2/>).

/// Maximum indentation of a line that is not a block of code.
const MAX_INDENT: usize = 3;

/// Returns the lines as Markdown.
pub(super) fn inert<S: AsRef<str>>(lines: impl IntoIterator<Item = S>) -> Vec<String> {
    let lines: Vec<String> = lines.into_iter().map(|it| printable(it.as_ref())).collect();
    let mut escaped = Vec::with_capacity(lines.len());
    let (mut at, mut after_blank, mut in_list) = (0, true, false);
    while at < lines.len() {
        let (depth, content) = parts(&lines[at]);
        if content.is_empty() {
            escaped.push(String::new());
            (at, after_blank) = (at + 1, true);
            continue;
        }
        if let Some(end) = end_of_fence(&lines, at) {
            block(&lines[at + 1..end], depth, &mut escaped);
            (at, after_blank, in_list) = (end + 1, false, false);
            continue;
        }
        if depth > MAX_INDENT && after_blank && !in_list {
            let end = end_of_indented(&lines, at);
            block(&lines[at..end], MAX_INDENT + 1, &mut escaped);
            (at, after_blank) = (end, false);
            continue;
        }
        let marked = marker(content).is_some_and(|(mark, _)| mark != ">");
        in_list = marked || in_list && (depth > 0 || !after_blank);
        let indent = " ".repeat(depth.min(MAX_INDENT));
        escaped.push(format!("{indent}{}", line(content)));
        (at, after_blank) = (at + 1, false);
    }
    while escaped.last().is_some_and(String::is_empty) {
        escaped.pop();
    }
    escaped
}

/// Returns the line without control characters and changes of writing direction.
fn printable(line: &str) -> String {
    let is_visible = |it: &char| {
        !it.is_control() && !matches!(it, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    let line = line.trim_end().replace('\t', "    ");
    line.chars().filter(is_visible).collect()
}

/// Returns the indentation and the content of a line.
fn parts(line: &str) -> (usize, &str) {
    let content = line.trim();
    (line.len() - line.trim_start().len(), content)
}

/// Returns the line that ends the fence beginning in line `start`; `None` if no fence begins or the fence is not closed.
fn end_of_fence(lines: &[String], start: usize) -> Option<usize> {
    let (depth, opening) = parts(&lines[start]);
    let (fence, length) = run(opening)?;
    let is_fence = matches!(fence, '`' | '~') && length >= 3 && depth <= MAX_INDENT;
    if !is_fence || (fence == '`' && opening[length..].contains('`')) {
        return None;
    }
    let closes = |line: &String| {
        let (depth, closing) = parts(line);
        let closing = run(closing).filter(|(_, count)| *count == closing.len());
        depth <= MAX_INDENT && closing.is_some_and(|(it, count)| it == fence && count >= length)
    };
    let inside = lines[start + 1..].iter().position(closes)?;
    Some(start + 1 + inside)
}

/// Returns the first character of a text, if it is ASCII, and its number of repetitions.
fn run(text: &str) -> Option<(char, usize)> {
    let first = text.chars().next().filter(char::is_ascii)?;
    Some((first, text.len() - text.trim_start_matches(first).len()))
}

/// Returns the end of the lines indented as a block of code.
fn end_of_indented(lines: &[String], start: usize) -> usize {
    let is_inside = |line: &&String| {
        let (depth, content) = parts(line);
        depth > MAX_INDENT || content.is_empty()
    };
    let mut end = start + lines[start..].iter().take_while(is_inside).count();
    while lines[end - 1].trim().is_empty() {
        end -= 1;
    }
    end
}

/// Writes a block of plain text, with the indentation reduced by `depth`.
fn block(lines: &[String], depth: usize, escaped: &mut Vec<String>) {
    let longest = lines.iter().flat_map(|line| {
        line.split(|it| it != '`')
            .map(str::len)
            .filter(|length| *length > 0)
    });
    let fence = "`".repeat(longest.max().map_or(3, |longest| longest.max(2) + 1));
    escaped.push(format!("{fence}text"));
    for line in lines {
        let cut = parts(line).0.min(depth);
        escaped.push(line.get(cut..).unwrap_or_default().to_string());
    }
    escaped.push(fence);
}

/// Returns the mark of a list or a quote at the beginning of a text, and the text behind it.
fn marker(text: &str) -> Option<(&str, &str)> {
    let digits = text.len()
        - text
            .trim_start_matches(|it: char| it.is_ascii_digit())
            .len();
    let length = match text.as_bytes().get(digits)? {
        b'>' | b'-' | b'+' | b'*' if digits == 0 => 1,
        b'.' | b')' if (1..10).contains(&digits) => digits + 1,
        _ => return None,
    };
    let (mark, rest) = text.split_at(length);
    let is_mark = mark == ">" || rest.is_empty() || rest.starts_with(' ');
    is_mark.then(|| (mark, rest.trim_start()))
}

/// Returns one escaped line, with a single blank behind marks of lists and quotes, so that no code is indented there.
fn line(mut content: &str) -> String {
    let mut text = String::new();
    while let Some((mark, rest)) = marker(content) {
        text.push_str(mark);
        if !rest.is_empty() {
            text.push(' ');
        }
        content = rest;
    }
    let mut rest = content;
    // Markdown splits the cells of a table before it reads code within a line.
    let is_cut = spans(content).any(|span| span.contains('|'));
    while let Some(next) = rest.chars().next() {
        let taken = match next {
            '`' => match span(rest) {
                Some(code) if !(is_cut && has_live(code)) => keep(code, &mut text),
                _ => escape(rest, '`', &mut text),
            },
            '~' if rest.starts_with("~~~") => escape(rest, '~', &mut text),
            // Otherwise the backslash would escape the mark that is put before an address.
            '\\' if escaped(rest) == "\\" && rest != "\\" => escape(&rest[..1], '\\', &mut text),
            '\\' => keep(escaped(rest), &mut text),
            '[' => match link(rest).filter(|_| !text.ends_with('!')) {
                Some(link) => keep(link, &mut text),
                None => escape(&rest[..1], '[', &mut text),
            },
            '<' => match automatic_link(rest) {
                Some(link) => keep(link, &mut text),
                None if begins_tag(rest) => escape(&rest[..1], '<', &mut text),
                None => keep("<", &mut text),
            },
            _ => match address(rest) {
                "" => keep(&rest[..next.len_utf8()], &mut text),
                address => {
                    text.push_str(&format!("<{address}>"));
                    address.len()
                }
            },
        };
        rest = &rest[taken..];
    }
    text
}

fn keep(part: &str, text: &mut String) -> usize {
    text.push_str(part);
    part.len()
}

/// Escapes all repetitions of a character. Returns their number.
fn escape(rest: &str, character: char, text: &mut String) -> usize {
    let length = rest.len() - rest.trim_start_matches(character).len();
    for _ in 0..length {
        text.push('\\');
        text.push(character);
    }
    length
}

/// Returns the code within a line at the beginning of a text, with its equally many backticks on both sides.
fn span(text: &str) -> Option<&str> {
    let (_, length) = run(text).filter(|(it, _)| *it == '`')?;
    let mut at = length;
    loop {
        at += text[at..].find('`')?;
        let (_, count) = run(&text[at..])?;
        at += count;
        if count == length {
            return Some(&text[..at]);
        }
    }
}

/// Returns all code within a line.
fn spans(mut text: &str) -> impl Iterator<Item = &str> {
    std::iter::from_fn(move || {
        loop {
            let at = text.find(['`', '\\'])?;
            text = &text[at..];
            let code = span(text);
            let length = match code {
                Some(code) => code.len(),
                None if text.starts_with('\\') => escaped(text).len(),
                None => run(text)?.1,
            };
            text = &text[length..];
            if code.is_some() {
                return code;
            }
        }
    })
}

/// True if the text would need escapes outside of code.
fn has_live(code: &str) -> bool {
    code.contains(['[', '<']) || code.contains("://") || code.contains("~~~")
}

/// Returns a backslash with the mark that it escapes, if any.
fn escaped(text: &str) -> &str {
    let mark = text[1..].starts_with(|it: char| it.is_ascii_punctuation());
    &text[..if mark { 2 } else { 1 }]
}

const SCHEMES: [&str; 2] = ["https://", "http://"];

/// `[words](https://…)`
fn link(text: &str) -> Option<&str> {
    let (words, rest) = text[1..].split_once(']')?;
    let target = rest.strip_prefix('(')?;
    let (target, _) = target.split_once(')')?;
    let is_plain = |it: char| !it.is_whitespace() && !"()<>[]`\\\"|".contains(it);
    let is_web = SCHEMES.iter().any(|it| target.starts_with(it)) && target.chars().all(is_plain);
    let are_words = !words.trim().is_empty()
        && !words.contains(['[', '`', '<', '\\', '|', '~'])
        && !words.contains("://");
    (is_web && are_words).then(|| &text[..words.len() + target.len() + 4])
}

/// `<https://…>`
fn automatic_link(text: &str) -> Option<&str> {
    let (target, _) = text[1..].split_once('>')?;
    let is_plain = |it: char| !it.is_whitespace() && it != '<';
    let is_web = SCHEMES.iter().any(|it| target.starts_with(it));
    (is_web && target.chars().all(is_plain)).then(|| &text[..target.len() + 2])
}

fn begins_tag(text: &str) -> bool {
    text[1..].starts_with(|it: char| it.is_ascii_alphabetic() || matches!(it, '/' | '!' | '?'))
}

/// Returns the address at the beginning of a text, without punctuation behind it; empty if there is none.
fn address(text: &str) -> &str {
    let Some(scheme) = SCHEMES.iter().find(|it| text.starts_with(**it)) else {
        return "";
    };
    let ends = |it: char| it.is_whitespace() || "<>[]`\\\"|".contains(it);
    let end = text.find(ends).unwrap_or(text.len());
    let address = text[..end].trim_end_matches(['.', ',', ';', ':', '!', '?', ')', '\'', '*', '_']);
    if address.len() > scheme.len() {
        address
    } else {
        ""
    }
}

#[cfg(test)]
mod tests {
    use super::inert;

    fn of(text: &str) -> String {
        inert(text.lines()).join("\n")
    }

    #[test]
    fn plain_prose_is_left_as_it_is() {
        for text in [
            "The distance is e |cos φ|/(R + r), where a < b and c <= d ~ e.",
            "- a list\n  of `code` and *words*,\n- and 2 > 1\n\n> a quote",
            "1. one\n2. two\n\n# A heading\n\n| a | b |\n|---|---|\n| `c` | d |",
            "`[Q]`, `` `<T>` `` and \\[, \\`, \\\\",
            "<https://example.org/a_b> and [a page](https://example.org/c?d=e#f).",
            "a hard break\\\nand a *b* _c_ ~~d~~",
        ] {
            assert_eq!(of(text), text);
        }
    }

    #[test]
    fn a_block_of_code_becomes_one_of_text() {
        for (text, expected) in [
            ("```\nlet a = [1];\n```", "```text\nlet a = [1];\n```"),
            ("~~~rust\n<T>\n~~~~\nend", "```text\n<T>\n```\nend"),
            ("````should_panic\n```\n````", "````text\n```\n````"),
            ("  ```\n    a\n   b\n  ```", "```text\n  a\n b\n```"),
            (
                "one\n\n    a\n\n      b\n\ntwo",
                "one\n\n```text\na\n\n  b\n```\n\ntwo",
            ),
            ("\ta = b;", "```text\na = b;\n```"),
            ("```\n```", "```text\n```"),
            ("```\n[Q]\n ```\n", "```text\n[Q]\n```"),
        ] {
            assert_eq!(of(text), expected, "{text}");
        }
    }

    #[test]
    fn a_line_that_only_resembles_a_block_is_escaped() {
        for (text, expected) in [
            // Open to the end, in a list, in a quote, deeper than a fence may be.
            ("```rust\n[Q]", "\\`\\`\\`rust\n\\[Q]"),
            ("- ```\n  <T>\n  ```", "- \\`\\`\\`\n  \\<T>\n  \\`\\`\\`"),
            ("> ~~~\n> a\n> ~~~", "> \\~\\~\\~\n> a\n> \\~\\~\\~"),
            (
                "-     a\n1.\t\tb\n>     c\n> -     d",
                "- a\n1. b\n> c\n> - d",
            ),
            ("- a\n\n      b\n\n    c", "- a\n\n   b\n\n   c"),
            ("text\n      continued", "text\n   continued"),
            ("```` ``` ````", "```` ``` ````"),
            ("``` a ` b", "\\`\\`\\` a \\` b"),
        ] {
            assert_eq!(of(text), expected, "{text}");
        }
    }

    #[test]
    fn nothing_in_a_line_names_an_item_or_opens_a_tag() {
        for (text, expected) in [
            ("[Q], Vec<T> and <b>", "\\[Q], Vec\\<T> and \\<b>"),
            (
                "[`Q`] [a](b) [c][d] [e]: f",
                "\\[`Q`] \\[a](b) \\[c]\\[d] \\[e]: f",
            ),
            ("![a](https://b.c)", "!\\[a](<https://b.c>)"),
            ("</p> <!-- --> <?x?>", "\\</p> \\<!-- --> \\<?x?>"),
            (
                "see https://a.b/c, (http://d.e).",
                "see <https://a.b/c>, (<http://d.e>).",
            ),
            ("`open [Q]", "\\`open \\[Q]"),
            ("a\\b \\https://a.b/c \\", "a\\\\b \\\\<https://a.b/c> \\"),
            ("``two ` [Q]``", "``two ` [Q]``"),
            // In a table the second bar would end the code.
            ("| `a | [Q]` |", "| \\`a | \\[Q]\\` |"),
            ("a\u{202e}b\rc\u{0}\td", "abc    d"),
        ] {
            assert_eq!(of(text), expected, "{text}");
        }
    }
}
