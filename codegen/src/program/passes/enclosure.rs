//! An expression → how far it can be from where it is, and from a straight line, while what it is made of moves.
//!
//! A mechanism is looked at over a span of time that holds its last frame and this one. Every value runs along a straight line through
//! both, up to a deviation: the *radius* bounds its distance from its value in this frame, the *sag* its distance from the line. Both
//! are expressions that bound it rigorously, by the mean value theorem and the remainder of linear interpolation, as far as functions
//! are smooth; what must be positive for that is listed. Deliberately unknown here: what is done with the bounds.

use std::collections::HashMap;

use crate::expr::{ExprId, Factor, Graph, Node, Number, Rational, SplineId, SymbolId, Term};
use crate::system::{SymbolRole, System};

/// Bounds of one value, both at least zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) struct Enclosure {
    /// How far the value is from where it is in this frame.
    pub radius: ExprId,
    /// How far it is from the straight line.
    pub sag: ExprId,
}

/// The bounds of a product of more factors are found by halves.
const LONGEST_FLAT: usize = 8;

/// The cosine and the sine part of a sum of arms that turn with one angle.
type Amplitude = [ExprId; 2];

/// What the span is like, as symbols.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// How far the time goes from this frame, in s.
    pub time: SymbolId,
    /// The same in steps: 1 where the span ends with the frames.
    pub stretch: SymbolId,
    /// What the square of a radius is multiplied by in the remainder of linear interpolation, for a second derivative of 1.
    pub bend: SymbolId,
    /// Whether the span goes beyond the frames: 1, or else 0.
    pub beyond: SymbolId,
    /// How far rounding leaves what frames hold from what it stands for, as a part of its size.
    pub rounding: SymbolId,
}

/// The bounds that are known so far.
pub(in crate::program) struct Enclosures {
    span: Span,
    known: HashMap<SymbolId, Enclosure>,
    found: HashMap<ExprId, Enclosure>,
    /// What has been found with the bounds of a symbol, by that symbol: the angle in the place of the arms that it turns.
    resting: HashMap<SymbolId, Vec<ExprId>>,
    /// What must not be negative for the bounds to hold.
    pub required: Vec<ExprId>,
}

impl Enclosures {
    /// Time alone moves.
    pub fn new(span: Span, system: &mut System) -> Enclosures {
        let graph = &mut system.mechanism.graph;
        let time = Enclosure {
            radius: graph.variable(span.time),
            sag: graph.zero(),
        };
        Enclosures {
            span,
            known: HashMap::from([(system.mechanism.time, time)]),
            found: HashMap::new(),
            resting: HashMap::new(),
            required: Vec::new(),
        }
    }

    /// States the bounds of a symbol.
    pub fn know(&mut self, symbol: SymbolId, enclosure: Enclosure) {
        self.known.insert(symbol, enclosure);
        for expr in self.resting.remove(&symbol).unwrap_or_default() {
            self.found.remove(&expr);
        }
    }

    /// Keeps what has been found until bounds that it rests on change.
    fn keep(&mut self, expr: ExprId, found: Enclosure, system: &System) {
        self.found.insert(expr, found);
        let mut bases: Vec<SymbolId> = system
            .mechanism
            .graph
            .symbols(expr)
            .iter()
            .map(|&it| base(it, system))
            .collect();
        bases.sort_unstable();
        bases.dedup();
        for symbol in bases {
            self.resting.entry(symbol).or_default().push(expr);
        }
    }

