//! Bounds the error of q, q̇ and q̈ that Newton-Raphson leaves, around the exact solution.
//!
//! **The pose.** The solver stops at a pose q whose computed residuals r are at rounding level. They are below 4 ε of
//! their scales, or so small that a fresh step does not lower them by a quarter. Only noise prevents that: the
//! rounding of the rows at a rounded pose. The exact residuals differ from the computed ones by the running error δ
//! of their evaluation. With the mean value theorem |q − q*| ≤ |Φ_q⁻¹| (|r| + δ + |ΔΦ_q| |q − q*|), component by
//! component, where ΔΦ_q is the change of the Jacobian within the error itself. The smallest solution of this
//! inequality is found by iteration. If the iteration diverges, the error has no bound: the pose cannot be told from
//! a singular one.
//!
//! **The rates** solve Φ_q q̇ = b with entries and a right-hand side that are off by their running errors, which
//! contain the error of the pose. Elimination solves a system whose entries are off by a few roundings of Σ |l_ik|
//! |u_kj| (Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., theorem 9.4), where a rounding is
//! counted for every operation on nonzero numbers. Again |q̇ − q̇*| ≤ |Φ_q⁻¹| (…), and likewise for q̈.

use super::bounded::{Margin, product_of as product};
use super::verdict::Scalar;

/// Rounding level of a scaled residual in Newton-Raphson, in ε.
const LEVEL: f64 = linkwright::generated::newton::ROUNDING;

/// Fraction of the residual that ends a solve if a step leaves more.
const NOISE: f64 = linkwright::generated::newton::NOISE;

/// Errors of everything that is evaluated at a pose with errors.
pub struct Evaluated {
    /// Of each residual.
    pub residuals: Vec<Margin>,
    /// Of each entry of the Jacobian, row by row.
    pub jacobian: Vec<Vec<Margin>>,
    /// Of each row's rate at fixed coordinates.
    pub drift: Vec<Margin>,
    /// Of each row's γ.
    pub gamma: Vec<Margin>,
}

/// A system of equations at its exact solution.
pub struct Dense {
    /// Φ_q.
    pub jacobian: Vec<Vec<f64>>,
    /// Φ_q⁻¹.
    pub inverse: Vec<Vec<f64>>,
    /// Scale of each row.
    pub rows: Vec<f64>,
    /// Scale of each coordinate.
    pub columns: Vec<f64>,
    /// q, q̇ and q̈.
    pub levels: [Vec<f64>; 3],
}

/// Bounds on the error of the solution.
pub struct Bounds {
    /// Of q, q̇ and q̈.
    pub levels: [Vec<Margin>; 3],
    /// Relative change of the Jacobian within the error of the pose.
    pub change: f64,
}

impl Bounds {
    /// Infinite bounds; the expected errors of the pose are kept.
    fn none(pose: &[Margin]) -> Bounds {
        let unbounded = |expected: f64| Margin {
            worst: f64::INFINITY,
            expected,
        };
        let rates = vec![unbounded(f64::INFINITY); pose.len()];
        Bounds {
            levels: [
                pose.iter().map(|it| unbounded(it.expected)).collect(),
                rates.clone(),
                rates,
            ],
            change: f64::INFINITY,
        }
    }
}

/// Largest change of the Jacobian within the error for which a bound exists.
const LARGEST_CHANGE: f64 = 0.5;

