//! Approximates angles by parabolas through both frames, with bounds on the deviation, for long series of pairs.
//!
//! Bounds of bounds grow from pair to pair by more than the bounded values, so signs are kept as far as frames know them. The
//! parabola of an angle follows from those of the angles before it; the remainder is multiplied by the transmission ratio, which
//! is extrapolated over the window too. The unit of time is the length of the window from the second frame. The letters are those
//! of the [module](super); the guide (`theory.md`) has the argument.

use super::pair::Bounded;
use super::ratio::Determinant;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::program::builder::Builder;
use crate::program::passes::enclosure::Enclosure;
use crate::program::pin_motion::Known;

/// Course of an angle over a window.
#[derive(Clone, Copy, Debug)]
pub(in crate::program) struct Course {
    /// Slope y: the signed change along the chord.
    turn: ExprId,
    /// Curvature c: the second derivative of the parabola.
    curve: ExprId,
    /// Bounds S of the deviation from the parabola at both ends of the window; bounds in between are geometric means.
    deviations: [ExprId; 2],
}

impl Course {
    /// Bounds the deviation of the angle from the chord.
    pub fn deviation(&self, name: &str, builder: &mut Builder<'_>) -> ExprId {
        let [before, after] = self.deviations;
        let difference = builder.graph().subtract(before, after);
        let deviation = builder.graph().choose(difference, after, before);
        let remainder = builder.paths.window.remainder;
        let [remainder, curve] = [
            builder.graph().variable(remainder),
            builder.graph().magnitude(self.curve),
        ];
        let curved = builder.graph().multiply(remainder, curve);
        let deviation = builder.graph().add(curved, deviation);
        builder.bounded(&format!("{name}_deviation"), deviation)
    }
}

/// Vector of constant length that moves a pair.
struct Arm {
    vector: Vector,
    length: ExprId,
    /// Bound on the deviation of its angle from the chord.
    deviation: ExprId,
    course: Course,
    /// Largest rate on the parabola.
    rate: ExprId,
}

/// Values that both angles of a pair share.
struct Triangle<'a> {
    bounded: &'a Bounded,
    arms: Vec<Arm>,
    /// Both links in this frame.
    links: [Vector; 2],
    /// Slopes y of both angles.
    turns: [ExprId; 2],
    /// Largest rates while the earlier angles follow their parabolas.
    rates: [ExprId; 2],
    /// Bound on the change of the angle between the links.
    opened: ExprId,
    determinant: Determinant,
}

