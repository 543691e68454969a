//! Finds the local minima of a cost that depends on one parameter in a range.
//!
//! The range is sampled evenly, and every low sample refined by golden sections, so the result depends only on the cost.

use crate::expr::{ExprId, Graph, SymbolId, Tape};

/// Range of the parameter of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Range {
    pub from: f64,
    pub to: f64,
    /// True if the end coincides with the beginning.
    pub is_closed: bool,
}

impl Range {
    /// One full turn.
    pub const TURN: Range = Range {
        from: 0.0,
        to: std::f64::consts::TAU,
        is_closed: true,
    };
}

/// A local minimum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Minimum {
    pub place: f64,
    pub cost: f64,
}

/// Local minima, lowest first, with the largest sampled cost.
#[derive(Clone, Debug, Default)]
pub(super) struct Minima {
    found: Vec<Minimum>,
    pub largest: f64,
}

impl Minima {
    pub fn first(&self) -> Option<Minimum> {
        self.found.first().copied()
    }

    /// Iterates over the minima, lowest first.
    pub fn iter(&self) -> impl Iterator<Item = &Minimum> {
        self.found.iter()
    }
}

/// Number of samples of the range, fine enough for a feature of half a degree.
const SAMPLES: usize = 720;

/// Number of golden sections; each shortens the interval by the factor 0.618.
const SECTIONS: usize = 60;

/// Expressions as functions of the parameter.
pub(super) struct Along {
    tape: Tape,
    parameter: SymbolId,
    symbols: Vec<f64>,
    workspace: Vec<f64>,
    values: Vec<f64>,
}

impl Along {
    /// Creates the functions; `known` has the values of all symbols except the parameter.
    pub fn new(
        graph: &Graph,
        parts: &[ExprId],
        parameter: SymbolId,
        known: impl Fn(SymbolId) -> f64,
    ) -> Along {
        let mut symbols = vec![0.0; graph.symbol_count()];
        for &symbol in parts.iter().flat_map(|&part| graph.symbols(part)) {
            symbols[symbol.index()] = known(symbol);
        }
        Along {
            tape: Tape::new(graph, parts),
            parameter,
            symbols,
            workspace: Vec::new(),
            values: vec![0.0; parts.len()],
        }
    }

    /// Returns the work of a search for minima, in terms that are added.
    pub fn work(&self) -> usize {
        SAMPLES * self.tape.length() / 4 + self.symbols.len() / 64
    }

    /// Returns the values at one parameter.
    pub fn at(&mut self, place: f64) -> &[f64] {
        self.symbols[self.parameter.index()] = place;
        self.tape
            .evaluate(&self.symbols, &mut self.workspace, &mut self.values);
        &self.values
    }

    /// Returns the sum of the squares at one parameter.
    pub fn square(&mut self, place: f64) -> f64 {
        self.at(place).iter().map(|value| value * value).sum()
    }
}

/// Returns the local minima of a cost.
pub(super) fn minima(range: Range, mut cost: impl FnMut(f64) -> f64) -> Minima {
    let mut cost = |place: f64| -> f64 {
        let value = cost(place);
        // The curve cannot be touched where it is undefined.
        if value.is_finite() { value } else { f64::MAX }
    };
    let step = (range.to - range.from) / SAMPLES as f64;
    let place = |at: usize| range.from + step * at as f64;
    let samples: Vec<f64> = (0..=SAMPLES).map(|at| cost(place(at))).collect();
    let largest = samples
        .iter()
        .copied()
        .filter(|&sample| sample < f64::MAX)
        .fold(f64::MIN, f64::max);
    let mut minima = Vec::new();
    for at in 0..=SAMPLES {
        // The last sample of a closed range equals its first.
        if samples[at] == f64::MAX || (range.is_closed && at == SAMPLES) {
            continue;
        }
        let before = match at {
            0 if range.is_closed => samples[SAMPLES - 1],
            0 => f64::MAX,
            _ => samples[at - 1],
        };
        let after = samples.get(at + 1).copied().unwrap_or(f64::MAX);
        // Of equal neighbors, the last counts.
        if samples[at] > before || samples[at] >= after {
            continue;
        }
        let (mut low, mut high) = (place(at) - step, place(at) + step);
        if !range.is_closed {
            (low, high) = (low.max(range.from), high.min(range.to));
        }
        minima.push(refined(low, high, &mut cost));
    }
    minima.sort_by(|one, other| one.cost.total_cmp(&other.cost));
    Minima {
        found: minima,
        largest,
    }
}

/// Returns the minimum between two parameters by golden sections (Kiefer 1953).
fn refined(mut low: f64, mut high: f64, cost: &mut impl FnMut(f64) -> f64) -> Minimum {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    for _ in 0..SECTIONS {
        let [left, right] = [high - RATIO * (high - low), low + RATIO * (high - low)];
        if cost(left) <= cost(right) {
            high = right;
        } else {
            low = left;
        }
    }
    let place = 0.5 * (low + high);
    Minimum {
        place,
        cost: cost(place),
    }
}

#[cfg(test)]
mod tests {
    use super::{Along, Range, minima};
    use crate::expr::Graph;

    /// Checks the distance from the point (2 cos c, 2 sin c) to the unit circle, which is least at c, also across the seam.
    #[test]
    fn the_nearest_point_of_a_circle_is_found_on_both_sides_of_the_seam() {
        for nearest in [1.0_f64, 0.0, -0.001] {
            let mut graph = Graph::new();
            let parameter = graph.symbol("s");
            let s = graph.variable(parameter);
            let parts = [graph.cos(s), graph.sin(s)];
            let goal = [2.0 * nearest.cos(), 2.0 * nearest.sin()]
                .map(|value| graph.number(crate::expr::Number::Float(value)));
            let gap = [0, 1].map(|axis| graph.subtract(parts[axis], goal[axis]));
            let mut along = Along::new(&graph, &gap, parameter, |_| 0.0);
            let minima = minima(Range::TURN, |place| along.square(place));
            let first = minima.first().expect("a minimum");
            assert!((first.place - nearest).abs() < 1e-7, "{first:?}");
            assert!((first.cost - 1.0).abs() < 1e-12, "{first:?}");
            assert_eq!(minima.iter().count(), 1);
        }
    }

    #[test]
    fn a_range_is_not_left() {
        let range = Range {
            from: 1.0,
            to: 2.0,
            is_closed: false,
        };
        let first = minima(range, |place| place * place).first();
        assert!((first.expect("a minimum").place - 1.0).abs() < 1e-9);
    }
}
