//! A sequence of closed forms → the functions of its tears: what remains, its derivative, and everything at the end.

use std::collections::HashSet;

use super::Torn;
use super::sequence::{Remaining, Step};
use super::three_circles::Circles;
use super::turned_link::TurnedLink;
use super::two_pins::Between;
use crate::expr::{ExprId, Node, Number, SymbolId};
use crate::joint::Quantity;
use crate::program::block::NewtonBlock;
use crate::program::builder::{Builder, Inside};
use crate::program::forms::Solved;
use crate::program::function::{Function, Level, Statement};
use crate::program::tearing::{self, Tearing, parted};
use crate::system::{SymbolRole, System};

/// A step whose position has been stated.
enum Stated {
    Closed(Box<dyn Solved>),
    TwoPins(Between),
    ThreeCircles(Circles),
}

/// What remains with given tears.
struct Rest {
    residual: ExprId,
    /// By each tear.
    slopes: Vec<ExprId>,
}

/// What is found at each instant beside the unknowns.
pub(super) fn found(
    torn: &Torn,
    tearing: &Tearing,
    builder: &mut Builder<'_>,
) -> tearing::TornFields {
    let mut directions = Vec::with_capacity(torn.whole.unknowns.len());
    for &unknown in &torn.whole.unknowns {
        let name = builder.system.unknown_name(unknown).to_string();
        directions.push(is_angle(unknown, builder).then(|| {
            let named = |function: &str| format!("{function}_{name}");
            ["sin", "cos"].map(|function| builder.system.intermediate(&named(function)))
        }));
    }
    let tears = torn.sequence.tears.iter();
    let names: Vec<&str> = tears.map(|&it| builder.system.unknown_name(it)).collect();
    let name = names.join("_");
    let signs = (1..=tearing.signs.len()).map(|number| format!("sign_{number}_{name}"));
    let memory: Vec<String> = [format!("determinant_{name}")]
        .into_iter()
        .chain(signs)
        .collect();
    let memory = memory.iter();
    tearing::TornFields {
        directions,
        memory: memory
            .map(|name| builder.system.intermediate(name))
            .collect(),
    }
}

fn is_angle(unknown: usize, builder: &Builder<'_>) -> bool {
    builder.system.vector_form.unknowns[unknown].quantity == Quantity::Angle
}

/// The functions; `None` where the drawing does not say which sign a closed form has.
pub(super) fn tearing(
    torn: &Torn,
    block: &NewtonBlock,
    builder: &mut Builder<'_>,
) -> Option<Tearing> {
    let places = builder
        .derivatives
        .tear(&torn.sequence.tears, builder.system);
    let before = builder.begin_inside();
    let tearing = stated(torn, &places, block, builder);
    builder.end_inside(before);
    builder.derivatives.mend(&places);
    tearing
}

