//! Describes what is at an offset: the meaning of a name, its declaration, its value, and the equations of a joint.

use linkwright_codegen::Read;
use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::expr::{Graph, Number};
use linkwright_codegen::stages::joint::{CONSTRAINTS, DRIVERS};
use linkwright_codegen::stages::model::{UNITS, unit};
use linkwright_codegen::stages::syntax::{Kind, Statement};

use crate::description::Description;
use crate::equations;
use crate::names::{Sort, SymbolId};

/// Largest number of lines of a declaration.
const MAX_LINES: usize = 12;

/// Largest number of listed declarations or bodies.
const MAX_LISTED: usize = 6;

/// Text beside the pointer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hover {
    /// Described place.
    pub span: Span,
    /// Text in Markdown: paragraphs, fenced code, code spans, and the documentation of the description.
    pub text: String,
}

/// Returns the text beside the pointer; `None` if there is nothing to describe. The equations `read` are those of this text; `None` if
/// they have not been derived.
pub fn hover(description: &Description, read: Option<&Read>, offset: usize) -> Option<Hover> {
    let about = About { description, read };
    let (span, text) = match description.names.mention_at(offset) {
        Some(mention) => (mention.span, about.symbol(mention.symbol, mention.span)),
        None => about.word(offset)?,
    };
    Some(Hover { span, text })
}

struct About<'a> {
    description: &'a Description,
    read: Option<&'a Read>,
}

impl About<'_> {
    /// Describes a symbol; at the name of a joint's statement, with its equations.
    fn symbol(&self, id: SymbolId, place: Span) -> String {
        let names = &self.description.names;
        let symbol = &names.symbols[id];
        let here = names.mentioned_at(place).map(|it| &names.symbols[it]);
        let mut written: Vec<(Span, &str)> = here.map(|it| (it.written, it.opening)).collect();
        // Repetitions share one declaration.
        written.dedup();
        let declared = written.iter().take(MAX_LISTED);
        let declared: Vec<String> = declared
            .map(|(written, opening)| self.declaration(opening, *written))
            .collect();
        let mut parts = vec![format!("```mech\n{}\n```", declared.join("\n"))];
        let mut what = symbol.sort.noun().to_string();
        match symbol.sort {
            Sort::BodyPoint => {
                let carriers: Vec<String> = names
                    .same(id)
                    .into_iter()
                    .filter_map(|it| names.symbols[it].body)
                    .map(|it| format!("`{}`", names.symbols[it].spelled))
                    .collect();
                what = format!("point of {}", bodies(&carriers));
            }
            Sort::Point => {
                let carriers = names.carriers_of(id).map(|it| &names.symbols[it].spelled);
                let carriers: Vec<String> = carriers.map(|it| format!("`{it}`")).collect();
                if !carriers.is_empty() {
                    what = format!("{what}, carried by {}", bodies(&carriers));
                }
            }
            _ => {}
        }
        // Each repetition has its own value.
        let is_one = names.mentioned_at(place).take(2).count() == 1;
        let read = self.read.filter(|_| is_one);
        let value = read.and_then(|read| equations::of_value(read, &symbol.name, symbol.place));
        let coordinates =
            read.and_then(|read| equations::of_body(read, &symbol.name, symbol.place));
        if let Some(value) = value {
            what = format!("{what} {value}");
        }
        if let Some(coordinates) = coordinates {
            let quoted: Vec<String> = coordinates.iter().map(|it| format!("`{it}`")).collect();
            what = format!("{what} with the coordinates {}", quoted.join(", "));
        }
        parts.push(what);
        parts.extend((!symbol.docs.is_empty()).then(|| symbol.docs.join("\n")));
        let statement = match symbol.sort {
            Sort::Driver | Sort::Free | Sort::Equation => Some(symbol.statement),
            _ => self.statement_named_at(place),
        };
        parts.extend(statement.and_then(|it| self.equations(it)));
        parts.join("\n\n")
    }

    /// Returns a declaration as it is written, cut off after [`MAX_LINES`] lines.
    fn declaration(&self, opening: &str, written: Span) -> String {
        let text = self.description.source.text.get(written.range());
        let lines: Vec<&str> = text.unwrap_or_default().lines().collect();
        let mut text = lines[..lines.len().min(MAX_LINES)].join("\n");
        if lines.len() > MAX_LINES {
            text.push_str("\n…");
        }
        format!("{opening}{text}")
    }

    /// Returns the statement of the joint that is named at a place; `None` if there is none.
    fn statement_named_at(&self, place: Span) -> Option<Span> {
        let statement = self.description.statements().find(|statement| {
            let Statement::Joint(joint) = statement else {
                return false;
            };
            let name = joint.name.as_ref().map(|it| it.span.start);
            name == Some(place.start)
        });
        statement.map(Statement::span)
    }

    fn equations(&self, statement: Span) -> Option<String> {
        let rows = equations::of_statement(self.read?, statement);
        (!rows.is_empty()).then(|| format!("```text\n{}\n```", rows.join("\n")))
    }

    /// Describes a word of the language: a kind of joint, a unit, a number.
    fn word(&self, offset: usize) -> Option<(Span, String)> {
        let lexeme = self.description.lexeme_at(offset)?;
        let span = Span::new(lexeme.start, lexeme.end);
        let word = self.description.written(lexeme);
        let text = match lexeme.kind {
            Kind::Number => quantity(word)?,
            Kind::Word => self.kind(word, span).or_else(|| built_in(word))?,
            _ => return None,
        };
        Some((span, text))
    }

    /// Describes a kind of joint or driver: its syntax, and the equations of this statement.
    fn kind(&self, word: &str, place: Span) -> Option<String> {
        let statement = self.description.statement_around(place);
        let equations = statement.and_then(|it| self.equations(it));
        let mut kinds = CONSTRAINTS.iter().chain(DRIVERS);
        let kind = kinds.find(|it| it.keyword == word);
        let starts = statement.is_some_and(|it| it.start == place.start);
        let example = kind.map(|it| format!("syntax: {}", it.example));
        let parts: Vec<String> = match (example, starts) {
            (Some(example), _) => [Some(example), equations].into_iter().flatten().collect(),
            (None, true) => equations.into_iter().collect(),
            (None, false) => Vec::new(),
        };
        (!parts.is_empty()).then(|| parts.join("\n\n"))
    }
}

