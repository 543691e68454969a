//! Writes tables of measured chains.

use super::measure::Measured;
use crate::stability::verdict::Scalar;
use crate::study::table::aligned;

/// Labels of the levels of each quantity.
const NAMES: [[&str; 3]; 2] = [["φ", "φ̇", "φ̈"], ["x, y", "ẋ, ẏ", "ẍ, ÿ"]];

/// Name of a scalar.
pub fn name(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::F64 => "f64",
        Scalar::F32 => "f32",
    }
}

/// Table of the sweeps: refused frames, frames solved by tearing, and the largest ratios.
pub fn sweeps(measured: &[Measured]) -> String {
    let mut rows = vec![
        [
            "scalar",
            "step, s",
            "cells",
            "growth",
            "frames",
            "by tears",
            "refused",
            "refused, all at once",
            "largest ratio of means",
            "of the largest",
        ]
        .map(str::to_string),
    ];
    for it in measured {
        let [mean, largest] = it.largest_ratios();
        rows.push([
            name(it.scalar).to_string(),
            it.sweep.step.to_string(),
            it.cells.to_string(),
            it.growth.to_string(),
            it.sweep.frames.to_string(),
            it.torn.by_tears.to_string(),
            it.torn.refused.len().to_string(),
            it.dense.refused.len().to_string(),
            format!("{mean:.2}"),
            format!("{largest:.2}"),
        ]);
    }
    aligned(&rows, 1)
}

/// Errors of the chains of one scalar and one step.
pub fn errors<'a>(measured: impl Iterator<Item = &'a Measured>) -> String {
    let mut rows = vec![
        [
            "cells",
            "growth",
            "of",
            "mean, tears",
            "mean, all at once",
            "ratio",
            "largest, tears",
            "largest, all at once",
            "ratio",
        ]
        .map(str::to_string),
    ];
    for it in measured {
        for (quantity, names) in NAMES.iter().enumerate() {
            for (level, name) in names.iter().enumerate() {
                let [torn, dense] = [&it.torn, &it.dense].map(|way| way.errors[quantity][level]);
                let [mean, largest] = it.ratios(quantity, level);
                rows.push([
                    it.cells.to_string(),
                    it.growth.to_string(),
                    (*name).to_string(),
                    format!("{:.1e}", torn.mean),
                    format!("{:.1e}", dense.mean),
                    format!("{mean:.2}"),
                    format!("{:.1e}", torn.largest),
                    format!("{:.1e}", dense.largest),
                    format!("{largest:.2}"),
                ]);
            }
        }
    }
    aligned(&rows, 3)
}
