//! Searches a sequence of closed forms for all unknowns except for a few tearing variables.
//!
//! Of all sequences with the fewest tearing variables, the one with the fewest operations is taken, and of equal ones the first.
//! Sequences that are nearly singular in the design configuration are excluded. The search is bounded: tearing variables are
//! tried one by one, and in pairs if an equation has both.

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use super::three_circles::ThreeCircles;
use super::two_pins::TwoPins;
use crate::expr::ExprId;
use crate::joint::Quantity;
use crate::program::forms::{Candidate, Form, closed};
use crate::program::tearing::MOST_TEARS;
use crate::words::Singular;

/// Approximate numbers of operations of one evaluation, with its derivative in a tearing variable: closed forms of two equations,
/// of one equation, a link with two pins, and three circles.
const COSTS: [usize; 4] = [60, 40, 20, 70];

/// Largest number of unknowns for which tearing variables are searched.
const LARGEST_TORN: usize = 256;

/// Solution of a subsystem for given tearing variables.
#[derive(Clone, Debug)]
pub(in crate::program::forms) struct Sequence {
    /// Tearing variables: unknowns of the vector form.
    pub tears: Vec<usize>,
    /// Steps, in the order of evaluation.
    pub steps: Vec<Step>,
    /// Tearing residuals, one per tearing variable, in order.
    pub remaining: Vec<Remaining>,
}

/// Solution of some unknowns.
#[derive(Clone, Debug)]
pub(in crate::program::forms) enum Step {
    /// Closed form.
    Closed(Arc<dyn Form>),
    /// Link between two known pins: its direction follows, and its length gives a residual.
    TwoPins(TwoPins),
    /// Three links that meet: two differences of their circles are linear, and the length of the first link gives a residual.
    ThreeCircles(ThreeCircles),
}

/// Source of a tearing residual.
#[derive(Clone, Copy, Debug)]
pub(in crate::program::forms) enum Remaining {
    /// Equation of the subsystem, by its index.
    Equation(usize),
    /// Length of the link of a step, by the index of the step, with the index of its first equation.
    Length { step: usize, equation: usize },
}

/// One equation, or the two components of a vector equation.
#[derive(Clone, Debug)]
struct Item {
    equations: Vec<usize>,
    mentions: BTreeSet<usize>,
}

/// Search for the sequences of a subsystem.
pub(super) struct Search<'a, 'b> {
    candidate: &'a mut Candidate<'b>,
    items: Vec<Item>,
    /// Results of tried solutions of an item for its open unknowns; only looked up.
    tried: HashMap<(usize, Vec<usize>), Option<Step>>,
}

impl<'a, 'b> Search<'a, 'b> {
    pub fn new(candidate: &'a mut Candidate<'b>) -> Search<'a, 'b> {
        let items = items(candidate);
        Search {
            candidate,
            items,
            tried: HashMap::new(),
        }
    }

    /// Returns the sequences with the fewest tearing variables, the cheapest first.
    pub fn sequences(&mut self) -> Vec<Sequence> {
        let unknowns = self.candidate.unknowns.to_vec();
        if unknowns.len() > LARGEST_TORN {
            return Vec::new();
        }
        for count in 1..=MOST_TEARS {
            // A sequence of one step saves nothing.
            if unknowns.len() < count + 2 {
                break;
            }
            let choices = self.choices(&unknowns, count).into_iter();
            let mut sequences: Vec<(usize, Sequence)> = choices
                .flat_map(|tears| [true, false].map(|circles| self.with(&tears, circles)))
                .flatten()
                .collect();
            sequences.sort_by_key(|(cost, _)| *cost);
            if !sequences.is_empty() {
                return sequences
                    .into_iter()
                    .map(|(_, sequence)| sequence)
                    .collect();
            }
        }
        Vec::new()
    }

