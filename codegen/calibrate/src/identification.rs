//! Identifies which parameters a weighted sensitivity matrix determines.
//!
//! Its columns are scaled to unit length, so that units and magnitudes do not matter (van der Sluis 1969), and
//! decomposed into singular values. A singular value of zero, up to rounding, belongs to a combination of parameters
//! that can change and leave every measured value unchanged. A small one belongs to a combination with hardly any
//! effect. The ratio of the largest to it is its condition index (Belsley, Kuh and Welsch 1980, *Regression
//! Diagnostics*, section 3.2).

use nalgebra::{DMatrix, DVector};

/// Part of the largest singular value below which a singular value is rounding.
const RANK: f64 = 1e-9;

/// Condition index above which a combination has hardly any effect: three digits of the measured values are lost.
const HARDLY: f64 = 1e3;

/// Length of a column, relative to the longest one for relative changes of parameters, below which the parameter has no
/// effect.
const NOTHING: f64 = 1e-12;

/// Component, relative to the largest one, below which a parameter does not take part in a combination.
const PART: f64 = 1e-3;

/// Parameters that can change together and leave the measured values unchanged.
#[derive(Clone, Debug, PartialEq)]
pub struct Indistinct {
    /// Index and change in SI units of each parameter, the first one by one; a single parameter has no effect at all.
    pub changes: Vec<(usize, f64)>,
    /// Condition index; `None` if the measured values do not change at all.
    pub index: Option<f64>,
}

/// Combinations of parameters that a motion determines.
#[derive(Clone, Debug, PartialEq)]
pub struct Identification {
    /// Ratio of the largest to the smallest singular value that is determined, for columns of unit length.
    pub condition: f64,
    /// Indistinguishable combinations, followed by those that are hardly distinguishable.
    pub indistinct: Vec<Indistinct>,
    names: Vec<String>,
    lengths: Vec<f64>,
    /// Singular values and vectors of the determined combinations.
    determined: Vec<(f64, DVector<f64>)>,
    is_determined: Vec<bool>,
}

impl Identification {
    pub(crate) fn of(jacobian: &DMatrix<f64>, values: &[f64], names: &[String]) -> Identification {
        let count = names.len();
        let lengths: Vec<f64> = jacobian.column_iter().map(|it| it.norm()).collect();
        let size = |place: usize| {
            if values[place] == 0.0 {
                1.0
            } else {
                values[place].abs()
            }
        };
        let longest = (0..count).fold(0.0_f64, |most, it| most.max(lengths[it] * size(it)));
        let moves = |place: &usize| lengths[*place] * size(*place) > NOTHING * longest;
        let moving: Vec<usize> = (0..count).filter(moves).collect();
        let mut indistinct: Vec<Indistinct> = (0..count)
            .filter(|it| !moves(it))
            .map(|place| Indistinct {
                changes: vec![(place, 1.0)],
                index: None,
            })
            .collect();
        let mut is_determined: Vec<bool> = (0..count).map(|it| moves(&it)).collect();
        let mut determined: Vec<(f64, DVector<f64>)> = Vec::new();
        let mut hardly = Vec::new();
        if moving.is_empty() {
            // An empty matrix has no decomposition, and nothing is determined.
            return Identification {
                condition: f64::INFINITY,
                names: names.to_vec(),
                indistinct,
                lengths,
                determined,
                is_determined,
            };
        }
        // With fewer rows than columns, the decomposition would omit the undetermined combinations.
        let rows = jacobian.nrows().max(moving.len());
        let scaled = DMatrix::from_fn(rows, moving.len(), |row, column| {
            let place = moving[column];
            jacobian
                .get((row, place))
                .map_or(0.0, |it| it / lengths[place])
        });
        let decomposed = scaled.svd(false, true);
        let values_of = decomposed.singular_values;
        let largest = values_of.iter().copied().fold(0.0, f64::max);
        for (place, row) in decomposed
            .v_t
            .iter()
            .flat_map(|it| it.row_iter())
            .enumerate()
        {
            let singular = values_of[place];
            let mut whole = DVector::zeros(count);
            for (component, place) in row.iter().zip(&moving) {
                whole[*place] = *component;
            }
            let is_zero = singular <= RANK * largest;
            let index = largest / singular;
            if is_zero || index > HARDLY {
                let combination = combination(&whole, &lengths, (!is_zero).then_some(index));
                if is_zero {
                    for (place, _) in &combination.changes {
                        is_determined[*place] = false;
                    }
                    indistinct.push(combination);
                } else {
                    hardly.push(combination);
                }
            }
            if !is_zero {
                determined.push((singular, whole));
            }
        }
        indistinct.extend(hardly);
        let smallest = determined
            .iter()
            .fold(f64::INFINITY, |least, it| least.min(it.0));
        Identification {
            condition: largest / smallest,
            names: names.to_vec(),
            indistinct,
            lengths,
            determined,
            is_determined,
        }
    }

    /// Number of determined combinations of parameters.
    pub fn rank(&self) -> usize {
        self.determined.len()
    }

    /// True if a parameter is determined on its own.
    pub fn determines(&self, place: usize) -> bool {
        self.is_determined[place]
    }

    /// True if all parameters are determined.
    pub fn determines_all(&self) -> bool {
        self.is_determined.iter().all(|it| *it)
    }

    /// Part of each row in each determined combination: orthogonal columns of unit length.
    pub(crate) fn projections(&self, jacobian: &DMatrix<f64>) -> DMatrix<f64> {
        let lengths = self.lengths.iter().enumerate();
        let moving: Vec<(usize, f64)> = lengths.map(|(place, it)| (place, *it)).collect();
        DMatrix::from_fn(jacobian.nrows(), self.rank(), |row, combination| {
            let (singular, vector) = &self.determined[combination];
            let parts = moving.iter().filter(|it| vector[it.0] != 0.0);
            let parts =
                parts.map(|(place, length)| jacobian[(row, *place)] / length * vector[*place]);
            parts.sum::<f64>() / singular
        })
    }

