//! Evaluates piecewise cubics and their derivatives, in numbers and in expressions.
//!
//! A spline is stored once per graph, with numbers as coefficients. The fourth derivative vanishes, so an expression names a
//! spline and an order from 0 to 3. An argument without symbols is evaluated at once. Continuity of the pieces is not checked.

use std::collections::HashMap;
use std::sync::Arc;

use super::graph::Graph;
use super::node::{ExprId, Node};
use super::number::Number;

/// A spline of one [`Graph`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SplineId(pub(super) u32);

impl SplineId {
    /// Returns the position in order of declaration, from 0.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Consecutive cubic pieces.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    /// Name for users.
    pub name: String,
    /// Start of each piece, ascending; at least two. The last piece extends to infinity.
    pub starts: Vec<f64>,
    /// Coefficients of the powers 0 to 3 of the distance from the start of each piece. Before the first start, the tangent
    /// there applies.
    pub pieces: Vec<[f64; 4]>,
    /// Period, from the first start to the last; `None` if the spline is not periodic.
    pub period: Option<f64>,
}

impl Spline {
    /// Returns the value and the first three derivatives.
    pub fn at(&self, argument: f64) -> [f64; 4] {
        let (Some(&first), Some(&[height, slope, ..])) = (self.starts.first(), self.pieces.first())
        else {
            return [f64::NAN; 4];
        };
        let argument = match self.period {
            Some(period) => argument - period * ((argument - first) / period).floor(),
            None => argument,
        };
        let passed = self.starts.partition_point(|&start| start <= argument);
        let place = match passed.checked_sub(1) {
            Some(place) => place,
            // Rounding may move an argument of the period before its start, where the first piece is extended.
            None if self.period.is_some() => 0,
            None => return [height + slope * (argument - first), slope, 0.0, 0.0],
        };
        let [a, b, c, d] = self.pieces[place];
        let along = argument - self.starts[place];
        [
            a + along * (b + along * (c + along * d)),
            b + along * (2.0 * c + along * (3.0 * d)),
            2.0 * c + along * (6.0 * d),
            6.0 * d,
        ]
    }
}

impl Spline {
    /// Returns the greatest magnitudes of the first three derivatives over the pieces. The unbounded last piece counts up to
    /// the total length of all others.
    pub fn largest_derivatives(&self) -> [f64; 3] {
        let reach = match (self.starts.first(), self.starts.last()) {
            (Some(first), Some(last)) => last - first,
            _ => 0.0,
        };
        let mut largest = [0.0_f64; 3];
        for (place, &[_, b, c, d]) in self.pieces.iter().enumerate() {
            let length = match self.starts.get(place..place + 2) {
                Some(&[start, end]) => end - start,
                _ => reach,
            };
            let slope = |along: f64| (b + along * (2.0 * c + along * (3.0 * d))).abs();
            // The slope is extremal at an end of the piece, or where the second derivative is zero.
            let turning = (-c / (3.0 * d)).clamp(0.0, length);
            let slopes = [0.0, length, if turning.is_nan() { 0.0 } else { turning }].map(slope);
            let curvatures = [2.0 * c, 2.0 * c + 6.0 * d * length].map(f64::abs);
            largest[0] = slopes.into_iter().fold(largest[0], f64::max);
            largest[1] = curvatures.into_iter().fold(largest[1], f64::max);
            largest[2] = largest[2].max((6.0 * d).abs());
        }
        largest
    }
}

/// Splines of one graph, without duplicates.
#[derive(Clone, Debug, Default)]
pub(super) struct SplineTable {
    splines: Vec<Arc<Spline>>,
    /// Indices of splines by name; never iterated.
    by_name: HashMap<String, Vec<usize>>,
}

impl SplineTable {
    /// Returns a spline.
    pub fn spline(&self, id: SplineId) -> &Arc<Spline> {
        &self.splines[id.index()]
    }

    /// Returns the id of a spline; `None` if it is not stored.
    fn find(&self, spline: &Spline) -> Option<SplineId> {
        let mut named = self.by_name.get(&spline.name)?.iter();
        let place = named.find(|place| *self.splines[**place] == *spline)?;
        Some(id(*place))
    }

    /// Stores a new spline.
    fn add(&mut self, spline: Spline) -> SplineId {
        let place = self.splines.len();
        let named = self.by_name.entry(spline.name.clone()).or_default();
        named.push(place);
        self.splines.push(Arc::new(spline));
        id(place)
    }
}

fn id(place: usize) -> SplineId {
    // A description contains far fewer than 2^32 statements.
    SplineId(place as u32)
}

impl Graph {
    /// Returns the id of a spline; equal splines have equal ids.
    ///
    /// # Panics
    /// Panics if the spline has fewer than two pieces, or a different number of starts.
    pub fn add_spline(&mut self, spline: Spline) -> SplineId {
        assert!(
            spline.pieces.len() >= 2 && spline.pieces.len() == spline.starts.len(),
            "every piece has a start"
        );
        self.spline_table.find(&spline).unwrap_or_else(|| {
            self.ledger.store(spline.pieces.len() / 2);
            self.spline_table.add(spline)
        })
    }

    /// Returns the data of a spline.
    pub fn spline_of(&self, spline: SplineId) -> &Spline {
        self.spline_table.spline(spline)
    }

    /// Iterates over all splines with their ids, in order of declaration.
    pub fn splines(&self) -> impl Iterator<Item = (SplineId, &Spline)> {
        let splines = (0u32..).zip(&self.spline_table.splines);
        splines.map(|(id, spline)| (SplineId(id), &**spline))
    }

    /// Returns the derivative of this order of a spline at an argument.
    pub fn spline(&mut self, spline: SplineId, order: u8, argument: ExprId) -> ExprId {
        if !self.is_finite(argument) {
            return self.not_a_number();
        }
        if order > 3 {
            return self.zero();
        }
        if self.is_constant(argument)
            && let Some(value) = self.constant_value(argument)
        {
            let number = self.spline_of(spline).at(value)[usize::from(order)];
            return self.number(Number::float(number));
        }
        self.intern(Node::Spline {
            spline,
            order,
            argument,
        })
    }
}
