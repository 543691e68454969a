//! Code that is laid out already, and code that the formatter lays out, in its order → tokens.
//!
//! Syntax takes the formatter most of its time. What can be laid out without it, it sees as one call of a macro with a string, of
//! which the layout makes lines again. Comments, which syntax does not know, are such lines, too.

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, quote};
use syn::LitStr;

use super::docs::doc_lines;
use crate::emit::lines::terms;

/// What a call of the macro begins with; no other code does.
const MARKER: &str = "lines_in_generated_code!(";

/// What the string in it begins with; no other string does.
const BEGIN: &str = "=>";

/// What stands between two lines; it is in no code and no comment.
const BREAK: &str = "\u{1f}";

/// The longest line that fits as deep as statements stand, and how deep that is.
const LONGEST_LINE: usize = 96;
const DEEPEST: usize = 24;

/// Items or statements, one after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Code(Vec<Piece>);

#[derive(Clone, Debug)]
pub(super) enum Piece {
    /// Lines that are laid out, but for those that are too long.
    Lines(Vec<String>),
    /// What the formatter lays out.
    Syntax(TokenStream),
}

impl Code {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn pieces(&self) -> &[Piece] {
        &self.0
    }

    /// Adds code: lines as they are to stand, or any code that is none.
    pub fn push(&mut self, code: &str) {
        match code.split('\n').all(is_laid_out) {
            true => self.lines(code),
            false => self.syntax(tokens(code)),
        }
    }

    /// Adds a comment.
    pub fn comment(&mut self, text: &str) {
        let text: String = text.chars().filter(|it| is_of_comment(*it)).collect();
        self.lines(&format!("// {text}"));
    }

    /// Adds lines as they stand.
    pub fn lines(&mut self, lines: &str) {
        let lines = lines.split('\n').map(str::to_string);
        match self.0.last_mut() {
            Some(Piece::Lines(before)) => before.extend(lines),
            _ => self.0.push(Piece::Lines(lines.collect())),
        }
    }

    pub fn syntax(&mut self, code: TokenStream) {
        self.0.push(Piece::Syntax(code));
    }

    pub fn append(&mut self, code: Code) {
        for piece in code.0 {
            match (self.0.last_mut(), piece) {
                (Some(Piece::Lines(before)), Piece::Lines(lines)) => before.extend(lines),
                (_, piece) => self.0.push(piece),
            }
        }
    }

