//! Proves that the two modes of a block never meet, for closed forms and ranges of their drivers.
//!
//! The modes of two links meet if the links are collinear, so that the square of their half chord vanishes. Angles and lengths of
//! drivers may have any value of their laws, and modes either sign. Angles that parameters or inputs change range over a turn,
//! other such values are unbounded, and nothing is proven of these.

use std::collections::{HashSet, VecDeque};
use std::f64::consts::TAU;

use super::enclosed::{Enclosed, Enclosing, Place};
use super::interval::Interval;
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::Quantity;
use crate::pool::{Pool, SymbolRole};
use crate::program::{Program, Statement};
use crate::system::System;

/// Smallest square of a half chord, relative to the links, that separates modes: the links then enclose more than a hundredth of
/// a radian.
const LEAST_CHORD: f64 = 1e-4;

/// Largest number of modes of earlier blocks that may have either sign.
const MOST_SIGNS: usize = 4;

/// Largest number of examined boxes of arguments for a block, over all modes of earlier blocks.
const BOXES: usize = 2048;

/// Number of boxes, of each choice of modes, whose middles are examined as well. Whatever refutes later boxes lies between these.
const MIDDLES: usize = 64;

/// Traversal of the blocks of a program.
struct Walk<'a> {
    pool: &'a Pool,
    system: &'a System,
    enclosing: Enclosing<'a>,
    /// Symbols that change in time other than by arguments; only looked up.
    moving: HashSet<SymbolId>,
    /// Ranges of the arguments, the driven quantities, in order.
    driven: Vec<[f64; 2]>,
    /// Number of arguments at the last half chord; later ones belong to rates.
    at_chord: usize,
    /// Blocks of the plan whose modes are the first arguments.
    signs: Vec<usize>,
}

/// Returns, for each block of a program, true if its modes are proven never to meet.
pub fn never_meet(pool: &Pool, system: &System, program: &Program) -> Vec<bool> {
    let mut walk = Walk::new(pool, system, program);
    let blocks = program.blocks.iter();
    blocks
        .map(|block| {
            let mut chords = Vec::new();
            for statement in &block.function.statements {
                walk.statement(statement, &mut chords);
            }
            block.newton.is_none() && walk.are_apart(&chords, block.place)
        })
        .collect()
}

