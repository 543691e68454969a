//! Reads the motion of points from instants: computed from coordinates, or kept as outputs.

use linkwright::PointMotion;
use linkwright_codegen::stages::expr::SymbolId;
use linkwright_codegen::stages::program::Output;

use super::compiled::Compiled;
use crate::instant::{Instant, Layout};
use crate::reader::{Formulas, Reader};

/// Points that instants offer, with their names.
#[derive(Clone, Debug)]
pub(super) struct Points {
    names: Vec<String>,
    source: Source,
}

/// Source of the motion of points.
#[derive(Clone, Debug)]
enum Source {
    /// Functions of the coordinates.
    Computed(Reader),
    /// Indices in instants of x and y, by level.
    Kept(Vec<[[usize; 2]; 3]>),
}

impl Points {
    /// Returns the points of a program: all of the description, or the outputs with position, velocity and acceleration.
    pub fn new(compiled: &Compiled) -> Points {
        let Compiled { solved, layout, .. } = compiled;
        let (pool, system) = (solved.pool(), solved.system());
        let program = solved.program();
        if let Some(outputs) = &program.outputs {
            return Points::kept(outputs, layout);
        }
        let names = system.outputs.iter().map(|it| it.name.clone());
        let formulas = Formulas::new(&program.points, pool, system, program, layout);
        Points {
            names: names.collect(),
            source: Source::Computed(Reader::of(formulas)),
        }
    }

    fn kept(outputs: &[Output], layout: &Layout) -> Points {
        let slot = |symbol: SymbolId| layout.slot(symbol).expect("instants keep outputs");
        let (mut names, mut slots) = (Vec::new(), Vec::new());
        for output in outputs {
            if let Output::Point { name, fields } = output
                && let &[position, velocity, acceleration] = &fields[..]
            {
                names.push(name.clone());
                slots.push([position, velocity, acceleration].map(|it| it.map(slot)));
            }
        }
        Points {
            names,
            source: Source::Kept(slots),
        }
    }

    /// Names in order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Returns the motion of all points.
    pub fn all(&self, instant: &Instant) -> Vec<PointMotion> {
        let mut motions = self.of_values(instant);
        for output in instant.outputs() {
            let motion = &mut motions[output.point];
            let levels = [
                &mut motion.position,
                &mut motion.velocity,
                &mut motion.acceleration,
            ];
            *levels[output.level] = output.components;
        }
        motions
    }

    /// Returns the functions of the coordinates that give six numbers for each point; `None` if instants keep the points.
    pub fn computed(&self) -> Option<&Formulas> {
        match &self.source {
            Source::Computed(reader) => Some(reader.formulas()),
            Source::Kept(_) => None,
        }
    }

    /// Returns the index in instants of a component of a point; `None` for points that instants do not keep.
    pub fn slot(&self, point: usize, level: usize, axis: usize) -> Option<usize> {
        match &self.source {
            Source::Computed(_) => None,
            Source::Kept(slots) => Some(slots.get(point)?[level][axis]),
        }
    }

    fn of_values(&self, instant: &Instant) -> Vec<PointMotion> {
        match &self.source {
            Source::Computed(reader) => {
                let values = reader.values(instant);
                let motion = |it: &[f64]| motion([[it[0], it[1]], [it[2], it[3]], [it[4], it[5]]]);
                values.chunks_exact(6).map(motion).collect()
            }
            Source::Kept(slots) => {
                let value = |slot: usize| instant.values()[slot];
                let levels = slots.iter().map(|levels| levels.map(|it| it.map(value)));
                levels.map(motion).collect()
            }
        }
    }
}

fn motion([position, velocity, acceleration]: [[f64; 2]; 3]) -> PointMotion {
    PointMotion {
        position,
        velocity,
        acceleration,
    }
}