    /// Adds a function with this documentation, these attributes, and these statements.
    pub fn function<S: AsRef<str>>(
        &mut self,
        documentation: impl IntoIterator<Item = S>,
        attributes: impl IntoIterator<Item = &'static str>,
        head: &str,
        statements: Code,
    ) {
        let lines = doc_lines(documentation).into_iter();
        let mut before: Vec<String> = lines.map(|line| format!("///{line}")).collect();
        before.extend(attributes.into_iter().map(str::to_string));
        let before = before.join("\n");
        if let [Piece::Lines(lines)] = statements.pieces() {
            self.lines(&format!("{before}\n{head} {{"));
            lines
                .iter()
                .for_each(|line| self.lines(&format!("    {line}")));
            self.lines("}");
            return;
        }
        let before = tokens(&format!("{before}\n{head}"));
        self.syntax(quote!(#before { #statements }));
    }
}

impl ToTokens for Code {
    fn to_tokens(&self, all: &mut TokenStream) {
        for piece in &self.0 {
            match piece {
                Piece::Lines(lines) => {
                    let string = string(&lines.join(BREAK));
                    all.extend(quote!(lines_in_generated_code!(#string);));
                }
                Piece::Syntax(tokens) => all.extend(tokens.clone()),
            }
        }
    }
}

/// The string that holds lines.
fn string(lines: &str) -> Literal {
    let has_escapes = lines.contains(['"', '\\', '\r']);
    let plain = (!has_escapes).then(|| format!("\"{BEGIN}{lines}\"").parse());
    // Documentation may hold what has to be escaped.
    plain
        .and_then(Result::ok)
        .unwrap_or_else(|| Literal::string(&format!("{BEGIN}{lines}")))
}

/// A comment.
pub(super) fn comment(text: &str) -> TokenStream {
    let mut code = Code::default();
    code.comment(text);
    code.to_token_stream()
}

/// The statement that takes a value apart into these fields, as far as they are read; nothing where none is.
pub(super) fn taken_apart(kind: &str, value: &str, fields: &[(bool, &str)]) -> Option<String> {
    let read = fields.iter().filter(|(is_read, _)| *is_read);
    let names: String = read.map(|(_, name)| format!("{name}, ")).collect();
    (!names.is_empty()).then(|| format!("let {kind} {{ {names}.. }} = {value};"))
}

/// Code as tokens.
pub(super) fn tokens(code: &str) -> TokenStream {
    // It is made of names and numbers, so this is a matter of our own code alone.
    code.parse()
        .unwrap_or_else(|error| panic!("generated code has no tokens: {error}: {code}"))
}

/// What follows the macro's opening parenthesis on the first line of such a call.
pub(super) fn called(line: &str) -> Option<&str> {
    line.strip_prefix(MARKER)
}

/// The lines in the string of such a call, given with its quotes.
pub(super) fn decoded(string: &str) -> Option<Vec<String>> {
    let inner = string.strip_prefix('"')?.strip_suffix('"')?;
    let code = inner.strip_prefix(BEGIN)?;
    if !code.contains('\\') {
        return Some(code.split(BREAK).map(str::to_string).collect());
    }
    let value = syn::parse_str::<LitStr>(string).ok()?.value();
    let lines = value[BEGIN.len()..].split(BREAK);
    Some(lines.map(str::to_string).collect())
}

/// Whether a line needs no formatter however deep it stands: it is short, or breaks between terms or elements.
fn is_laid_out(line: &str) -> bool {
    let content = line.trim_start();
    let is_plain = match content.strip_suffix(" {") {
        Some(head) => !head.contains('{') && !head.contains('='),
        None => !content.contains('{'),
    };
    let is_short = line.len() <= LONGEST_LINE;
    let breaks = || content.ends_with(',') || terms(content, DEEPEST).is_some();
    is_plain && (is_short || breaks())
}

/// Whether a character may stand in a comment.
fn is_of_comment(letter: char) -> bool {
    letter != '"' && letter != '\\' && !letter.is_control()
}

#[cfg(test)]
mod tests {
    use quote::{ToTokens, quote};

    use super::super::layout::laid_out;
    use super::super::pieces::formatted;
    use super::{Code, LONGEST_LINE, Piece, decoded, tokens};

    /// A function with these statements, and text of every kind around them.
    fn function(statements: impl ToTokens) -> String {
        let items = quote! {
            /// A function.
            fn f(at: &mut Frame, last: &Frame) -> Result<(), Failure> {
                #statements
                if !exceeds_rounding(a, b) { return Err(singular(a, t, 3)); }
                Ok(())
            }
            const ONE: f64 = 1.0;
        };
        laid_out(&formatted(items, &[]))
    }

    fn lines(code: &Code) -> usize {
        let pieces = code.pieces().iter().map(|piece| match piece {
            Piece::Lines(lines) => lines.len(),
            Piece::Syntax(_) => 0,
        });
        pieces.sum()
    }

    const STATEMENTS: [&str; 8] = [
        "let a = -2.5e-7 * x / (y - 1.0) + math::atan2(u, -v);",
        "let (sine, cosine) = math::sin_cos(at.q.phi + 0.5);",
        "at.q.phi = angle_near(sine, cosine, last.q.phi);",
        "required(a - b, 3)?;",
        "let lift = TABLE_LIFT.at(x)[1] * branches.loop_a.sign::<Scalar>();",
        "jacobian[(2, 3)] = -a;",
        "if !exceeds_rounding(a - b, 2.0) {\n    return Err(out_of_reach(a, b, 0.0, t, 1));\n}",
        "let long = alpha * (beta - gamma) * delta + alpha * (gamma - beta) * delta + alpha * beta * gamma * delta - epsilon;",
    ];

    #[test]
    fn lines_are_what_the_formatter_makes_of_their_tokens() {
        let mut code = Code::default();
        STATEMENTS.iter().for_each(|statement| code.push(statement));
        assert_eq!(lines(&code), STATEMENTS.len() + 2);
        assert_eq!(function(code), function(tokens(&STATEMENTS.concat())));
    }

    #[test]
    fn a_function_is_what_the_formatter_makes_of_its_tokens() {
        let head = "fn found_at_last(at: &mut Frame, last: &Frame, branches: &Branches, conditions: &Conditions<'_>) -> Result<(), Failure>";
        let documentation = ["A \"quoted\" word.", "", "The end."];
        let whole = |statements: Code| {
            let mut code = Code::default();
            code.function(documentation, ["#[inline]"], head, statements);
            laid_out(&formatted(code.to_token_stream(), &[]))
        };
        let (mut in_lines, mut in_tokens) = (Code::default(), Code::default());
        for statement in STATEMENTS.iter().chain(&["Ok(())"]) {
            in_lines.push(statement);
            in_tokens.syntax(tokens(statement));
        }
        assert_eq!(lines(&in_lines), STATEMENTS.len() + 3);
        let found = whole(in_lines);
        assert_eq!(found, whole(in_tokens));
        assert!(found.starts_with(
            "/// A \"quoted\" word.\n///\n/// The end.\n#[inline]\nfn found_at_last(\n    at: &mut Frame,\n"
        ));
    }

    #[test]
    fn what_may_not_fit_into_a_line_is_left_to_the_formatter() {
        let mut code = Code::default();
        code.push(&format!("let a = f({});", "c".repeat(LONGEST_LINE)));
        code.push("let a = if b < 0.0 { 1.0 } else { 2.0 };");
        assert_eq!(lines(&code), 0);
    }

    #[test]
    fn what_has_to_be_escaped_comes_back() {
        let mut code = Code::default();
        code.lines("/// A \"word\" and a \\.\nlet a = 1.0;");
        code.comment("μ, and no \"quotes\"");
        let string = code.to_token_stream().to_string();
        let (start, end) = (string.find('"'), string.rfind('"'));
        let found = start
            .zip(end)
            .and_then(|(start, end)| decoded(&string[start..=end]));
        let wanted = [
            "/// A \"word\" and a \\.",
            "let a = 1.0;",
            "// μ, and no quotes",
        ];
        assert_eq!(found, Some(wanted.map(str::to_string).to_vec()));
    }
}
