//! Assigns rows, which have an order only, to instants of a motion.

/// Returns the instants of the rows with the smallest sum of costs, of which each is later than that of the row before. `costs` holds those
/// of a row at every instant, row by row. `None` if there are more rows than instants.
///
/// On a closed motion the instants repeat: an index beyond the last instant is one of the next turn, and all rows lie within one turn.
pub(super) fn aligned(costs: &[Vec<f64>], is_closed: bool) -> Option<(f64, Vec<usize>)> {
    let instants = costs.first()?.len();
    if costs.len() > instants {
        return None;
    }
    let shifts = if is_closed { instants } else { 1 };
    let mut best: Option<(f64, Vec<usize>)> = None;
    for shift in 0..shifts {
        // On a closed motion, the first row is at the first instant of the turn.
        let cost = |row: usize, step: usize| costs[row][(shift + step) % instants];
        let mut sums: Vec<f64> = (0..instants)
            .map(|step| match is_closed && step > 0 {
                true => f64::INFINITY,
                false => cost(0, step),
            })
            .collect();
        let mut before: Vec<Vec<usize>> = Vec::with_capacity(costs.len());
        for row in 1..costs.len() {
            let (mut least, mut place) = (f64::INFINITY, 0);
            let mut next = vec![f64::INFINITY; instants];
            let mut origins = vec![0; instants];
            for step in 1..instants {
                if sums[step - 1] < least {
                    (least, place) = (sums[step - 1], step - 1);
                }
                next[step] = least + cost(row, step);
                origins[step] = place;
            }
            before.push(origins);
            sums = next;
        }
        let last = (0..instants).min_by(|a, b| sums[*a].total_cmp(&sums[*b]))?;
        if best.as_ref().is_some_and(|it| it.0 <= sums[last]) || !sums[last].is_finite() {
            continue;
        }
        let mut places = vec![last];
        for origins in before.iter().rev() {
            places.push(origins[places[places.len() - 1]]);
        }
        places.reverse();
        best = Some((sums[last], places.iter().map(|it| shift + it).collect()));
    }
    best
}

#[cfg(test)]
mod tests {
    use super::aligned;

    fn costs(rows: &[usize], instants: usize) -> Vec<Vec<f64>> {
        let cost = |it: usize, at: usize| if it == at { 0.0 } else { 1.0 };
        let row = |at: &usize| (0..instants).map(|it| cost(it, *at)).collect();
        rows.iter().map(row).collect()
    }

    #[test]
    fn rows_keep_their_order() {
        assert_eq!(
            aligned(&costs(&[1, 4, 5], 8), false),
            Some((0.0, vec![1, 4, 5]))
        );
        // The second row would be before the first one.
        let (sum, places) = aligned(&costs(&[4, 1, 5], 8), false).expect("three instants");
        assert_eq!(sum, 1.0);
        assert!(places.windows(2).all(|it| it[0] < it[1]), "{places:?}");
        assert_eq!(aligned(&costs(&[0, 1, 2], 2), false), None);
    }

    #[test]
    fn a_turn_begins_at_any_instant() {
        assert_eq!(
            aligned(&costs(&[6, 1, 3], 8), true),
            Some((0.0, vec![6, 9, 11]))
        );
        let (sum, _) = aligned(&costs(&[6, 1, 3], 8), false).expect("three instants");
        assert_eq!(sum, 1.0);
        // Two turns would be needed.
        let (sum, _) = aligned(&costs(&[6, 5, 4], 8), true).expect("three instants");
        assert_eq!(sum, 1.0);
    }
}
