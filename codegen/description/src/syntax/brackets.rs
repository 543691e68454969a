//! Balances brackets before `syn` reads the text.
//!
//! Unmatched brackets are reported with the location of their opening. Edits make the text balanced, and never deeper than
//! [`MAX_DEPTH`].
//!
//! The shape of the text tells where a bracket should have been closed. A `;`, or a brace other than that of an `if`, is never
//! inside parentheses. A line that [starts a statement](StatementStarts) is not inside the braces of a body.

use super::scan::{Fill, Kind, Scan};
use super::statement_shapes::{
    continues_after, excess_of_closing_braces, looks_like_statement, opens_piece, opens_statements,
    word,
};
use super::{KEYWORDS, MAX_DEPTH};
use crate::diagnostic::{Code, Diagnostic, Span};

/// Maximum number of open brackets in a message, innermost first.
const MAX_SHOWN_BRACKETS: usize = 3;

/// Maximum number of missing brackets that a message writes out.
const MAX_SHOWN_CLOSINGS: usize = 8;

/// Offsets of lines that start a statement, ascending.
pub(super) struct StatementStarts(Vec<usize>);

impl StatementStarts {
    pub(super) fn contains(&self, offset: usize) -> bool {
        self.0.binary_search(&offset).is_ok()
    }
}

/// An open bracket.
struct Opener {
    bracket: u8,
    at: usize,
    /// True for the braces of a mechanism or a motion, which contain statements.
    holds_statements: bool,
    /// True for braces after `if` or `else`, which contain a formula.
    holds_formula: bool,
    /// True if the bracket is nested too deeply; the pair is then hidden from `syn`.
    hidden: bool,
}

/// Balances the brackets of a scan; adds findings and edits to the scan.
pub(super) fn balance(text: &str, scan: &mut Scan) -> StatementStarts {
    let lexemes = std::mem::take(&mut scan.lexemes);
    let mut balance = Balance {
        scan,
        open: Vec::new(),
        braces: 0,
        formulas: 0,
        too_deep: false,
    };
    let excess = excess_of_closing_braces(&lexemes);
    let mut starts = Vec::new();
    for (index, lexeme) in lexemes.iter().enumerate() {
        let previous = index.checked_sub(1).map(|before| &lexemes[before]);
        let end_of_previous = previous.map_or(lexeme.start, |it| it.end);
        // Within a formula, a call at the start of a line starts no statement.
        let in_formula =
            balance.formulas > 0 && word(text, lexeme).is_none_or(|word| !KEYWORDS.contains(&word));
        if !in_formula && looks_like_statement(text, &lexemes[index..]) {
            let continues = previous.is_some_and(|it| continues_after(it.kind));
            if !continues {
                starts.push(lexeme.start);
            }
            // A motion in a motion means a missing brace only if some brace stays open.
            let next_motion =
                word(text, lexeme) == Some("motion") && excess[index] < balance.braces;
            balance.before_statement(end_of_previous, continues, next_motion);
        }
        match lexeme.kind {
            Kind::Open(bracket) => {
                let holds_formula = bracket == b'{' && opens_piece(text, &lexemes[..index]);
                if bracket == b'{' && !holds_formula {
                    balance.close_parentheses(end_of_previous);
                }
                let holds_statements = bracket == b'{'
                    && (balance.open.is_empty() || opens_statements(text, &lexemes[..index]));
                balance.open(bracket, lexeme.start, holds_statements, holds_formula);
            }
            Kind::Mark(b';') => balance.close_formulas(end_of_previous),
            Kind::Close(bracket) => {
                if bracket == b'}' {
                    balance.close_parentheses(end_of_previous);
                }
                let more_follows = excess[index + 1] > 0
                    && lexemes
                        .get(index + 1)
                        .is_some_and(|next| word(text, next) != Some("mechanism"));
                balance.close(bracket, lexeme.start, more_follows);
            }
            Kind::Word | Kind::Number | Kind::Text | Kind::Mark(_) => {}
        }
    }
    balance.end(text);
    scan.lexemes = lexemes;
    StatementStarts(starts)
}

struct Balance<'a> {
    scan: &'a mut Scan,
    open: Vec<Opener>,
    /// Number of open braces.
    braces: isize,
    /// Number of open braces that contain formulas.
    formulas: usize,
    too_deep: bool,
}

