//! The blocks of a plan → whether all of them have stayed on their path since the last frame.
//!
//! A mechanism stays on its path where its equations have one solution near a straight line through both frames all the while: then
//! this frame is the one that the last one leads to, in the same assembly mode. That is so where a Newton operator with the
//! Jacobian of this frame contracts (Krawczyk 1969; Neumaier, Interval Methods for Systems of Equations, 1990, chapter 5), for which
//! [`Enclosures`] bound how far the equations are from zero on the line, and how far the Jacobian changes. Blocks are looked at
//! together, because bounds that pass from one to the next grow by more than what they bound. What is explicit has no other
//! solution. Deliberately unknown here: how a part is solved.

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
use super::two_links::TwoLinks;
use crate::expr::{ExprId, Node, SymbolId};
use crate::structure::{Definition, SolvedBlock, Subsystem};
use crate::system::{SymbolRole, System};
use isolation::Loops;

/// What is known of all values while paths are looked at.
pub(super) struct Paths {
    /// What the window is like.
    pub window: TimeWindow,
    enclosures: Enclosures,
    /// The pairs of links that closed forms have found, by the angle of each.
    pub links: HashMap<usize, TwoLinks>,
    /// What stands for angles that no frame keeps.
    pub directions: HashMap<usize, [SymbolId; 2]>,
    /// What unknowns are that follow from others, as far as that is short.
    definitions: HashMap<SymbolId, ExprId>,
    /// The other ones that nothing has mentioned yet, by what they define, with the places of their blocks.
    awaited: HashMap<usize, (Definition, usize)>,
    /// Whether frames keep the angles of closed forms.
    keeps_angles: bool,
    /// The inputs that have been met.
    signals: HashSet<usize>,
    /// The angles whose arms have been computed, with their directions where arms turn with them.
    turned: HashMap<usize, Option<Direction>>,
    deviations: HashMap<usize, SymbolId>,
}

impl Paths {
    pub fn new(system: &mut System) -> Paths {
        let window = TimeWindow {
            time: system.intermediate("window_time"),
            steps: system.intermediate("window_steps"),
            remainder: system.intermediate("window_remainder"),
            beyond: system.intermediate("window_beyond"),
            rounding: system.intermediate("window_rounding"),
        };
        Paths {
            window,
            enclosures: Enclosures::new(window, system),
            links: HashMap::new(),
            directions: HashMap::new(),
            definitions: HashMap::new(),
            awaited: HashMap::new(),
            keeps_angles: system.mechanism.requests.is_empty(),
            signals: HashSet::new(),
            turned: HashMap::new(),
            deviations: HashMap::new(),
        }
    }

    /// Forgets all bounds.
    fn begin(&mut self, system: &mut System) {
        self.enclosures = Enclosures::new(self.window, system);
        self.definitions.clear();
        self.awaited.clear();
        self.signals.clear();
        self.turned.clear();
        self.deviations.clear();
    }

    /// The cosine and the sine of an angle that a closed form finds.
    pub fn note_direction(&mut self, unknown: usize, direction: Direction, system: &System) {
        let graph = &system.mechanism.graph;
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

/// How many unknowns are looked at together, at least where there are as many: the work grows with their third power.
const TOGETHER: usize = 12;

/// What shows that a frame lies on the path of the last one.
#[derive(Clone, Debug)]
pub struct Path {
    /// What is looked at, all equations together.
    pub function: Function,
    /// What is looked at where all blocks are closed forms, one after another: it takes less, and may show less.
    pub closed: Option<Function>,
    /// How far unknowns may be from a straight line, of those that are found so.
    pub deviations: HashMap<usize, SymbolId>,
    /// The symbols of the window.
    pub window: TimeWindow,
}

impl Path {
    /// Both of its functions, to be changed.
    pub(super) fn whole_functions_mut(&mut self) -> impl Iterator<Item = &mut Function> {
        [&mut self.function].into_iter().chain(&mut self.closed)
    }

    /// Its functions, and those inside.
    pub fn functions(&self) -> impl Iterator<Item = &Function> {
        let inner = self.function.statements.iter().filter_map(Statement::inner);
        [&self.function]
            .into_iter()
            .chain(inner)
            .chain(&self.closed)
    }
}

impl Builder<'_> {
    /// What shows that these blocks, with their places in the plan, have stayed on their path.
    pub(super) fn path<'b>(
        mut self,
        blocks: impl Iterator<Item = (usize, &'b SolvedBlock)>,
    ) -> Path {
        let mut loops = Loops::default();
        self.begin_path();
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
                ..Function::default()
            },
            closed: None,
            deviations: std::mem::take(&mut self.paths.deviations),
            window: self.paths.window,
        }
    }

    /// Knows no bounds yet.
    pub(super) fn begin_path(&mut self) {
        self.paths.begin(self.system);
        // Drivers are as they are.
        let zero = self.graph().zero();
        let shifts = self.derivatives.shifts().into_iter();
        let shifts = shifts.map(|symbol| (symbol, zero));
        self.paths.definitions.extend(shifts);
    }

    /// The arms in expressions.
    pub(super) fn path_geometry(&mut self, expressions: &[ExprId]) {
        let mut angles: Vec<usize> = Vec::new();
        for &expr in expressions {
            for symbol in self.system.mechanism.graph.symbols(expr) {
                if let SymbolRole::Arm(place) = self.system.roles[symbol.index()] {
                    angles.push(self.system.vector_form.arms[place].angle);
                }
            }
        }
        angles.sort_unstable();
        angles.dedup();
        for angle in angles {
            self.path_direction(angle);
        }
    }

    /// The direction of an angle in this frame, whose arms are computed with it; `None` where there are none.
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

    /// Whether nothing moves unknowns.
    pub(super) fn is_still(&mut self, unknowns: &[usize], residuals: &[ExprId]) -> bool {
        let zero = self.graph().zero();
        let own: HashSet<usize> = unknowns.iter().copied().collect();
        residuals.iter().all(|&residual| {
            let symbols = self.system.mechanism.graph.symbols(residual).to_vec();
            symbols.into_iter().all(|symbol| {
                let is_own = self
                    .moving(symbol)
                    .is_some_and(|unknown| own.contains(&unknown));
                is_own || {
                    let symbol = self.graph().variable(symbol);
                    self.enclosure(symbol).radius == zero
                }
            })
        })
    }

    /// The unknown that a position or an arm moves with.
    pub(super) fn moving(&self, symbol: SymbolId) -> Option<usize> {
        match self.system.roles[symbol.index()] {
            SymbolRole::Position(unknown) => Some(unknown),
            SymbolRole::Arm(place) => Some(self.system.vector_form.arms[place].angle),
            _ => None,
        }
    }
}