    /// Covariance of the parameters in the determined combinations; `errors` is that of errors in these combinations.
    pub(crate) fn covariance(&self, errors: &DMatrix<f64>) -> DMatrix<f64> {
        let count = self.lengths.len();
        let mut covariance = DMatrix::zeros(count, count);
        for (row, (one, first)) in self.determined.iter().enumerate() {
            for (column, (other, second)) in self.determined.iter().enumerate() {
                covariance += first * second.transpose() * (errors[(row, column)] / (one * other));
            }
        }
        let lengths = &self.lengths;
        let unscaled = |row: usize, column: usize| {
            covariance[(row, column)] / (lengths[row] * lengths[column])
        };
        DMatrix::from_fn(count, count, |row, column| {
            match covariance[(row, column)] == 0.0 {
                true => 0.0,
                false => unscaled(row, column),
            }
        })
    }

    /// Describes the indistinguishable combinations, in one sentence each.
    pub fn sentences(&self) -> Vec<String> {
        let name = |place: usize| format!("`{}`", self.names[place]);
        let each = self.indistinct.iter().map(|it| match (it.changes.as_slice(), it.index) {
            ([(place, _)], None) => format!("{} affects no measured quantity", name(*place)),
            (changes, index) => {
                let names: Vec<String> = changes.iter().map(|it| name(it.0)).collect();
                let listed = match names.as_slice() {
                    [all @ .., last] if !all.is_empty() => format!("{} and {last}", all.join(", ")),
                    names => names.join(", "),
                };
                let ratio: Vec<String> = changes.iter().map(|it| number(it.1)).collect();
                let ratio = ratio.join(" : ");
                match index {
                    None => format!(
                        "{listed} cannot be distinguished: a change by {ratio} affects no measured quantity"
                    ),
                    Some(index) => format!(
                        "{listed} can hardly be distinguished: a change by {ratio} they show {index:.0} times less than the best combination"
                    ),
                }
            }
        });
        each.collect()
    }
}

/// Formats a number with a few digits.
fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    match text.trim_end_matches('0').trim_end_matches('.') {
        "" | "-" | "0" | "-0" => format!("{value:.2e}"),
        short => short.to_string(),
    }
}

/// Returns the parameters of a singular vector; the first one changes by one.
fn combination(vector: &DVector<f64>, lengths: &[f64], index: Option<f64>) -> Indistinct {
    let largest = vector.amax();
    let parts = vector
        .iter()
        .enumerate()
        .filter(|(_, it)| it.abs() > PART * largest);
    let mut changes: Vec<(usize, f64)> = parts
        .map(|(place, it)| (place, it / lengths[place]))
        .collect();
    let first = changes.first().map_or(1.0, |it| it.1);
    for (_, change) in &mut changes {
        *change /= first;
    }
    Indistinct { changes, index }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(count: usize) -> Vec<String> {
        (0..count).map(|it| format!("p{it}")).collect()
    }

    #[test]
    fn a_pair_is_named_with_its_ratio_and_others_are_determined() {
        // The third column is twice the first one, the last one is zero.
        let jacobian = DMatrix::from_row_slice(
            4,
            4,
            &[
                1.0, 0.3, 2.0, 0.0, 2.0, -0.5, 4.0, 0.0, 3.0, 0.1, 6.0, 0.0, -1.0, 0.9, -2.0, 0.0,
            ],
        );
        let identification = Identification::of(&jacobian, &[1.0; 4], &names(4));
        assert_eq!(identification.rank(), 2);
        let determined: Vec<bool> = (0..4).map(|it| identification.determines(it)).collect();
        assert_eq!(determined, [false, true, false, false]);
        assert_eq!(
            identification.sentences(),
            [
                "`p3` affects no measured quantity",
                "`p0` and `p2` cannot be distinguished: a change by 1 : -0.5 affects no measured quantity",
            ]
        );
    }

    #[test]
    fn parameter_without_effect_is_not_determined() {
        let identification = Identification::of(&DMatrix::zeros(5, 2), &[0.02, 0.0], &names(2));
        assert_eq!(identification.rank(), 0);
        assert!(!identification.determines(0) && !identification.determines(1));
        assert_eq!(
            identification.sentences(),
            [
                "`p0` affects no measured quantity",
                "`p1` affects no measured quantity",
            ]
        );
        assert!(
            identification
                .covariance(&DMatrix::zeros(0, 0))
                .iter()
                .all(|it| *it == 0.0)
        );
    }

    #[test]
    fn the_covariance_is_the_inverse_of_the_normal_matrix() {
        let jacobian = DMatrix::from_row_slice(3, 2, &[1.0, 200.0, 2.0, 500.0, 3.0, -100.0]);
        let identification = Identification::of(&jacobian, &[1.0, 0.01], &names(2));
        let normal = (jacobian.transpose() * &jacobian)
            .try_inverse()
            .expect("regular");
        let errors = DMatrix::from_diagonal_element(2, 2, 2.0);
        let covariance = identification.covariance(&errors);
        for (one, other) in covariance.iter().zip(&(normal * 2.0)) {
            assert!((one - other).abs() < 1e-12 * other.abs(), "{one} {other}");
        }
        assert!(identification.determines_all() && identification.indistinct.is_empty());
        let projections = identification.projections(&jacobian);
        let squares = projections.transpose() * &projections;
        assert!((squares - DMatrix::identity(2, 2)).amax() < 1e-12);
    }
}
