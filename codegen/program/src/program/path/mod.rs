//! Verifies that all blocks of a plan stay on their path since the last frame.
//!
//! A mechanism stays on its path if, at every instant, its equations have one solution near the chord between both frames. The
//! new frame then is the continuation of the last one, in the same assembly mode. This holds if a Newton operator with the
//! Jacobian of this frame contracts (Krawczyk 1969; Neumaier, Interval Methods for Systems of Equations, 1990, chapter 5).
//! [`Enclosures`] bound the residuals on the chord and the change of the Jacobian.
//!
//! Blocks are verified together, because bounds that pass from block to block grow too fast. Explicit unknowns are unique.

mod basis;
mod bounds;
mod chain;
mod columns;
mod definitions;
mod isolation;
mod line;

use std::collections::{HashMap, HashSet};

use super::builder::{Builder, Direction};
use super::function::{Function, Statement};
use super::passes::enclosure::{Enclosures, TimeWindow};
use super::quantities::LinkName;
use super::two_links::TwoLinks;
use crate::expr::{ExprId, Node, SymbolId};
use crate::pool::{Pool, SymbolRole};
use crate::structure::{Definition, SolvedBlock, Subsystem};
use crate::system::System;
use isolation::Loops;

/// Bounds of all values while paths are verified.
pub(super) struct Paths {
    /// Window of time.
    pub window: TimeWindow,
    enclosures: Enclosures,
    /// Pairs of links that closed forms have recorded, by the angle of each link.
    pub links: HashMap<usize, TwoLinks>,
    /// Names of links of constant length, by the angle of each link.
    pub names: HashMap<usize, LinkName>,
    /// Cosine and sine of angles that frames do not keep.
    pub directions: HashMap<usize, [SymbolId; 2]>,
    /// Short values of unknowns that follow from others.
    definitions: HashMap<SymbolId, ExprId>,
    /// Other explicit assignments that are not mentioned yet, by unknown, with the indices of their blocks.
    awaited: HashMap<usize, (Definition, usize)>,
    /// True if frames keep the angles of closed forms.
    keeps_angles: bool,
    /// Inputs with bounds.
    signals: HashSet<usize>,
    /// Angles with computed vectors, with their directions if vectors rotate with them.
    turned: HashMap<usize, Option<Direction>>,
    deviations: HashMap<usize, SymbolId>,
}

impl Paths {
    pub fn new(pool: &mut Pool, system: &System) -> Paths {
        let window = TimeWindow {
            time: pool.intermediate("window_time"),
            steps: pool.intermediate("window_steps"),
            remainder: pool.intermediate("window_remainder"),
            beyond: pool.intermediate("window_beyond"),
            rounding: pool.intermediate("window_rounding"),
        };
        Paths {
            window,
            enclosures: Enclosures::new(window, pool, system),
            links: HashMap::new(),
            names: HashMap::new(),
            directions: HashMap::new(),
            definitions: HashMap::new(),
            awaited: HashMap::new(),
            keeps_angles: system.mechanism.requests.is_empty(),
            signals: HashSet::new(),
            turned: HashMap::new(),
            deviations: HashMap::new(),
        }
    }

    /// Removes all bounds.
    fn begin(&mut self, pool: &mut Pool, system: &System) {
        self.enclosures = Enclosures::new(self.window, pool, system);
        self.definitions.clear();
        self.awaited.clear();
        self.signals.clear();
        self.turned.clear();
        self.deviations.clear();
    }

    /// Records the cosine and the sine of an angle of a closed form.
    pub fn note_direction(
        &mut self,
        unknown: usize,
        direction: Direction,
        pool: &Pool,
        system: &System,
    ) {
        let graph = &pool.graph;
        let symbol = |expr: ExprId| match *graph.node(expr) {
            Node::Symbol(symbol) => Some(symbol),
            _ => None,
        };
        if let (Some(cosine), Some(sine)) = (symbol(direction.cosine), symbol(direction.sine))
            && !(self.keeps_angles && unknown < system.coordinates.len())
        {
            self.directions.insert(unknown, [cosine, sine]);
        }
    }
}

/// Number of unknowns from which on equations are verified together: the work grows with the third power.
const TOGETHER: usize = 12;

/// Verification that a frame lies on the path of the last one.
#[derive(Clone, Debug)]
pub struct Path {
    /// Verification of all equations together.
    pub function: Function,
    /// Verification of closed forms one after another, which is cheaper but may prove less; `None` if a block is not a closed
    /// form.
    pub closed: Option<Function>,
    /// Bounds on the deviation of unknowns from the chord, as far as the verification finds them.
    pub deviations: HashMap<usize, SymbolId>,
    /// Symbols of the window.
    pub window: TimeWindow,
}