impl Dense {
    /// Bounds on the error of a solver in this scalar. `evaluate` returns the errors of the equations at coordinates
    /// and rates with errors.
    pub fn bounds(
        &self,
        scalar: Scalar,
        evaluate: &dyn Fn(&[Margin], &[Margin]) -> Evaluated,
    ) -> Bounds {
        let n = self.rows.len();
        let unit = scalar.epsilon() / 2.0;
        let none = vec![Margin::NONE; n];
        let at_pose = evaluate(&none, &none);
        let accepted = self.accepted(&at_pose.residuals, scalar);
        // The solver's tolerance is not a rounding of its own: it does not count among the expected errors.
        let noise: Vec<Margin> = at_pose
            .residuals
            .iter()
            .zip(&accepted)
            .map(|(own, accepted)| Margin {
                worst: own.worst + accepted,
                expected: own.expected,
            })
            .collect();
        let mut first = self.spread(&noise);
        for (margin, value) in first.iter_mut().zip(&self.levels[0]) {
            // The last step rounds the coordinates; the tolerance covers the worst of that.
            margin.expected = margin.expected.hypot(Margin::even(unit * value).expected);
        }
        let change_of = |pose: &[Margin]| -> Vec<Margin> {
            let moved = evaluate(pose, &none);
            let rows = moved.jacobian.iter().zip(&at_pose.jacobian);
            let sums = rows.map(|(moved, still)| {
                let entries = moved.iter().zip(still).zip(pose);
                let sum: f64 = entries
                    .map(|((moved, still), off)| {
                        product((moved.worst - still.worst).max(0.0), off.worst)
                    })
                    .sum();
                // On the way to the exact pose, the mean change of the Jacobian is half of that or less.
                Margin {
                    worst: 0.5 * sum,
                    expected: 0.0,
                }
            });
            self.spread(&sums.collect::<Vec<_>>())
        };
        let mut pose = first.clone();
        let mut change = 0.0;
        for _ in 0..20 {
            let moved = change_of(&pose);
            let ratios = moved.iter().zip(&first).zip(&self.columns);
            change = ratios.fold(0.0_f64, |largest, ((moved, _), scale)| {
                let size = self.size(&pose);
                largest.max(moved.worst / scale / size)
            });
            // NaN must not count as a bound either.
            let regular = change <= LARGEST_CHANGE;
            if !regular {
                return Bounds::none(&first);
            }
            for ((margin, first), moved) in pose.iter_mut().zip(&first).zip(moved) {
                margin.worst = first.worst + moved.worst;
            }
        }
        let at_error = evaluate(&pose, &none);
        let elimination = self.elimination(unit);
        let rates = |right: &[Margin], at: &Evaluated, values: &[f64]| {
            let rows: Vec<Margin> = (0..n)
                .map(|row| {
                    let entries = (0..n).map(|column| {
                        let entry = self.jacobian[row][column];
                        // Scaling the rows and columns takes three roundings.
                        let elimination_error = Margin::even(elimination[row][column])
                            .plus(Margin::even(3.0 * unit * entry));
                        at.jacobian[row][column]
                            .plus(elimination_error)
                            .times(values[column])
                    });
                    entries.fold(right[row], Margin::plus)
                })
                .collect();
            let first = self.spread(&rows);
            // The same matrix also multiplies the error: |x − x*| ≤ |A⁻¹| (… + |ΔA| |x − x*|).
            let mut bound = first.clone();
            for _ in 0..8 {
                let moved: Vec<Margin> = (0..n)
                    .map(|row| {
                        let entries = (0..n).map(|column| {
                            let off = at.jacobian[row][column].worst + elimination[row][column];
                            product(off, bound[column].worst)
                        });
                        Margin {
                            worst: entries.sum(),
                            expected: 0.0,
                        }
                    })
                    .collect();
                let moved = self.spread(&moved);
                for ((margin, first), moved) in bound.iter_mut().zip(&first).zip(moved) {
                    margin.worst = first.worst + moved.worst;
                }
            }
            // Scaling back rounds the result.
            let rounded = bound.iter().zip(values);
            rounded
                .map(|(margin, value)| {
                    let rounding = scalar.rounding(*value);
                    margin.plus(rounding).plus(rounding)
                })
                .collect::<Vec<Margin>>()
        };
        let velocity = rates(&at_error.drift, &at_error, &self.levels[1]);
        let at_both = evaluate(&pose, &velocity);
        let acceleration = rates(&at_both.gamma, &at_both, &self.levels[2]);
        Bounds {
            levels: [pose, velocity, acceleration],
            change,
        }
    }

