//! Spreads of measures that follow from the tolerances of parameters.
//!
//! [`StackUp`] is the first order: derivatives of measures times tolerances. [`SampledSpread`] is the spread of mechanisms whose
//! parameters are drawn from their distributions. Both hold at the times of one nominal motion.

mod first_order;
mod moments;
mod prepared;
mod sampled;
mod samples;
mod verdict;

pub use first_order::{LinearSpread, StackUp, Toleranced};
pub use moments::{Moments, QUANTILES};
pub use prepared::{Prepared, Unprepared, prepared};
pub use sampled::{MAX_SAMPLED_VALUES, SampledMeasure, SampledSpread};
pub use samples::{Sampling, ToleranceSamples};
pub use verdict::{Departure, RELEVANT, STANDARD_ERRORS, departures};
