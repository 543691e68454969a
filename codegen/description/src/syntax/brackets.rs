//! *Lexemes → balanced brackets.* Finds brackets that are never closed or close nothing, says where each was opened, and edits the
//! text so that `syn` sees them balanced and never deeper than [`DEEPEST`].
//!
//! Where a bracket should have been closed is judged by the shape of the text: `;` and braces, other than those of an `if`, never stand in parentheses, and a
//! line that [starts a statement](StatementStarts) does not stand inside the braces of a body.

use super::scan::{Fill, Kind, Scan};
use super::statement_shapes::{
    continues_after, excess_of_closing_braces, looks_like_statement, opens_piece, opens_statements,
    word,
};
use super::{DEEPEST, KEYWORDS};
use crate::diagnostic::{Code, Diagnostic, Span};

/// How many brackets left open are shown, the innermost first.
const SHOWN: usize = 3;

/// So many missing brackets are written out.
const LONGEST_CLOSING: usize = 8;

/// Offsets at which a line starts a statement, ascending.
pub(super) struct StatementStarts(Vec<usize>);

impl StatementStarts {
    pub(super) fn contains(&self, offset: usize) -> bool {
        self.0.binary_search(&offset).is_ok()
    }
}

/// A bracket that waits for its other half.
struct Opener {
    bracket: u8,
    at: usize,
    /// The braces of a mechanism or a motion, in which statements stand.
    holds_statements: bool,
    /// The braces of a piece of a formula, after `if` or `else`.
    holds_formula: bool,
    /// Too deep: hidden from `syn`, and so will its other half be.
    hidden: bool,
}

/// Balances the brackets of a scan, adding findings and edits to it.
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
        // Inside a formula a call at the start of a line starts no statement.
        let in_formula =
            balance.formulas > 0 && word(text, lexeme).is_none_or(|word| !KEYWORDS.contains(&word));
        if !in_formula && looks_like_statement(text, &lexemes[index..]) {
            let continues = previous.is_some_and(|it| continues_after(it.kind));
            if !continues {
                starts.push(lexeme.start);
            }
            // A motion inside a motion is no missing brace where all braces are closed further below.
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
    /// How many of them are braces.
    braces: isize,
    /// How many of them hold formulas.
    formulas: usize,
    too_deep: bool,
}

impl Balance<'_> {
    fn open(&mut self, bracket: u8, at: usize, holds_statements: bool, holds_formula: bool) {
        let hidden = self.open.len() >= DEEPEST;
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

    /// The innermost opener, taken off where it is of this sort.
    fn take_if(&mut self, is_meant: impl FnOnce(&Opener) -> bool) -> Option<Opener> {
        let opener = self.open.pop_if(|opener| is_meant(opener))?;
        self.braces -= isize::from(opener.bracket == b'{');
        self.formulas -= usize::from(opener.holds_formula);
        Some(opener)
    }

    /// Closes every parenthesis and square bracket that is open above the innermost brace.
    fn close_parentheses(&mut self, place: usize) {
        while let Some(opener) = self.take_if(|opener| opener.bracket != b'{') {
            self.insert(&opener, place);
        }
    }

    /// Closes everything that is open inside of a formula.
    fn close_formulas(&mut self, place: usize) {
        self.close_parentheses(place);
        while let Some(opener) = self.take_if(|opener| opener.holds_formula) {
            self.insert(&opener, place);
            self.close_parentheses(place);
        }
    }

    /// A line that starts a statement: what is still open inside the braces of the mechanism or of a motion was meant to be
    /// closed before it, and a motion before the next one.
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
        // `(` closed by `]`: one mistake, not two.
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

    /// The end of the file: one finding, however much is open.
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
        for opener in self.open.iter().rev().take(SHOWN) {
            let label = format!("`{}` opened here", opener.bracket as char);
            finding = finding.also(Span::new(opener.at, opener.at + 1), label);
        }
        finding = finding.help(if missing.len() <= LONGEST_CLOSING {
            format!("close what is open with `{missing}`")
        } else {
            "close each bracket where what it holds ends".to_string()
        });
        // A comment left open has swallowed the brackets: that is said already.
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

/// The finding for anything nested too deeply.
pub(super) fn too_deep(span: Span) -> Diagnostic {
    Diagnostic::error(
        Code::NestedTooDeeply,
        span,
        format!("nested more than {DEEPEST} levels deep"),
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
