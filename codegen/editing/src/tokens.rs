//! Splits a text into tokens, for coloring.
//!
//! A text with errors has tokens as well. They are in written order and do not overlap; white space and unreadable characters belong to
//! none.

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::joint::CONSTRAINTS;
use linkwright_codegen::stages::syntax::{CLAUSES, KEYWORDS, Kind, Lexeme, lexemes_and_comments};

/// Part of a text that has one color.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// Place.
    pub span: Span,
    /// Kind.
    pub kind: TokenKind,
}

/// Kind of a token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// First word of a statement, or of a clause in it.
    Keyword,
    /// Any other word.
    Name,
    /// Digits of a number.
    Number,
    /// Unit of a number.
    Unit,
    /// Comment that is not documentation.
    Comment,
    /// Documentation.
    Documentation,
    /// Path of a file, with its quotes.
    Text,
    /// Mark or bracket.
    Operator,
}

impl TokenKind {
    /// Returns the name of the kind, for a style sheet.
    pub fn name(self) -> &'static str {
        match self {
            TokenKind::Keyword => "keyword",
            TokenKind::Name => "name",
            TokenKind::Number => "number",
            TokenKind::Unit => "unit",
            TokenKind::Comment => "comment",
            TokenKind::Documentation => "documentation",
            TokenKind::Text => "text",
            TokenKind::Operator => "operator",
        }
    }
}

/// Returns the tokens of a text.
pub fn tokens(text: &str) -> Vec<Token> {
    let (lexemes, comments) = lexemes_and_comments(text);
    let mut tokens = Vec::with_capacity(lexemes.len() + comments.len());
    tokens.extend(comments.iter().map(|it| Token {
        span: it.span,
        kind: match it.is_documentation {
            true => TokenKind::Documentation,
            false => TokenKind::Comment,
        },
    }));
    let mut is_behind_keyword = false;
    for (place, lexeme) in lexemes.iter().enumerate() {
        let Lexeme { start, end, .. } = *lexeme;
        let mut add = |start: usize, end: usize, kind: TokenKind| {
            let span = Span::new(start, end);
            tokens.extend((start < end).then_some(Token { span, kind }));
        };
        match lexeme.kind {
            Kind::Word => {
                is_behind_keyword = is_keyword(text, &lexemes, place, is_behind_keyword);
                let kind = match is_behind_keyword {
                    true => TokenKind::Keyword,
                    false => TokenKind::Name,
                };
                add(start, end, kind);
            }
            Kind::Number => {
                let unit = start + length_of_digits(&text[start..end]);
                add(start, unit, TokenKind::Number);
                add(unit, end, TokenKind::Unit);
            }
            Kind::Text => add(start, end, TokenKind::Text),
            Kind::Open(_) | Kind::Close(_) | Kind::Mark(_) => add(start, end, TokenKind::Operator),
        }
    }
    tokens.sort_by_key(|it| it.span);
    let open = unreadable_texts(text, &tokens);
    if !open.is_empty() {
        tokens.extend(open);
        tokens.sort_by_key(|it| it.span);
    }
    tokens
}

/// Returns quoted texts that the scan does not read: those without a closing quote, and those that are not paths.
fn unreadable_texts(text: &str, tokens: &[Token]) -> Vec<Token> {
    let ends = std::iter::once(0).chain(tokens.iter().map(|it| it.span.range().end));
    let starts = tokens.iter().map(|it| it.span.range().start);
    let gaps = ends.zip(starts.chain([text.len()]));
    let quoted = gaps.flat_map(|(start, end)| {
        let lines = text[start..end].split_inclusive('\n');
        let lines = lines.scan(start, |start, line| {
            let here = *start;
            *start += line.len();
            Some((here, line))
        });
        lines.filter_map(|(start, line)| {
            let quote = line.find('"')?;
            Some(Token {
                span: Span::new(start + quote, start + line.trim_end().len()),
                kind: TokenKind::Text,
            })
        })
    });
    quoted.collect()
}

