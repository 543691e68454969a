//! Jᵀ λ = f for a part in closed form: the multipliers of its equations, by Cramer's rule with the determinant of its position.
//!
//! For two turning links, [Ω w_a, Ω w_b], the forces f are the moments about their pins, and λ is the force in the pin that joins
//! them: it has the lever arms that the two moment equations give it.

use crate::expr::ExprId;
use crate::joint::geometry::{Vector, dot};
use crate::program::builder::Builder;

/// The Jacobian of a part.
#[derive(Clone, Copy, Debug)]
pub enum Transposed {
    /// ∂g/∂u of one equation for one unknown.
    One(ExprId),
    /// Two equations for two unknowns.
    Two {
        /// The derivatives of both equations, as x and y of a vector equation, in each unknown.
        columns: [Vector; 2],
        /// Their determinant.
        determinant: ExprId,
        /// How the equations became components: a place in what arranges them.
        arrangement: usize,
        /// Whether the vector equation is taken with the opposite sign.
        reversed: bool,
    },
}

impl Transposed {
    /// One multiplier for each equation of the part, from one force for each of its unknowns.
    pub fn solve(&self, forces: &[ExprId], builder: &mut Builder<'_>) -> Option<Vec<ExprId>> {
        match (*self, forces) {
            (Transposed::One(slope), &[force]) => Some(vec![builder.graph().divide(force, slope)]),
            (
                Transposed::Two {
                    columns,
                    determinant,
                    arrangement,
                    reversed,
                },
                &[first, second],
            ) => {
                let [a, b] = columns;
                let graph = builder.graph();
                let determinant = match reversed {
                    true => graph.negate(determinant),
                    false => determinant,
                };
                let minus = [a[1], b[0]].map(|part| graph.negate(part));
                let sides = [[b[1], minus[0]], [minus[1], a[0]]];
                let [x, y] = sides.map(|side| {
                    let numerator = dot([first, second], side, graph);
                    graph.divide(numerator, determinant)
                });
                let [minus_x, minus_y] = [x, y].map(|part| graph.negate(part));
                Some(match arrangement {
                    0 => vec![x, y],
                    1 => vec![x, minus_y],
                    2 => vec![y, x],
                    _ => vec![y, minus_x],
                })
            }
            _ => None,
        }
    }
}
