//! Solves mechanisms whose parameters are drawn from their distributions.

use linkwright::{Blocks as _, Failure};

use super::first_order::StackUp;
use super::moments::Moments;
use super::prepared::Prepared;
use super::samples::ToleranceSamples;
use crate::batch::Batch;
use crate::observable::Observable;

/// Largest number of values that are kept: mechanisms times frames times measures, 1 GiB.
pub const MAX_SAMPLED_VALUES: usize = 1 << 27;

/// Number of mechanisms between two reports of progress.
const CHUNK: usize = 1 << 10;

/// Spread of sampled mechanisms.
#[derive(Clone, Debug)]
pub struct SampledSpread {
    /// Number of mechanisms.
    pub count: usize,
    /// True if `reached` has ended the work early.
    pub is_interrupted: bool,
    /// Number of mechanisms that cannot be assembled at the first time.
    pub unassembled: usize,
    /// Number of assembled mechanisms whose motion ends early.
    pub ended: usize,
    /// First failure, with its reason in words.
    pub failure: Option<(Failure, String)>,
    /// Spreads, in the order of the measures.
    pub measures: Vec<SampledMeasure>,
}

/// Spread of a measure.
#[derive(Clone, Debug)]
pub struct SampledMeasure {
    /// Moments at each time, of the mechanisms that are solved there.
    pub moments: Vec<Moments>,
}

impl SampledSpread {
    /// Solves `count` mechanisms at the times of the nominal motion, which has one at least. `reached` receives the number of solved
    /// mechanisms; it returns false to end the work with these. The result depends on neither the number of threads nor the size of pieces.
    pub fn new(
        prepared: &Prepared,
        nominal: &StackUp,
        samples: &ToleranceSamples<'_>,
        count: u32,
        threads: usize,
        mut reached: impl FnMut(usize) -> bool,
    ) -> SampledSpread {
        let observables: Vec<Observable> =
            nominal.measures.iter().map(|it| it.observable).collect();
        let mut batch = Batch::new(&prepared.blocks, &nominal.times, &observables);
        batch.threads = threads;
        let of_set = nominal.times.len() * observables.len();
        let parameters = prepared.blocks.nominal_parameters().0;
        let mut spread = SampledSpread {
            count: count as usize,
            is_interrupted: false,
            unassembled: 0,
            ended: 0,
            failure: None,
            measures: Vec::new(),
        };
        let mut values = vec![f64::NAN; count as usize * of_set];
        let mut first = 0;
        for piece in values.chunks_mut((CHUNK * of_set).max(1)) {
            let sets = piece.len() / of_set.max(1);
            let mut drawn = parameters.repeat(sets);
            let rows = drawn.chunks_mut(parameters.len().max(1));
            for (row, index) in rows.zip(first..) {
                samples.write(index, row);
            }
            // The lengths of all slices follow from the same counts.
            let outcomes = batch.solve(&drawn, &[], piece).unwrap_or_default();
            for outcome in outcomes {
                let Some(failure) = outcome.failure else {
                    continue;
                };
                match outcome.solved {
                    0 => spread.unassembled += 1,
                    _ => spread.ended += 1,
                }
                let reason = || (failure, prepared.blocks.reported(&failure));
                spread.failure.get_or_insert_with(reason);
            }
            first += sets as u32;
            if !reached(first as usize) && first < count {
                spread.is_interrupted = true;
                spread.count = first as usize;
                break;
            }
        }
        values.truncate(spread.count * of_set);
        let measures = nominal.measures.iter().enumerate();
        let measures = measures.map(|(own, measure)| {
            let mut column = Vec::with_capacity(spread.count);
            let moments = measure.nominal.iter().enumerate();
            let moments = moments.map(|(place, &about)| {
                column.clear();
                let rows = values.chunks_exact(of_set);
                let of_instant = rows.map(|it| it[place * observables.len() + own]);
                column.extend(of_instant.filter(|it| !it.is_nan()));
                Moments::of(&mut column, about)
            });
            SampledMeasure {
                moments: moments.collect(),
            }
        });
        spread.measures = measures.collect();
        spread
    }
}
