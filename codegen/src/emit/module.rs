//! System and Program of a motion → what its module is made of, whatever language it is written in.
//!
//! Here stand what values are called, where functions find what they read, the operations that an expression is computed by, which
//! numbers are looked at last, and the sentences of the documentation, so that modules of different languages say and compute the same.
//! A language comes with its [`Words`] and prints the rest. Deliberately unknown here: how anything is written.

pub(super) mod accessors;
pub(super) mod checks;
pub(super) mod documentation;
pub(super) mod drawing;
pub(super) mod facts;
pub(super) mod forces;
pub(super) mod needs;
pub(super) mod path_enclosures;
pub(super) mod scope;
pub(super) mod tables;
pub(super) mod wrapped;

use super::Notation;
use super::derivation::{self, BlockWords, PlainWords, Script, SingularPose};
use super::scalar::Scalar;
use crate::assemblies::{StoredAssemblies, exchanges, stored};
use crate::expr::{IdMap, IdSet, SymbolId};
use crate::pool::{Pool, SymbolRole};
use crate::program::passes::names::LocalNames;
use crate::program::{LARGEST_TEXTBOOK, Program};
use crate::solved::Solved;
use crate::system::{Derived, System};
use crate::words::Phrase;

/// What a language asks of names.
#[derive(Clone, Copy, Debug)]
pub(super) struct Words {
    /// A wish as a name: `bd_square` of `|BD|^2`.
    pub spelled: fn(&str) -> String,
    /// What no local value of a function is called.
    pub of_functions: &'static [&'static str],
    /// What no field of a frame is called.
    pub of_frames: &'static [&'static str],
}

/// A mechanism or one of its motions, as it is written.
pub(super) struct Module<'a> {
    pub pool: &'a Pool,
    pub system: &'a System,
    pub program: &'a Program,
    pub scalar: Scalar,
    /// Where each part of the plan is singular.
    pub poses: Vec<SingularPose>,
    /// The ways in which it can be assembled, where Newton-Raphson starts from one of them.
    pub assemblies: Option<StoredAssemblies>,
    /// What each block of the program is called.
    pub words: Vec<BlockWords>,
    /// What the language asks of names.
    pub names: Words,
    /// What the frame calls what it keeps beside the coordinates.
    fields: LocalNames,
    comments: PlainWords<'a>,
    /// The deviations that enclosures are filled with.
    enclosures: IdSet<SymbolId>,
    /// The blocks that exchange a mode where it meets the other one, by the mode's symbol.
    pub exchanged: IdMap<SymbolId, usize>,
}

/// A coordinate, its rate or its acceleration in a structure of coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Component<'a> {
    /// `q`, `qd` or `qdd`.
    pub vector: &'static str,
    pub name: &'a str,
}

impl<'a> Module<'a> {
    pub(super) fn new(solved: &'a Solved, scalar: Scalar, names: Words) -> Module<'a> {
        let Solved {
            derived: Derived { pool, system },
            plan,
            program,
        } = solved;
        let kept = program.fields.iter().copied();
        let script = Script::Text(Notation::Unicode);
        let poses = derivation::singular_poses(pool, system, plan, &program.forms, script);
        Module {
            fields: LocalNames::of_symbols(kept, pool, system, names.of_frames, names.spelled),
            words: derivation::block_words(&program.blocks, pool, system, plan, &poses),
            poses,
            names,
            assemblies: stored(pool, system, program),
            comments: PlainWords::new(pool, system, Notation::Unicode),
            enclosures: path_enclosures::deviations_of_enclosures(program, system),
            exchanged: exchanges(pool, system, program),
            pool,
            system,
            program,
            scalar,
        }
    }

    /// Whether frames hold all coordinates, and not only what is asked for.
    pub(super) fn holds_coordinates(&self) -> bool {
        self.program.outputs.is_none()
    }

    /// Whether the mechanism is too large for functions that go through all coordinates at once.
    pub(super) fn is_large(&self) -> bool {
        self.system.coordinates.len() > LARGEST_TEXTBOOK
    }

    /// The place of a coordinate, its rate or its acceleration.
    pub(super) fn component(&self, symbol: SymbolId) -> Option<Component<'a>> {
        let (vector, unknown) = match self.pool.role(symbol) {
            SymbolRole::Position(unknown) => ("q", unknown),
            SymbolRole::Rate(unknown) => ("qd", unknown),
            SymbolRole::Acceleration(unknown) => ("qdd", unknown),
            _ => return None,
        };
        let name = &self.system.coordinates.get(unknown)?.name;
        Some(Component { vector, name })
    }

    /// Whether frames hold a value.
    pub(super) fn is_field(&self, symbol: SymbolId) -> bool {
        self.holds_coordinates() && self.system.is_coordinate(symbol, self.pool)
            || self.program.is_field(symbol)
    }

    /// What a field is called that is none of the coordinates.
    pub(super) fn own_field(&self, symbol: SymbolId) -> &str {
        self.fields.name_of(symbol).unwrap_or_default()
    }

    /// What a symbol is called that says what the window is like.
    pub(super) fn span_part(&self, symbol: SymbolId) -> Option<&'static str> {
        let window = &self.program.path.as_ref()?.window;
        let parts = [
            (window.time, "time"),
            (window.steps, "steps"),
            (window.remainder, "remainder"),
            (window.beyond, "beyond"),
            (window.rounding, "rounding"),
        ];
        parts
            .into_iter()
            .find(|(own, _)| *own == symbol)
            .map(|(_, name)| name)
    }

    /// Whether a deviation is that of a enclosure.
    pub(super) fn has_enclosure(&self, deviation: SymbolId) -> bool {
        self.enclosures.contains(&deviation)
    }

    /// Words as a comment says them.
    pub(super) fn said(&self, words: &Phrase) -> String {
        self.comments.say(words)
    }

    /// The number of a block as failures count it.
    pub(super) fn block_number(&self, place: usize) -> u16 {
        self.program.number_of(place)
    }

    /// The place of a driven joint's length among what must be positive.
    pub(super) fn requirement_place(&self, joint: usize) -> usize {
        let requirements = self.program.requirements.as_ref();
        requirements.map_or(0, |it| it.place_of(joint))
    }
}
