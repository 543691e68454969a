//! Finds the points whose coordinates are plain numbers in the text, so that they can be dragged.

use std::collections::{BTreeMap, BTreeSet};

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::model::Mechanism;
use linkwright_codegen::stages::syntax::{
    Expression, ExpressionKind, Kind, Member, Name, Pair, Statement,
};
use linkwright_codegen::stages::units::Unit;

use crate::description::Description;
use crate::names::{Symbol, mechanisms};

/// Rounding of moved coordinates, as a share of the characteristic length.
const RESOLUTION: f64 = 1e-4;

/// Declared point, as something to drag.
#[derive(Clone, Debug, PartialEq)]
pub struct Handle {
    /// Name in the mechanism: `K`, or `K_c1` if bodies have different points of one name. Two bodies that share a point have a handle
    /// each. A global point keeps its name if bodies carry it as different points.
    pub point: String,
    /// Body in whose frame the coordinates are; `None` for global coordinates.
    pub body: Option<String>,
    /// Place of the name.
    pub declared: Span,
    /// Coordinates x and y, or a sentence with the reason that they cannot be dragged.
    pub coordinates: Result<[Coordinate; 2], String>,
}

/// Coordinate that is written as a plain number.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// Place of the number, with its sign and its unit.
    pub span: Span,
    /// Value in m.
    pub value: f64,
    /// Number with its sign and its unit, as written.
    pub(crate) written: String,
    /// Digits without sign and unit.
    pub(crate) digits: String,
    /// Name of the unit for other values; empty for m that is not written.
    pub(crate) unit: String,
    /// Unit for other values.
    pub(crate) measured: Unit,
    /// Rounding of other values, in m.
    pub(crate) resolution: f64,
}

/// Returns the declared points of a description in written order. `mechanism` is that of any of its motions.
///
/// Points of the ground and of bodies are included, origins of bodies are not: they are estimates.
pub fn handles(description: &Description, mechanism: &Mechanism) -> Vec<Handle> {
    let finder = Finder::new(description, mechanism);
    let mut handles = Vec::new();
    for statement in description.statements() {
        match statement {
            Statement::Points(points) => {
                let each = points.points.iter();
                handles.extend(each.map(|it| finder.handle(&it.name, None, &it.position)));
            }
            Statement::Body(body) => {
                for member in &body.members {
                    if let Member::Local { name, position, .. } = member {
                        handles.push(finder.handle(name, Some(&body.name), position));
                    }
                }
            }
            _ => {}
        }
    }
    handles
}

struct Finder<'a> {
    description: &'a Description,
    mechanism: &'a Mechanism,
    /// Names of its points.
    points: BTreeSet<&'a str>,
    /// Text of the mechanism itself, without its parts.
    whole: Option<Span>,
    /// Braces of repetitions, in written order.
    repetitions: Vec<Span>,
    /// Nouns of named values.
    values: BTreeMap<&'a str, &'static str>,
}