impl<'a> Walk<'a> {
    fn new(pool: &'a Pool, system: &'a System, program: &Program) -> Walk<'a> {
        let graph: &'a Graph = &pool.graph;
        let signs: Vec<SymbolId> = program.branches.iter().map(|it| it.symbol).collect();
        let mut enclosing = Enclosing::new(graph, &signs);
        let time = system.mechanism.time;
        let always = Interval::new(f64::NEG_INFINITY, f64::INFINITY);
        enclosing.know(time, always);
        let inputs = system.mechanism.inputs.iter();
        let inputs = inputs.flat_map(|input| input.symbols);
        Walk {
            pool,
            system,
            enclosing,
            moving: inputs.chain([time]).collect(),
            driven: Vec::new(),
            at_chord: 0,
            signs: program.branches.iter().map(|it| it.block).collect(),
        }
    }

    fn is_moving(&self, expr: ExprId) -> bool {
        let symbols = self.pool.graph.symbols(expr);
        symbols.iter().any(|symbol| self.moving.contains(symbol))
    }

    /// Returns the bounds of a moving value; `None` if it has none.
    fn range(&mut self, expr: ExprId) -> Option<[f64; 2]> {
        let range = self.enclosing.known(expr)?;
        (range.defined && (range.high - range.low).is_finite()).then_some([range.low, range.high])
    }

    /// Adds an argument with this range.
    fn argument(&mut self, range: [f64; 2]) -> Place {
        self.driven.push(range);
        Place::Argument(self.signs.len() + self.driven.len() - 1)
    }

    fn statement(&mut self, statement: &Statement, chords: &mut Vec<[Place; 2]>) {
        match *statement {
            Statement::Let { target, value, .. } if self.is_moving(value) => {
                let is_driven = match self.pool.role(target) {
                    SymbolRole::Position(place) => {
                        Some(self.system.vector_form.unknowns[place].quantity)
                    }
                    _ => None,
                };
                match (is_driven, self.range(value)) {
                    (Some(Quantity::Length), Some(range)) => {
                        let argument = self.argument(range);
                        self.enclosing.bind(target, argument);
                    }
                    // Angles that gears tie to an angle rotate by other amounts: each is bounded by itself.
                    _ => {
                        self.moving.insert(target);
                        self.enclosing.statement(statement);
                    }
                }
            }
            Statement::SineCosine {
                sine,
                cosine,
                angle,
            } if self.is_moving(angle) => {
                let turn = [0.0, TAU];
                let range = self.range(angle);
                let range = range.filter(|[low, high]| high - low < TAU).unwrap_or(turn);
                let argument = self.argument(range);
                let [s, c] = [
                    self.enclosing.sine(argument),
                    self.enclosing.cosine(argument),
                ];
                self.enclosing.bind(sine, s);
                self.enclosing.bind(cosine, c);
            }
            Statement::Reach { excess, scale, .. } => {
                chords.push([excess, scale].map(|it| self.enclosing.value(it)));
                self.at_chord = self.driven.len();
            }
            _ => self.enclosing.statement(statement),
        }
    }

    /// True if the links of a block are never collinear.
    fn are_apart(&self, chords: &[[Place; 2]], block: Option<usize>) -> bool {
        let signs = self.signs.iter().enumerate();
        let before: Vec<usize> = signs
            .filter(|(_, own)| Some(**own) < block)
            .map(|(at, _)| at)
            .collect();
        if chords.is_empty() || before.len() > MOST_SIGNS {
            return false;
        }
        let enclosed = self.enclosing.clone().finish(chords.concat());
        let mut boxes = BOXES;
        (0..1_u32 << before.len()).all(|modes| {
            let mut arguments = vec![Interval::point(1.0); self.signs.len()];
            for (bit, &at) in before.iter().enumerate() {
                if modes & (1 << bit) != 0 {
                    arguments[at] = Interval::point(-1.0);
                }
            }
            for (place, &[low, high]) in self.driven.iter().enumerate() {
                // Arguments behind `at_chord` do not affect the chords.
                let is_used = place < self.at_chord;
                arguments.push(Interval::new(low, if is_used { high } else { low }));
            }
            is_apart(&enclosed, arguments, &mut boxes)
        })
    }
}

/// True if all half chords stay above the smallest one; bisects boxes of arguments.
///
/// Bounds at the middle of a box refute the whole box: no smaller box that contains this point has narrower bounds. Large boxes come
/// first, so that their middles cover the ranges early.
fn is_apart(enclosed: &Enclosed, whole: Vec<Interval>, boxes: &mut usize) -> bool {
    let mut registers = Vec::new();
    let mut open = VecDeque::from([whole]);
    let mut middles = MIDDLES;
    let mut are_apart = |arguments: &[Interval]| {
        let bounds = enclosed.at(arguments, &mut registers);
        bounds
            .chunks_exact(2)
            .all(|it| it[0].defined && it[1].defined && it[0].low > LEAST_CHORD * it[1].high)
    };
    while let Some(mut arguments) = open.pop_front() {
        if *boxes == 0 {
            return false;
        }
        *boxes -= 1;
        if are_apart(&arguments) {
            continue;
        }
        if middles > 0 {
            middles -= 1;
            let middle: Vec<Interval> = arguments
                .iter()
                .map(|it| Interval::point(it.middle()))
                .collect();
            if !are_apart(&middle) {
                return false;
            }
        }
        let widths = arguments.iter().map(|it| it.high - it.low);
        let widest = widths
            .enumerate()
            .max_by(|one, other| one.1.total_cmp(&other.1));
        let Some((widest, _)) = widest.filter(|it| it.1 > 0.0) else {
            return false;
        };
        let Interval { low, high, .. } = arguments[widest];
        let middle = arguments[widest].middle();
        let mut other = arguments.clone();
        other[widest] = Interval::new(middle, high);
        arguments[widest] = Interval::new(low, middle);
        open.extend([arguments, other]);
    }
    true
}
