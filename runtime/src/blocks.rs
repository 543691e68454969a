//! Declares [`Blocks`], the equations of a mechanism as generated code or the interpreter supplies them.
//!
//! A mechanism is a list of blocks that are solved one after another. An implementation solves one instant from the
//! last frame; [`crate::shell`] does everything that all mechanisms share.

use crate::block::Start;
use crate::failure::{Failure, FailureKind};
use crate::failure_message::{BlockName, FailureMessage};
use crate::guard::Pair;
use crate::math::Real;
use crate::motion::PointMotion;
use crate::settings::Settings;
use crate::signal::Signal;
use crate::time_window::TimeWindow;
use crate::value_range::ValueRange;

/// Equations of a mechanism, solved block by block, and the names of its parts.
///
/// Generated code and the interpreter implement this trait; the functions that solve are not shown and may change with
/// every release. Indices count from 0, in the order of the description.
pub trait Blocks {
    /// Scalar type: f64 or f32.
    type Scalar: Real;
    /// Solved instant.
    type Frame: Clone;
    /// Value of each coordinate.
    type Coordinates: Values<Self::Scalar>;
    /// Assembly mode of each loop.
    type Branches: Clone;
    /// Numbers that the caller can change between instants; `()` without any.
    type Parameters: Values<Self::Scalar>;
    /// Signals besides the time that drive the mechanism; `()` without any.
    type Inputs: Values<Signal<Self::Scalar>>;
    /// A [`PathEnclosure`](crate::time_window::PathEnclosure) for each unknown of Newton-Raphson.
    #[doc(hidden)]
    type PathEnclosures: Clone;

    /// Parameters of the description.
    fn nominal_parameters(&self) -> Self::Parameters;

    /// Signals of the description at assembly.
    fn initial_inputs(&self) -> Self::Inputs;

    /// Assembly modes of the design configuration.
    fn drawn_branches(&self) -> Self::Branches;

    /// Modes beyond a change point at which the block of this number meets another branch; `None` without another
    /// branch.
    #[doc(hidden)]
    fn exchanged(&self, branches: &Self::Branches, block: u16) -> Option<Self::Branches>;

    /// True if a block may exchange its mode. Otherwise the program contains no code for change points.
    #[doc(hidden)]
    fn may_cross(&self) -> bool {
        true
    }

    /// True if Newton-Raphson solves a block.
    #[doc(hidden)]
    fn is_iterated(&self) -> bool {
        size_of::<Self::PathEnclosures>() != 0
    }

    /// Pose in the design configuration of these parameters.
    fn drawn_pose(&self, parameters: &Self::Parameters) -> Self::Coordinates;

    /// Estimate before the first frame: a pose at rest from which the mechanism is assembled at time `t` (s). Unknowns
    /// that are not coordinates have their values in the design configuration.
    #[doc(hidden)]
    fn estimate(
        &self,
        pose: &Self::Coordinates,
        parameters: &Self::Parameters,
        t: Self::Scalar,
    ) -> Self::Frame;

    /// Moves the estimate close to a stored assembly if `branches` name one. Afterwards `branches` name none, since the
    /// mechanism moves on.
    #[doc(hidden)]
    fn begin(&self, _branches: &mut Self::Branches, _last: &mut Self::Frame) {}

    /// Time of a frame (s).
    fn time(frame: &Self::Frame) -> Self::Scalar;

    /// Changes only the time of a frame (s).
    #[doc(hidden)]
    fn set_time(frame: &mut Self::Frame, t: Self::Scalar);

    /// Solves all blocks for one instant from the last frame. Blocks that determine their mode write it to `branches`.
    ///
    /// # Errors
    /// Returns the failure of the first block that cannot be solved; `at` is then not a frame.
    #[doc(hidden)]
    fn solve(
        &self,
        at: &mut Self::Frame,
        last: &Self::Frame,
        branches: &mut Self::Branches,
        conditions: &Conditions<'_, Self::Scalar, Self::Parameters, Self::Inputs>,
    ) -> Result<(), Failure<Self::Scalar>>;

