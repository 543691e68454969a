//! Colors messages for stderr if a terminal shows them.
//!
//! Output to a file or another program has no colors, nor has a terminal if `NO_COLOR` is set or the terminal is dumb. The text of a
//! message is unchanged.

use std::env;
use std::io::IsTerminal as _;

const RESET: &str = "\u{1b}[0m";
const BOLD: &str = "\u{1b}[1m";
const RED: &str = "\u{1b}[1;31m";
const YELLOW: &str = "\u{1b}[1;33m";
const BLUE: &str = "\u{1b}[1;34m";
const GREEN: &str = "\u{1b}[1;32m";

/// Returns the message in the form that stderr displays best.
pub fn on_terminal(text: &str) -> String {
    let is_set = |name: &str| env::var_os(name).is_some_and(|value| !value.is_empty());
    let is_dumb = env::var_os("TERM").is_some_and(|terminal| terminal == "dumb");
    match std::io::stderr().is_terminal() && !is_set("NO_COLOR") && !is_dumb {
        true => colored(text),
        false => text.to_string(),
    }
}

/// Colors the message line by line.
fn colored(text: &str) -> String {
    let lines = text.split('\n').map(line);
    lines.collect::<Vec<_>>().join("\n")
}

fn line(text: &str) -> String {
    for (word, color) in [("error", RED), ("warning", YELLOW)] {
        // The line is `error: …` or `error[K07]: …`.
        if let Some((head, rest)) = text.split_once(": ")
            && let Some(code) = head.strip_prefix(word)
            && (code.is_empty() || code.starts_with('[') && code.ends_with(']'))
        {
            return format!("{color}{head}{RESET}{BOLD}: {rest}{RESET}");
        }
    }
    let trimmed = text.trim_start();
    let indent = &text[..text.len() - trimmed.len()];
    for (mark, color) in [
        ("--> ", BLUE),
        ("::: ", BLUE),
        ("= help", GREEN),
        ("= note", BLUE),
    ] {
        if let Some(rest) = trimmed.strip_prefix(mark) {
            return format!("{indent}{color}{mark}{RESET}{rest}");
        }
    }
    // The line is `12 | the line` or `   |    ^^^ the fault`.
    if let Some((number, rest)) = trimmed.split_once('|')
        && number.trim_end().bytes().all(|it| it.is_ascii_digit())
        && (rest.is_empty() || rest.starts_with(' '))
    {
        let is_marked = number.is_empty() && rest.trim_start().starts_with(['^', '-']);
        let rest = match is_marked {
            true => format!("{RED}{rest}{RESET}"),
            false => rest.to_string(),
        };
        return format!("{indent}{BLUE}{number}|{RESET}{rest}");
    }
    text.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    const MESSAGE: &str = "\
error[K11]: no point is named `Hing`
 --> arm.mech:3:17
  |
3 |     body rod at Hing { A }
  |                 ^^^^ not declared above
  |
  = help: did you mean `Hinge`?

error: 1 error in arm.mech";

    #[test]
    fn only_colors_are_added() {
        let mut plain = colored(MESSAGE);
        assert!(plain.starts_with("\u{1b}[1;31merror[K11]\u{1b}[0m\u{1b}[1m: no point"));
        assert!(plain.contains("\n\u{1b}[1;34m3 |\u{1b}[0m     body rod"));
        assert!(plain.contains("\u{1b}[1;31m                 ^^^^ not declared above\u{1b}[0m"));
        for color in [RESET, BOLD, RED, YELLOW, BLUE, GREEN] {
            plain = plain.replace(color, "");
        }
        assert_eq!(plain, MESSAGE);
    }

    #[test]
    fn other_text_stays_as_it_is() {
        for text in ["", "wrote a.svg", "errors are: none", "a | b", "  a: b"] {
            assert_eq!(colored(text), text);
        }
    }
}