fn stated(
    torn: &Torn,
    places: &[usize],
    block: &NewtonBlock,
    builder: &mut Builder<'_>,
) -> Option<Tearing> {
    let sequence = &torn.sequence;
    for &tear in &sequence.tears {
        if is_angle(tear, builder) {
            builder.explicit_angle(tear);
        }
    }
    let (mut steps, mut sign_values) = (Vec::new(), Vec::new());
    for step in &sequence.steps {
        steps.push(match step {
            Step::TwoPins(link) => Stated::TwoPins(link.position(builder)),
            Step::ThreeCircles(circles) => Stated::ThreeCircles(circles.position(builder)),
            Step::Closed(form) => {
                let solved = form.position(builder);
                sign_values.extend(sign_value(form.as_ref(), sign_values.len(), builder)?);
                Stated::Closed(solved)
            }
        });
    }
    let rests = rests(torn, &mut steps, places, builder);
    let (determinant, inverse) = inverse(&rests, builder);
    let residuals = rests.iter().map(|rest| rest.residual);
    let evaluated: Vec<ExprId> = residuals
        .chain(inverse.iter().copied())
        .chain([determinant])
        .collect();
    let statements = std::mem::take(&mut builder.statements);
    for level in [Level::Velocity, Level::Acceleration] {
        solve_level(torn, &mut steps, places, &inverse, level, builder);
    }
    let later = std::mem::take(&mut builder.statements);
    let completed = completed(torn, places, block, builder)?;
    let graph = &builder.system.mechanism.graph;
    let found = statements.iter().chain(&later).flat_map(Statement::targets);
    let found: HashSet<SymbolId> = found.collect();
    let read = statements.iter().chain(&later).flat_map(Statement::values);
    let all = evaluated.iter().chain(&completed).copied();
    let mut read = read.chain(all);
    // What is read of the unknowns must have been found.
    let is_missing = |symbol: &SymbolId| {
        let unknown = match builder.system.roles[symbol.index()] {
            SymbolRole::Position(unknown) => unknown,
            _ => return false,
        };
        torn.whole.unknowns.contains(&unknown)
            && !sequence.tears.contains(&unknown)
            && !found.contains(symbol)
    };
    if read.any(|expr| graph.symbols(expr).iter().any(is_missing)) {
        return None;
    }
    let (evaluate, complete, carried) = parted(&statements, evaluated, completed, &later, graph);
    let scales: Vec<(usize, ExprId)> = sequence
        .remaining
        .iter()
        .map(|remaining| match *remaining {
            Remaining::Equation(at) => (at, builder.graph().one()),
            Remaining::Length { step, equation } => match steps[step].link() {
                Some(link) => (equation, link.length(builder)),
                None => (equation, builder.graph().one()),
            },
        })
        .collect();
    let terms = sequence.remaining.iter().map(|remaining| match *remaining {
        Remaining::Equation(at) => {
            let scale = block.scaled_by[0].scale(block.quantities[at]);
            (magnitude(torn.whole.residuals[at], builder.system) / scale).max(1.0)
        }
        Remaining::Length { .. } => 1.0,
    });
    let terms = terms.collect();
    let proof = match (&sequence.steps[..], &sequence.tears[..]) {
        (&[Step::ThreeCircles(ref circles)], &[tear]) => {
            let shifts = builder.derivatives.shifts();
            let proof = circles.proof(tear, builder);
            Some(proof.map(|part| builder.without(part, &shifts)))
        }
        _ => None,
    };
    let place = |tear| {
        let own = torn.whole.unknowns.iter();
        own.clone().position(|unknown| unknown == tear)
    };
    let signs = builder.inside.as_ref().map(|inside| &inside.signs);
    let others = torn.whole.unknowns.iter();
    let others = others.filter(|unknown| !sequence.tears.contains(unknown));
    Some(Tearing {
        angles: others.filter(|&&it| is_angle(it, builder)).count(),
        tears: sequence.tears.iter().filter_map(place).collect(),
        signs: signs.into_iter().flatten().map(|(sign, _)| *sign).collect(),
        carried,
        proof,
        rows: scales.iter().map(|(row, _)| *row).collect(),
        terms,
        scales: Function::of_results(scales.into_iter().map(|(_, factor)| factor)),
        evaluate,
        complete,
        sign_values: Function::of_results(sign_values),
    })
}

/// The sum of the magnitudes of a sum's terms in the drawing.
fn magnitude(sum: ExprId, system: &System) -> f64 {
    let graph = &system.mechanism.graph;
    match graph.node(sum) {
        Node::Sum(terms) => {
            let values = terms.iter();
            let values =
                values.map(|term| term.coefficient.to_f64() * system.drawn_value(term.expr));
            values.map(f64::abs).sum()
        }
        _ => system.drawn_value(sum).abs(),
    }
}

/// What has the sign of a closed form that has just been stated, in terms of unknowns, where it has one. `None` where the drawing does
/// not say how both belong together.
fn sign_value(
    form: &dyn crate::program::forms::Form,
    known: usize,
    builder: &mut Builder<'_>,
) -> Option<Option<ExprId>> {
    let signs = builder.inside.as_ref().map(|inside| &inside.signs);
    let drawn = match signs.map_or(&[][..], |signs| &signs[known..]) {
        [] => return Some(None),
        [(_, drawn)] => *drawn,
        _ => return None,
    };
    let system = &mut *builder.system;
    let value = form
        .determinant(&system.vector_form, &mut system.mechanism.graph)
        .value?;
    let agreement = drawn * builder.system.drawn_value(value);
    // Written so that NaN decides nothing.
    let (same, opposite) = (agreement > 0.0, agreement < 0.0);
    let graph = &mut builder.system.mechanism.graph;
    match (same, opposite) {
        (true, _) => Some(Some(value)),
        (_, true) => Some(Some(graph.negate(value))),
        _ => None,
    }
}

