//! Finds the order in which a Jacobian is that of a chain of cells, from its sparsity pattern.
//!
//! A cell has two unknowns. Two equations link each cell to the next one. Two more equations close the chain, and may depend on
//! every cell. Pantographs and scissor lifts have this structure.

use std::collections::BTreeMap;

/// Smallest number of unknowns for which the order of a chain saves work.
const MIN_UNKNOWNS: usize = 16;

/// Rows and columns in the order of a chain.
pub(super) struct Order {
    /// Rows: cell by cell the equations that link the cell to the next one, then the two that close the chain.
    pub rows: Vec<usize>,
    /// Columns, cell by cell.
    pub columns: Vec<usize>,
}

/// Returns the order of a chain, from the end that its equations mention first; `None` for other structures.
pub(super) fn order(size: usize, places: impl Iterator<Item = [usize; 2]>) -> Option<Order> {
    if size < MIN_UNKNOWNS || !size.is_multiple_of(2) {
        return None;
    }
    let mut columns_of: Vec<Vec<usize>> = vec![Vec::new(); size];
    for [row, column] in places {
        columns_of[row].push(column);
    }
    columns_of.iter_mut().for_each(|columns| columns.sort());
    let mut links: BTreeMap<&[usize], Vec<usize>> = BTreeMap::new();
    for (row, columns) in columns_of.iter().enumerate() {
        links.entry(columns).or_default().push(row);
    }
    // Both equations of a link mention both of its cells.
    links.retain(|columns, rows| columns.len() == 4 && rows.len() == 2);
    if links.len() + 1 != size / 2 {
        return None;
    }
    let mut linked_by: Vec<Vec<&[usize]>> = vec![Vec::new(); size];
    for columns in links.keys() {
        columns.iter().for_each(|&it| linked_by[it].push(columns));
    }
    // Columns that no other link mentions.
    let unshared = |columns: &[usize]| -> Vec<usize> {
        let columns = columns.iter().copied();
        columns.filter(|&it| linked_by[it].len() == 1).collect()
    };
    let ends = links
        .iter()
        .filter(|(columns, _)| unshared(columns).len() == 2);
    let (&first, _) = ends.min_by_key(|(_, rows)| rows[0])?;
    let mut order = Order {
        rows: Vec::new(),
        columns: unshared(first),
    };
    let mut link = first;
    while let Some(rows) = links.remove(link) {
        order.rows.extend(rows);
        let columns = link.iter().copied();
        let cell: Vec<usize> = columns.filter(|it| !order.columns.contains(it)).collect();
        let next = linked_by[*cell.first()?].iter();
        let next = next.copied().find(|next| links.contains_key(next));
        let follows = |next: &[usize]| cell.iter().all(|it| next.contains(it));
        if cell.len() != 2 || !next.is_none_or(follows) {
            return None;
        }
        order.columns.extend(cell);
        link = next.unwrap_or(link);
    }
    let closing = (0..size).filter(|row| !order.rows.contains(row));
    let closing: Vec<usize> = closing.collect();
    order.rows.extend(closing);
    (order.columns.len() == size && order.rows.len() == size).then_some(order)
}

#[cfg(test)]
mod tests {
    use super::order;

    /// Returns the pattern of a chain of cells, whose two last equations mention every cell; `named` permutes rows and columns.
    fn chain(cells: usize, named: impl Fn(usize) -> usize) -> Vec<[usize; 2]> {
        let size = 2 * cells;
        let mut places = Vec::new();
        for row in 0..size {
            let columns = match row < size - 2 {
                true => row / 2 * 2..row / 2 * 2 + 4,
                false => 0..size,
            };
            places.extend(columns.map(|column| [named(row), named(column)]));
        }
        places
    }

    #[test]
    fn a_chain_in_order_stays_as_it_is() {
        let order_found = order(20, chain(10, |it| it).into_iter()).unwrap();
        assert!(order_found.rows.into_iter().eq(0..20));
        assert!(order_found.columns.into_iter().eq(0..20));
    }

    #[test]
    fn a_chain_in_disorder_is_put_in_order() {
        let places = chain(10, |it| (it * 7 + 3) % 20);
        let order_found = order(20, places.iter().copied()).unwrap();
        for [row, column] in places {
            let place = |all: &[usize], one| all.iter().position(|it| *it == one).unwrap();
            let row = place(&order_found.rows, row);
            let column = place(&order_found.columns, column);
            assert!(row >= 18 || column / 2 == row / 2 || column / 2 == row / 2 + 1);
        }
    }

    #[test]
    fn other_structures_have_no_order() {
        // Cases: a link that reads a third cell, a ring, one equation too few, and too few cells.
        let far = chain(10, |it| it).into_iter().chain([[4, 11]]);
        assert!(order(20, far).is_none());
        let ring = chain(10, |it| it).into_iter();
        let ring = ring.filter(|[row, column]| *row < 18 || !(2..18).contains(column));
        assert!(order(20, ring).is_none());
        let cut = chain(10, |it| it).into_iter().filter(|[row, _]| *row != 5);
        assert!(order(20, cut).is_none());
        assert!(order(14, chain(7, |it| it).into_iter()).is_none());
    }
}
