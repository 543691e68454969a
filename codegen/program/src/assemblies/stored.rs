//! Finds all assemblies of a mechanism at t = 0, with nominal parameters and initial values of inputs.
//!
//! Every block contributes both signs of its closed forms and all poses of Newton-Raphson. Generated code starts from these
//! assemblies. So they are stored only if they are proven complete, and if their letters agree with `linkwright check`.

use super::enclosed::Enclosing;
use super::interval::Interval;
use super::poses::{Poses, poses};
use super::turns::counts_turns;
use crate::expr::SymbolId;
use crate::joint::Quantity;
use crate::pool::Pool;
use crate::program::{Block, Level, NewtonBlock, Program, Statement, TornFields, sign_of};
use crate::system::System;

/// Largest number of examined parts of each block.
const MOST_PARTS: usize = 20_000;

/// Largest number of stored assemblies.
const MOST_STORED: usize = 64;

/// Largest number of tried combinations of signs and poses.
const MOST_TRIED: usize = 512;

/// All assemblies, and the unknowns that give them.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredAssemblies {
    /// Unknowns of the vector form: those of every block of Newton-Raphson, block by block.
    pub unknowns: Vec<usize>,
    /// Assemblies: positive signs first, then ascending in the searched unknowns.
    pub all: Vec<StoredAssembly>,
}

/// Assembly of a mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredAssembly {
    /// Label as in `linkwright check`: `+-b`, a sign for each closed form and a letter for each block without one.
    pub label: String,
    /// True for each closed form with a positive sign, in the order of the program's branches.
    pub signs: Vec<bool>,
    /// Sign of the determinant of each block without a closed form; `None` if it is nearly zero.
    pub determinants: Vec<Option<bool>>,
    /// Values of the unknowns to ten digits, the start of Newton-Raphson. Angles are within half a turn of the design
    /// configuration.
    pub values: Vec<f64>,
}

/// Returns all assemblies of a mechanism that needs Newton-Raphson; `None` without such a block, or if some may be missing.
pub fn stored(pool: &Pool, system: &System, program: &Program) -> Option<StoredAssemblies> {
    let iterated = program.blocks.iter();
    let iterated: Vec<&NewtonBlock> = iterated.filter_map(|it| it.newton.as_ref()).collect();
    if iterated.is_empty() || counts_turns(pool, system, program) {
        return None;
    }
    let mut search = Search {
        pool,
        system,
        program,
        tried: 0,
        all: Vec::new(),
    };
    let way = Way {
        enclosing: given(pool, system),
        signs: vec![true; program.branches.len()],
        letters: String::new(),
        determinants: Vec::new(),
        values: Vec::new(),
    };
    search.below(0, way)?;
    let unknowns = iterated.iter().flat_map(|it| it.unknowns.iter().copied());
    (!search.all.is_empty()).then(|| StoredAssemblies {
        unknowns: unknowns.collect(),
        all: search.all,
    })
}

/// Rounds a value to ten digits: of a radian, or of the value itself.
fn rounded(value: f64, quantity: Quantity) -> f64 {
    let text = match quantity {
        Quantity::Angle => format!("{value:.10}"),
        _ => format!("{value:.9e}"),
    };
    // Adding 0.0 removes the sign of a zero.
    text.parse().map_or(value, |rounded: f64| rounded + 0.0)
}

/// Returns the bounds of all symbols before the first block.
fn given<'a>(pool: &'a Pool, system: &System) -> Enclosing<'a> {
    let mechanism = &system.mechanism;
    let graph = &pool.graph;
    let mut enclosing = Enclosing::new(graph, &[]);
    enclosing.know(mechanism.time, Interval::point(0.0));
    let mut nominal = vec![0.0; graph.symbol_count()];
    graph.fill_nominal(&mut nominal);
    for parameter in &mechanism.parameters {
        let value = nominal[parameter.symbol.index()];
        enclosing.know(parameter.symbol, Interval::point(value));
    }
    for input in &mechanism.inputs {
        if let Some(value) = graph.constant_value(input.initial) {
            enclosing.know(input.symbols[0], Interval::point(value));
        }
    }
    enclosing
}

/// Choices and results so far.
#[derive(Clone)]
struct Way<'a> {
    enclosing: Enclosing<'a>,
    signs: Vec<bool>,
    letters: String,
    determinants: Vec<Option<bool>>,
    values: Vec<f64>,
}

struct Search<'a> {
    pool: &'a Pool,
    system: &'a System,
    program: &'a Program,
    tried: usize,
    all: Vec<StoredAssembly>,
}