impl Builder<'_> {
    /// Returns the courses of both angles of a pair; `None` if anything but vectors of constant length moves the pair.
    pub(super) fn courses_of(
        &mut self,
        bounded: &Bounded,
        known: &mut Known,
    ) -> Option<[Course; 2]> {
        let pair = &bounded.pair;
        if !pair.is_fixed(self.graph().zero()) {
            return None;
        }
        let arms = self.arms_before(pair.closure, known)?;
        let [first, second] = pair.angles.map(|angle| self.path_direction(angle));
        let directions = [first?, second?];
        let links = [0, 1].map(|side| {
            let vector = self.turn(directions[side], pair.links[side]);
            let name = |axis| format!("{}_{axis}", pair.names[side]);
            [
                self.bounded(&name("x"), vector[0]),
                self.bounded(&name("y"), vector[1]),
            ]
        });
        let turns = pair.angles.map(|angle| self.turn_over_span(angle));
        let opened = {
            let difference = self.graph().subtract(turns[1], turns[0]);
            let difference = self.graph().magnitude(difference);
            let deviation = self.graph().multiply(bounded.slopes.both, bounded.bent);
            let opened = self.graph().add(difference, deviation);
            self.bounded(&format!("{}_opened", pair.name), opened)
        };
        let rates = self.rates_of(bounded, &arms, turns);
        let determinant = self.determinant_over_span(bounded, links, turns, opened);
        let triangle = Triangle {
            bounded,
            arms,
            links,
            turns,
            rates,
            opened,
            determinant,
        };
        Some([0, 1].map(|side| self.course_of(side, &triangle)))
    }

    /// Returns the vectors that move a pair; `None` if anything but vectors of constant length does.
    fn arms_before(&mut self, closure: Vector, known: &mut Known) -> Option<Vec<Arm>> {
        let zero = self.graph().zero();
        let mut rest = closure;
        let mut arms = Vec::new();
        for angle in self.angles_in(closure) {
            let turned = self.pool.turned_vector(rest, angle);
            let (local, others) = turned?;
            let position = self.position(angle);
            let Enclosure { radius, deviation } = self.enclosure(position);
            let vector = [0, 1].map(|axis| self.graph().subtract(rest[axis], others[axis]));
            rest = others;
            if self.components(local).radius != zero {
                return None;
            }
            if radius == zero {
                continue;
            }
            let course = match known.courses.get(&angle) {
                Some(&course) => course,
                None => {
                    let course = Course {
                        turn: self.turn_over_span(angle),
                        curve: zero,
                        deviations: [deviation; 2],
                    };
                    known.courses.insert(angle, course);
                    course
                }
            };
            arms.push(Arm {
                vector,
                length: self.length_of(local),
                deviation,
                course,
                rate: self.rate_on(course),
            });
        }
        (self.components(rest).radius == zero).then_some(arms)
    }

    /// Returns the slope y of an angle.
    fn turn_over_span(&mut self, angle: usize) -> ExprId {
        let moved = self.moved_since(angle);
        let stretch = self.paths.window.steps;
        let stretch = self.graph().variable(stretch);
        let turn = self.graph().multiply(stretch, moved);
        let name = format!("{}_turn", self.system.unknown_name(angle));
        self.bounded(&name, turn)
    }

    /// Returns the largest rate on a parabola: |y| + |c| (½ + b), since its slope equals that of the chord half a step before the
    /// second frame.
    fn rate_on(&mut self, course: Course) -> ExprId {
        let beyond = self.paths.window.beyond;
        let [beyond, half] = [self.graph().variable(beyond), self.graph().rational(1, 2)];
        let farthest = self.graph().add(half, beyond);
        let [turn, curve] = [course.turn, course.curve].map(|it| self.graph().magnitude(it));
        let curved = self.graph().multiply(curve, farthest);
        self.graph().add(turn, curved)
    }

    /// Returns the longest time from an instant between both frames to an end of the window.
    fn farthest(&mut self) -> ExprId {
        let beyond = self.paths.window.beyond;
        let [beyond, one] = [self.graph().variable(beyond), self.graph().one()];
        self.graph().add(one, beyond)
    }

    /// Returns the largest rates of both angles: at some instant between both frames they equal y, and second derivatives bound
    /// their change.
    fn rates_of(&mut self, bounded: &Bounded, arms: &[Arm], turns: Vector) -> [ExprId; 2] {
        let Bounded {
            pair, slopes, turn, ..
        } = bounded;
        let farthest = self.farthest();
        let (mut pins, mut drifts) = (Vec::new(), Vec::new());
        for arm in arms {
            let curve = self.graph().magnitude(arm.course.curve);
            let square = self.square(arm.rate);
            let both = self.graph().add(curve, square);
            pins.push(self.graph().multiply(arm.length, arm.rate));
            drifts.push(self.graph().multiply(arm.length, both));
        }
        let pins = self.graph().sum(&pins);
        let speed = self.graph().multiply(turn.inverse, pins);
        let square = self.square(speed);
        let square = self.bounded(&format!("{}_speed_square", pair.name), square);
        let drift = self.graph().sum(&drifts);
        let drift = self.bounded(&format!("{}_drift", pair.name), drift);
        [0, 1].map(|side| {
            let [own, other] = [slopes.each[side], slopes.each[1 - side]];
            let opening = self.graph().multiply(turn.cosine, own);
            let slope = self.graph().add(other, opening);
            let turning = self.graph().multiply(square, slope);
            let second = self.graph().add(drift, turning);
            let change = self.graph().product(&[farthest, turn.inverse, own, second]);
            let size = self.graph().magnitude(turns[side]);
            let rate = self.graph().add(size, change);
            self.bounded(&format!("{}_rate", pair.names[side]), rate)
        })
    }

    /// Returns the course of one angle of a pair.
    fn course_of(&mut self, side: usize, triangle: &Triangle<'_>) -> Course {
        let Triangle {
            bounded,
            arms,
            links,
            turns,
            rates,
            opened,
            determinant,
        } = triangle;
        let Bounded {
            pair, slopes, turn, ..
        } = bounded;
        let other = 1 - side;
        let (name, own) = (&pair.names[side], slopes.each[side]);
        let squares = turns.map(|turn| self.square(turn));
        let changes = [0, 1].map(|side| {
            let largest = self.square(rates[side]);
            self.graph().subtract(largest, squares[side])
        });
        let length = pair.lengths[other];
        let mut second = {
            let square = self.square(length);
            vec![
                self.graph().multiply(pair.product, squares[side]),
                self.graph().multiply(square, squares[other]),
            ]
        };
        let mut third = {
            let largest = self.square(rates[side]);
            vec![
                self.graph().product(&[length, own, changes[other]]),
                self.graph().multiply(*opened, largest),
                changes[side],
            ]
        };
        let mut deviations = [Vec::new(), Vec::new()];
        for arm in arms {
            let lever = self.cross(arm.vector, links[other]);
            let lever = self.bounded(&format!("{name}_lever"), lever);
            let along = self.dot(arm.vector, links[other]);
            let along = self.bounded(&format!("{name}_along"), along);
            let deviation = self.graph().multiply(slopes.each[other], bounded.bent);
            let deviation = self.graph().add(arm.deviation, deviation);
            let difference = self.graph().subtract(turns[other], arm.course.turn);
            let opened = {
                let size = self.graph().magnitude(difference);
                let opened = self.graph().add(size, deviation);
                self.bounded(&format!("{name}_opened"), opened)
            };
            let turn_square = self.square(arm.course.turn);
            second.push(self.graph().multiply(along, turn_square));
            let curved = self.graph().multiply(lever, arm.course.curve);
            second.push(self.graph().negate(curved));
            let curve = self.graph().magnitude(arm.course.curve);
            let rate_square = self.square(arm.rate);
            let both = self.graph().add(curve, rate_square);
            let both = self.graph().multiply(opened, both);
            let change = self.graph().subtract(rate_square, turn_square);
            let both = self.graph().add(both, change);
            third.push(self.graph().product(&[arm.length, own, both]));
            let whole = self.graph().multiply(arm.length, length);
            let factors = self.factors_of(
                name,
                [lever, along],
                difference,
                [deviation, opened, whole],
                determinant,
            );
            for (end, factor) in factors.into_iter().enumerate() {
                deviations[end].push(self.graph().multiply(factor, arm.course.deviations[end]));
            }
        }
        let curve = {
            let sum = self.graph().sum(&second);
            let inverse = match side {
                0 => determinant.inverse,
                _ => self.graph().negate(determinant.inverse),
            };
            let curve = self.graph().multiply(sum, inverse);
            self.bounded(&format!("{name}_curve"), curve)
        };
        let size = self.graph().magnitude(curve);
        third.push(self.graph().product(&[size, turn.cosine, *opened]));
        let remainder = self.paths.window.remainder;
        let remainder = self.graph().variable(remainder);
        let third = self.graph().sum(&third);
        let change = self.graph().multiply(turn.inverse, third);
        let change = self.bounded(&format!("{name}_change"), change);
        // The distance of the second derivative from c is at most this, so the angle's own rate changes by less than assumed.
        let change = {
            let second = self.graph().add(size, change);
            let farthest = self.farthest();
            let further = self.graph().multiply(farthest, second);
            let turn_size = self.graph().magnitude(turns[side]);
            let rate = self.graph().add(turn_size, further);
            let rate = self.bounded(&format!("{name}_own_rate"), rate);
            let both = [rate, rates[side]].map(|rate| self.square(rate));
            let less = self.graph().subtract(both[0], both[1]);
            let one = self.graph().one();
            let opening = self.graph().add(one, *opened);
            let less = self.graph().product(&[turn.inverse, opening, less]);
            self.graph().add(change, less)
        };
        let change = self.graph().multiply(remainder, change);
        let rounding = self.graph().product(&[pair.rounding, turn.inverse, own]);
        let local = self.graph().add(change, rounding);
        let local = self.bounded(&format!("{name}_own"), local);
        let [before, after] = deviations.map(|mut deviations| {
            deviations.push(local);
            self.graph().sum(&deviations)
        });
        Course {
            turn: turns[side],
            curve,
            deviations: [
                self.bounded(&format!("{name}_deviation_before"), before),
                self.bounded(&format!("{name}_deviation_after"), after),
            ],
        }
    }

    pub(super) fn square(&mut self, value: ExprId) -> ExprId {
        self.graph().multiply(value, value)
    }
}