    /// The bounds of an expression.
    pub fn of(&mut self, expr: ExprId, system: &mut System) -> Enclosure {
        if let Some(&found) = self.found.get(&expr) {
            return found;
        }
        let graph = &mut system.mechanism.graph;
        let found = match graph.node(expr).clone() {
            _ if graph.is_fixed(expr) => still(graph),
            Node::Number(_) | Node::Pi => still(graph),
            Node::Symbol(symbol) => self.of_symbol(symbol, system),
            Node::Sum(terms) => self.of_sum(&terms, system),
            Node::Product(factors) => self.of_product(&factors, system),
            Node::Sin(x) | Node::Cos(x) => {
                let inner = self.of(x, system);
                let one = system.mechanism.graph.one();
                self.composed(inner, [one, one], system)
            }
            Node::Exp(x) => {
                let inner = self.of(x, system);
                let graph = &mut system.mechanism.graph;
                let largest = graph.add(x, inner.radius);
                let slope = graph.exp(largest);
                self.composed(inner, [slope, slope], system)
            }
            Node::Ln(x) => {
                let inner = self.of(x, system);
                let least = self.least(x, inner, system);
                let graph = &mut system.mechanism.graph;
                let slopes = [-1, -2].map(|power| graph.power(least, Rational::integer(power)));
                self.composed(inner, slopes, system)
            }
            Node::Atan2(y, x) => self.of_arctangent(y, x, system),
            Node::Floor(x) => {
                let inner = self.of(x, system);
                self.require_between_integers(x, inner.radius, system);
                still(&system.mechanism.graph)
            }
            Node::Choose {
                condition,
                below,
                otherwise,
            } => match graph.magnitude_of(expr) {
                Some(x) => self.of_magnitude(x, system),
                None => self.of_choice(expr, [condition, below, otherwise], system),
            },
            Node::Spline {
                spline,
                order,
                argument,
            } => self.of_spline(spline, order, argument, system),
        };
        self.keep(expr, found, system);
        found
    }

    fn of_symbol(&mut self, symbol: SymbolId, system: &mut System) -> Enclosure {
        if let Some(&known) = self.known.get(&symbol) {
            return known;
        }
        let Some((angle, amplitude)) = arm(symbol, system) else {
            unreachable!(
                "`{}` has no bounds",
                system.mechanism.graph.symbol_name(symbol)
            )
        };
        self.of_turned(angle, amplitude, system)
    }

    /// A wave a cos φ + b sin φ, whose derivatives in φ are at most √(a² + b²).
    fn of_turned(&mut self, angle: usize, amplitude: Amplitude, system: &mut System) -> Enclosure {
        let turning = system.vector_form.unknowns[angle].position;
        let turning = self.of_symbol(turning, system);
        let length = length(amplitude, &mut system.mechanism.graph);
        self.composed(turning, [length, length], system)
    }

    /// Arms that turn with the same angle are one arm.
    fn of_sum(&mut self, terms: &[Term], system: &mut System) -> Enclosure {
        let (mut radii, mut sags) = (Vec::new(), Vec::new());
        let mut turned: Vec<(usize, Amplitude)> = Vec::new();
        let mut bounds: Vec<Enclosure> = Vec::new();
        for term in terms {
            if let Node::Symbol(symbol) = *system.mechanism.graph.node(term.expr)
                && let Some((angle, amplitude)) = arm(symbol, system)
            {
                let graph = &mut system.mechanism.graph;
                let own = amplitude.map(|part| graph.scale(term.coefficient, part));
                match turned.iter_mut().find(|(other, _)| *other == angle) {
                    Some((_, sum)) => *sum = [0, 1].map(|part| graph.add(sum[part], own[part])),
                    None => turned.push((angle, own)),
                }
                continue;
            }
            let own = self.of(term.expr, system);
            let size = match term.coefficient.is_negative() {
                true => term.coefficient.neg(),
                false => term.coefficient,
            };
            let graph = &mut system.mechanism.graph;
            bounds.push(Enclosure {
                radius: graph.scale(size, own.radius),
                sag: graph.scale(size, own.sag),
            });
        }
        for (angle, amplitude) in turned {
            bounds.push(self.of_turned(angle, amplitude, system));
        }
        for bound in bounds {
            radii.push(bound.radius);
            sags.push(bound.sag);
        }
        let graph = &mut system.mechanism.graph;
        Enclosure {
            radius: graph.sum(&radii),
            sag: graph.sum(&sags),
        }
    }

    /// The largest magnitude of a value over the span.
    fn largest(&self, value: ExprId, bounds: Enclosure, system: &mut System) -> ExprId {
        match constant_size(value, system) {
            Some(size) => size,
            None => {
                let graph = &mut system.mechanism.graph;
                let size = graph.magnitude(value);
                graph.add(size, bounds.radius)
            }
        }
    }

    /// The bounds of a product, factor by factor; of a long one half by half, since the bounds of a part mention all its factors.
    fn of_product(&mut self, factors: &[Factor], system: &mut System) -> Enclosure {
        self.of_factors(factors, system).1
    }