/// The residuals and their derivatives by the tears, once all steps are stated.
fn rests(
    torn: &Torn,
    steps: &mut [Stated],
    places: &[usize],
    builder: &mut Builder<'_>,
) -> Vec<Rest> {
    for step in steps.iter_mut() {
        if let Stated::Closed(solved) = step {
            solved.prepare(builder);
        }
    }
    for &place in places {
        for step in steps.iter_mut() {
            step.rates(Level::Response(place), builder);
        }
    }
    let mut rests = Vec::with_capacity(places.len());
    for remaining in &torn.sequence.remaining {
        let residual = match *remaining {
            Remaining::Length { step, .. } => match steps[step].link() {
                Some(link) => link.residual(builder),
                None => builder.graph().zero(),
            },
            Remaining::Equation(at) => torn.whole.residuals[at],
        };
        let residual = builder.value("rest", residual);
        let mut slopes = Vec::with_capacity(places.len());
        for &place in places {
            let slope = rest_rate(torn, steps, *remaining, Level::Response(place), builder);
            slopes.push(builder.value("slope", slope));
        }
        rests.push(Rest { residual, slopes });
    }
    rests
}

/// The rate of what remains.
fn rest_rate(
    torn: &Torn,
    steps: &[Stated],
    remaining: Remaining,
    level: Level,
    builder: &mut Builder<'_>,
) -> ExprId {
    match remaining {
        Remaining::Equation(at) => builder.rate_at(torn.whole.residuals[at], level),
        Remaining::Length { step, .. } => match steps[step].link() {
            Some(link) => link.residual_rate(level, builder),
            None => builder.graph().zero(),
        },
    }
}

/// The determinant of the derivatives, and their inverse row by row, by Cramer's rule.
fn inverse(rests: &[Rest], builder: &mut Builder<'_>) -> (ExprId, Vec<ExprId>) {
    let one = builder.graph().one();
    match rests {
        [first, second] => {
            let ([a, b], [c, d]) = (
                [first.slopes[0], first.slopes[1]],
                [second.slopes[0], second.slopes[1]],
            );
            let determinant = builder.cross([a, b], [c, d]);
            let determinant = builder.value("determinant", determinant);
            let ratio = builder.graph().divide(one, determinant);
            let ratio = builder.value("inverse", ratio);
            let minus = builder.negated([b, c]);
            let entries = [d, minus[0], minus[1], a];
            let entries = entries.map(|entry| builder.graph().multiply(entry, ratio));
            let entries = entries.map(|entry| builder.value("inverse", entry));
            (determinant, entries.to_vec())
        }
        _ => {
            let determinant = rests.first().map_or(one, |rest| rest.slopes[0]);
            let inverse = builder.graph().divide(one, determinant);
            let inverse = builder.value("inverse", inverse);
            (determinant, vec![inverse])
        }
    }
}

/// States what a level finds: what everything does while the tears rest, then what the tears do, then both together.
fn solve_level(
    torn: &Torn,
    steps: &mut [Stated],
    places: &[usize],
    inverse: &[ExprId],
    level: Level,
    builder: &mut Builder<'_>,
) {
    let before = std::mem::take(&mut builder.statements);
    for step in steps.iter_mut() {
        step.rates(level, builder);
    }
    let own = std::mem::replace(&mut builder.statements, before);
    let symbol_at = |unknown: usize, builder: &Builder<'_>| {
        let unknown = &builder.system.vector_form.unknowns[unknown];
        match level {
            Level::Velocity => unknown.rate,
            _ => unknown.acceleration,
        }
    };
    let zero = builder.graph().zero();
    let tears: Vec<SymbolId> = torn
        .sequence
        .tears
        .iter()
        .map(|&tear| symbol_at(tear, builder))
        .collect();
    let mut held: Vec<(SymbolId, ExprId)> = tears.iter().map(|&tear| (tear, zero)).collect();
    let mut moved: Vec<(SymbolId, ExprId, ExprId)> = Vec::new();
    for statement in own {
        let Statement::Let { target, value, .. } = statement else {
            builder.state(statement);
            continue;
        };
        let at_rest = builder.graph().substitute(value, &held);
        if at_rest == value {
            builder.assign(target, value);
            continue;
        }
        let name = format!("{}_held", builder.system.symbol_name(target));
        let resting = builder.value(&name, at_rest);
        held.push((target, resting));
        moved.push((target, value, resting));
    }
    let mut drifts = Vec::with_capacity(places.len());
    for remaining in &torn.sequence.remaining {
        let drift = rest_rate(torn, steps, *remaining, level, builder);
        let drift = builder.graph().substitute(drift, &held);
        drifts.push(builder.value("drift", drift));
    }
    for (row, &tear) in inverse.chunks(places.len()).zip(&tears) {
        let terms = row.iter().zip(&drifts);
        let terms: Vec<ExprId> = terms
            .map(|(&entry, &drift)| builder.graph().multiply(entry, drift))
            .collect();
        let sum = builder.graph().sum(&terms);
        let value = builder.graph().negate(sum);
        builder.assign(tear, value);
    }
    for (target, value, resting) in moved {
        let unknown = match builder.system.roles[target.index()] {
            SymbolRole::Rate(unknown) | SymbolRole::Acceleration(unknown) => Some(unknown),
            _ => None,
        };
        let whole = match unknown {
            None => value,
            Some(unknown) => {
                let mut terms = vec![resting];
                for (&place, &tear) in places.iter().zip(&tears) {
                    let response = builder
                        .derivatives
                        .of_unknown(unknown, place, builder.system);
                    let tear = builder.graph().variable(tear);
                    terms.push(builder.graph().multiply(response, tear));
                }
                builder.graph().sum(&terms)
            }
        };
        builder.assign(target, whole);
    }
}

