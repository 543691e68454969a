//! What a mechanism states of itself → [`Blocks`], the border between generated or interpreted equations and the shell.
//!
//! A mechanism is a list of blocks that are solved one after another. Whoever knows them says how one instant is found from the last
//! one; everything else is the same for all mechanisms and is done by [`crate::shell`]. The module does not know what a block is made
//! of.

use crate::block::Start;
use crate::failure::{Failure, FailureKind};
use crate::failure_message::{BlockName, FailureMessage};
use crate::guard::Pair;
use crate::math::Real;
use crate::motion::PointMotion;
use crate::settings::Settings;
use crate::signal::Signal;
use crate::time_window::TimeWindow;

/// The equations of a mechanism, solved block by block.
pub trait Blocks {
    /// f64 or f32.
    type Scalar: Real;
    /// One solved instant.
    type Frame: Clone;
    /// A value for each coordinate.
    type Coordinates: Values<Self::Scalar>;
    /// The assembly mode of each loop.
    type Branches: Clone;
    /// What can be changed between instants; `()` where there is nothing.
    type Parameters: Values<Self::Scalar>;
    /// The signals that move it beside time; `()` where there are none.
    type Inputs: Signals<Self::Scalar>;
    /// A [`PathEnclosure`](crate::time_window::PathEnclosure) for each unknown that Newton-Raphson finds.
    type PathEnclosures: Clone;

    /// The parameters of the description.
    fn nominal_parameters(&self) -> Self::Parameters;

    /// The signals of the description at assembly.
    fn initial_inputs(&self) -> Self::Inputs;

    /// The assembly modes of the drawing.
    fn drawn_branches(&self) -> Self::Branches;

    /// The modes that the block of this number exchanges with another one where both meet; `None` where it has no other.
    fn exchanged(&self, branches: &Self::Branches, block: u16) -> Option<Self::Branches>;

    /// True if a block may exchange its mode. Where none may, nothing of that becomes part of a program.
    fn may_cross(&self) -> bool {
        true
    }

    /// True if Newton-Raphson solves a block.
    fn is_iterated(&self) -> bool {
        size_of::<Self::PathEnclosures>() != 0
    }

    /// The pose in the drawing of these parameters.
    fn drawn_pose(&self, parameters: &Self::Parameters) -> Self::Coordinates;

    /// The frame before the first one: a pose at rest from which the mechanism is assembled at time `t` (s). What is no
    /// coordinate is that of the drawing.
    fn estimate(
        &self,
        pose: &Self::Coordinates,
        parameters: &Self::Parameters,
        t: Self::Scalar,
    ) -> Self::Frame;

    /// Puts the frame before the first one near the assembly that is wanted, where `branches` name one of those that are stored; they do
    /// not any more afterwards, since the mechanism moves on.
    fn begin(&self, _branches: &mut Self::Branches, _last: &mut Self::Frame) {}

    /// The time of a frame (s).
    fn time(frame: &Self::Frame) -> Self::Scalar;

    /// Changes the time of a frame (s), and nothing else.
    fn set_time(frame: &mut Self::Frame, t: Self::Scalar);

    /// Solves all blocks for one instant from the last frame. The modes of blocks that find their mode are noted in `branches`.
    ///
    /// # Errors
    /// The first block that cannot be solved; `at` is then not a frame.
    fn solve(
        &self,
        at: &mut Self::Frame,
        last: &Self::Frame,
        branches: &mut Self::Branches,
        conditions: &Conditions<'_, Self::Scalar, Self::Parameters, Self::Inputs>,
    ) -> Result<(), Failure<Self::Scalar>>;

    /// Whether the blocks can show that a frame lies on the path of the last one.
    fn is_guarded(&self) -> bool;

    /// PathEnclosures of what does not move.
    fn enclosures(&self) -> Self::PathEnclosures;

    /// Asks of every block whether its equations have one solution near the straight line through both frames all over a window: then
    /// whatever is found in it lies on one path. Afterwards `enclosures` say where that is.
    ///
    /// # Errors
    /// The first block of which that cannot be shown.
    fn verify_path(
        &self,
        pair: &Pair<'_, Self>,
        window: &TimeWindow<Self::Scalar>,
        enclosures: &mut Self::PathEnclosures,
    ) -> Result<(), u16>
    where
        Self: Sized;

    /// Whether [`Blocks::verify_nonsingular`] may show anything.
    fn is_closed(&self) -> bool {
        false
    }

    /// Asks of every block that it has a closed form which is not singular anywhere in a window, and turns nothing by half a turn there:
    /// then whatever is found in it lies on one path. That takes less than [`Blocks::verify_path`], which may show more.
    ///
    /// # Errors
    /// The first block of which that cannot be shown.
    fn verify_nonsingular(
        &self,
        _pair: &Pair<'_, Self>,
        _span: &TimeWindow<Self::Scalar>,
    ) -> Result<(), u16>
    where
        Self: Sized,
    {
        Err(0)
    }

    /// Whether what Newton-Raphson has found lies in its enclosures, so many steps after the second of the frames that they go through.
    fn is_within(
        &self,
        at: &Self::Frame,
        enclosures: &Self::PathEnclosures,
        steps: Self::Scalar,
    ) -> bool;

    /// What the mechanism is called.
    fn name(&self) -> &str;

    /// What the coordinate `index` is called; `None` beyond the last one.
    fn coordinate_name(&self, index: usize) -> Option<&str>;

    /// What the parameter `index` is called; `None` beyond the last one.
    fn parameter_name(&self, index: usize) -> Option<&str>;

