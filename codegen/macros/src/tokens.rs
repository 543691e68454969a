//! *Trees of tokens → one token after another, with brackets, as a description writes them.* Documentation, which the compiler hands on
//! as attributes, is a comment again. Nothing is known here of the language; trees nest as deeply as they like.

use std::vec::IntoIter;

use proc_macro2::{Delimiter, Group, LineColumn, Punct, Spacing, Span, TokenTree};
use syn::LitStr;

/// A word, a number, a text, a mark, a bracket or a comment.
pub struct Token {
    /// What the description is to say.
    pub text: String,
    /// Where the compiler is to report what is wrong with it.
    pub span: Span,
    /// From where to where it is written; `None` where something else is written there, as with what other macros make.
    pub extent: Option<[LineColumn; 2]>,
    /// Whether the next mark belongs to it, as in `->`.
    pub joint: bool,
}

impl Token {
    fn new(text: String, span: Span) -> Token {
        let extent = [span.start(), span.end()];
        let is_there = behind(extent[0], &text) == extent[1];
        Token {
            text,
            span,
            extent: is_there.then_some(extent),
            joint: false,
        }
    }

    fn mark(mark: &Punct) -> Token {
        Token {
            joint: mark.spacing() == Spacing::Joint,
            ..Token::new(mark.to_string(), mark.span())
        }
    }

    /// Whether it ends with its line only.
    pub fn is_line_comment(&self) -> bool {
        self.text.starts_with("//")
    }
}

/// The place behind a text that begins at `start`.
fn behind(start: LineColumn, text: &str) -> LineColumn {
    text.chars().fold(start, |at, letter| match letter {
        '\n' => LineColumn {
            line: at.line + 1,
            column: 0,
        },
        _ => LineColumn {
            line: at.line,
            column: at.column + 1,
        },
    })
}

/// All tokens in their order.
pub fn flat(trees: Vec<TokenTree>) -> Vec<Token> {
    let mut found = Vec::new();
    // The groups that are open, each with what closes it.
    let mut open = vec![(trees.into_iter(), None)];
    while let Some((trees, _)) = open.last_mut() {
        if let Some(comment) = documentation(trees) {
            found.push(comment);
            continue;
        }
        match trees.next() {
            None => found.extend(open.pop().and_then(|(_, close)| close)),
            Some(TokenTree::Group(group)) => {
                let inside: Vec<TokenTree> = group.stream().into_iter().collect();
                let [before, close] = match brackets(&group, &inside) {
                    Some([before, close]) => [Some(before), Some(close)],
                    None => [None, None],
                };
                found.extend(before);
                open.push((inside.into_iter(), close));
            }
            Some(TokenTree::Punct(mark)) => found.push(Token::mark(&mark)),
            Some(other) => found.push(Token::new(other.to_string(), other.span())),
        }
    }
    found
}

/// What a group stands between. What a macro has put in for a variable stands between nothing, but a sum remains one term.
fn brackets(group: &Group, inside: &[TokenTree]) -> Option<[Token; 2]> {
    let is_operator =
        |it: &TokenTree| matches!(it, TokenTree::Punct(mark) if "+-*/^".contains(mark.as_char()));
    let [open, close] = match group.delimiter() {
        Delimiter::Brace => ["{", "}"],
        Delimiter::Bracket => ["[", "]"],
        Delimiter::None if !inside.iter().any(is_operator) => return None,
        Delimiter::Parenthesis | Delimiter::None => ["(", ")"],
    };
    Some([
        Token::new(open.to_string(), group.span_open()),
        Token::new(close.to_string(), group.span_close()),
    ])
}

/// The comment that the next trees stand for, which are taken then.
fn documentation(trees: &mut IntoIter<TokenTree>) -> Option<Token> {
    let attribute = Attribute::first_of(trees.as_slice())?;
    let comment = attribute.comment()?;
    trees.nth(attribute.length - 1);
    Some(comment)
}

/// `#[…]` or `#![…]`.
pub struct Attribute {
    /// Whether it is of what it stands in, not of what follows.
    pub is_inner: bool,
    /// What stands between the brackets.
    pub inside: Vec<TokenTree>,
    /// Its first and its last place.
    pub place: [Span; 2],
    /// How many trees it consists of.
    pub length: usize,
}

impl Attribute {
    /// The attribute that trees begin with.
    pub fn first_of(trees: &[TokenTree]) -> Option<Attribute> {
        let is = |tree: Option<&TokenTree>, mark| matches!(tree, Some(TokenTree::Punct(it)) if it.as_char() == mark);
        if !is(trees.first(), '#') {
            return None;
        }
        let is_inner = is(trees.get(1), '!');
        let before = if is_inner { 2 } else { 1 };
        match trees.get(before)? {
            TokenTree::Group(group) if group.delimiter() == Delimiter::Bracket => Some(Attribute {
                is_inner,
                inside: spliced(group.stream()),
                place: [trees.first()?.span(), group.span_close()],
                length: before + 1,
            }),
            _ => None,
        }
    }

    /// The words of `doc = "…"`.
    pub fn words(&self) -> Option<String> {
        match self.inside.as_slice() {
            [
                TokenTree::Ident(name),
                TokenTree::Punct(equals),
                TokenTree::Literal(text),
            ] if name == "doc" && equals.as_char() == '=' => {
                let text: LitStr = syn::parse_str(&text.to_string()).ok()?;
                Some(text.value())
            }
            _ => None,
        }
    }

    /// The comment with its words: the one that is written there, or one in its place.
    fn comment(&self) -> Option<Token> {
        let words = self.words()?;
        let [span, close] = self.place;
        let (line, block) = match self.is_inner {
            true => ("//!", "/*!"),
            false => ("///", "/**"),
        };
        let written = [format!("{line}{words}"), format!("{block}{words}*/")];
        let written = written.map(|text| Token::new(text, span));
        if let Some(written) = written.into_iter().find(|it| it.extent.is_some()) {
            return Some(written);
        }
        let text = match words.contains('\n') {
            true => format!(
                "{block} {} */",
                words.replace("*/", "* /").replace("/*", "/ *")
            ),
            // A fourth slash would make it a comment that documents nothing.
            false if words.starts_with('/') => format!("{line} {words}"),
            false => format!("{line}{words}"),
        };
        let (start, end) = (span.start(), close.end());
        Some(Token {
            text,
            span,
            extent: (start < end).then_some([start, end]),
            joint: false,
        })
    }
}

/// The trees with those of groups without brackets in place of the groups.
pub fn spliced(stream: impl IntoIterator<Item = TokenTree>) -> Vec<TokenTree> {
    let mut found = Vec::new();
    for tree in stream {
        match tree {
            TokenTree::Group(group) if group.delimiter() == Delimiter::None => {
                found.extend(spliced(group.stream()));
            }
            other => found.push(other),
        }
    }
    found
}
