//! Scans words, numbers, quoted texts and unreadable characters, and edits them for `syn`.

use super::lengths::{number_length, word_length};
use super::{Fill, Kind, Scanner};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::syntax::unreadable;

impl Scanner<'_> {
    pub(super) fn word(&mut self) {
        let length = word_length(self.rest());
        let (start, end) = (self.at, self.at + length);
        if !self.rest()[..length].is_ascii() {
            let word = &self.text[start..end];
            let finding = Diagnostic::error(
                Code::NameNotAllowed,
                Span::new(start, end),
                format!("the name `{word}` is not ASCII"),
            )
            .label("names are made of `a` to `z`, `A` to `Z`, `0` to `9` and `_`");
            self.scan.report(finding.help(spelling(word)));
            self.scan.edit(start, end, Fill::Underscores);
        }
        self.lexeme(Kind::Word, length);
    }

    /// True if `table NAME =` precedes; a quoted text is allowed only there.
    pub(super) fn names_a_file(&self) -> bool {
        let [.., table, name, equals] = &self.scan.lexemes[..] else {
            return false;
        };
        table.kind == Kind::Word
            && &self.text[table.start..table.end] == "table"
            && name.kind == Kind::Word
            && equals.kind == Kind::Mark(b'=')
    }

    pub(super) fn text(&mut self) {
        let inside = &self.rest()[1..];
        let length = inside.find(|it: char| it == '"' || it.is_control());
        let start = self.at;
        let Some(length) = length.filter(|&length| inside[length..].starts_with('"')) else {
            let end = start + 1 + inside.find(['\n', '\r']).unwrap_or(inside.len());
            let span = Span::new(start, end);
            let finding = Diagnostic::error(
                Code::UnreadableCharacter,
                span,
                "a text without its closing quote",
            )
            .label("expected `\"` on this line")
            .help("write the path between quotes: `table lift = \"lift.csv\";`");
            self.scan.report(finding);
            self.scan.damage.push(start);
            self.scan.edit(start, end, Fill::Blank);
            self.fresh_line = false;
            self.at = end;
            return;
        };
        let end = start + length + 2;
        if inside[..length].contains('\\') {
            // Rust's lexer would read an escape; resolving the table rejects the path.
            self.scan.edit(start + 1, end - 1, Fill::Underscores);
        }
        self.lexeme(Kind::Text, length + 2);
    }

    pub(super) fn number(&mut self) {
        let length = number_length(self.rest());
        let (start, end) = (self.at, self.at + length);
        let number = &self.text[start..end];
        let base = match number.as_bytes() {
            [b'0', b'x' | b'X', ..] => Some("hexadecimal"),
            [b'0', b'o' | b'O', ..] => Some("octal"),
            [b'0', b'b' | b'B', ..] => Some("binary"),
            _ => None,
        };
        if let Some(base) = base {
            let message = format!("`{number}` is not a number of this language");
            let finding = Diagnostic::error(Code::OutsideGrammar, Span::new(start, end), message)
                .label(format!("`{}` starts a {base} number", &number[..2]))
                .help("write the number in decimal digits");
            self.scan.report(finding);
            self.scan.damage.push(start);
            self.scan.edit(start, end, Fill::Zeros);
        } else if !number.is_ascii() {
            let unit =
                number.trim_start_matches(|it: char| it.is_ascii_digit() || it == '.' || it == '_');
            let message = format!("the unit `{unit}` is not ASCII");
            let finding = Diagnostic::error(
                Code::NameNotAllowed,
                Span::new(end - unit.len(), end),
                message,
            );
            self.scan.report(finding.help(spelling(unit)));
            self.scan.edit(end - unit.len(), end, Fill::Underscores);
        }
        self.lexeme(Kind::Number, length);
    }

    pub(super) fn unreadable(&mut self, character: char) {
        let previous = self
            .scan
            .lexemes
            .last()
            .filter(|it| it.end == self.at && it.kind == Kind::Number);
        let number = previous.map(|it| &self.text[it.start..it.end]);
        let reading = unreadable::read(self.rest(), character, number);
        let (start, end) = (self.at, self.at + reading.length);
        let span = Span::new(start, end);
        let finding = Diagnostic::error(Code::UnreadableCharacter, span, reading.message);
        let help = reading.help.unwrap_or_else(|| "remove it".to_string());
        self.scan.report(finding.help(help));
        match reading.meant {
            Some(meant) => self.scan.edit(start, end, Fill::Text(meant)),
            None => {
                self.scan.damage.push(start);
                self.scan.edit(start, end, Fill::Blank);
            }
        }
        self.fresh_line = false;
        self.at = end;
    }
}

/// Suggests an ASCII spelling of a name or unit.
fn spelling(word: &str) -> String {
    match unreadable::ascii_spelling(word) {
        Some(spelled) => format!("write `{spelled}`"),
        None => "write it with other letters".to_string(),
    }
}