/// True if a word begins a statement or a clause. A declared name may be equal to such a word.
fn is_keyword(text: &str, lexemes: &[Lexeme], place: usize, is_behind_keyword: bool) -> bool {
    let next = lexemes.get(place + 1).map(|it| it.kind);
    if matches!(next, Some(Kind::Mark(b':' | b'=' | b'.'))) {
        return false;
    }
    if begins_statement(text, lexemes, place) {
        return true;
    }
    let Some(before) = place.checked_sub(1) else {
        return false;
    };
    let word = &text[lexemes[place].start..lexemes[place].end];
    let is_clause = match lexemes[before].kind {
        // The word behind a keyword is its operand.
        Kind::Word => !is_behind_keyword || word == "if",
        Kind::Open(_) | Kind::Mark(b',') => word == "if",
        Kind::Mark(b'.' | b';') => false,
        _ => true,
    };
    is_clause && CLAUSES.contains(&word)
}

/// True if a word is the first of a statement.
fn begins_statement(text: &str, lexemes: &[Lexeme], place: usize) -> bool {
    let written = |it: &Lexeme| &text[it.start..it.end];
    let word = written(&lexemes[place]);
    let mut before = lexemes[..place].iter().rev().peekable();
    if before.peek().is_some_and(|it| written(it) == "redundant") {
        before.next();
    }
    let is_first = before.next().is_none_or(|it| {
        matches!(
            it.kind,
            Kind::Mark(b';') | Kind::Open(b'{') | Kind::Close(b'}')
        )
    });
    let mut joints = CONSTRAINTS.iter().map(|it| it.keyword);
    is_first && (word == "mechanism" || KEYWORDS.contains(&word) || joints.any(|it| it == word))
}

/// Returns the length of a number without its unit.
fn length_of_digits(number: &str) -> usize {
    let bytes = number.as_bytes();
    let digits = |from: usize| {
        let rest = bytes[from..].iter();
        from + rest
            .take_while(|it| it.is_ascii_digit() || **it == b'_')
            .count()
    };
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if let Some(b'e' | b'E') = bytes.get(end) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        if bytes.get(end + 1 + sign).is_some_and(u8::is_ascii_digit) {
            end = digits(end + 1 + sign);
        }
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the tokens with their kinds, one a line.
    fn listed(text: &str) -> String {
        let lines = tokens(text).into_iter().map(|Token { span, kind }| {
            let name = kind.name();
            format!("{name} {}\n", &text[span.range()])
        });
        lines.collect()
    }

    #[test]
    fn a_statement_is_split() {
        let text = "//! file\nmechanism at {\n  /// doc\n  point P = (-1.5e-3mm, L/2); // rest\n  table lift = \"a.csv\" columns 1;\n}";
        let expected = "documentation //! file\nkeyword mechanism\nname at\noperator {\ndocumentation /// doc\nkeyword point\nname P\noperator =\noperator (\noperator -\nnumber 1.5e-3\nunit mm\noperator ,\nname L\noperator /\nnumber 2\noperator )\noperator ;\ncomment // rest\nkeyword table\nname lift\noperator =\ntext \"a.csv\"\nkeyword columns\nnumber 1\noperator ;\noperator }\n";
        assert_eq!(listed(text), expected);
    }

    #[test]
    fn names_may_be_words_of_the_language() {
        let text =
            "body point at to { on: (0, 0), part: (1, 0) } redundant revolute part(to, ground);";
        let keywords: Vec<&str> = tokens(text)
            .iter()
            .filter(|it| it.kind == TokenKind::Keyword)
            .map(|it| &text[it.span.range()])
            .collect();
        assert_eq!(keywords, ["body", "at", "redundant", "revolute"]);
    }

    #[test]
    fn broken_texts_have_tokens() {
        assert_eq!(
            listed("P: (30mm /* open"),
            "name P\noperator :\noperator (\nnumber 30\nunit mm\ncomment /* open\n"
        );
        assert_eq!(
            listed("\u{feff}ä€ 3µm \"x"),
            "name ä\nnumber 3\nunit µm\ntext \"x\n"
        );
        assert_eq!(
            listed("table lift = \"a.c\n table"),
            "keyword table\nname lift\noperator =\ntext \"a.c\nname table\n"
        );
        assert_eq!(listed(""), "");
    }
}
