//! Finds a maximum matching of equations and unknowns.
//!
//! Hopcroft and Karp, An n^{5/2} algorithm for maximum matchings in bipartite graphs, SIAM J. Comput. 2 (1973). Ties are broken
//! by written order: earlier rows and columns come first.

use std::collections::VecDeque;

use super::Incidence;

/// Pairs of a row and a column; each row and each column is in at most one pair.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Matching {
    /// Column of each row; `None` if the row is unmatched.
    pub column_of: Vec<Option<usize>>,
    /// Row of each column; `None` if the column is unmatched.
    pub row_of: Vec<Option<usize>>,
}

/// Returns a matching with the most pairs.
pub fn maximum_matching(incidence: &Incidence) -> Matching {
    let row_count = incidence.rows.len();
    let mut matching = Matching {
        column_of: vec![None; row_count],
        row_of: vec![None; incidence.columns],
    };
    // Most rows find a free column at once; the phases below repair the others.
    for (row, pattern) in incidence.rows.iter().enumerate() {
        if let Some(&column) = pattern
            .iter()
            .find(|&&column| matching.row_of[column].is_none())
        {
            matching.pair(row, column);
        }
    }
    loop {
        let layers = layers(incidence, &matching);
        let mut next_edge = vec![0; row_count];
        let mut augmented = false;
        for row in 0..row_count {
            if matching.column_of[row].is_none() {
                augmented |= augment(row, incidence, &layers, &mut next_edge, &mut matching);
            }
        }
        if !augmented {
            return matching;
        }
    }
}

impl Matching {
    fn pair(&mut self, row: usize, column: usize) {
        self.column_of[row] = Some(column);
        self.row_of[column] = Some(row);
    }
}

/// Returns the length of the shortest alternating path from a free row to each row.
fn layers(incidence: &Incidence, matching: &Matching) -> Vec<Option<usize>> {
    let mut layers = vec![None; incidence.rows.len()];
    let mut queue = VecDeque::new();
    for (row, column) in matching.column_of.iter().enumerate() {
        if column.is_none() {
            layers[row] = Some(0);
            queue.push_back((row, 0));
        }
    }
    while let Some((row, layer)) = queue.pop_front() {
        for &column in &incidence.rows[row] {
            if let Some(next) = matching.row_of[column]
                && layers[next].is_none()
            {
                layers[next] = Some(layer + 1);
                queue.push_back((next, layer + 1));
            }
        }
    }
    layers
}

/// Finds a path that descends one layer per step to a free column, and flips the path. The stack is explicit, as paths are as
/// long as a chain has bodies.
fn augment(
    start: usize,
    incidence: &Incidence,
    layers: &[Option<usize>],
    next_edge: &mut [usize],
    matching: &mut Matching,
) -> bool {
    let mut path = vec![start];
    while let Some(&row) = path.last() {
        let Some(&column) = incidence.rows[row].get(next_edge[row]) else {
            path.pop();
            continue;
        };
        next_edge[row] += 1;
        match matching.row_of[column] {
            None => {
                // Each row of the path takes the column of its step; its old column goes to the previous row.
                let mut column = column;
                for &row in path.iter().rev() {
                    let old = matching.column_of[row];
                    matching.pair(row, column);
                    match old {
                        Some(old) => column = old,
                        None => return true,
                    }
                }
                return true;
            }
            Some(next)
                if layers[next].is_some() && layers[next] == layers[row].map(|layer| layer + 1) =>
            {
                path.push(next);
            }
            Some(_) => {}
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matched(rows: &[&[usize]], columns: usize) -> Vec<Option<usize>> {
        let rows = rows.iter().map(|row| row.to_vec()).collect();
        maximum_matching(&Incidence { rows, columns }).column_of
    }

    #[test]
    fn a_diagonal_is_its_own_matching() {
        assert_eq!(matched(&[&[0], &[1], &[2]], 3), [Some(0), Some(1), Some(2)]);
    }

    #[test]
    fn an_early_choice_is_undone_where_it_blocks() {
        // Row 0 takes column 0 first, and must give it to row 1; row 1 in turn needs it more than row 0.
        assert_eq!(matched(&[&[0, 1], &[0]], 2), [Some(1), Some(0)]);
        // A chain of exchanges through three rows.
        assert_eq!(
            matched(&[&[0, 1], &[1, 2], &[0]], 3),
            [Some(1), Some(2), Some(0)]
        );
    }

    #[test]
    fn the_exam_has_a_perfect_matching() {
        // Rows: x1; y1; x1 φ1 x2 φ2; y1 φ1 y2 φ2; x2; φ1. Solved by hand: φ2 from the third row, y2 from the fourth.
        let rows: &[&[usize]] = &[&[0], &[1], &[0, 2, 3, 5], &[1, 2, 4, 5], &[3], &[2]];
        let expected = [Some(0), Some(1), Some(5), Some(4), Some(3), Some(2)];
        assert_eq!(matched(rows, 6), expected);
    }

    #[test]
    fn unmatched_columns_stay_free() {
        assert_eq!(matched(&[&[0], &[0]], 2), [Some(0), None]);
        assert_eq!(matched(&[&[], &[1]], 2), [None, Some(1)]);
    }
}