    /// Residual of each row that the solver may leave.
    fn accepted(&self, residuals: &[Margin], scalar: Scalar) -> Vec<f64> {
        let epsilon = scalar.epsilon();
        let rounded = self.jacobian.iter().zip(residuals).zip(&self.rows);
        let noise = rounded.map(|((entries, own), scale)| {
            let moved = entries.iter().zip(&self.levels[0]);
            let moved: f64 = moved
                .map(|(entry, value)| product(entry.abs(), epsilon / 2.0 * value.abs()))
                .sum();
            (moved + 2.0 * own.worst) / scale
        });
        let noise = noise.fold(0.0_f64, f64::max) / NOISE;
        let level = noise.max(LEVEL * epsilon);
        self.rows.iter().map(|scale| level * scale).collect()
    }

    fn size(&self, margins: &[Margin]) -> f64 {
        let scaled = margins.iter().zip(&self.columns);
        scaled
            .map(|(margin, scale)| margin.worst / scale)
            .fold(f64::MIN_POSITIVE, f64::max)
    }

    /// Product of |Φ_q⁻¹| and errors of the rows.
    fn spread(&self, rows: &[Margin]) -> Vec<Margin> {
        let sums = self.inverse.iter().map(|entries| {
            let terms = entries.iter().zip(rows);
            terms.fold(Margin::NONE, |sum, (entry, row)| {
                sum.plus(row.times(*entry))
            })
        });
        sums.collect()
    }

    /// Perturbation of the entries by elimination with partial pivoting, from its own factors.
    fn elimination(&self, unit: f64) -> Vec<Vec<f64>> {
        let n = self.rows.len();
        let mut scaled: Vec<Vec<f64>> = (0..n)
            .map(|row| {
                let entries = self.jacobian[row].iter().zip(&self.columns);
                entries
                    .map(|(entry, scale)| entry * (scale / self.rows[row]))
                    .collect()
            })
            .collect();
        let mut order: Vec<usize> = (0..n).collect();
        for k in 0..n {
            let larger = |best: usize, row: usize| {
                if scaled[row][k].abs() > scaled[best][k].abs() {
                    row
                } else {
                    best
                }
            };
            let pivot = (k..n).fold(k, larger);
            scaled.swap(k, pivot);
            order.swap(k, pivot);
            let (above, below) = scaled.split_at_mut(k + 1);
            let pivot_row = &above[k];
            for row in below {
                let multiplier = row[k] / pivot_row[k];
                row[k] = multiplier;
                let entries = row.iter_mut().zip(pivot_row).skip(k + 1);
                for (entry, upper) in entries.filter(|_| multiplier != 0.0) {
                    *entry -= multiplier * upper;
                }
            }
        }
        let lower = |row: usize, k: usize| match row.cmp(&k) {
            std::cmp::Ordering::Greater => scaled[row][k].abs(),
            std::cmp::Ordering::Equal => 1.0,
            std::cmp::Ordering::Less => 0.0,
        };
        let in_lower: Vec<f64> = (0..n)
            .map(|row| (0..row).filter(|&k| scaled[row][k] != 0.0).count() as f64)
            .collect();
        let in_upper: Vec<f64> = (0..n)
            .map(|k| (k..n).filter(|&column| scaled[k][column] != 0.0).count() as f64)
            .collect();
        let mut perturbed = vec![vec![0.0; n]; n];
        for row in 0..n {
            for column in 0..n {
                let upper = |k: usize| {
                    if column >= k {
                        scaled[k][column].abs()
                    } else {
                        0.0
                    }
                };
                let met = (0..n).filter(|&k| lower(row, k) * upper(k) > 0.0);
                let operations = 2.0 * met.clone().filter(|&k| k != row).count() as f64;
                let sum: f64 = met
                    .map(|k| {
                        // A multiplier is rounded twice, and both triangular solves add theirs.
                        let multiplier_roundings = if k == row { 0.0 } else { 2.0 };
                        let solves = in_lower[row] + in_upper[k] + 1.0;
                        lower(row, k) * upper(k) * (operations + multiplier_roundings + solves)
                    })
                    .sum();
                perturbed[order[row]][column] =
                    unit * sum * self.rows[order[row]] / self.columns[column];
            }
        }
        perturbed
    }
}
