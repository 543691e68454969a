//! Decomposes a square system into irreducible blocks in solve order.
//!
//! In a graph, each equation depends on the equations of its other unknowns; the blocks are its strongly connected components
//! (Tarjan, Depth-first search and linear graph algorithms, SIAM J. Comput. 1 (1972); Duff, Erisman and Reid, Direct Methods for
//! Sparse Matrices, chapter 6). The blocks do not depend on the choice of the perfect matching. Independent blocks are in the
//! order of their first equations.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::{Incidence, Matching};

/// Returns the rows of each block, ascending, in solve order, without unmatched rows.
pub fn components(incidence: &Incidence, matching: &Matching) -> Vec<Vec<usize>> {
    let successors = |row: usize| -> Vec<usize> {
        let matched = matching.column_of[row];
        let others = incidence.rows[row]
            .iter()
            .filter(|&&column| Some(column) != matched);
        others
            .filter_map(|&column| matching.row_of[column])
            .collect()
    };
    let graph: Vec<Vec<usize>> = (0..incidence.rows.len()).map(successors).collect();
    let component_of = strongly_connected(&graph);
    let count = component_of
        .iter()
        .map(|&component| component + 1)
        .max()
        .unwrap_or(0);
    let mut rows: Vec<Vec<usize>> = vec![Vec::new(); count];
    for (row, &component) in component_of.iter().enumerate() {
        if matching.column_of[row].is_some() {
            rows[component].push(row);
        }
    }
    in_solve_order(rows, &graph, &component_of)
}

/// Returns the component of each vertex, by Tarjan's algorithm with an explicit stack.
fn strongly_connected(graph: &[Vec<usize>]) -> Vec<usize> {
    const UNSEEN: usize = usize::MAX;
    let size = graph.len();
    let (mut index, mut low) = (vec![UNSEEN; size], vec![0; size]);
    let mut component_of = vec![UNSEEN; size];
    let (mut stack, mut next_index, mut next_component) = (Vec::new(), 0, 0);
    for root in 0..size {
        if index[root] != UNSEEN {
            continue;
        }
        let mut walk = vec![(root, 0)];
        while let Some((vertex, edge)) = walk.pop() {
            if edge == 0 {
                (index[vertex], low[vertex]) = (next_index, next_index);
                next_index += 1;
                stack.push(vertex);
            }
            if let Some(&next) = graph[vertex].get(edge) {
                walk.push((vertex, edge + 1));
                if index[next] == UNSEEN {
                    walk.push((next, 0));
                } else if component_of[next] == UNSEEN {
                    low[vertex] = low[vertex].min(index[next]);
                }
                continue;
            }
            if low[vertex] == index[vertex] {
                while let Some(member) = stack.pop() {
                    component_of[member] = next_component;
                    if member == vertex {
                        break;
                    }
                }
                next_component += 1;
            }
            if let Some(&(parent, _)) = walk.last() {
                low[parent] = low[parent].min(low[vertex]);
            }
        }
    }
    component_of
}

/// Sorts blocks by Kahn's algorithm: of the blocks that are ready, the one with the earliest equation comes first.
fn in_solve_order(
    rows: Vec<Vec<usize>>,
    graph: &[Vec<usize>],
    component_of: &[usize],
) -> Vec<Vec<usize>> {
    let mut waiting = vec![0; rows.len()];
    let mut dependents: Vec<Vec<usize>> = vec![Vec::new(); rows.len()];
    for (vertex, successors) in graph.iter().enumerate() {
        let component = component_of[vertex];
        for &needed in successors {
            if component_of[needed] != component {
                waiting[component] += 1;
                dependents[component_of[needed]].push(component);
            }
        }
    }
    let first = |component: usize| rows[component].first().copied().unwrap_or(usize::MAX);
    let mut ready: BinaryHeap<Reverse<(usize, usize)>> = (0..rows.len())
        .filter(|&component| waiting[component] == 0)
        .map(|component| Reverse((first(component), component)))
        .collect();
    let mut ordered = Vec::with_capacity(rows.len());
    while let Some(Reverse((_, component))) = ready.pop() {
        if !rows[component].is_empty() {
            ordered.push(rows[component].clone());
        }
        for &dependent in &dependents[component] {
            waiting[dependent] -= 1;
            if waiting[dependent] == 0 {
                ready.push(Reverse((first(dependent), dependent)));
            }
        }
    }
    ordered
}

#[cfg(test)]
mod tests {
    use super::super::maximum_matching;
    use super::*;

    fn blocks(rows: &[&[usize]], columns: usize) -> Vec<Vec<usize>> {
        let rows = rows.iter().map(|row| row.to_vec()).collect();
        let incidence = Incidence { rows, columns };
        components(&incidence, &maximum_matching(&incidence))
    }

    #[test]
    fn a_triangular_system_is_solved_from_its_single_unknown_on() {
        // Solves x2, then x1 from x1 + x2, then x0 from all three.
        assert_eq!(blocks(&[&[0, 1, 2], &[1, 2], &[2]], 3), [[2], [1], [0]]);
    }

    #[test]
    fn two_coupled_equations_are_one_block() {
        assert_eq!(
            blocks(&[&[0, 1], &[0, 1], &[1, 2]], 3),
            [vec![0, 1], vec![2]]
        );
    }

    #[test]
    fn independent_blocks_keep_their_written_order() {
        assert_eq!(blocks(&[&[2], &[0], &[1]], 3), [[0], [1], [2]]);
    }

    #[test]
    fn the_exam_is_solved_as_by_hand() {
        // Rows: x1; y1; x1 φ1 x2 φ2; y1 φ1 y2 φ2; x2; φ1.
        let rows: &[&[usize]] = &[&[0], &[1], &[0, 2, 3, 5], &[1, 2, 4, 5], &[3], &[2]];
        assert_eq!(blocks(rows, 6), [[0], [1], [4], [5], [2], [3]]);
    }

    #[test]
    fn a_cycle_of_three_is_one_block() {
        assert_eq!(blocks(&[&[0, 1], &[1, 2], &[2, 0]], 3), [[0, 1, 2]]);
    }
}