    /// Returns the sets of tearing variables that are tried.
    fn choices(&self, unknowns: &[usize], count: usize) -> Vec<Vec<usize>> {
        match count {
            1 => unknowns.iter().map(|&it| vec![it]).collect(),
            _ => {
                let pairs = self.items.iter().flat_map(|item| {
                    let mentions: Vec<usize> = item.mentions.iter().copied().collect();
                    let pair = |at: usize| {
                        let others = mentions[at + 1..].iter();
                        others
                            .map(|&other| [mentions[at], other])
                            .collect::<Vec<_>>()
                    };
                    (0..mentions.len()).flat_map(pair).collect::<Vec<_>>()
                });
                let pairs: BTreeSet<[usize; 2]> = pairs.collect();
                pairs.into_iter().map(Vec::from).collect()
            }
        }
    }

    /// Returns the sequence of these tearing variables, with its cost; `None` if an unknown does not follow. If `circles` is
    /// true, the sequence ends with three of them.
    fn with(&mut self, tears: &[usize], circles: bool) -> Option<(usize, Sequence)> {
        let mut known: BTreeSet<usize> = tears.iter().copied().collect();
        let mut left: Vec<usize> = (0..self.items.len()).collect();
        let (mut steps, mut remaining, mut cost) = (Vec::new(), Vec::new(), 0);
        while !left.is_empty() {
            if remaining.len() > tears.len() {
                return None;
            }
            let open =
                |item: &Item| -> Vec<usize> { item.mentions.difference(&known).copied().collect() };
            if circles && left.len() == 2 {
                let step = self.circles(
                    [left[0], left[1]],
                    [0, 1].map(|at| open(&self.items[left[at]])),
                )?;
                let equation = self.items[left[0]].equations[0];
                remaining.push(Remaining::Length {
                    step: steps.len(),
                    equation,
                });
                known.extend(step.unknowns());
                steps.push(step);
                cost += COSTS[3];
                left.clear();
                continue;
            }
            // Closed forms come first: a link between two known pins leaves an equation that a closed form may not leave.
            let next_step = [false, true].into_iter().find_map(|by_length| {
                (0..left.len()).find_map(|at| {
                    let item = &self.items[left[at]];
                    let (equations, open) = (item.equations.len(), open(item));
                    match (equations, open.len(), by_length) {
                        (_, 0, false) => Some((at, None)),
                        (1, 1, false) | (2, 2, false) | (2, 1, true) => {
                            let step = self.step(left[at], open)?;
                            Some((at, Some(step)))
                        }
                        _ => None,
                    }
                })
            });
            let (at, step) = next_step?;
            let item = &self.items[left.remove(at)];
            match step {
                None => remaining.extend(item.equations.iter().map(|&it| Remaining::Equation(it))),
                Some(step) => {
                    cost += match (&step, item.equations.len()) {
                        (Step::TwoPins(_) | Step::ThreeCircles(_), _) => COSTS[2],
                        (Step::Closed(_), 1) => COSTS[1],
                        (Step::Closed(_), _) => COSTS[0],
                    };
                    if let Step::TwoPins(_) = step {
                        let equation = item.equations[0];
                        let step = steps.len();
                        remaining.push(Remaining::Length { step, equation });
                    }
                    known.extend(step.unknowns());
                    steps.push(step);
                }
            }
        }
        let is_whole = self.candidate.unknowns.iter().all(|it| known.contains(it));
        // A closed form gives the direction of an angle, and not its number of turns.
        let wound = self.wound();
        let counts = |step: &Step| match step {
            Step::Closed(form) => matches!(form.singular(), Singular::Coefficient(_)),
            _ => false,
        };
        let directed = steps.iter().filter(|step| !counts(step));
        if directed
            .flat_map(Step::unknowns)
            .any(|it| wound.contains(&it))
        {
            return None;
        }
        let ends_so = matches!(steps.last(), Some(Step::ThreeCircles(_))) == circles;
        (is_whole && ends_so && remaining.len() == tears.len()).then(|| {
            (
                cost,
                Sequence {
                    tears: tears.to_vec(),
                    steps,
                    remaining,
                },
            )
        })
    }