impl<'a> Finder<'a> {
    fn new(description: &'a Description, mechanism: &'a Mechanism) -> Finder<'a> {
        let values = description
            .statements()
            .filter_map(|statement| match statement {
                Statement::Constant(it) => Some((it.name.text.as_str(), "constant")),
                Statement::Parameter(it) => Some((it.constant.name.text.as_str(), "parameter")),
                _ => None,
            });
        Finder {
            description,
            mechanism,
            points: mechanism.points.iter().map(|it| it.name.as_str()).collect(),
            whole: mechanisms(&description.source.text, &description.lexemes)
                .last()
                .map(|it| it.span),
            repetitions: repetitions(description),
            values: values.collect(),
        }
    }

    fn handle(&self, name: &Name, body: Option<&Name>, position: &Pair) -> Handle {
        let point = self.point(name, body);
        let coordinates = match self.expanded(name, body) {
            Some(reason) => Err(reason),
            None => self.coordinates(position),
        };
        Handle {
            point,
            body: body.map(|it| it.text.clone()),
            declared: name.span,
            coordinates,
        }
    }

    /// Returns the name of a point in the mechanism.
    fn point(&self, name: &Name, body: Option<&Name>) -> String {
        let plain = &name.text;
        let Some(body) = body.filter(|_| !self.points.contains(plain.as_str())) else {
            return plain.clone();
        };
        let named = |body: &str| format!("{plain}_{body}");
        let is_known = |it: &String| self.points.contains(it.as_str());
        // A point that several bodies share is named after one of them.
        let names = &self.description.names;
        let is_declared = |it: &Symbol| it.place == name.span && it.body.is_some();
        let id = names.symbols.iter().position(is_declared);
        let shared = id.into_iter().flat_map(|id| names.same(id));
        let bodies = shared.filter_map(|id| names.symbols[id].body);
        let mut others = bodies.map(|id| named(&names.symbols[id].name));
        let of_body = Some(named(&body.text)).filter(is_known);
        let of_body = of_body.or_else(|| others.find(is_known));
        of_body.unwrap_or_else(|| plain.clone())
    }

    /// Returns the reason that a point is not written for itself; `None` if it is.
    fn expanded(&self, name: &Name, body: Option<&Name>) -> Option<String> {
        let place = name.span;
        let has = |it: &Span| it.start <= place.start && place.end <= it.end;
        if !self.whole.is_some_and(|it| has(&it)) {
            // Points of a body keep their names, the body is named with its part.
            let named = body.unwrap_or(name).text.as_str();
            let spellings = &self.mechanism.spellings;
            let spelled = spellings.get(named).map_or(named, String::as_str);
            return Some(match spelled.rsplit_once('.') {
                Some((part, _)) => format!("belongs to the part `{part}`"),
                None => "belongs to a part".to_string(),
            });
        }
        let before = self
            .repetitions
            .partition_point(|it| it.start <= place.start);
        let around = self.repetitions[..before].last().is_some_and(has);
        around.then(|| "made by `repeat`".to_string())
    }

    fn coordinates(&self, position: &Pair) -> Result<[Coordinate; 2], String> {
        let [x, y] = [&position.x, &position.y].map(|it| self.literal(it));
        let [x, y] = [x?, y?];
        // A zero takes its unit from its neighbor, two zeros from the rest of the description.
        let usual = self.mechanism.units.written.of_lengths();
        let usual = usual.map_or("", |it| it.name.as_str());
        let [x_unit, y_unit] = match [x.is_plain_zero(), y.is_plain_zero()] {
            [true, true] => [usual, usual],
            [true, false] => [y.unit, y.unit],
            [false, true] => [x.unit, x.unit],
            [false, false] => [x.unit, y.unit],
        };
        Ok([self.coordinate(x, x_unit)?, self.coordinate(y, y_unit)?])
    }

    fn coordinate(&self, literal: Literal<'_>, unit: &str) -> Result<Coordinate, String> {
        let Literal {
            written, digits, ..
        } = literal;
        let sign = if written.starts_with('-') { -1.0 } else { 1.0 };
        let value: f64 = digits.parse().map_err(|_| formula(written))?;
        Ok(Coordinate {
            span: literal.span,
            value: sign
                * length(literal.unit)
                    .ok_or_else(|| formula(written))?
                    .si(value),
            written: written.to_string(),
            digits: digits.to_string(),
            unit: unit.to_string(),
            measured: length(unit).ok_or_else(|| formula(written))?,
            resolution: RESOLUTION * self.mechanism.characteristic_length,
        })
    }

    /// Returns a plain number.
    ///
    /// # Errors
    /// The expression is another one; the message is the reason for the user.
    fn literal<'e>(&'e self, expression: &'e Expression) -> Result<Literal<'e>, String> {
        let text = self.description.source.text.get(expression.span.range());
        let text = text.unwrap_or_default();
        let (number, unsigned) = match &expression.kind {
            ExpressionKind::Negative(inner) => {
                let unsigned = text.strip_prefix('-').map(str::trim_start);
                (&inner.kind, unsigned.unwrap_or_default())
            }
            kind => (kind, text),
        };
        match number {
            ExpressionKind::Number { digits, unit } => {
                let unit = unit.as_ref().map_or("", |it| it.text.as_str());
                // Parentheses and comments would be lost.
                let is_plain = unsigned
                    .strip_suffix(unit)
                    .is_some_and(|it| it.replace('_', "") == *digits);
                is_plain
                    .then_some(Literal {
                        span: expression.span,
                        written: text,
                        digits,
                        unit,
                    })
                    .ok_or_else(|| formula(text))
            }
            ExpressionKind::Reference(reference) if number == &expression.kind => {
                // Other names of numbers are indices, which repetitions alone have.
                match self.values.get(reference.name.text.as_str()) {
                    Some(noun) => Err(format!("given by the {noun} `{text}`")),
                    None => Err(formula(text)),
                }
            }
            _ => Err(formula(text)),
        }
    }
}

/// Plain number.
struct Literal<'a> {
    span: Span,
    written: &'a str,
    digits: &'a str,
    unit: &'a str,
}

impl Literal<'_> {
    fn is_plain_zero(&self) -> bool {
        self.unit.is_empty() && self.digits.parse() == Ok(0.0)
    }
}

fn formula(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    format!("`{}` is a formula", words.join(" "))
}

/// Returns a unit of length, m for an empty name; `None` if the name is not one.
fn length(name: &str) -> Option<Unit> {
    let meter = Unit::parse("m")?;
    match name.is_empty() {
        true => Some(meter),
        false => Unit::parse(name).filter(|it| it.powers == meter.powers),
    }
}

/// Returns the braces of all outermost repetitions, in written order.
fn repetitions(description: &Description) -> Vec<Span> {
    let mut repetitions = Vec::new();
    let mut depth = 0_usize;
    // Depth and start of the current repetition, from its braces on.
    let mut current: Option<(usize, usize)> = None;
    let mut is_begun = false;
    for (place, lexeme) in description.lexemes.iter().enumerate() {
        match lexeme.kind {
            Kind::Open(b'{') => {
                if is_begun && current.is_none() {
                    current = Some((depth, lexeme.start));
                }
                is_begun = false;
                depth += 1;
            }
            Kind::Close(b'}') => {
                depth = depth.saturating_sub(1);
                if let Some((_, start)) = current.filter(|(outer, _)| *outer == depth) {
                    repetitions.push(Span::new(start, lexeme.end));
                    current = None;
                }
            }
            Kind::Word if description.written(*lexeme) == "repeat" => {
                let next = description.lexemes.get(place + 1);
                let before = place.checked_sub(1).map(|it| description.lexemes[it].kind);
                let opens = matches!(
                    before,
                    None | Some(Kind::Mark(b';') | Kind::Open(b'{') | Kind::Close(b'}'))
                );
                // A point may have this name.
                is_begun |= opens && next.is_some_and(|it| it.kind == Kind::Word);
            }
            _ => {}
        }
    }
    repetitions
}
