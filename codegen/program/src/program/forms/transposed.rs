//! Solves Jᵀ λ = f for the multipliers of a closed form, by Cramer's rule with the determinant of its position.
//!
//! For two rotating links, [Ω w_a, Ω w_b], the forces f are the moments about their pins. Then λ is the force in the pin between
//! them, with the lever arms of both moment equations.

use crate::expr::ExprId;
use crate::joint::geometry::{Vector, dot};
use crate::program::builder::Builder;

/// Jacobian of a subsystem.
#[derive(Clone, Copy, Debug)]
pub enum Transposed {
    /// Derivative ∂g/∂u of one equation in one unknown.
    One(ExprId),
    /// Two equations in two unknowns.
    Two {
        /// Derivatives of both equations, as x and y of a vector equation, in each unknown.
        columns: [Vector; 2],
        /// Determinant of the columns.
        determinant: ExprId,
        /// Arrangement of the equations as components: an index of `arrangements`.
        arrangement: usize,
        /// True if the vector equation has the opposite sign.
        reversed: bool,
    },
}

impl Transposed {
    /// Returns one multiplier per equation of the subsystem, from one force per unknown.
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