    /// True if the blocks can verify that a frame lies on the path of the last one.
    #[doc(hidden)]
    fn is_guarded(&self) -> bool;

    /// Path enclosures of a mechanism at rest.
    #[doc(hidden)]
    fn enclosures(&self) -> Self::PathEnclosures;

    /// Verifies that each block's equations have one solution near the chord through both frames over a whole window.
    /// Every frame found in the window then lies on one path. Afterwards `enclosures` bound that path.
    ///
    /// # Errors
    /// Returns the first block whose path cannot be verified.
    #[doc(hidden)]
    fn verify_path(
        &self,
        pair: &Pair<'_, Self>,
        window: &TimeWindow<Self::Scalar>,
        enclosures: &mut Self::PathEnclosures,
    ) -> Result<(), u16>
    where
        Self: Sized;

    /// True if [`Blocks::verify_nonsingular`] can succeed.
    #[doc(hidden)]
    fn is_closed(&self) -> bool {
        false
    }

    /// Verifies that each block has a closed form, is not singular in a window and turns nothing by half a turn there.
    /// Every frame found in the window then lies on one path. This costs less than [`Blocks::verify_path`], which may
    /// verify more.
    ///
    /// # Errors
    /// Returns the first block that cannot be verified.
    #[doc(hidden)]
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

    /// True if the unknowns of Newton-Raphson lie in their enclosures, so many steps after the second frame of the
    /// enclosures.
    #[doc(hidden)]
    fn is_within(
        &self,
        at: &Self::Frame,
        enclosures: &Self::PathEnclosures,
        steps: Self::Scalar,
    ) -> bool;

    /// Name of the mechanism.
    fn name(&self) -> &str;

    /// Name of the coordinate `index`; `None` beyond the last one.
    fn coordinate_name(&self, index: usize) -> Option<&str>;

    /// Name of the parameter `index`; `None` beyond the last one.
    fn parameter_name(&self, index: usize) -> Option<&str>;

    /// Name of the input `index`; `None` beyond the last one.
    fn input_name(&self, index: usize) -> Option<&str>;

    /// Range of the parameter `_index`; `None` if the description gives none.
    fn parameter_range(&self, _index: usize) -> Option<ValueRange<'_, Self::Scalar>> {
        None
    }

    /// Range of the values of the input `_index`; `None` if the description gives none.
    fn input_range(&self, _index: usize) -> Option<ValueRange<'_, Self::Scalar>> {
        None
    }

    /// Value, rate and acceleration of the coordinate `index` in a frame; `None` if frames do not hold the coordinate.
    fn coordinate(&self, frame: &Self::Frame, index: usize) -> Option<[Self::Scalar; 3]>;

    /// True if frames hold all coordinates, from which points follow.
    #[doc(hidden)]
    fn holds_coordinates(&self) -> bool {
        false
    }

    /// Adds a multiple of the difference of two frames to a third one, in all numbers except for the time.
    #[doc(hidden)]
    fn add(
        &self,
        sum: &mut Self::Frame,
        multiple: Self::Scalar,
        frame: &Self::Frame,
        base: &Self::Frame,
    );

    /// Name of the point `index` among those that frames offer; `None` beyond the last one.
    fn point_name(&self, index: usize) -> Option<&str>;

    /// Motion of the point `index`; `None` if frames do not offer it.
    fn point(&self, frame: &Self::Frame, index: usize) -> Option<PointMotion<Self::Scalar>>;

    /// Name of the block `index` in solve order; `None` beyond the last one.
    fn block_name(&self, index: usize) -> Option<BlockName<'_>>;

    /// Index and value of the first required positive quantity that these parameters make zero or negative; `None` if
    /// all are positive.
    #[doc(hidden)]
    fn not_positive(&self, _parameters: &Self::Parameters) -> Option<(u16, Self::Scalar)> {
        None
    }

    /// Joint and name of the required positive quantity `_index`; `None` beyond the last one.
    #[doc(hidden)]
    fn requirement_name(&self, _index: usize) -> Option<BlockName<'_>> {
        None
    }

    /// Label of the load `_index` among the loads that failures name; `None` beyond the last one.
    #[doc(hidden)]
    fn load_name(&self, _index: usize) -> Option<&str> {
        None
    }

    /// Describes a failure in the mechanism's own terms.
    fn explained(&self, failure: &Failure<Self::Scalar>) -> FailureMessage<'_, Self::Scalar> {
        let place = usize::from(failure.block);
        let input = failure.input.map(usize::from);
        FailureMessage {
            failure: *failure,
            block: match (input, failure.kind) {
                (Some(input), _) => self.input_name(input).map(|name| BlockName::new(name, "")),
                (None, FailureKind::OutsideRange { .. }) => self
                    .parameter_name(place)
                    .map(|name| BlockName::new(name, "")),
                (None, FailureKind::NotPositive { .. }) => self.requirement_name(place),
                (None, FailureKind::LoadNotFinite { load }) => self
                    .load_name(usize::from(load))
                    .map(|name| BlockName::new(name, "")),
                (None, _) => self.block_name(place),
            },
            range: match (input, failure.kind) {
                (Some(input), FailureKind::OutsideRange { .. }) => self.input_range(input),
                (None, FailureKind::OutsideRange { .. }) => self.parameter_range(place),
                _ => None,
            },
        }
    }
}