/// Of each unknown its cosine, or itself where it is a length; then their sines, rates and accelerations; then all residuals; then how
/// the unknowns respond to the tears, in scales.
fn completed(
    torn: &Torn,
    places: &[usize],
    block: &NewtonBlock,
    builder: &mut Builder<'_>,
) -> Option<Vec<ExprId>> {
    let zero = builder.graph().zero();
    let unknowns = &torn.whole.unknowns;
    let (mut cosines, mut sines) = (Vec::new(), Vec::new());
    for &unknown in unknowns {
        if is_angle(unknown, builder) {
            let inside = builder.inside.as_ref()?;
            let direction = inside.directions.get(&unknown)?;
            cosines.push(direction.cosine);
            sines.push(direction.sine);
        } else {
            cosines.push(builder.position(unknown));
            sines.push(zero);
        }
    }
    let mut results = [cosines, sines].concat();
    for level in [Level::Velocity, Level::Acceleration] {
        for &unknown in unknowns {
            let unknown = &builder.system.vector_form.unknowns[unknown];
            let symbol = match level {
                Level::Velocity => unknown.rate,
                _ => unknown.acceleration,
            };
            results.push(builder.graph().variable(symbol));
        }
    }
    results.extend(&torn.whole.residuals);
    let scale = |unknown: usize, builder: &Builder<'_>| {
        let quantity = builder.system.vector_form.unknowns[unknown].quantity;
        block.scaled_by[1].scale(quantity)
    };
    for (&place, &tear) in places.iter().zip(&torn.sequence.tears) {
        let own = scale(tear, builder);
        for &unknown in unknowns
            .iter()
            .filter(|&it| !torn.sequence.tears.contains(it))
        {
            let response = builder
                .derivatives
                .of_unknown(unknown, place, builder.system);
            let factor = own / scale(unknown, builder);
            results.push(match factor == 1.0 {
                true => response,
                false => builder.graph().scale(Number::float(factor), response),
            });
        }
    }
    Some(results)
}

impl Stated {
    fn rates(&mut self, level: Level, builder: &mut Builder<'_>) {
        match self {
            Stated::Closed(solved) => solved.rates(level, builder),
            Stated::TwoPins(between) => between.rates(level, builder),
            Stated::ThreeCircles(circles) => circles.rates(level, builder),
        }
    }

    /// The link whose length remains to be met.
    fn link(&self) -> Option<&TurnedLink> {
        match self {
            Stated::Closed(_) => None,
            Stated::TwoPins(between) => Some(&between.link),
            Stated::ThreeCircles(circles) => circles.first(),
        }
    }
}

/// What a builder had stated before a torn block.
pub(super) struct Before {
    statements: Vec<Statement>,
    defined: HashSet<SymbolId>,
    writes_prose: bool,
}

impl Builder<'_> {
    /// Begins to state closed forms inside a torn block, as if nothing had been stated.
    fn begin_inside(&mut self) -> Before {
        self.inside = Some(Inside::default());
        Before {
            statements: std::mem::take(&mut self.statements),
            defined: std::mem::take(&mut self.defined),
            writes_prose: std::mem::replace(&mut self.writes_prose, false),
        }
    }

    fn end_inside(&mut self, before: Before) {
        self.inside = None;
        self.statements = before.statements;
        self.defined = before.defined;
        self.writes_prose = before.writes_prose;
    }
}
