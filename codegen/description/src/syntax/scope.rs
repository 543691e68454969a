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

/// Names that expanded statements no longer contain, with all their places in the source.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Expansion {
    /// Declarations; repeated statements and parts repeat them.
    pub declared: Vec<Expanded>,
    /// Locations of names, each with the location of its declaration.
    pub mentions: Vec<[Span; 2]>,
}

/// Declaration of an index, a part, or a mechanism that may be a part.
#[derive(Clone, Debug, PartialEq)]
pub struct Expanded {
    /// Meaning of the name.
    pub sort: ExpandedSort,
    /// Declared name.
    pub name: Name,
    /// Location of the declaration without braces.
    pub span: Span,
}

/// Meaning of a name that is expanded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExpandedSort {
    /// Index of a repetition.
    Index,
    /// Mechanism as a part of another.
    Part,
    /// Mechanism that may be a part.
    Mechanism,
}

/// Names visible to the parser.
#[derive(Debug, Default)]
pub(super) struct Scope {
    levels: Vec<Level>,
    pub spellings: Spellings,
    pub expansion: Expansion,
    /// Number of statements and repetitions expanded so far.
    pub written_out: usize,
}

/// Names of a mechanism or of one part.
#[derive(Debug, Default)]
struct Level {
    /// Indices, innermost last.
    indices: Vec<(Name, i64)>,
    /// Whole-number constants with the locations of their declarations.
    whole_numbers: HashMap<String, (i64, Span)>,
    /// Arguments for constants of a part; `None` for values that are not whole numbers.
    given: HashMap<String, Option<i64>>,
    parts: HashMap<String, Span>,
    /// First part of each name without its indices.
    first_parts: HashMap<String, Span>,
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
    pub(super) fn set_index(&mut self, name: &Name, value: Option<i64>) {
        let Some(level) = self.levels.last_mut() else {
            return;
        };
        match value {
            Some(value) => level.indices.push((name.clone(), value)),
            None => {
                level.indices.pop();
            }
        }
    }

    /// Returns value and declaration of an index.
    pub(super) fn index(&self, name: &str) -> Option<(i64, Span)> {
        let mut indices = self.level()?.indices.iter().rev();
        let (index, value) = indices.find(|it| it.0.text == name)?;
        Some((*value, index.span))
    }

    /// Returns value and declaration of an index or of a whole-number constant.
    pub(super) fn whole_number(&self, name: &str) -> Option<(i64, Span)> {
        let known = self.level()?.whole_numbers.get(name).copied();
        self.index(name).or(known)
    }

    /// Records a constant, unless an argument of the part overrides it.
    pub(super) fn add_constant(&mut self, name: &Name, value: Option<i64>) {
        let Some(level) = self.levels.last_mut() else {
            return;
        };
        let value = level.given.get(&name.text).copied().unwrap_or(value);
        if let Some(value) = value {
            let declared = (value, name.span);
            level.whole_numbers.insert(name.text.clone(), declared);
        }
    }

    /// Records a declaration.
    pub(super) fn declare(&mut self, sort: ExpandedSort, name: Name, span: Span) {
        let declared = Expanded { sort, name, span };
        self.expansion.declared.push(declared);
    }

    /// Records a name with the location of its declaration.
    pub(super) fn mention(&mut self, name: Span, declaration: Span) {
        self.expansion.mentions.push([name, declaration]);
    }

    /// Records a part, whose name has the text before its indices; parts that differ in indices alone share one name.
    pub(super) fn declare_part(&mut self, name: Name, span: Span) {
        if let Some(level) = self.levels.last_mut() {
            let first = level.first_parts.entry(name.text.clone());
            let first = *first.or_insert(name.span);
            self.mention(name.span, first);
        }
        self.declare(ExpandedSort::Part, name, span);
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
