//! Flattens trees of tokens into a sequence with brackets, in the notation of a description.
//!
//! Documentation, which the compiler passes on as attributes, becomes comments again. Trees may be nested to any depth.

use std::vec::IntoIter;

use proc_macro2::{Delimiter, Group, LineColumn, Punct, Spacing, Span, TokenTree};
use syn::LitStr;

/// Word, number, text, mark, bracket or comment.
pub struct Token {
    /// Text in the description.
    pub text: String,
    /// Location of errors for the compiler.
    pub span: Span,
    /// Start and end in the source; `None` if the source has another text there, as for tokens of other macros.
    pub extent: Option<[LineColumn; 2]>,
    /// True if the next mark belongs to this one, as in `->`.
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

    /// True for a comment that ends with its line.
    pub fn is_line_comment(&self) -> bool {
        self.text.starts_with("//")
    }
}

/// Location behind a text that begins at `start`.
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

/// Returns all tokens in their order.
pub fn flat(trees: Vec<TokenTree>) -> Vec<Token> {
    let mut tokens = Vec::new();
    // Open groups, each with its closing bracket.
    let mut open = vec![(trees.into_iter(), None)];
    while let Some((trees, _)) = open.last_mut() {
        if let Some(comment) = documentation(trees) {
            tokens.push(comment);
            continue;
        }
        match trees.next() {
            None => tokens.extend(open.pop().and_then(|(_, close)| close)),
            Some(TokenTree::Group(group)) => {
                let inside: Vec<TokenTree> = group.stream().into_iter().collect();
                let [before, close] = match brackets(&group, &inside) {
                    Some([before, close]) => [Some(before), Some(close)],
                    None => [None, None],
                };
                tokens.extend(before);
                open.push((inside.into_iter(), close));
            }
            Some(TokenTree::Punct(mark)) => tokens.push(Token::mark(&mark)),
            Some(other) => tokens.push(Token::new(other.to_string(), other.span())),
        }
    }
    tokens
}

/// Brackets of a group; `None` for a group without any. A variable of a macro has none, but a sum is parenthesized to
/// remain one term.
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

/// Takes the comment that the next trees represent; `None` if they do not represent any.
fn documentation(trees: &mut IntoIter<TokenTree>) -> Option<Token> {
    let attribute = Attribute::first_of(trees.as_slice())?;
    let comment = attribute.comment()?;
    trees.nth(attribute.length - 1);
    Some(comment)
}

/// Attribute `#[…]` or `#![…]`.
pub struct Attribute {
    /// True for an attribute of the enclosing item, not of the following one.
    pub is_inner: bool,
    /// Trees between the brackets.
    pub inside: Vec<TokenTree>,
    /// First and last location.
    pub place: [Span; 2],
    /// Number of trees of the attribute.
    pub length: usize,
}

impl Attribute {
    /// Attribute with which trees begin; `None` if there is none.
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

    /// Words of `doc = "…"`; `None` for another attribute.
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

    /// Comment with the attribute's words: as in the source, or an equivalent one.
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
            // A fourth slash would make a comment without documentation.
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

/// Trees with those of groups without brackets in place of the groups.
pub fn spliced(stream: impl IntoIterator<Item = TokenTree>) -> Vec<TokenTree> {
    let mut trees = Vec::new();
    for tree in stream {
        match tree {
            TokenTree::Group(group) if group.delimiter() == Delimiter::None => {
                trees.extend(spliced(group.stream()));
            }
            other => trees.push(other),
        }
    }
    trees
}
