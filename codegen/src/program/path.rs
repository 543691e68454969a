//! The blocks of a plan → whether all of them have kept to their path since the last frame.
//!
//! A mechanism keeps to its path where its equations have one solution near a straight line through both frames all the while: then
//! this frame is the one that the last one leads to, in the same assembly mode. That is so where a Newton operator with the
//! Jacobian of this frame contracts (Krawczyk 1969; Neumaier, Interval Methods for Systems of Equations, 1990, chapter 5), for which
//! [`Enclosures`] bound how far the equations are from zero on the line, and how far the Jacobian changes. Blocks are looked at
//! together, because bounds that pass from one to the next grow by more than what they bound. What is explicit has no other
//! solution. Deliberately unknown here: how a part is solved.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::builder::{Builder, Direction};
use super::function::{Function, Statement, Written};
use super::passes::enclosure::{Enclosure, Enclosures, Span};
use super::two_links::TwoLinks;
use crate::expr::{ExprId, Node, SymbolId};
use crate::joint::Quantity;
use crate::structure::{Definition, Part, SolvedBlock};
use crate::system::{SymbolRole, System};

/// How many symbols a definition may mention that takes the place of what it defines.
const SHORT: usize = 16;

/// What is known of all values while paths are looked at.
pub(super) struct Paths {
    /// What the span is like.
    pub span: Span,
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
    /// The angles whose arms have been computed.
    turned: HashSet<usize>,
    sags: HashMap<usize, SymbolId>,
}

impl Paths {
    pub fn new(system: &mut System) -> Paths {
        let span = Span {
            time: system.intermediate("span_time"),
            stretch: system.intermediate("span_stretch"),
            bend: system.intermediate("span_bend"),
            beyond: system.intermediate("span_beyond"),
            rounding: system.intermediate("span_rounding"),
        };
        Paths {
            span,
            enclosures: Enclosures::new(span, system),
            links: HashMap::new(),
            directions: HashMap::new(),
            definitions: HashMap::new(),
            awaited: HashMap::new(),
            keeps_angles: system.mechanism.requests.is_empty(),
            signals: HashSet::new(),
            turned: HashSet::new(),
            sags: HashMap::new(),
        }
    }