/// Lists the names of bodies.
fn bodies(names: &[String]) -> String {
    match names {
        [first, .., last] if names.len() > MAX_LISTED => {
            format!("{} bodies from {first} to {last}", names.len())
        }
        [only] => format!("body {only}"),
        [rest @ .., last] => format!("the bodies {} and {last}", rest.join(", ")),
        [] => "a body".to_string(),
    }
}

/// Converts a number with a unit to SI units; `None` if the text is not one.
fn quantity(text: &str) -> Option<String> {
    let suffix = UNITS.iter().filter(|it| text.ends_with(**it));
    let suffix = suffix.max_by_key(|it| it.len())?;
    let digits = text.strip_suffix(*suffix)?.replace('_', "");
    let mut graph = Graph::new();
    let number = graph.number(Number::parse(&digits)?);
    let (factor, dimension) = unit(suffix, &mut graph)?;
    let product = graph.multiply(number, factor);
    let value = graph.constant_value(product)?;
    Some(format!(
        "{}, {value} {}",
        dimension.name(),
        dimension.unit()
    ))
}

/// Describes a predefined name, or a value that gears assign.
fn built_in(word: &str) -> Option<String> {
    Some(match word {
        "t" => "the time, in s".to_string(),
        "pi" => format!("π = {}", std::f64::consts::PI),
        "pressure_angle" => "the angle between the line of action of the teeth and the common tangent of the pitch circles; if it is given, bearings carry the tooth force".to_string(),
        "friction" => "Coulomb friction in a joint: it resists sliding, in proportion to the reaction".to_string(),
        "radius" => "the radius of a pin with friction".to_string(),
        "over" => "the length of a slide with friction, whose ends carry the moment".to_string(),
        "motor" => "a motor at a driver: torque, speed and power at its shaft are measures".to_string(),
        "gear" => "the rotation of the shaft of a motor per unit of the driven quantity".to_string(),
        "efficiency" => "the part of the power that the gear of a motor transmits, in both directions".to_string(),
        "ground" => "the fixed body; it carries every `point` of the description".to_string(),
        _ => return None,
    })
}