    /// The product of one factor or more, and its bounds.
    fn of_factors(&mut self, factors: &[Factor], system: &mut System) -> (ExprId, Enclosure) {
        if factors.len() > LONGEST_FLAT {
            let (first, second) = factors.split_at(factors.len() / 2);
            let [first, second] = [first, second].map(|half| self.of_factors(half, system));
            let bounds = self.multiplied(first, second, system);
            return (system.mechanism.graph.multiply(first.0, second.0), bounds);
        }
        let graph = &system.mechanism.graph;
        let mut product = (graph.one(), still(graph));
        for (place, factor) in factors.iter().enumerate() {
            let value = system.mechanism.graph.power(factor.base, factor.exponent);
            let own = (value, self.of_power(factor, system));
            product = match place {
                0 => own,
                _ => {
                    let bounds = self.multiplied(product, own, system);
                    (system.mechanism.graph.multiply(product.0, value), bounds)
                }
            };
        }
        product
    }

    /// The bounds of a · b.
    fn multiplied(
        &mut self,
        (a, of_a): (ExprId, Enclosure),
        (b, of_b): (ExprId, Enclosure),
        system: &mut System,
    ) -> Enclosure {
        let [largest_a, largest_b] =
            [(a, of_a), (b, of_b)].map(|(value, of)| self.largest(value, of, system));
        let size_b =
            constant_size(b, system).unwrap_or_else(|| system.mechanism.graph.magnitude(b));
        let graph = &mut system.mechanism.graph;
        let moved = [
            graph.multiply(largest_a, of_b.radius),
            graph.multiply(size_b, of_a.radius),
        ];
        let bend = graph.variable(self.span.bend);
        let curved = graph.product(&[bend, of_a.radius, of_b.radius]);
        let bent = [
            graph.multiply(largest_a, of_b.sag),
            graph.multiply(largest_b, of_a.sag),
            graph.multiply(of_a.sag, of_b.sag),
            curved,
            curved,
        ];
        Enclosure {
            radius: graph.sum(&moved),
            sag: graph.sum(&bent),
        }
    }

    fn of_power(&mut self, factor: &Factor, system: &mut System) -> Enclosure {
        let Factor { base, exponent } = *factor;
        let inner = self.of(base, system);
        if exponent == Rational::ONE || inner == still(&system.mechanism.graph) {
            return match exponent == Rational::ONE {
                true => inner,
                false => still(&system.mechanism.graph),
            };
        }
        // |x| over the span, from the side on which the derivative is largest.
        let is_whole = exponent.denominator() == 1;
        let graph = &mut system.mechanism.graph;
        let size = if is_whole {
            graph.magnitude(base)
        } else {
            base
        };
        let largest = graph.add(size, inner.radius);
        let least = graph.subtract(size, inner.radius);
        let mut slope = |order: i64, before: Rational| {
            // n (n − 1) … |x|^(n − order)
            let left = exponent
                .checked_sub(Rational::integer(order))
                .unwrap_or(exponent);
            let coefficient = match order {
                1 => exponent.absolute(),
                _ => exponent
                    .absolute()
                    .checked_mul(before.absolute())
                    .unwrap_or(before),
            };
            if coefficient.is_zero() {
                return graph.zero();
            }
            let place = if left.is_negative() { least } else { largest };
            let power = graph.power(place, left);
            graph.scale(Number::rational(coefficient), power)
        };
        let before = exponent.checked_sub(Rational::ONE).unwrap_or(exponent);
        let slopes = [slope(1, before), slope(2, before)];
        if !is_whole || exponent.is_negative() {
            self.required.push(least);
        }
        self.composed(inner, slopes, system)
    }

    fn of_arctangent(&mut self, y: ExprId, x: ExprId, system: &mut System) -> Enclosure {
        let [of_y, of_x] = [y, x].map(|part| self.of(part, system));
        let graph = &mut system.mechanism.graph;
        let squares = [y, x].map(|part| graph.multiply(part, part));
        let square = graph.sum(&squares);
        let distance = graph.sqrt(square);
        let radius = graph.add(of_y.radius, of_x.radius);
        let least = graph.subtract(distance, radius);
        self.required.push(least);
        // Where x is negative, y must keep its sign: there the angle jumps.
        let left = graph.subtract(x, of_x.radius);
        let size = graph.magnitude(y);
        let kept = graph.subtract(size, of_y.radius);
        let one = graph.one();
        let jumps = graph.choose(left, kept, one);
        self.required.push(jumps);
        let slopes = [-1, -2].map(|power| graph.power(least, Rational::integer(power)));
        let sag = graph.add(of_y.sag, of_x.sag);
        self.composed(Enclosure { radius, sag }, slopes, system)
    }