impl Path {
    /// Returns both functions for changes.
    pub(super) fn whole_functions_mut(&mut self) -> impl Iterator<Item = &mut Function> {
        [&mut self.function].into_iter().chain(&mut self.closed)
    }

    /// Returns the functions, and those inside.
    pub fn functions(&self) -> impl Iterator<Item = &Function> {
        let inner = self.function.statements.iter().filter_map(Statement::inner);
        [&self.function]
            .into_iter()
            .chain(inner)
            .chain(&self.closed)
    }
}

impl Builder<'_> {
    /// Returns the verification that these blocks, with their indices in the plan, stay on their path.
    pub(super) fn path<'b>(
        mut self,
        blocks: impl Iterator<Item = (usize, &'b SolvedBlock)>,
    ) -> Path {
        let mut loops = Loops::default();
        self.begin_path();
        self.name_rods();
        for (place, block) in blocks {
            for part in &block.parts {
                self.path_of_part(part, place, &mut loops);
            }
            for definition in &block.definitions {
                self.path_of_definition(definition, place);
            }
            if loops.unknowns.len() >= TOGETHER {
                self.isolate(std::mem::take(&mut loops));
            }
        }
        self.isolate(loops);
        Path {
            function: Function {
                statements: self.statements,
                quantities: self.quantities,
                ..Function::default()
            },
            closed: None,
            deviations: std::mem::take(&mut self.paths.deviations),
            window: self.paths.window,
        }
    }

    /// Starts without bounds.
    pub(super) fn begin_path(&mut self) {
        self.paths.begin(self.pool, self.system);
        // Drivers are not shifted here.
        let zero = self.graph().zero();
        let shifts = self.derivatives.shifts().into_iter();
        let shifts = shifts.map(|symbol| (symbol, zero));
        self.paths.definitions.extend(shifts);
    }

    /// Computes the rotated vectors of expressions.
    pub(super) fn path_geometry(&mut self, expressions: &[ExprId]) {
        let mut angles: Vec<usize> = Vec::new();
        for &expr in expressions {
            for symbol in self.pool.graph.symbols(expr) {
                if let SymbolRole::Arm(place) = self.pool.role(*symbol) {
                    angles.push(self.pool.arms()[place].angle);
                }
            }
        }
        angles.sort_unstable();
        angles.dedup();
        for angle in angles {
            self.path_direction(angle);
        }
    }

    /// Returns the direction of an angle in this frame and computes its vectors; `None` if there are none.
    pub(super) fn path_direction(&mut self, angle: usize) -> Option<Direction> {
        if let Some(&direction) = self.paths.turned.get(&angle) {
            return direction;
        }
        let direction = match self.paths.directions.get(&angle) {
            Some(&[cosine, sine]) => {
                let [cosine, sine] = [cosine, sine].map(|it| self.graph().variable(it));
                let direction = Direction { cosine, sine };
                self.arms(angle, direction);
                Some(direction)
            }
            None => self.explicit_angle(angle),
        };
        self.paths.turned.insert(angle, direction);
        direction
    }

    fn path_of_part(&mut self, part: &Subsystem, block: usize, loops: &mut Loops) {
        let equations = part.equations.iter();
        let residuals: Vec<ExprId> = equations.map(|it| self.in_short(it.residual)).collect();
        for &residual in &residuals {
            self.meet(residual, loops);
        }
        if self.is_still(&part.unknowns, &residuals) {
            part.unknowns.iter().for_each(|&it| self.know_still(it));
            return;
        }
        self.join(&part.unknowns, &residuals, block, loops);
    }

    /// True if all unknowns are constant.
    pub(super) fn is_still(&mut self, unknowns: &[usize], residuals: &[ExprId]) -> bool {
        let zero = self.graph().zero();
        let of_block: HashSet<usize> = unknowns.iter().copied().collect();
        residuals.iter().all(|&residual| {
            let symbols = self.pool.graph.symbols(residual).to_vec();
            symbols.into_iter().all(|symbol| {
                let is_own = self
                    .moving(symbol)
                    .is_some_and(|unknown| of_block.contains(&unknown));
                is_own || {
                    let symbol = self.graph().variable(symbol);
                    self.enclosure(symbol).radius == zero
                }
            })
        })
    }

    /// Returns the unknown that moves a position or a vector component.
    pub(super) fn moving(&self, symbol: SymbolId) -> Option<usize> {
        match self.pool.role(symbol) {
            SymbolRole::Position(unknown) => Some(unknown),
            SymbolRole::Arm(place) => Some(self.pool.arms()[place].angle),
            _ => None,
        }
    }
}