    /// Returns the angles that equations mention directly, and not only through rotated vectors.
    fn wound(&self) -> BTreeSet<usize> {
        let Candidate {
            equations,
            form,
            pool,
            ..
        } = &*self.candidate;
        let unknowns = self.candidate.unknowns.iter().copied();
        let angles = unknowns.filter(|&it| form.unknowns[it].quantity == Quantity::Angle);
        let is_mentioned = |unknown: &usize| {
            let symbol = form.unknowns[*unknown].position;
            let mut equations = equations.iter();
            equations.any(|&equation| pool.graph.depends_on(equation, symbol))
        };
        angles.filter(is_mentioned).collect()
    }

    /// Returns the common solution of two items for the open unknowns of each; `None` if there is none.
    fn circles(&mut self, items: [usize; 2], open: [Vec<usize>; 2]) -> Option<Step> {
        let equations = items.map(|item| self.items[item].equations.clone());
        let ([x, y], [u, v]) = (&equations[0][..], &equations[1][..]) else {
            return None;
        };
        let ([a, b], [c, d]) = (&open[0][..], &open[1][..]) else {
            return None;
        };
        let (equations, unknowns) = ([[*x, *y], [*u, *v]], [[*a, *b], [*c, *d]]);
        ThreeCircles::of(equations, unknowns, self.candidate).map(Step::ThreeCircles)
    }

    /// Returns the solution of an item for its open unknowns; `None` if there is none.
    fn step(&mut self, item: usize, open: Vec<usize>) -> Option<Step> {
        let Search {
            candidate,
            items,
            tried,
        } = self;
        let equations = &items[item].equations;
        let key = (item, open);
        if let Some(known) = tried.get(&key) {
            return known.clone();
        }
        let step = match (&equations[..], &key.1[..]) {
            (&[x, y], &[unknown]) => TwoPins::of([x, y], unknown, candidate).map(Step::TwoPins),
            (equations, open) => closed(equations, open, candidate)
                .filter(|form| keeps_its_line(form.as_ref(), candidate))
                .map(Step::Closed),
        };
        tried.insert(key, step.clone());
        step
    }
}

impl Step {
    /// Returns the unknowns that the step solves for.
    pub fn unknowns(&self) -> Vec<usize> {
        match self {
            Step::Closed(form) => form.unknowns(),
            Step::TwoPins(link) => vec![link.angle],
            Step::ThreeCircles(circles) => circles.angles.to_vec(),
        }
    }
}

/// True if a line that a closed form rotates is constant in the orientation of its angle. Other lines move with the tearing
/// variables, which costs as much as it saves.
fn keeps_its_line(form: &dyn Form, candidate: &Candidate<'_>) -> bool {
    let Singular::TurningLine {
        start, direction, ..
    } = form.singular()
    else {
        return true;
    };
    let mut parts = [start, direction].into_iter().flatten();
    parts.all(|part| candidate.pool.graph.is_fixed(part))
}

/// Returns single equations, and the components of vector equations as pairs.
fn items(candidate: &Candidate<'_>) -> Vec<Item> {
    let count = candidate.equations.len();
    let row = |at: usize| &candidate.form.rows[candidate.rows[at]];
    let unknowns: BTreeSet<usize> = candidate.unknowns.iter().copied().collect();
    let mentions = |equation: ExprId| {
        let mentioned = candidate.pool.mentioned(equation);
        mentioned
            .into_iter()
            .filter(|it| unknowns.contains(it))
            .collect::<BTreeSet<usize>>()
    };
    let (mut items, mut at) = (Vec::new(), 0);
    while at < count {
        let is_pair = at + 1 < count && row(at).joint == row(at + 1).joint && {
            let components = [row(at).component, row(at + 1).component];
            components == ["x", "y"]
        };
        let equations: Vec<usize> = (at..at + 1 + usize::from(is_pair)).collect();
        at += equations.len();
        let mentioned = equations
            .iter()
            .flat_map(|&it| mentions(candidate.equations[it]));
        items.push(Item {
            mentions: mentioned.collect(),
            equations,
        });
    }
    items
}
