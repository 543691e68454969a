//! Scans comments: keeps documentation and hides the rest from `syn`.

use super::{Comment, Documentation, Scanner};
use crate::diagnostic::{Code, Diagnostic, Span};

impl Scanner<'_> {
    pub(super) fn line_comment(&mut self) {
        let length = self.rest().find('\n').unwrap_or(self.rest().len());
        let comment = &self.rest()[..length];
        let inner = comment.starts_with("//!");
        let is_documentation = inner || comment.starts_with("///") && !comment.starts_with("////");
        self.note_comment(length, is_documentation);
        if is_documentation {
            let comment = &self.rest()[..length];
            let lines = vec![documentation_line(&comment[3..])];
            self.document(inner, lines, length);
        }
        self.skip(length);
    }

    pub(super) fn block_comment(&mut self) {
        let start = self.at;
        let Some(length) = block_comment_length(self.rest()) else {
            let end = self.text.trim_end().len();
            let finding = Diagnostic::error(
                Code::UnexpectedEnd,
                Span::empty(end),
                "the file ends inside a comment",
            )
            .label("expected `*/`")
            .also(Span::new(start, start + 2), "the comment starts here")
            .help("close the comment with `*/`, or start it with `//`");
            self.scan.report(finding);
            self.scan.damage.push(start);
            self.note_comment(self.rest().len(), false);
            self.skip(self.rest().len());
            return;
        };
        let comment = &self.rest()[..length];
        let inner = comment.starts_with("/*!");
        let is_documentation =
            inner || comment.starts_with("/**") && !comment.starts_with("/***") && length > 4;
        self.note_comment(length, is_documentation);
        if is_documentation {
            let comment = &self.rest()[..length];
            let content = comment[3..length - 2].trim();
            let lines = content.lines().map(|line| {
                let line = line.trim_start();
                documentation_line(line.strip_prefix('*').unwrap_or(line))
            });
            let lines = lines.collect();
            self.document(inner, lines, length);
        }
        self.skip(length);
    }

    fn note_comment(&mut self, length: usize, is_documentation: bool) {
        self.scan.comments.push(Comment {
            span: Span::new(self.at, self.at + length),
            is_documentation,
        });
    }

    fn document(&mut self, inner: bool, lines: Vec<String>, length: usize) {
        let span = Span::new(self.at, self.at + length);
        self.scan.documentation.push(Documentation {
            inner,
            lines,
            span,
            before: self.at,
        });
    }

    pub(super) fn settle_documentation(&mut self) {
        for comment in &mut self.scan.documentation[self.pending_documentation..] {
            comment.before = self.at;
        }
        self.pending_documentation = self.scan.documentation.len();
    }
}

/// Returns the length of a block comment with nested comments; `None` if it is not closed.
pub(crate) fn block_comment_length(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let mut depth = 0_usize;
    let mut at = 0;
    while at + 1 < bytes.len() {
        match (bytes[at], bytes[at + 1]) {
            (b'/', b'*') => {
                depth += 1;
                at += 2;
            }
            (b'*', b'/') => {
                depth -= 1;
                at += 2;
                if depth == 0 {
                    return Some(at);
                }
            }
            _ => at += 1,
        }
    }
    None
}

fn documentation_line(line: &str) -> String {
    line.strip_prefix(' ')
        .unwrap_or(line)
        .trim_end()
        .to_string()
}