    /// |x| is no farther away and has a kink.
    fn of_magnitude(&mut self, x: ExprId, system: &mut System) -> Enclosure {
        let Enclosure { radius, sag } = self.of(x, system);
        let graph = &mut system.mechanism.graph;
        let size = graph.magnitude(x);
        let kept = graph.subtract(size, radius);
        Enclosure {
            radius,
            sag: graph.choose(kept, radius, sag),
        }
    }

    /// Where it is certain which arm holds its bounds; elsewhere the arms join, and the value moves by no more than both do.
    fn of_choice(
        &mut self,
        expr: ExprId,
        [condition, below, otherwise]: [ExprId; 3],
        system: &mut System,
    ) -> Enclosure {
        if let Some(periodic) = self.of_periodic(expr, system) {
            return periodic;
        }
        let deciding = self.of(condition, system).radius;
        let arms = [below, otherwise].map(|arm| self.of(arm, system));
        let graph = &mut system.mechanism.graph;
        let size = graph.magnitude(condition);
        let certain = graph.subtract(size, deciding);
        let zero = graph.zero();
        let both = graph.add(arms[0].radius, arms[1].radius);
        let [surely_below, surely_otherwise] = [
            graph.subtract(condition, deciding),
            graph.add(condition, deciding),
        ];
        let mut bound = |[below, otherwise]: [ExprId; 2]| match [below == zero, otherwise == zero] {
            // Where one arm does not move, the other one is enough wherever it may be taken.
            [_, true] if both == below => graph.choose(surely_below, below, zero),
            [true, _] if both == otherwise => graph.choose(surely_otherwise, zero, otherwise),
            _ => {
                let chosen = graph.choose(condition, below, otherwise);
                graph.choose(certain, both, chosen)
            }
        };
        let [radius, sag] = [arms.map(|arm| arm.radius), arms.map(|arm| arm.sag)].map(&mut bound);
        Enclosure { radius, sag }
    }

    /// A choice by what is brought into one period joins there too: what moves beyond the end of a period goes on from the number of
    /// periods before.
    fn of_periodic(&mut self, expr: ExprId, system: &mut System) -> Option<Enclosure> {
        let floors = floors(expr, system);
        let &[floor] = &floors[..] else {
            return None;
        };
        let Node::Floor(periods) = *system.mechanism.graph.node(floor) else {
            return None;
        };
        let inner = self.of(periods, system);
        // Within the frames one end of a period may lie, beyond them none.
        let beyond = system.mechanism.graph.variable(self.span.beyond);
        let radius = system.mechanism.graph.multiply(beyond, inner.radius);
        self.require_between_integers(periods, radius, system);
        let last = system.in_last_frame(periods);
        let graph = &mut system.mechanism.graph;
        let before = graph.floor(last);
        let passed = graph.subtract(floor, before);
        let passed = graph.magnitude(passed);
        let one_and_a_half = graph.rational(3, 2);
        let few = graph.subtract(one_and_a_half, passed);
        self.required.push(few);
        let number = system.intermediate("periods");
        let graph = &mut system.mechanism.graph;
        let held = graph.variable(number);
        let fixed = graph.replace_parts(expr, &[(floor, held)]);
        self.known.insert(number, still(graph));
        let bounds = self.of(fixed, system);
        let [now, then] = [floor, before].map(|value| {
            [bounds.radius, bounds.sag].map(|bound| {
                let graph = &mut system.mechanism.graph;
                graph.substitute(bound, &[(number, value)])
            })
        });
        let required: Vec<ExprId> = std::mem::take(&mut self.required);
        let graph = &mut system.mechanism.graph;
        self.required = required
            .into_iter()
            .flat_map(|expr| match graph.depends_on(expr, number) {
                true => [floor, before]
                    .map(|value| graph.substitute(expr, &[(number, value)]))
                    .to_vec(),
                false => vec![expr],
            })
            .collect();
        let over = graph.multiply(passed, then[0]);
        let bent = graph.multiply(passed, now[0]);
        let parts = [now[1], bent, over];
        Some(Enclosure {
            radius: graph.add(now[0], over),
            sag: graph.sum(&parts),
        })
    }

