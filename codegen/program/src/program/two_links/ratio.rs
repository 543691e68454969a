//! Extrapolates the transmission ratio of two links, a quotient of two sines, over a window.

use super::pair::Bounded;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::program::builder::Builder;
use crate::program::function::Statement;

/// Determinant of a pair, w_a × w_b, over the window.
pub(super) struct Determinant {
    pub inverse: ExprId,
    /// Signed relative change along the chords.
    pub slope: ExprId,
    /// Bound on how far the logarithm of the magnitude may lie below this change.
    pub rest: ExprId,
}

impl Builder<'_> {
    /// Returns the determinant over the window, and requires that it changes by at most half of itself.
    pub(super) fn determinant_over_span(
        &mut self,
        bounded: &Bounded,
        links: [Vector; 2],
        turns: Vector,
        opened: ExprId,
    ) -> Determinant {
        let Bounded {
            pair, slopes, bent, ..
        } = bounded;
        let name = &pair.name;
        let one = self.graph().one();
        let value = self.cross(links[0], links[1]);
        let inverse = self.graph().divide(one, value);
        let inverse = self.bounded(&format!("{name}_inverse_determinant"), inverse);
        let cotangent = self.graph().multiply(pair.product, inverse);
        let cotangent = self.bounded(&format!("{name}_cotangent"), cotangent);
        let difference = self.graph().subtract(turns[1], turns[0]);
        let slope = self.graph().multiply(cotangent, difference);
        let slope = self.bounded(&format!("{name}_slope"), slope);
        let size = self.graph().magnitude(cotangent);
        let deviation = self.graph().multiply(slopes.both, *bent);
        let beside = self.beside_sine(one, size, deviation, opened, one);
        let beside = self.bounded(&format!("{name}_beside"), beside);
        let size = self.graph().magnitude(slope);
        let largest = self.graph().add(size, beside);
        let largest = self.bounded(&format!("{name}_change"), largest);
        let half = self.graph().rational(1, 2);
        let value = self.graph().subtract(half, largest);
        self.state(Statement::Require {
            value,
            block: pair.block,
        });
        // ln (1 + z) ≥ z − z² if z ≥ −½.
        let square = self.square(largest);
        let rest = self.graph().add(beside, square);
        let rest = self.bounded(&format!("{name}_rest"), rest);
        Determinant {
            inverse,
            slope,
            rest,
        }
    }

    /// Bounds the distance of a sine of magnitude `sine` from its tangent. The angle changes by `opened` and deviates from a
    /// chord: relative to the sine this is ½ x², relative to the cosine the deviation and x³/6, with rounding of both.
    fn beside_sine(
        &mut self,
        sine: ExprId,
        cosine: ExprId,
        deviation: ExprId,
        opened: ExprId,
        whole: ExprId,
    ) -> ExprId {
        let rounding = self.paths.window.rounding;
        let [rounding, half, sixth] = [
            self.graph().variable(rounding),
            self.graph().rational(1, 2),
            self.graph().rational(1, 6),
        ];
        let square = self.square(opened);
        let third = self.graph().product(&[sixth, square, opened]);
        let along = self.graph().add(deviation, third);
        let parts = [
            self.graph().product(&[half, sine, square]),
            self.graph().multiply(cosine, along),
            self.graph().multiply(rounding, whole),
        ];
        self.graph().sum(&parts)
    }

    /// Bounds the transmission ratio from a vector, from above: at both ends of the window, and by the geometric mean in between.
    ///
    /// The ratio is a quotient of two sines. Each sine is its tangent plus a remainder, and 1 + x ≤ exp x ≤ 1 + x + x² up to x =
    /// 1.79.
    pub(super) fn factors_of(
        &mut self,
        name: &str,
        [lever, along]: [ExprId; 2],
        difference: ExprId,
        [deviation, opened, whole]: [ExprId; 3],
        determinant: &Determinant,
    ) -> [ExprId; 2] {
        let zero = self.graph().zero();
        let [sine, cosine] = [lever, along].map(|it| self.graph().magnitude(it));
        let opposite = self.graph().negate(along);
        let along = self.graph().choose(lever, opposite, along);
        let slope = self.graph().multiply(along, difference);
        let slope = self.bounded(&format!("{name}_lever_slope"), slope);
        let size = self.graph().magnitude(slope);
        // If the lever may vanish, its magnitude bounds it over the whole window.
        let crossing = {
            let twice = self.graph().add(size, size);
            self.graph().subtract(sine, twice)
        };
        let kept = self.graph().choose(crossing, zero, slope);
        let kept = self.bounded(&format!("{name}_lever_kept"), kept);
        let lost = {
            let kept = self.graph().magnitude(kept);
            self.graph().subtract(size, kept)
        };
        let beside = self.beside_sine(sine, cosine, deviation, opened, whole);
        let largest = self.graph().sum(&[sine, beside, lost]);
        let largest = self.bounded(&format!("{name}_lever_largest"), largest);
        let run = self.graph().divide(kept, largest);
        let run = self.graph().subtract(run, determinant.slope);
        let run = self.bounded(&format!("{name}_run"), run);
        let inverse = self.graph().magnitude(determinant.inverse);
        let ratio = self.graph().multiply(largest, inverse);
        let ratio = self.bounded(&format!("{name}_ratio"), ratio);
        let beyond = self.paths.window.beyond;
        let beyond = self.graph().variable(beyond);
        let onward = self.graph().multiply(beyond, run);
        let ends = [
            self.graph().subtract(determinant.rest, run),
            self.graph().add(determinant.rest, onward),
        ];
        ends.map(|end| {
            let end = self.bounded(&format!("{name}_growth"), end);
            let [one, square] = [self.graph().one(), self.square(end)];
            let factor = self.graph().sum(&[one, end, square]);
            self.graph().multiply(ratio, factor)
        })
    }
}
