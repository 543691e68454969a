//! What is known by name while a text is read: the indices of `repeat` statements, constants that are whole numbers, and parts.
//!
//! A part is read in a scope of its own: it sees neither the indices nor the constants of the mechanism that it is a part of. Afterwards
//! only how names are written out is left of it. What constants and bodies are is not known here.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::formula::Name;
use crate::diagnostic::Span;

/// The most statements and repetitions that are written out.
pub(super) const MOST: usize = 50_000;

/// Names that are written otherwise than they are called: `rod[3]` for `rod3`, by what they are called.
pub type Spellings = BTreeMap<String, String>;

/// What is known by name.
#[derive(Debug, Default)]
pub(super) struct Scope {
    levels: Vec<Level>,
    pub spellings: Spellings,
    /// How many statements and repetitions have been written out.
    pub written_out: usize,
}

/// What a mechanism, or a part of it, knows.
#[derive(Debug, Default)]
struct Level {
    /// Innermost last.
    indices: Vec<(String, i64)>,
    whole_numbers: HashMap<String, i64>,
    /// What is given for constants of a part, as far as it is a whole number.
    given: HashMap<String, Option<i64>>,
    parts: HashMap<String, Span>,
    bodies: HashMap<String, BodyOfPart>,
}

/// A body that came with a part.
#[derive(Debug)]
struct BodyOfPart {
    /// What its part puts before names.
    prefix: String,
    /// What its points are called in the part.
    points: HashSet<String>,
}

impl Scope {
    /// Nothing is known yet.
    pub(super) fn new() -> Scope {
        Scope {
            levels: vec![Level::default()],
            ..Scope::default()
        }
    }

    fn level(&self) -> Option<&Level> {
        self.levels.last()
    }

    /// Enters a part, with what is given for its constants.
    pub(super) fn enter(&mut self, given: HashMap<String, Option<i64>>) {
        self.levels.push(Level {
            given,
            ..Level::default()
        });
    }

    /// Leaves it, and keeps what it is called and which bodies it has: those of its own parts, and `bodies` with their points.
    pub(super) fn leave(&mut self, part: &Name, bodies: Vec<(String, HashSet<String>)>) {
        let left = self.levels.pop().unwrap_or_default();
        let Some(level) = self.levels.last_mut() else {
            return;
        };
        let name = |inner: &str| inside(&part.text, inner);
        for (body, points) in bodies {
            let prefix = inside(&part.text, "");
            let own = BodyOfPart { prefix, points };
            level.bodies.insert(name(&body), own);
        }
        for (body, of) in left.bodies {
            let prefix = inside(&part.text, &of.prefix);
            level
                .bodies
                .insert(name(&body), BodyOfPart { prefix, ..of });
        }
        let inner = left.parts.into_iter().map(|(it, span)| (name(&it), span));
        level.parts.extend(inner);
        level.parts.insert(part.text.clone(), part.span);
    }

    /// Leaves a part that was only looked at.
    pub(super) fn leave_unused(&mut self) {
        self.levels.pop();
    }

    /// Sets an index for what is read next, or takes it away.
    pub(super) fn set_index(&mut self, name: &str, value: Option<i64>) {
        let Some(level) = self.levels.last_mut() else {
            return;
        };
        match value {
            Some(value) => level.indices.push((name.to_string(), value)),
            None => {
                level.indices.pop();
            }
        }
    }

    /// The value of an index.
    pub(super) fn index(&self, name: &str) -> Option<i64> {
        let mut indices = self.level()?.indices.iter().rev();
        indices.find(|it| it.0 == name).map(|it| it.1)
    }

    /// The value of an index or of a constant that is a whole number.
    pub(super) fn whole_number(&self, name: &str) -> Option<i64> {
        let known = self.level()?.whole_numbers.get(name).copied();
        self.index(name).or(known)
    }

    /// Keeps the value of a constant; what is given for it counts instead.
    pub(super) fn add_constant(&mut self, name: &str, value: Option<i64>) {
        let Some(level) = self.levels.last_mut() else {
            return;
        };
        let value = level.given.get(name).copied().unwrap_or(value);
        if let Some(value) = value {
            level.whole_numbers.insert(name.to_string(), value);
        }
    }

    /// Where the part of this name is.
    pub(super) fn part(&self, name: &str) -> Option<Span> {
        self.level()?.parts.get(name).copied()
    }

    /// What a point of a body that came with a part is called.
    pub(super) fn point_of_part(&self, body: &str, point: &str) -> Option<String> {
        let body = self.level()?.bodies.get(body)?;
        let has = body.points.contains(point);
        has.then(|| format!("{}{point}", body.prefix))
    }

    /// How a name is written.
    pub(super) fn spelled<'a>(&'a self, name: &'a str) -> &'a str {
        self.spellings.get(name).map_or(name, String::as_str)
    }
}

/// What `inner` of a part is called: `stage3_rod`.
pub(super) fn inside(part: &str, inner: &str) -> String {
    format!("{part}_{inner}")
}