    fn of_spline(
        &mut self,
        spline: SplineId,
        order: u8,
        argument: ExprId,
        system: &mut System,
    ) -> Enclosure {
        let inner = self.of(argument, system);
        let steepest = system
            .mechanism
            .graph
            .spline_of(spline)
            .largest_derivatives();
        let graph = &mut system.mechanism.graph;
        let [first, second, third] = steepest.map(|value| graph.number(Number::float(value)));
        match order {
            0 => self.composed(inner, [first, second], system),
            1 => self.composed(inner, [second, third], system),
            // The second derivative has kinks, the third one jumps.
            2 => {
                let radius = graph.multiply(third, inner.radius);
                Enclosure {
                    radius,
                    sag: radius,
                }
            }
            _ => {
                let radius = graph.add(third, third);
                Enclosure {
                    radius,
                    sag: radius,
                }
            }
        }
    }

    /// The bounds of f(x), whose first and second derivative are at most these over the span.
    fn composed(
        &self,
        inner: Enclosure,
        [first, second]: [ExprId; 2],
        system: &mut System,
    ) -> Enclosure {
        let graph = &mut system.mechanism.graph;
        let bend = graph.variable(self.span.bend);
        let moved = graph.multiply(first, inner.sag);
        let curved = graph.product(&[second, bend, inner.radius, inner.radius]);
        Enclosure {
            radius: graph.multiply(first, inner.radius),
            sag: graph.add(moved, curved),
        }
    }

    /// The least value of what must be positive.
    fn least(&mut self, x: ExprId, inner: Enclosure, system: &mut System) -> ExprId {
        let least = system.mechanism.graph.subtract(x, inner.radius);
        self.required.push(least);
        least
    }

    fn require_between_integers(&mut self, x: ExprId, radius: ExprId, system: &mut System) {
        let graph = &mut system.mechanism.graph;
        let floor = graph.floor(x);
        let above = graph.subtract(x, floor);
        let one = graph.one();
        let below = graph.subtract(one, above);
        self.required.push(graph.subtract(above, radius));
        self.required.push(graph.subtract(below, radius));
    }
}

/// The symbol whose bounds those of a symbol follow from.
fn base(symbol: SymbolId, system: &System) -> SymbolId {
    match system.roles.get(symbol.index()) {
        Some(&SymbolRole::Arm(place)) => {
            system.vector_form.unknowns[system.vector_form.arms[place].angle].position
        }
        _ => symbol,
    }
}

/// The angle that turns a component of an arm, and the component as a wave of that angle.
fn arm(symbol: SymbolId, system: &mut System) -> Option<(usize, Amplitude)> {
    let SymbolRole::Arm(place) = *system.roles.get(symbol.index())? else {
        return None;
    };
    let arm = &system.vector_form.arms[place];
    let [x, y] = arm.local;
    let amplitude = match symbol == arm.symbols[0] {
        true => [x, system.mechanism.graph.negate(y)],
        false => [y, x],
    };
    Some((arm.angle, amplitude))
}

fn length(amplitude: Amplitude, graph: &mut Graph) -> ExprId {
    let squares = amplitude.map(|part| graph.multiply(part, part));
    let square = graph.sum(&squares);
    graph.sqrt(square)
}

/// What the magnitude of a value never exceeds, where that is known without looking.
fn constant_size(value: ExprId, system: &mut System) -> Option<ExprId> {
    match *system.mechanism.graph.node(value) {
        Node::Sin(_) | Node::Cos(_) => Some(system.mechanism.graph.one()),
        Node::Symbol(symbol) => {
            let (_, amplitude) = arm(symbol, system)?;
            Some(length(amplitude, &mut system.mechanism.graph))
        }
        _ if system.mechanism.graph.is_fixed(value) => {
            Some(system.mechanism.graph.magnitude(value))
        }
        _ => None,
    }
}

fn still(graph: &Graph) -> Enclosure {
    Enclosure {
        radius: graph.zero(),
        sag: graph.zero(),
    }
}

/// The whole parts in an expression that move.
fn floors(expr: ExprId, system: &System) -> Vec<ExprId> {
    let graph = &system.mechanism.graph;
    let mut found = Vec::new();
    let (mut open, mut seen) = (vec![expr], std::collections::HashSet::new());
    while let Some(expr) = open.pop() {
        if graph.is_fixed(expr) || !seen.insert(expr) {
            continue;
        }
        if let Node::Floor(_) = graph.node(expr) {
            found.push(expr);
        }
        open.extend(graph.operands(expr));
    }
    found
}
