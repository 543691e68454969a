//! Decomposes a system into its over-determined, square and under-determined parts.
//!
//! Dulmage and Mendelsohn, Coverings of bipartite graphs, Canad. J. Math. 10 (1958): alternating paths from an unmatched row
//! reach rows with too few unknowns. Paths from an unmatched column reach columns with too few equations. The choice of the
//! unmatched row depends on the matching, the parts do not.

use super::{Incidence, Matching};

/// Coarse decomposition of Dulmage and Mendelsohn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CoarseDecomposition {
    /// Unmatched rows, ascending: one per surplus equation.
    pub free_rows: Vec<usize>,
    /// Unmatched columns, ascending: one per remaining degree of freedom.
    pub free_columns: Vec<usize>,
    /// Rows of the over-determined part, ascending.
    pub over_rows: Vec<usize>,
    /// Columns of the under-determined part, ascending.
    pub under_columns: Vec<usize>,
}

impl CoarseDecomposition {
    /// True if every row and every column is matched.
    pub fn is_square(&self) -> bool {
        self.free_rows.is_empty() && self.free_columns.is_empty()
    }
}

/// Returns the parts that follow from a maximum matching.
pub fn coarse_decomposition(incidence: &Incidence, matching: &Matching) -> CoarseDecomposition {
    let free = |pairs: &[Option<usize>]| -> Vec<usize> {
        (0..pairs.len()).filter(|&at| pairs[at].is_none()).collect()
    };
    let (free_rows, free_columns) = (free(&matching.column_of), free(&matching.row_of));
    let over_rows = reached(&free_rows, &incidence.rows, &matching.row_of);
    let under_columns = reached(&free_columns, &incidence.transposed(), &matching.column_of);
    CoarseDecomposition {
        free_rows,
        free_columns,
        over_rows,
        under_columns,
    }
}

/// Returns the vertices that alternating paths from `starts` reach on their side: along any edge, and back along a pair.
fn reached(starts: &[usize], edges: &[Vec<usize>], pair_of_other: &[Option<usize>]) -> Vec<usize> {
    let mut seen = vec![false; edges.len()];
    let mut stack = starts.to_vec();
    for &start in starts {
        seen[start] = true;
    }
    while let Some(at) = stack.pop() {
        for &other in &edges[at] {
            if let Some(next) = pair_of_other[other]
                && !seen[next]
            {
                seen[next] = true;
                stack.push(next);
            }
        }
    }
    (0..edges.len()).filter(|&at| seen[at]).collect()
}

#[cfg(test)]
mod tests {
    use super::super::maximum_matching;
    use super::*;

    fn parts(rows: &[&[usize]], columns: usize) -> CoarseDecomposition {
        let incidence = Incidence {
            rows: rows.iter().map(|row| row.to_vec()).collect(),
            columns,
        };
        coarse_decomposition(&incidence, &maximum_matching(&incidence))
    }

    #[test]
    fn a_square_system_has_one_part() {
        assert!(parts(&[&[0, 1], &[0]], 2).is_square());
    }

    #[test]
    fn one_part_can_be_over_and_another_underdetermined() {
        // Rows 0 and 1 share column 0; column 2 and 3 share row 2.
        let decomposition = parts(&[&[0], &[0], &[2, 3], &[1]], 4);
        assert_eq!(decomposition.free_rows, [1]);
        assert_eq!(decomposition.over_rows, [0, 1]);
        assert_eq!(decomposition.free_columns, [3]);
        assert_eq!(decomposition.under_columns, [2, 3]);
    }
}
