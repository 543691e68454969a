//! The transmission ratio of two links, a quotient of two sines, as it runs on over a window.

use super::pair::Bounded;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::program::builder::Builder;
use crate::program::function::Statement;

/// The determinant of a pair, w_a × w_b, as it runs on over the window.
pub(super) struct Determinant {
    pub inverse: ExprId,
    /// Its change along the lines, as a part of it, with its sign.
    pub slope: ExprId,
    /// How far the logarithm of its magnitude may be below that.
    pub rest: ExprId,
}

impl Builder<'_> {
    /// The determinant over the window. Asks that it changes by no more than half of itself.
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
        // ln (1 + z) ≥ z − z² where z ≥ −½.
        let square = self.square(largest);
        let rest = self.graph().add(beside, square);
        let rest = self.bounded(&format!("{name}_rest"), rest);
        Determinant {
            inverse,
            slope,
            rest,
        }
    }

    /// How far a sine (`sine` in size) is from its tangent where its angle goes `opened` and deviates from a line: ½ x² of itself, and of
    /// the cosine what the angle deviates and x³/6; and rounding of what both are a part of.
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

    /// No less than the transmission ratio from an arm at both ends of the window, and than its geometric mean between.
    ///
    /// The ratio is that of two sines. Each is on its tangent but for what is beside it, and 1 + x ≤ exp x ≤ 1 + x + x² up to x = 1.79.
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
        // Where the lever may vanish, it is bounded by its size all over the window.
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
