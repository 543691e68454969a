//! Joins the program that is written out with a fuller one of the same mechanism.

use linkwright::Blocks as _;
use linkwright_codegen::stages::expr::SymbolId;
use linkwright_codegen::stages::program::Output;

use super::Interpreted;
use crate::instant::{Instant, OutputMotion};
use crate::supplied::Modes;
use crate::view::View;

/// Blocks of the program that is written out, which omits some values of a fuller one.
#[derive(Clone, Debug)]
pub struct Emitted {
    blocks: Interpreted,
    /// Indices of values in instants of the fuller program, and of the same values in those of the emitted one.
    same: Vec<[usize; 2]>,
    /// Points of `output`: index, level, and indices of x and y in instants of the emitted program.
    points: Vec<(usize, usize, [usize; 2])>,
}

impl Emitted {
    /// Joins the emitted program with a fuller one.
    pub(super) fn new(blocks: Interpreted, fuller: &Interpreted) -> Emitted {
        let layouts = [fuller.layout(), blocks.layout()];
        let of_symbol = |symbol: SymbolId| {
            let [fuller, own] = layouts.map(|it| it.slot(symbol));
            Some([fuller?, own?])
        };
        let coordinates = fuller.system().coordinates.iter();
        let coordinates = coordinates.flat_map(|it| [it.position, it.rate, it.acceleration]);
        let forces = fuller.forces.iter().zip(&blocks.forces);
        let forces = forces.filter_map(|(fuller, own)| Some([(*fuller)?, (*own)?]));
        let same = coordinates.filter_map(of_symbol).chain(forces).collect();
        let mut points = Vec::new();
        for output in blocks.program().outputs.iter().flatten() {
            let Output::Point { name, fields } = output else {
                continue;
            };
            let mut names = fuller.points.names().iter();
            let point = names.position(|it| it.eq_ignore_ascii_case(name));
            for (level, symbols) in fields.iter().enumerate() {
                let slots = symbols.map(|it| layouts[1].slot(it));
                if let (Some(point), [Some(x), Some(y)]) = (point, slots) {
                    points.push((point, level, [x, y]));
                }
            }
        }
        Emitted {
            blocks,
            same,
            points,
        }
    }

    /// Blocks of the emitted program.
    pub fn blocks(&self) -> &Interpreted {
        &self.blocks
    }

    /// Returns the modes of the emitted program among those of the fuller one.
    pub(crate) fn modes(&self, fuller: &impl View, modes: &Modes) -> Modes {
        let names = fuller.mode_names();
        let mut own = self.blocks.drawn_branches();
        for mode in self.blocks.mode_names() {
            let mut same = names.iter();
            let same = same.find(|it| it.name == mode.name && it.is_closed == mode.is_closed);
            match same {
                Some(same) if mode.is_closed => own.closed[mode.place] = modes.closed[same.place],
                Some(same) => own.iterated[mode.place] = modes.iterated[same.place],
                None => {}
            }
        }
        own
    }

    /// Returns an instant of the fuller program with all values that the emitted one has at the same time.
    pub(crate) fn joined(&self, fuller: &Instant, emitted: &Instant) -> Instant {
        let mut joined = fuller.clone();
        for &[to, from] in &self.same {
            joined.values_mut()[to] = emitted.values()[from];
        }
        let points = self.points.iter();
        let points = points.map(|&(point, level, slots)| OutputMotion {
            point,
            level,
            components: slots.map(|slot| emitted.values()[slot]),
        });
        joined.set_outputs(points.collect());
        joined
    }
}