    /// Forgets all bounds.
    fn begin(&mut self, system: &mut System) {
        self.enclosures = Enclosures::new(self.span, system);
        self.definitions.clear();
        self.awaited.clear();
        self.signals.clear();
        self.turned.clear();
        self.sags.clear();
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
    pub sags: HashMap<usize, SymbolId>,
    /// The symbols of the span.
    pub span: Span,
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

/// Equations that are looked at together.
#[derive(Default)]
struct Loops {
    unknowns: Vec<usize>,
    /// Where each unknown stands among them.
    columns: HashMap<usize, usize>,
    /// How far the unknowns go along the line.
    ways: Vec<SymbolId>,
    residuals: Vec<ExprId>,
    /// The block of each equation, by its place in the plan.
    blocks: Vec<usize>,
}

impl Builder<'_> {
    /// What shows that these blocks, with their places in the plan, have kept to their path.
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
            sags: std::mem::take(&mut self.paths.sags),
            span: self.paths.span,
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
            if !self.paths.turned.insert(angle) {
                continue;
            }
            match self.paths.directions.get(&angle) {
                Some(&[cosine, sine]) => {
                    let [cosine, sine] = [cosine, sine].map(|it| self.graph().variable(it));
                    self.arms(angle, Direction { cosine, sine });
                }
                None => self.explicit_angle(angle),
            }
        }
    }

    /// An expression with definitions in place of the unknowns that they define: arms of one body are one arm then.
    pub(super) fn in_short(&mut self, expr: ExprId) -> ExprId {
        let graph = &mut self.system.mechanism.graph;
        let definitions = graph.symbols(expr).iter();
        let definitions =
            definitions.filter_map(|symbol| Some((*symbol, *self.paths.definitions.get(symbol)?)));
        let definitions: Vec<(SymbolId, ExprId)> = definitions.collect();
        graph.substitute(expr, &definitions)
    }

    fn path_of_part(&mut self, part: &Part, block: usize, loops: &mut Loops) {
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

    /// Looks at these equations together with others.
    fn join(&mut self, unknowns: &[usize], residuals: &[ExprId], block: usize, loops: &mut Loops) {
        for &unknown in unknowns {
            let way = self.way(unknown);
            // On the line the unknowns have no sag of their own.
            let (radius, sag) = (self.graph().variable(way), self.graph().zero());
            self.know(unknown, Enclosure { radius, sag });
            loops.ways.push(way);
            loops.columns.insert(unknown, loops.unknowns.len());
            loops.unknowns.push(unknown);
        }
        loops.residuals.extend(residuals);
        loops.blocks.extend(residuals.iter().map(|_| block));
    }

    /// Asks that equations have one solution near the line.
    fn isolate(&mut self, loops: Loops) {
        let Loops {
            unknowns,
            columns,
            ways,
            residuals,
            blocks,
        } = loops;
        if unknowns.is_empty() {
            return;
        }
        let sags: Vec<SymbolId> = unknowns.iter().map(|&it| self.bound(it, "sag")).collect();
        let bounds: Vec<ExprId> = residuals.iter().map(|&it| self.enclosure(it).sag).collect();
        self.require(blocks[0]);
        let mut jacobian = Vec::new();
        for (row, &residual) in residuals.iter().enumerate() {
            let rate = self.rate(residual);
            let rates = self.system.mechanism.graph.symbols(rate).iter();
            let own = rates.filter_map(|&symbol| match self.system.roles[symbol.index()] {
                SymbolRole::Rate(unknown) => Some((*columns.get(&unknown)?, symbol)),
                _ => None,
            });
            let own: BTreeMap<usize, SymbolId> = own.collect();
            for (column, own) in own {
                let entry = self.graph().derivative(rate, own);
                if entry != self.graph().zero() {
                    jacobian.push(([row, column], entry));
                }
            }
        }
        for ((&unknown, &way), &sag) in unknowns.iter().zip(&ways).zip(&sags) {
            let [way, sag] = [way, sag].map(|it| self.graph().variable(it));
            let radius = self.graph().add(way, sag);
            self.know(unknown, Enclosure { radius, sag });
        }
        let zero = self.graph().zero();
        let mut varied = Vec::new();
        let mut variation = Vec::new();
        for &(place, entry) in &jacobian {
            let radius = self.enclosure(entry).radius;
            if radius != zero {
                varied.push(place);
                variation.push(Written {
                    expr: radius,
                    bodies: Vec::new(),
                });
            }
        }
        let entries = jacobian.iter().map(|(_, entry)| *entry);
        let variations = variation.iter().map(|it| it.expr);
        let all: Vec<ExprId> = entries
            .chain(variations)
            .chain(bounds.iter().copied())
            .collect();
        let sizes = unknowns.iter().map(|&it| self.size(it)).collect();
        self.path_geometry(&all);
        self.state(Statement::Isolate {
            blocks: blocks.clone(),
            found: sags.clone(),
            bounds,
            sizes,
            jacobian,
            varied,
            variation: Box::new(Function {
                results: variation,
                ..Function::default()
            }),
        });
        for ((&unknown, way), sag) in unknowns.iter().zip(ways).zip(sags) {
            self.paths.sags.insert(unknown, sag);
            let [way, sag] = [way, sag].map(|it| self.graph().variable(it));
            let reach = self.graph().add(way, sag);
            let radius = self.bound(unknown, "radius");
            self.assign(radius, reach);
            let radius = self.graph().variable(radius);
            self.know(unknown, Enclosure { radius, sag });
        }
        self.require(blocks[0]);
    }

    /// What rounding of an unknown is a part of: its value where it is a length.
    fn size(&mut self, unknown: usize) -> ExprId {
        let unknown = &self.system.vector_form.unknowns[unknown];
        match unknown.quantity {
            Quantity::Angle => self.graph().one(),
            Quantity::Length | Quantity::Power(_) => {
                let position = unknown.position;
                self.graph().variable(position)
            }
        }
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

    /// Where a definition is short, and not that of what turns arms or is driven, its value takes the place of what it defines. The
    /// others are looked at where something mentions what they define.
    pub(super) fn path_of_definition(&mut self, definition: &Definition, block: usize) {
        let value = self.in_short(definition.value);
        let own = &self.system.vector_form.unknowns[definition.unknown];
        let symbols = self.system.mechanism.graph.symbols(value);
        let mut roles = symbols.iter().map(|it| self.system.roles[it.index()]);
        let is_driven =
            roles.any(|role| matches!(role, SymbolRole::Time | SymbolRole::Input { .. }));
        if own.quantity != Quantity::Angle && !is_driven && symbols.len() <= SHORT {
            self.paths.definitions.insert(own.position, value);
        } else {
            let awaited = &mut self.paths.awaited;
            awaited.insert(definition.unknown, (*definition, block));
        }
    }

    /// The definition of what a symbol moves with, and its block, where nothing has mentioned it before.
    pub(super) fn awaited(&mut self, symbol: SymbolId) -> Option<(Definition, usize)> {
        let unknown = self.moving(symbol)?;
        self.paths.awaited.remove(&unknown)
    }

    /// Looks at the definitions of what an expression mentions, as far as nothing has mentioned it before.
    fn meet(&mut self, expr: ExprId, loops: &mut Loops) {
        for symbol in self.system.mechanism.graph.symbols(expr).to_vec() {
            if let Some((definition, block)) = self.awaited(symbol) {
                self.look_at_definition(&definition, block, loops);
            }
        }
    }

    fn look_at_definition(&mut self, definition: &Definition, block: usize, loops: &mut Loops) {
        let unknown = definition.unknown;
        let value = self.in_short(definition.value);
        self.meet(value, loops);
        let symbol = self.system.vector_form.unknowns[unknown].position;
        let symbols = self.system.mechanism.graph.symbols(value);
        let mut moving = symbols.iter().filter_map(|&symbol| self.moving(symbol));
        if moving.any(|unknown| loops.columns.contains_key(&unknown)) {
            let position = self.graph().variable(symbol);
            let residual = self.graph().subtract(position, value);
            return self.join(&[unknown], &[residual], block, loops);
        }
        let zero = self.graph().zero();
        let found = self.enclosure(value);
        self.path_geometry(&[found.radius, found.sag]);
        self.require(block);
        if found.radius == zero {
            return self.know(unknown, found);
        }
        let named = |builder: &mut Self, value: ExprId, what: &str| {
            if value == zero {
                return value;
            }
            let symbol = builder.bound(unknown, what);
            builder.assign(symbol, value);
            builder.graph().variable(symbol)
        };
        let sag = named(self, found.sag, "sag");
        // Between both frames it moves by their difference, and beyond them as much.
        let way = self.way(unknown);
        let way = self.graph().variable(way);
        let reach = self.graph().add(way, sag);
        let radius = named(self, reach, "radius");
        self.know(unknown, Enclosure { radius, sag });
    }

    /// How far an unknown goes along the line: what it has moved since the last frame, stretched.
    fn way(&mut self, unknown: usize) -> SymbolId {
        let way = self.bound(unknown, "way");
        let moved = match self.paths.directions.get(&unknown) {
            // Where the angle itself is not kept, the way is less than half a turn.
            Some(&[cosine, sine]) => {
                let both = [cosine, sine].map(|symbol| [symbol, self.system.last(symbol)]);
                let [[c, c_last], [s, s_last]] =
                    both.map(|pair| pair.map(|symbol| self.graph().variable(symbol)));
                let (along, across) = (
                    self.combined_product([c, c_last], [s, s_last], false),
                    self.combined_product([s, c_last], [c, s_last], true),
                );
                let moved = self.graph().atan2(across, along);
                self.graph().magnitude(moved)
            }
            None => {
                let symbol = self.system.vector_form.unknowns[unknown].position;
                let moved = self.moved(symbol);
                self.graph().magnitude(moved)
            }
        };
        let stretch = self.paths.span.stretch;
        let stretch = self.graph().variable(stretch);
        let value = self.graph().multiply(stretch, moved);
        self.assign(way, value);
        way
    }

    /// a b + c d, or else their difference.
    fn combined_product(
        &mut self,
        first: [ExprId; 2],
        second: [ExprId; 2],
        subtract: bool,
    ) -> ExprId {
        let [first, second] = [first, second].map(|factors| self.graph().product(&factors));
        match subtract {
            true => self.graph().subtract(first, second),
            false => self.graph().add(first, second),
        }
    }

    /// A value less what it was.
    fn moved(&mut self, symbol: SymbolId) -> ExprId {
        let last = self.system.last(symbol);
        let [now, before] = [symbol, last].map(|it| self.graph().variable(it));
        self.graph().subtract(now, before)
    }

    /// A symbol for a bound of an unknown.
    fn bound(&mut self, unknown: usize, what: &str) -> SymbolId {
        let name = self.system.unknown_name(unknown);
        let name = format!("{name}_{what}");
        self.system.intermediate(&name)
    }

    pub(super) fn know(&mut self, unknown: usize, enclosure: Enclosure) {
        let symbol = self.system.vector_form.unknowns[unknown].position;
        self.paths.enclosures.know(symbol, enclosure);
    }

    /// States that nothing moves an unknown.
    pub(super) fn know_still(&mut self, unknown: usize) {
        let zero = self.graph().zero();
        self.know(
            unknown,
            Enclosure {
                radius: zero,
                sag: zero,
            },
        );
    }

    pub(super) fn enclosure(&mut self, expr: ExprId) -> Enclosure {
        self.meet_signals(expr);
        self.paths.enclosures.of(expr, self.system)
    }

    /// States what the bounds of a block rely on.
    pub(super) fn require(&mut self, block: usize) {
        let mut required = std::mem::take(&mut self.paths.enclosures.required);
        required.sort_unstable();
        required.dedup();
        self.path_geometry(&required);
        for value in required {
            self.state(Statement::Require { value, block });
        }
    }

    /// States the bounds of the inputs that an expression mentions.
    fn meet_signals(&mut self, expr: ExprId) {
        for symbol in self.system.mechanism.graph.symbols(expr).to_vec() {
            let SymbolRole::Input { input, level: 0 } = self.system.roles[symbol.index()] else {
                continue;
            };
            if !self.paths.signals.insert(input) {
                continue;
            }
            let name = self.system.mechanism.inputs[input].name.to_lowercase();
            let found =
                ["radius", "sag"].map(|what| self.system.intermediate(&format!("{name}_{what}")));
            self.state(Statement::Signal { input, found });
            let [radius, sag] = found.map(|it| self.graph().variable(it));
            self.paths
                .enclosures
                .know(symbol, Enclosure { radius, sag });
        }
    }
}
