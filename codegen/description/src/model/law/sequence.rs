//! Builds sequences of rises and dwells through stations.
//!
//! Between two stations of equal height the motion dwells; between others it follows the law. Before the first and after the
//! last station it dwells, too, unless it is periodic. A periodic motion requires equal heights at the first and the last
//! station.
//!
//! The fraction s of the interval is chosen first, 0 in a dwell, and then the heights. So y(s) is one expression for all rises,
//! and a dwell is the start of the rise after it.

use super::super::expression::{Value, listed};
use super::super::resolve::Resolver;
use super::rise::Rise;
use super::{Increase, LAWS};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::{ExprId, Graph};
use crate::syntax::{Expression, ExpressionKind};

const FORM: &str = "sequence(x, cycloidal, (x0, h0), (x1, h1), …)";

/// Maximum number of pieces that are distinguished sequentially; more are bisected.
const MAX_CHAIN_LENGTH: usize = 24;

/// One station: position and height, as written and as values.
type Station<'a> = [(&'a Expression, Value); 2];

impl Resolver<'_> {
    /// Evaluates `sequence(x, LAW, (x0, h0), (x1, h1), …)`; a last argument `periodic` repeats the motion.
    pub(super) fn sequence(&mut self, arguments: &[Expression], span: Span) -> Option<Value> {
        let is_periodic = arguments
            .last()
            .is_some_and(|last| word(last) == Some("periodic"));
        let arguments = &arguments[..arguments.len() - usize::from(is_periodic)];
        let [written_x, written_law, pairs @ ..] = arguments else {
            let count = arguments.len();
            self.wrong_count("sequence", "at least 4 arguments", count, FORM, span);
            return None;
        };
        if pairs.len() < 2 {
            let count = arguments.len();
            self.wrong_count("sequence", "at least 4 arguments", count, FORM, span);
            return None;
        }
        let law = word(written_law).and_then(Rise::named);
        if law.is_none() {
            let rises = LAWS.iter().filter(|law| Rise::named(law).is_some());
            let rises: Vec<&str> = rises.copied().collect();
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongForm,
                    written_law.span,
                    "the second argument of `sequence` must name a law of motion",
                )
                .label("no law of this name")
                .help(format!("the laws are {}", listed(&rises))),
            );
        }
        let x = self.value(written_x);
        let stations: Vec<Option<Station<'_>>> =
            pairs.iter().map(|pair| self.station(pair)).collect();
        let (law, x) = (law?, x?);
        let stations: Vec<Station<'_>> = stations.into_iter().collect::<Option<_>>()?;
        let mut fits = true;
        for station in &stations {
            let [place, height] = *station;
            fits &= self.fits_like(place.0, place.1.1, (written_x, x.1));
            fits &= self.fits_like(height.0, height.1.1, (stations[0][1].0, stations[0][1].1.1));
        }
        let words = Increase {
            problem: "the arguments of a sequence must increase",
            label: "not larger than the one before",
            earlier: "the one before",
            help: &format!("write `{FORM}` with x0 < x1 < …: order the pairs by their first value"),
        };
        for pair in stations.windows(2) {
            let [earlier, later] = [0, 1].map(|at| (pair[at][0].0, pair[at][0].1.0));
            fits = fits && self.increases(earlier, later, &words);
        }
        if !fits {
            return None;
        }
        let (first, last) = (stations[0], stations[stations.len() - 1]);
        let x = if is_periodic {
            self.closes(first[1], last[1])?;
            self.within_period(x.0, first[0].1.0, last[0].1.0)
        } else {
            x.0
        };
        let mut phases: Vec<Phase> = stations
            .windows(2)
            .map(|pair| Phase::between(x, pair_of(pair, 0), pair_of(pair, 1), &mut self.graph))
            .collect();
        if !is_periodic {
            let [before, after] = [first, last].map(|station| (station[0].1.0, station[1].1.0));
            phases.insert(0, Phase::dwell(before.0, before.1, &mut self.graph));
            phases.push(Phase::dwell(after.0, after.1, &mut self.graph));
        }
        let motion = joined(law, x, phases, &mut self.graph);
        let dimension = stations
            .iter()
            .map(|station| station[1].1.1)
            .reduce(|one, other| one.joined(other))?;
        Some((motion, dimension))
    }

    fn station<'a>(&mut self, written: &'a Expression) -> Option<Station<'a>> {
        let pair = match &written.kind {
            ExpressionKind::Components(parts) => parts.as_slice(),
            _ => &[],
        };
        let [place, height] = pair else {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongForm,
                    written.span,
                    "a station of `sequence` must be a pair",
                )
                .label("no pair")
                .help(format!(
                    "write `{FORM}`: each pair is an argument and a height"
                )),
            );
            return None;
        };
        let values = (self.value(place), self.value(height));
        Some([(place, values.0?), (height, values.1?)])
    }

    /// Reports a periodic motion whose end differs from its beginning.
    fn closes(&mut self, first: (&Expression, Value), last: (&Expression, Value)) -> Option<()> {
        let gap = self.graph.subtract(last.1.0, first.1.0);
        if gap == self.graph.zero() {
            return Some(());
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::PiecesApart,
                last.0.span,
                "a periodic motion must end at the height at which it begins",
            )
            .label("not the height of the first pair")
            .also(first.0.span, "it begins here")
            .help("give the first and the last pair the same height, or leave out `periodic`"),
        );
        None
    }

    /// Returns x minus a whole number of periods, so that the result is in [from, to).
    fn within_period(&mut self, x: ExprId, from: ExprId, to: ExprId) -> ExprId {
        let graph = &mut self.graph;
        let (gone, period) = (graph.subtract(x, from), graph.subtract(to, from));
        let periods = graph.divide(gone, period);
        let whole = graph.floor(periods);
        let skipped = graph.multiply(period, whole);
        graph.subtract(x, skipped)
    }
}