/// Data with which one instant is solved.
#[derive(Clone, Copy, Debug)]
pub struct Conditions<'a, T, P, I> {
    /// Time (s).
    pub t: T,
    /// Kind of the last frame.
    pub start: Start,
    /// Parameters of the mechanism.
    pub parameters: &'a P,
    /// Signals at that time.
    pub inputs: &'a I,
    /// Limits within which Newton-Raphson must succeed.
    pub settings: &'a Settings<T>,
}

/// Values with an order: the numbers of coordinates and parameters, or the [`Signal`]s of inputs.
///
/// ```
/// use linkwright::{Signal, Values};
///
/// linkwright_macros::mechanism! {
///     mechanism arm {
///         input angle = 0;
///         point O = (0, 0);
///         body boom at O { O, P: (2, 0) }
///         revolute O(ground, boom);
///         drive phi(boom) = angle;
///     }
/// }
/// let mut inputs = arm::Inputs::INITIAL;
/// inputs.set(0, Signal::constant(0.5));
/// assert_eq!(inputs.angle.value, 0.5);
/// assert_eq!((inputs.count(), inputs.value(1)), (1, None));
/// ```
pub trait Values<V>: Clone {
    /// Number of values.
    fn count(&self) -> usize;

    /// Value at `index`; `None` beyond the last one.
    fn value(&self, index: usize) -> Option<V>;

    /// Changes the value at `index`; does nothing beyond the last one.
    fn set(&mut self, index: usize, value: V);

    /// True if every number is finite.
    fn are_finite(&self) -> bool;
}

impl<V> Values<V> for () {
    fn count(&self) -> usize {
        0
    }

    fn value(&self, _index: usize) -> Option<V> {
        None
    }

    fn set(&mut self, _index: usize, _value: V) {}

    #[inline]
    fn are_finite(&self) -> bool {
        true
    }
}

/// Index and value of the first value that is not positive; `None` if all are positive.
#[doc(hidden)]
pub fn first_not_positive<T: Real>(values: &[T]) -> Option<(u16, T)> {
    // Written so that NaN is not positive.
    let is_positive = |value: &T| *value > T::ZERO;
    let (place, value) = (0..).zip(values).find(|(_, value)| !is_positive(value))?;
    Some((place, *value))
}

/// Adds a multiple of the differences of two rows of numbers to a third one.
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
