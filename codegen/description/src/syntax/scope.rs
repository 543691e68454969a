//! Holds the names that expansion needs: indices of `repeat` statements, whole-number constants, and parts.
//!
//! A part has its own scope: the indices and constants of the enclosing mechanism are invisible in it. After a part, only the
//! spellings of its names remain.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::formula::Name;
use crate::diagnostic::Span;

/// Maximum number of expanded statements and repetitions.
pub(super) const MAX_EXPANDED: usize = 50_000;

/// Source spellings of resolved names, by resolved name: `rod[3]` for `rod3`.
pub type Spellings = BTreeMap<String, String>;

/// Names visible to the parser.
#[derive(Debug, Default)]
pub(super) struct Scope {
    levels: Vec<Level>,
    pub spellings: Spellings,
    /// Number of statements and repetitions expanded so far.
    pub written_out: usize,
}

/// Names of a mechanism or of one part.
#[derive(Debug, Default)]
struct Level {
    /// Indices, innermost last.
    indices: Vec<(String, i64)>,
    whole_numbers: HashMap<String, i64>,
    /// Arguments for constants of a part; `None` for values that are not whole numbers.
    given: HashMap<String, Option<i64>>,
    parts: HashMap<String, Span>,
    bodies: HashMap<String, BodyOfPart>,
}

/// A body of a part.
#[derive(Debug)]
struct BodyOfPart {
    /// Prefix of the names of the part.
    prefix: String,
    /// Names of its points within the part.
    points: HashSet<String>,
}

impl Scope {
    /// Creates an empty scope.
    pub(super) fn new() -> Scope {
        Scope {
            levels: vec![Level::default()],
            ..Scope::default()
        }
    }

    fn level(&self) -> Option<&Level> {
        self.levels.last()
    }

    /// Enters a part with arguments for its constants.
    pub(super) fn enter(&mut self, given: HashMap<String, Option<i64>>) {
        self.levels.push(Level {
            given,
            ..Level::default()
        });
    }

    /// Leaves a part and records its name and bodies: those of its own parts, and `bodies` with their points.
    pub(super) fn leave(&mut self, part: &Name, bodies: Vec<(String, HashSet<String>)>) {
        let left = self.levels.pop().unwrap_or_default();
        let Some(level) = self.levels.last_mut() else {
            return;
        };
        let name = |inner: &str| inside(&part.text, inner);
        for (body, points) in bodies {
            let prefix = inside(&part.text, "");
            let entry = BodyOfPart { prefix, points };
            level.bodies.insert(name(&body), entry);
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

    /// Leaves a part that is parsed only for its errors.
    pub(super) fn leave_unused(&mut self) {
        self.levels.pop();
    }

    /// Sets an index, or removes it for `None`.
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

    /// Returns the value of an index.
    pub(super) fn index(&self, name: &str) -> Option<i64> {
        let mut indices = self.level()?.indices.iter().rev();
        indices.find(|it| it.0 == name).map(|it| it.1)
    }

    /// Returns the value of an index or of a whole-number constant.
    pub(super) fn whole_number(&self, name: &str) -> Option<i64> {
        let known = self.level()?.whole_numbers.get(name).copied();
        self.index(name).or(known)
    }

    /// Records a constant, unless an argument of the part overrides it.
    pub(super) fn add_constant(&mut self, name: &str, value: Option<i64>) {
        let Some(level) = self.levels.last_mut() else {
            return;
        };
        let value = level.given.get(name).copied().unwrap_or(value);
        if let Some(value) = value {
            level.whole_numbers.insert(name.to_string(), value);
        }
    }

    /// Returns the location of the part with this name.
    pub(super) fn part(&self, name: &str) -> Option<Span> {
        self.level()?.parts.get(name).copied()
    }

    /// Returns the resolved name of a point on a body of a part.
    pub(super) fn point_of_part(&self, body: &str, point: &str) -> Option<String> {
        let body = self.level()?.bodies.get(body)?;
        let has = body.points.contains(point);
        has.then(|| format!("{}{point}", body.prefix))
    }

    /// Returns the source spelling of a name.
    pub(super) fn spelled<'a>(&'a self, name: &'a str) -> &'a str {
        self.spellings.get(name).map_or(name, String::as_str)
    }
}

/// Returns the resolved name of `inner` in a part: `stage3_rod`.
pub(super) fn inside(part: &str, inner: &str) -> String {
    format!("{part}_{inner}")
}
