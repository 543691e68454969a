//! Equations and unknowns → a sequence of closed forms that finds all unknowns but a few, the tears.
//!
//! Of all sequences with the fewest tears the one is taken that costs the fewest operations, and of equal ones the first. What is
//! nearly singular in the drawing is none. The search is bounded: tears are tried one by one, and pairs of them where some equation
//! holds both. Deliberately unknown here: how a sequence is solved.

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use super::three_circles::ThreeCircles;
use super::two_pins::TwoPins;
use crate::expr::ExprId;
use crate::joint::Quantity;
use crate::program::forms::{Candidate, Form, closed};
use crate::program::tearing::MOST_TEARS;
use crate::words::Singular;

/// About how many operations a closed form takes in one evaluation, with its derivative by a tear: of two equations, of one, and of a
/// link with two pins; and of three circles.
const COSTS: [usize; 4] = [60, 40, 20, 70];

/// The most unknowns among which tears are looked for.
const LARGEST_TORN: usize = 256;

/// How a part is solved with its tears given.
#[derive(Clone, Debug)]
pub(in crate::program::forms) struct Sequence {
    /// The tears, unknowns of the vector form.
    pub tears: Vec<usize>,
    /// In the order in which they can be computed.
    pub steps: Vec<Step>,
    /// As many as tears, in order.
    pub remaining: Vec<Remaining>,
}

/// What finds some unknowns.
#[derive(Clone, Debug)]
pub(in crate::program::forms) enum Step {
    /// A closed form.
    Closed(Arc<dyn Form>),
    /// A link between two pins that are known: it points from one to the other, and its length remains to be met.
    TwoPins(TwoPins),
    /// Three links that meet: two differences of their circles are linear, and the length of the first remains to be met.
    ThreeCircles(ThreeCircles),
}

/// What remains to be met.
#[derive(Clone, Copy, Debug)]
pub(in crate::program::forms) enum Remaining {
    /// An equation of the part, by its place.
    Equation(usize),
    /// The length of the link of a step, by its place, and the place of its first equation.
    Length { step: usize, equation: usize },
}

/// One equation, or the two components of a vector equation.
#[derive(Clone, Debug)]
struct Item {
    equations: Vec<usize>,
    mentions: BTreeSet<usize>,
}

/// The sequences of a part.
pub(super) struct Search<'a, 'b> {
    candidate: &'a mut Candidate<'b>,
    items: Vec<Item>,
    /// What has been tried to solve an item for its open unknowns; only looked up.
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

    /// The sequences with the fewest tears, the cheapest first.
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
            let mut found: Vec<(usize, Sequence)> = choices
                .flat_map(|tears| [true, false].map(|circles| self.with(&tears, circles)))
                .flatten()
                .collect();
            found.sort_by_key(|(cost, _)| *cost);
            if !found.is_empty() {
                return found.into_iter().map(|(_, sequence)| sequence).collect();
            }
        }
        Vec::new()
    }

    /// The tears that are tried.
    fn choices(&self, unknowns: &[usize], count: usize) -> Vec<Vec<usize>> {
        match count {
            1 => unknowns.iter().map(|&it| vec![it]).collect(),
            _ => {
                let pairs = self.items.iter().flat_map(|item| {
                    let own: Vec<usize> = item.mentions.iter().copied().collect();
                    let pair = |at: usize| {
                        let others = own[at + 1..].iter();
                        others.map(|&other| [own[at], other]).collect::<Vec<_>>()
                    };
                    (0..own.len()).flat_map(pair).collect::<Vec<_>>()
                });
                let pairs: BTreeSet<[usize; 2]> = pairs.collect();
                pairs.into_iter().map(Vec::from).collect()
            }
        }
    }

    /// What follows from these tears, with its cost; `None` where not everything does. Where `circles`, it ends with three of them.
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
            // Closed forms first: a link between two known pins leaves an equation, which something else may not.
            let found = [false, true].into_iter().find_map(|by_length| {
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
            let (at, step) = found?;
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
        // A closed form finds the direction of an angle, and not how often it has gone round.
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

    /// The angles that equations mention themselves, and not only by what they turn.
    fn wound(&self) -> BTreeSet<usize> {
        let Candidate {
            equations,
            form,
            graph,
            ..
        } = &*self.candidate;
        let own = self.candidate.unknowns.iter().copied();
        let angles = own.filter(|&it| form.unknowns[it].quantity == Quantity::Angle);
        let is_mentioned = |unknown: &usize| {
            let symbol = form.unknowns[*unknown].position;
            let mut equations = equations.iter();
            equations.any(|&equation| graph.depends_on(equation, symbol))
        };
        angles.filter(is_mentioned).collect()
    }

    /// How two items are solved together for the open unknowns of each.
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

    /// How an item is solved for its open unknowns.
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
    /// What it finds.
    pub fn unknowns(&self) -> Vec<usize> {
        match self {
            Step::Closed(form) => form.unknowns(),
            Step::TwoPins(link) => vec![link.angle],
            Step::ThreeCircles(circles) => circles.angles.to_vec(),
        }
    }
}

/// Whether a line that a form turns lies still in the orientation of its angle. Others move with the tears, which is as much work as
/// what is saved.
fn keeps_its_line(form: &dyn Form, candidate: &Candidate<'_>) -> bool {
    let Singular::TurningLine {
        start, direction, ..
    } = form.singular()
    else {
        return true;
    };
    let mut parts = [start, direction].into_iter().flatten();
    parts.all(|part| candidate.graph.is_fixed(part))
}

/// The equations one by one, but the components of vector equations together.
fn items(candidate: &Candidate<'_>) -> Vec<Item> {
    let count = candidate.equations.len();
    let row = |at: usize| &candidate.form.rows[candidate.rows[at]];
    let own: BTreeSet<usize> = candidate.unknowns.iter().copied().collect();
    let mentions = |equation: ExprId| {
        let mentioned = candidate.form.mentioned(equation, candidate.graph);
        mentioned
            .into_iter()
            .filter(|it| own.contains(it))
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