impl Balance<'_> {
    fn open(&mut self, bracket: u8, at: usize, holds_statements: bool, holds_formula: bool) {
        let hidden = self.open.len() >= MAX_DEPTH;
        if hidden {
            self.scan.edit(at, at + 1, Fill::Blank);
            self.scan.damage.push(at);
            if !self.too_deep {
                self.too_deep = true;
                self.scan.report(too_deep(Span::new(at, at + 1)));
            }
        }
        self.braces += isize::from(bracket == b'{');
        self.formulas += usize::from(holds_formula);
        self.open.push(Opener {
            bracket,
            at,
            holds_statements,
            holds_formula,
            hidden,
        });
    }

    /// Removes and returns the innermost opener if it satisfies the predicate.
    fn take_if(&mut self, is_meant: impl FnOnce(&Opener) -> bool) -> Option<Opener> {
        let opener = self.open.pop_if(|opener| is_meant(opener))?;
        self.braces -= isize::from(opener.bracket == b'{');
        self.formulas -= usize::from(opener.holds_formula);
        Some(opener)
    }

    /// Closes all parentheses and square brackets above the innermost brace.
    fn close_parentheses(&mut self, place: usize) {
        while let Some(opener) = self.take_if(|opener| opener.bracket != b'{') {
            self.insert(&opener, place);
        }
    }

    /// Closes all brackets opened within a formula.
    fn close_formulas(&mut self, place: usize) {
        self.close_parentheses(place);
        while let Some(opener) = self.take_if(|opener| opener.holds_formula) {
            self.insert(&opener, place);
            self.close_parentheses(place);
        }
    }

    /// Closes what should have ended before a line that starts a statement: brackets within the braces of the mechanism or
    /// motion, and a motion before the next motion.
    fn before_statement(&mut self, place: usize, continues: bool, next_motion: bool) {
        if !continues {
            self.close_formulas(place);
        }
        let must_close =
            |opener: &Opener| opener.bracket == b'{' && (next_motion || !opener.holds_statements);
        if self.braces >= 2
            && let Some(opener) = self.take_if(must_close)
        {
            self.insert(&opener, place);
        }
    }

    /// Reports a bracket that should have been closed at `place`, and closes it there.
    fn insert(&mut self, opener: &Opener, place: usize) {
        let closing = closing(opener.bracket);
        self.scan.damage.push(place);
        if opener.hidden {
            return;
        }
        self.scan
            .edit(place, place, Fill::Text(closing.to_string()));
        let opening = opener.bracket as char;
        let message = format!("unclosed `{opening}`");
        let finding = Diagnostic::error(Code::UnbalancedBracket, Span::empty(place), message)
            .label(format!("expected `{closing}`"))
            .also(
                Span::new(opener.at, opener.at + 1),
                format!("`{opening}` opened here"),
            )
            .help(format!("add the missing `{closing}`"));
        self.scan.report(finding);
    }

    fn close(&mut self, bracket: u8, at: usize, more_follows: bool) {
        let superfluous = bracket == b'}' && self.open.len() == 1 && more_follows;
        if let Some(opener) =
            self.take_if(|opener| !superfluous && closing(opener.bracket) == bracket as char)
        {
            if opener.hidden {
                self.scan.edit(at, at + 1, Fill::Blank);
            }
            return;
        }
        let span = Span::new(at, at + 1);
        self.scan.damage.push(at);
        // `(` closed by `]` is one mistake, not two.
        if let Some(opener) = self.take_if(|opener| opener.bracket != b'{' && bracket != b'}') {
            let (opening, wanted) = (opener.bracket as char, closing(opener.bracket));
            let fill = if opener.hidden {
                Fill::Blank
            } else {
                Fill::Text(wanted.to_string())
            };
            self.scan.edit(at, at + 1, fill);
            let message = format!("`{opening}` closed by `{}`", bracket as char);
            let finding = Diagnostic::error(Code::UnbalancedBracket, span, message)
                .label(format!("expected `{wanted}`"))
                .also(
                    Span::new(opener.at, opener.at + 1),
                    format!("`{opening}` opened here"),
                )
                .help(format!("write `{wanted}` instead"));
            self.scan.report(finding);
            return;
        }
        self.scan.edit(at, at + 1, Fill::Blank);
        let message = format!("unmatched `{}`", bracket as char);
        let label = if superfluous {
            "the mechanism would end here, but more follows"
        } else {
            "closes nothing"
        };
        let finding = Diagnostic::error(Code::UnbalancedBracket, span, message)
            .label(label)
            .help(format!(
                "remove the `{}`, or add the missing `{}`",
                bracket as char,
                opening(bracket)
            ));
        self.scan.report(finding);
    }

    /// Reports all brackets that are open at the end of the file in one finding.
    fn end(&mut self, text: &str) {
        let Some(innermost) = self.open.last() else {
            return;
        };
        let end = text.trim_end().len();
        let mut missing = String::new();
        for opener in self.open.iter().rev().filter(|opener| !opener.hidden) {
            missing.push(closing(opener.bracket));
        }
        let bracket = closing(innermost.bracket);
        let mut finding = Diagnostic::error(
            Code::UnexpectedEnd,
            Span::empty(end),
            "the file ends inside brackets",
        )
        .label(format!("expected `{bracket}`"));
        for opener in self.open.iter().rev().take(MAX_SHOWN_BRACKETS) {
            let label = format!("`{}` opened here", opener.bracket as char);
            finding = finding.also(Span::new(opener.at, opener.at + 1), label);
        }
        finding = finding.help(if missing.len() <= MAX_SHOWN_CLOSINGS {
            format!("close the open brackets with `{missing}`")
        } else {
            "close each bracket at the end of its contents".to_string()
        });
        // An unclosed comment has swallowed the brackets and is already reported.
        if self
            .scan
            .findings
            .iter()
            .all(|it| it.code != Code::UnexpectedEnd)
        {
            self.scan.report(finding);
        }
        self.scan.damage.push(end);
        self.scan.edit(text.len(), text.len(), Fill::Text(missing));
    }
}

/// Returns the finding for excessive nesting.
pub(super) fn too_deep(span: Span) -> Diagnostic {
    Diagnostic::error(
        Code::NestedTooDeeply,
        span,
        format!("nested more than {MAX_DEPTH} levels deep"),
    )
    .help("name a part of the formula with `const`, or write a chain without brackets")
}

fn closing(bracket: u8) -> char {
    match bracket {
        b'(' => ')',
        b'[' => ']',
        _ => '}',
    }
}

fn opening(bracket: u8) -> char {
    match bracket {
        b')' => '(',
        b']' => '[',
        _ => '{',
    }
}
