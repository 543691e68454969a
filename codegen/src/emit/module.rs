//! Prepares the module of a motion for any language.
//!
//! Names of values, locations of variables, order of operations, final checks and the sentences of the documentation are decided
//! here, so that modules in all languages compute and document the same. A language brings its [`Words`] and prints.

pub(super) mod accessors;
pub(super) mod checked_time;
pub(super) mod checks;
pub(super) mod documentation;
pub(super) mod drawing;
pub(super) mod facts;
pub(super) mod forces;
pub(super) mod limits;
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
use crate::system::System;
use crate::words::Phrase;

/// Rules of a language for names of values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Words {
    /// Returns a requested quantity as a name: `bd_square` for `|BD|^2`.
    pub spelled: fn(&str) -> String,
    /// Names that no local value of a function may have.
    pub of_functions: &'static [&'static str],
    /// Names that no field of a frame may have.
    pub of_frames: &'static [&'static str],
}

/// Mechanism, or one of its motions, with what every language needs to print it.
pub(super) struct Module<'a> {
    pub pool: &'a Pool,
    pub system: &'a System,
    pub program: &'a Program,
    pub scalar: Scalar,
    /// Singular poses of the plan's subsystems.
    pub poses: Vec<SingularPose>,
    /// Stored assemblies from which Newton-Raphson can start; `None` without a stored list.
    pub assemblies: Option<StoredAssemblies>,
    /// Names of the program's blocks.
    pub words: Vec<BlockWords>,
    /// Rules of the language.
    pub names: Words,
    /// Names of the frame's fields that are not coordinates.
    fields: LocalNames,
    comments: PlainWords<'a>,
    /// Deviations in path enclosures.
    enclosures: IdSet<SymbolId>,
    /// Blocks that exchange a mode at a change point, by the symbol of the mode.
    pub exchanged: IdMap<SymbolId, usize>,
}

/// Coordinate, rate or acceleration in a structure of coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Component<'a> {
    /// `q`, `qd` or `qdd`.
    pub vector: &'static str,
    pub name: &'a str,
}

impl<'a> Module<'a> {
    pub(super) fn new(solved: &'a Solved, scalar: Scalar, names: Words) -> Module<'a> {
        let (pool, system) = (solved.pool(), solved.system());
        let (plan, program) = (solved.plan(), solved.program());
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

    /// True if frames hold all coordinates; false if they hold only the requested outputs.
    pub(super) fn holds_coordinates(&self) -> bool {
        self.program.outputs.is_none()
    }

    /// True if the mechanism is too large for functions of all coordinates.
    pub(super) fn is_large(&self) -> bool {
        self.system.coordinates.len() > LARGEST_TEXTBOOK
    }

    /// Returns the component of a symbol; `None` if the symbol is not a coordinate, rate or acceleration.
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

    /// True if frames hold the value.
    pub(super) fn is_field(&self, symbol: SymbolId) -> bool {
        self.holds_coordinates() && self.system.is_coordinate(symbol, self.pool)
            || self.program.is_field(symbol)
    }

    /// Returns the name of a field that is not a coordinate.
    pub(super) fn own_field(&self, symbol: SymbolId) -> &str {
        self.fields.name_of(symbol).unwrap_or_default()
    }

    /// Returns the field of the time window that a symbol stands for; `None` if there is none.
    pub(super) fn window_part(&self, symbol: SymbolId) -> Option<&'static str> {
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
            .find(|(part, _)| *part == symbol)
            .map(|(_, name)| name)
    }

    /// True if a path enclosure has the deviation.
    pub(super) fn has_enclosure(&self, deviation: SymbolId) -> bool {
        self.enclosures.contains(&deviation)
    }

    /// Returns a phrase as the text of a comment.
    pub(super) fn comment(&self, words: &Phrase) -> String {
        self.comments.say(words)
    }

    /// Returns the number by which failures name a block.
    pub(super) fn block_number(&self, place: usize) -> u16 {
        self.program.number_of(place)
    }

    /// Returns the index of a driven joint's length among the quantities that must be positive.
    pub(super) fn requirement_place(&self, joint: usize) -> usize {
        let requirements = self.program.requirements.as_ref();
        requirements.map_or(0, |it| it.place_of(joint))
    }
}