impl<'a> Search<'a> {
    /// Tries all signs and poses of this block and later ones; `None` if something stays undecided.
    fn below(&mut self, index: usize, way: Way<'a>) -> Option<()> {
        let Some(block) = self.program.blocks.get(index) else {
            let signs = way.signs.iter().map(|&it| if it { '+' } else { '-' });
            self.all.push(StoredAssembly {
                label: signs.chain(way.letters.chars()).collect(),
                signs: way.signs,
                determinants: way.determinants,
                values: way.values,
            });
            return (self.all.len() <= MOST_STORED).then_some(());
        };
        let branches = self.program.branches.iter().enumerate();
        let branches_of_block: Vec<usize> = branches
            .filter(|(_, branch)| Some(branch.block) == block.place)
            .map(|(place, _)| place)
            .collect();
        // Positive signs come first; the first sign changes fastest.
        for choice in 0..1_usize << branches_of_block.len().min(MOST_TRIED.ilog2() as usize) {
            self.tried += 1;
            if self.tried > MOST_TRIED {
                return None;
            }
            let mut way = way.clone();
            for (bit, &place) in branches_of_block.iter().enumerate() {
                let is_positive = choice >> bit & 1 == 0;
                way.signs[place] = is_positive;
                let value = Interval::point(if is_positive { 1.0 } else { -1.0 });
                let symbol = self.program.branches[place].symbol;
                way.enclosing.know(symbol, value);
            }
            self.through(index, block, 0, way)?;
        }
        Some(())
    }

    /// Evaluates the statements of a block from one of them on.
    fn through(
        &mut self,
        index: usize,
        block: &'a Block,
        from: usize,
        mut way: Way<'a>,
    ) -> Option<()> {
        for (at, statement) in block.function.statements.iter().enumerate().skip(from) {
            match statement {
                Statement::Section(level) if *level != Level::Position => break,
                Statement::Angle {
                    target,
                    sine,
                    cosine,
                } => {
                    let [y, x] = [*sine, *cosine].map(|it| way.enclosing.known(it));
                    let angle = self.near_drawing(*target, y?, x?)?;
                    way.enclosing.know(*target, angle);
                }
                Statement::Reach { excess, .. } => {
                    let excess = way.enclosing.known(*excess)?;
                    if excess.high < 0.0 {
                        return Some(());
                    }
                    if !(excess.defined && excess.low > 0.0) {
                        return None;
                    }
                }
                Statement::Newton { found, torn, .. } => {
                    let newton = block.newton.as_ref()?;
                    let symbols: Vec<SymbolId> = found.iter().map(|it| it[0]).collect();
                    for (place, values) in self.poses(newton, &way)?.into_iter().enumerate() {
                        let way =
                            self.posed(newton, &symbols, torn.as_ref(), place, values, &way)?;
                        self.through(index, block, at + 1, way)?;
                    }
                    return Some(());
                }
                _ => way.enclosing.statement(statement),
            }
        }
        self.below(index + 1, way)
    }

    /// Returns the poses of a block; `None` if others are not excluded.
    fn poses(&self, newton: &NewtonBlock, way: &Way<'a>) -> Option<Vec<Vec<f64>>> {
        let known = |symbol: SymbolId| way.enclosing.known_symbol(symbol);
        let Poses {
            found, undecided, ..
        } = poses(newton, self.pool, self.system, &known, MOST_PARTS)?;
        undecided
            .is_empty()
            .then(|| found.into_iter().map(|pose| pose.unknowns).collect())
    }

    /// Returns the state after a block in one of its poses.
    fn posed(
        &self,
        newton: &NewtonBlock,
        symbols: &[SymbolId],
        torn: Option<&TornFields>,
        place: usize,
        values: Vec<f64>,
        way: &Way<'a>,
    ) -> Option<Way<'a>> {
        let mut way = way.clone();
        let letter = u8::try_from(place).ok()?.checked_add(b'a')?;
        way.letters
            .push(letter.is_ascii_lowercase().then_some(char::from(letter))?);
        for (at, (&symbol, value)) in symbols.iter().zip(values).enumerate() {
            let unknown = &self.system.vector_form.unknowns[newton.unknowns[at]];
            let value = Interval::point(value);
            let value = match unknown.quantity == Quantity::Angle {
                true => self.near_drawing(symbol, value.sine(), value.cosine())?,
                false => value,
            };
            if let Some(Some([sine, cosine])) = torn.map(|it| it.directions[at]) {
                way.enclosing.know(sine, value.sine());
                way.enclosing.know(cosine, value.cosine());
            }
            way.enclosing.know(symbol, Interval::point(value.middle()));
            way.values.push(rounded(value.middle(), unknown.quantity));
        }
        let mut enclosing = way.enclosing.clone();
        enclosing.statements(&newton.jacobian);
        let entries = newton.jacobian.results.iter();
        let entries: Option<Vec<f64>> = entries
            .map(|entry| Some(enclosing.known(entry.expr)?.middle()))
            .collect();
        way.determinants.push(sign_of(&entries?));
        Some(way)
    }

    /// Returns the angle of a vector nearest to the design configuration.
    fn near_drawing(&self, target: SymbolId, y: Interval, x: Interval) -> Option<Interval> {
        let drawn = self.system.drawn_symbol(target, self.pool);
        // This branch avoids the jump of angles.
        let forwards = Interval::angle(y, x);
        let angle = match forwards.defined {
            true => forwards,
            false => {
                let backwards = Interval::angle(y.negated(), x.negated());
                backwards.plus(Interval::about(std::f64::consts::PI))
            }
        };
        if !angle.defined {
            return None;
        }
        let turn = std::f64::consts::TAU;
        let turns = ((drawn - angle.middle()) / turn).round();
        match turns.is_finite() {
            true => Some(angle.plus(Interval::point(turns).times(Interval::about(turn)))),
            false => Some(angle),
        }
    }
}
