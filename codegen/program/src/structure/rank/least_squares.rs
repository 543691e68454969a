//! Solves damped least-squares problems.
//!
//! Minimizes |A x − b|² + μ |x|² by Householder reflections of A over √μ I, without AᵀA, whose condition number is the square of
//! A's (Nocedal and Wright, Numerical Optimization, 2006, section 10.3). The matrix may have any shape; a small μ gives the
//! shortest of all solutions.

/// Returns x for the rows of A.
pub(super) fn damped(rows: &[Vec<f64>], right: &[f64], damping: f64) -> Vec<f64> {
    let columns = rows.first().map_or(0, Vec::len);
    let height = rows.len() + columns;
    // Column by column, the right-hand side last.
    let mut matrix: Vec<Vec<f64>> = (0..columns)
        .map(|column| {
            let mut entries = vec![0.0; height];
            for (place, row) in entries.iter_mut().zip(rows) {
                *place = row[column];
            }
            entries[rows.len() + column] = damping.sqrt();
            entries
        })
        .collect();
    let mut last = vec![0.0; height];
    last[..right.len()].copy_from_slice(right);
    matrix.push(last);
    for step in 0..columns {
        // Below the rows of A, only the entries of the columns so far are nonzero.
        let end = rows.len() + step + 1;
        let (done, rest) = matrix.split_at_mut(step + 1);
        let pivot = &mut done[step];
        let size = super::independence::norm(&pivot[step..end]);
        if size == 0.0 {
            continue;
        }
        let diagonal = if pivot[step] > 0.0 { -size } else { size };
        let mut mirror = pivot[step..end].to_vec();
        mirror[0] -= diagonal;
        let square: f64 = mirror.iter().map(|it| it * it).sum();
        for column in rest {
            let part = &mut column[step..end];
            let along = 2.0 * super::independence::dot(&mirror, part) / square;
            for (entry, across) in part.iter_mut().zip(&mirror) {
                *entry -= along * across;
            }
        }
        pivot[step] = diagonal;
    }
    let mut solution: Vec<f64> = matrix[columns][..columns].to_vec();
    for last in (0..columns).rev() {
        let diagonal = matrix[last][last];
        solution[last] = if diagonal == 0.0 {
            0.0
        } else {
            solution[last] / diagonal
        };
        for before in 0..last {
            solution[before] -= solution[last] * matrix[last][before];
        }
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::damped;

    #[test]
    fn a_line_through_points_is_the_one_of_the_normal_equations() {
        // y = a + b x through (0, 1), (1, 2), (2, 4): a = 5/6, b = 3/2.
        let rows = [vec![1.0, 0.0], vec![1.0, 1.0], vec![1.0, 2.0]];
        let solution = damped(&rows, &[1.0, 2.0, 4.0], 0.0);
        assert!((solution[0] - 5.0 / 6.0).abs() < 1e-14 && (solution[1] - 1.5).abs() < 1e-14);
    }

    #[test]
    fn little_damping_gives_the_shortest_solution() {
        // 3 x + 4 y = 25: the point nearest to the origin is (3, 4).
        let solution = damped(&[vec![3.0, 4.0]], &[25.0], 1e-12);
        assert!((solution[0] - 3.0).abs() < 1e-10 && (solution[1] - 4.0).abs() < 1e-10);
    }

    #[test]
    fn damping_shortens_as_by_hand() {
        // (a² + μ) x = a b.
        let solution = damped(&[vec![2.0]], &[6.0], 4.0);
        assert!((solution[0] - 1.5).abs() < 1e-15);
    }
}