    /// What the input `index` is called; `None` beyond the last one.
    fn input_name(&self, index: usize) -> Option<&str>;

    /// The coordinate `index` of a frame: its value, its rate and its acceleration; `None` where frames do not hold it.
    fn coordinate(&self, frame: &Self::Frame, index: usize) -> Option<[Self::Scalar; 3]>;

    /// Whether frames hold all coordinates, from which points follow.
    fn holds_coordinates(&self) -> bool {
        false
    }

    /// Adds a multiple of the difference of two frames to a third one, in all numbers but the time.
    fn add(
        &self,
        sum: &mut Self::Frame,
        multiple: Self::Scalar,
        frame: &Self::Frame,
        base: &Self::Frame,
    );

    /// What the point `index` is called whose motion frames offer; `None` beyond the last one.
    fn point_name(&self, index: usize) -> Option<&str>;

    /// The motion of the point `index`; `None` where frames do not offer it.
    fn point(&self, frame: &Self::Frame, index: usize) -> Option<PointMotion<Self::Scalar>>;

    /// What the block `index` is called, in solve order; `None` beyond the last one.
    fn block_name(&self, index: usize) -> Option<BlockName<'_>>;

    /// The first of what must be positive that these parameters do not leave so: its place, and what it would be.
    fn not_positive(&self, _parameters: &Self::Parameters) -> Option<(u16, Self::Scalar)> {
        None
    }

    /// The joint of what must be positive, and what it is called.
    fn requirement_name(&self, _index: usize) -> Option<BlockName<'_>> {
        None
    }

    /// The label of the load at a place of those that a failure names; `None` beyond the last one.
    fn load_name(&self, _index: usize) -> Option<&str> {
        None
    }

    /// A failure in the mechanism's own terms.
    fn explained(&self, failure: &Failure<Self::Scalar>) -> FailureMessage<'_, Self::Scalar> {
        let place = usize::from(failure.block);
        FailureMessage {
            failure: *failure,
            block: match (failure.input, failure.kind) {
                (Some(input), _) => self
                    .input_name(usize::from(input))
                    .map(|name| BlockName::new(name, "")),
                (None, FailureKind::NotPositive { .. }) => self.requirement_name(place),
                (None, FailureKind::LoadNotFinite { load }) => self
                    .load_name(usize::from(load))
                    .map(|name| BlockName::new(name, "")),
                (None, _) => self.block_name(place),
            },
        }
    }
}

/// What one instant is solved with.
#[derive(Clone, Copy, Debug)]
pub struct Conditions<'a, T, P, I> {
    /// The time (s).
    pub t: T,
    /// What the last frame is.
    pub start: Start,
    /// The parameters.
    pub parameters: &'a P,
    /// The signals at that time.
    pub inputs: &'a I,
    /// The limits within which Newton-Raphson must succeed.
    pub settings: &'a Settings<T>,
}

/// Numbers with an order: coordinates, parameters.
pub trait Values<T>: Clone {
    /// How many there are.
    fn count(&self) -> usize;

    /// The value at `index`; `None` beyond the last one.
    fn value(&self, index: usize) -> Option<T>;

    /// Changes the value at `index`; does nothing beyond the last one.
    fn set(&mut self, index: usize, value: T);

    /// Whether every one of them is finite.
    fn are_finite(&self) -> bool;
}

impl<T> Values<T> for () {
    fn count(&self) -> usize {
        0
    }

    fn value(&self, _index: usize) -> Option<T> {
        None
    }

    fn set(&mut self, _index: usize, _value: T) {}

    #[inline]
    fn are_finite(&self) -> bool {
        true
    }
}

/// Signals with an order, that a caller supplies with their rates and accelerations.
pub trait Signals<T>: Clone {
    /// How many there are.
    fn count(&self) -> usize;

    /// The signal at `index`; `None` beyond the last one.
    fn signal(&self, index: usize) -> Option<Signal<T>>;

    /// Changes the signal at `index`; does nothing beyond the last one.
    fn set(&mut self, index: usize, signal: Signal<T>);

    /// Whether every number of them is finite.
    fn are_finite(&self) -> bool;

    /// The signals at a fraction of the time `h` (s) from these to `last`, on the smoothest way; see [`Signal::towards`].
    #[must_use]
    fn towards(&self, last: &Self, h: T, part: T) -> Self;
}

impl<T> Signals<T> for () {
    fn count(&self) -> usize {
        0
    }

    fn signal(&self, _index: usize) -> Option<Signal<T>> {
        None
    }

    fn set(&mut self, _index: usize, _signal: Signal<T>) {}

    #[inline]
    fn are_finite(&self) -> bool {
        true
    }

    #[inline]
    fn towards(&self, _last: &(), _h: T, _part: T) {}
}

/// The first value that is not positive, with its place.
#[doc(hidden)]
pub fn first_not_positive<T: Real>(values: &[T]) -> Option<(u16, T)> {
    // Written so that NaN is not positive.
    let is_positive = |value: &T| *value > T::ZERO;
    let (place, value) = (0..).zip(values).find(|(_, value)| !is_positive(value))?;
    Some((place, *value))
}

/// Numbers with a multiple of the differences of others added.
#[doc(hidden)]
pub fn sum<T: Real, const N: usize>(
    mut sum: [T; N],
    multiple: T,
    [numbers, base]: [[T; N]; 2],
) -> [T; N] {
    for ((sum, number), base) in sum.iter_mut().zip(numbers).zip(base) {
        *sum += multiple * (number - base);
    }
    sum
}
