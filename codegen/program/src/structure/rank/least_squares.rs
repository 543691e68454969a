//! A matrix and a right-hand side → the damped least-squares solution.
//!
//! min |A x − b|² + μ |x|² by Householder reflections of A over √μ I, which never forms Aᵀ A and so keeps its condition (Nocedal
//! and Wright, Numerical Optimization, 2006, section 10.3). Any shape will do; a small μ gives the shortest of all solutions.

/// x, for the rows of A.
pub(super) fn damped(rows: &[Vec<f64>], right: &[f64], damping: f64) -> Vec<f64> {
    let columns = rows.first().map_or(0, Vec::len);
    let height = rows.len() + columns;
    // Column by column, the right-hand side last.
    let mut matrix: Vec<Vec<f64>> = (0..columns)
        .map(|column| {
            let mut own = vec![0.0; height];
            for (place, row) in own.iter_mut().zip(rows) {
                *place = row[column];
            }
            own[rows.len() + column] = damping.sqrt();
            own
        })
        .collect();
    let mut last = vec![0.0; height];
    last[..right.len()].copy_from_slice(right);
    matrix.push(last);
    for step in 0..columns {
        // Below the rows of A only the entries of the columns so far are not zero.
        let end = rows.len() + step + 1;
        let (done, rest) = matrix.split_at_mut(step + 1);
        let own = &mut done[step];
        let size = super::independence::norm(&own[step..end]);
        if size == 0.0 {
            continue;
        }
        let diagonal = if own[step] > 0.0 { -size } else { size };
        let mut mirror = own[step..end].to_vec();
        mirror[0] -= diagonal;
        let square: f64 = mirror.iter().map(|it| it * it).sum();
        for column in rest {
            let part = &mut column[step..end];
            let along = 2.0 * super::independence::dot(&mirror, part) / square;
            for (entry, across) in part.iter_mut().zip(&mirror) {
                *entry -= along * across;
            }
        }
        own[step] = diagonal;
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
        let found = damped(&rows, &[1.0, 2.0, 4.0], 0.0);
        assert!((found[0] - 5.0 / 6.0).abs() < 1e-14 && (found[1] - 1.5).abs() < 1e-14);
    }

    #[test]
    fn little_damping_gives_the_shortest_solution() {
        // 3 x + 4 y = 25: the point nearest to the origin is (3, 4).
        let found = damped(&[vec![3.0, 4.0]], &[25.0], 1e-12);
        assert!((found[0] - 3.0).abs() < 1e-10 && (found[1] - 4.0).abs() < 1e-10);
    }

    #[test]
    fn damping_shortens_as_by_hand() {
        // (a² + μ) x = a b.
        let found = damped(&[vec![2.0]], &[6.0], 4.0);
        assert!((found[0] - 1.5).abs() < 1e-15);
    }
}