/// A phase of the motion, up to a position.
struct Phase {
    /// End of the phase; unused for the last one.
    end: ExprId,
    /// Height at the beginning.
    start: ExprId,
    /// Increase of the height; `None` for a dwell, where any value serves.
    gain: Option<ExprId>,
    /// Fraction of the interval.
    share: ExprId,
}

impl Phase {
    fn dwell(end: ExprId, height: ExprId, graph: &mut Graph) -> Phase {
        Phase {
            end,
            start: height,
            gain: None,
            share: graph.zero(),
        }
    }

    fn between(x: ExprId, places: [ExprId; 2], heights: [ExprId; 2], graph: &mut Graph) -> Phase {
        if heights[0] == heights[1] {
            return Phase::dwell(places[1], heights[0], graph);
        }
        let gone = graph.subtract(x, places[0]);
        let length = graph.subtract(places[1], places[0]);
        Phase {
            end: places[1],
            start: heights[0],
            gain: Some(graph.subtract(heights[1], heights[0])),
            share: graph.divide(gone, length),
        }
    }
}

/// Returns the motion through all phases.
fn joined(law: Rise, x: ExprId, mut phases: Vec<Phase>, graph: &mut Graph) -> ExprId {
    // A dwell takes the increase of the next rise from its height, and differs from that rise only in the fraction.
    for place in (1..phases.len()).rev() {
        let (start, gain) = (phases[place].start, phases[place].gain);
        let dwell = &mut phases[place - 1];
        if dwell.gain.is_none() && dwell.start == start {
            dwell.gain = gain;
        }
    }
    let shares: Vec<(ExprId, ExprId)> = phases.iter().map(|it| (it.end, it.share)).collect();
    let share = chosen(x, &shares, graph);
    let risen = law.risen(share, graph);
    let motions: Vec<(ExprId, ExprId)> = phases
        .iter()
        .map(|phase| {
            let motion = match phase.gain {
                Some(gain) => {
                    let gained = graph.multiply(gain, risen);
                    graph.add(phase.start, gained)
                }
                None => phase.start,
            };
            (phase.end, motion)
        })
        .collect();
    chosen(x, &motions, graph)
}

/// Returns the value of the first pair whose position exceeds x, or of the last pair. Neighbors of equal value are merged.
fn chosen(x: ExprId, pairs: &[(ExprId, ExprId)], graph: &mut Graph) -> ExprId {
    let mut pieces: Vec<(ExprId, ExprId)> = Vec::with_capacity(pairs.len());
    for &(end, value) in pairs {
        match pieces.last_mut() {
            Some(last) if last.1 == value => last.0 = end,
            _ => pieces.push((end, value)),
        }
    }
    among(x, &pieces, graph)
}

/// Returns the value at x. Many pieces are bisected with few comparisons; few are compared in sequence, as in a handwritten
/// formula.
fn among(x: ExprId, pieces: &[(ExprId, ExprId)], graph: &mut Graph) -> ExprId {
    match pieces {
        [] => graph.zero(),
        [(_, only)] => *only,
        few if few.len() <= MAX_CHAIN_LENGTH => {
            let mut pieces = few.iter().rev();
            let last = pieces.next().map_or(graph.zero(), |last| last.1);
            pieces.fold(last, |value, &(end, own)| {
                let left = graph.subtract(x, end);
                graph.choose(left, own, value)
            })
        }
        many => {
            let (before, after) = many.split_at(many.len() / 2);
            let left = graph.subtract(x, before[before.len() - 1].0);
            let [below, otherwise] = [before, after].map(|half| among(x, half, graph));
            graph.choose(left, below, otherwise)
        }
    }
}

fn pair_of(stations: &[Station<'_>], component: usize) -> [ExprId; 2] {
    [0, 1].map(|place: usize| stations[place][component].1.0)
}

/// Returns the argument if it is a bare word; `None` otherwise.
fn word(written: &Expression) -> Option<&str> {
    match &written.kind {
        ExpressionKind::Reference(reference) if reference.body.is_none() => {
            Some(reference.name.text.as_str())
        }
        _ => None,
    }
}
