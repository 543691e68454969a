//! Eliminates angles that follow another angle of their block.
//!
//! Let an equation say φ_j = ±φ_i + g, where g depends only on time or on earlier results. The vectors of φ_j are those of φ_i
//! rotated by g, R(φ_j) s = R(g) R(φ_i) s, and mirrored if the sign is minus. So the equation defines φ_j, and the other
//! equations do not mention φ_j any more.
//!
//! Relations such as φ_j = 2 φ_i are excluded: sine and cosine of φ_j are not linear in those of φ_i.

use super::elimination::{BlockEquation, Definition};
use crate::expr::{ExprId, Graph, Node};
use crate::joint::Quantity;
use crate::joint::geometry::turned;
use crate::system::VectorForm;

/// Block after elimination of angles that follow others.
#[derive(Clone, Debug)]
pub(super) struct Followed {
    /// Assignments of these angles in terms of the remaining unknowns.
    pub definitions: Vec<Definition>,
    /// Equations that remain.
    pub residuals: Vec<BlockEquation>,
    /// Unknowns that remain.
    pub unknowns: Vec<usize>,
}

/// Relation φ_follower = ±φ_leader + g.
#[derive(Clone, Copy, Debug)]
struct Relation {
    leader: usize,
    follower: usize,
    opposite: bool,
    offset: ExprId,
}

/// Eliminates all angles of a block that follow another angle of the block.
pub(super) fn follow(
    mut residuals: Vec<BlockEquation>,
    unknowns: &[usize],
    form: &mut VectorForm,
    graph: &mut Graph,
) -> Followed {
    let mut unknowns = unknowns.to_vec();
    let mut definitions = Vec::new();
    loop {
        let candidate = (0..residuals.len()).find_map(|at| {
            Some((
                at,
                relation(residuals[at].residual, &unknowns, form, graph)?,
            ))
        });
        let Some((at, relation)) = candidate else {
            break;
        };
        let row = residuals.remove(at).row;
        let arms: Vec<_> = form.arms_of(relation.follower).cloned().collect();
        let mut replacements = Vec::new();
        for arm in arms {
            if residuals.iter().any(|it| {
                graph.depends_on(it.residual, arm.symbols[0])
                    || graph.depends_on(it.residual, arm.symbols[1])
            }) {
                let [x, y] = arm.local;
                let local = if relation.opposite {
                    [x, graph.negate(y)]
                } else {
                    [x, y]
                };
                let [x, y] = form.arm(relation.leader, local, &arm.name, graph);
                let seen = if relation.opposite {
                    [x, graph.negate(y)]
                } else {
                    [x, y]
                };
                let (cosine, sine) = (graph.cos(relation.offset), graph.sin(relation.offset));
                let (cosine, sine) = (graph.tidied(cosine), graph.tidied(sine));
                let vector = turned(cosine, sine, seen, graph);
                replacements.extend(arm.symbols.into_iter().zip(vector));
            }
        }
        let leader = graph.variable(form.unknowns[relation.leader].position);
        let value = if relation.opposite {
            graph.subtract(relation.offset, leader)
        } else {
            graph.add(leader, relation.offset)
        };
        replacements.push((form.unknowns[relation.follower].position, value));
        for it in &mut residuals {
            it.residual = graph.substitute(it.residual, &replacements);
        }
        unknowns.retain(|&unknown| unknown != relation.follower);
        definitions.push(Definition {
            unknown: relation.follower,
            value,
            row,
        });
    }
    // An assignment may follow an angle that was eliminated later.
    definitions.reverse();
    Followed {
        definitions,
        residuals,
        unknowns,
    }
}

/// Returns the relation that an equation states between two angles of a block; `None` if the equation states anything else.
fn relation(
    residual: ExprId,
    unknowns: &[usize],
    form: &VectorForm,
    graph: &mut Graph,
) -> Option<Relation> {
    let mut mentioned = form.mentioned(residual, graph);
    mentioned.retain(|unknown| unknowns.binary_search(unknown).is_ok());
    let &[leader, follower] = &mentioned[..] else {
        return None;
    };
    let slope = |unknown: usize, graph: &mut Graph| {
        let symbol = form.unknowns[unknown].position;
        let angle = form.unknowns[unknown].quantity == Quantity::Angle;
        let slope = graph.derivative(residual, symbol);
        let constant = matches!(graph.node(slope), Node::Number(_));
        (angle && constant && !form.is_turned_by(residual, unknown, graph)).then_some(slope)
    };
    let slopes = [slope(leader, graph)?, slope(follower, graph)?];
    let ratio = graph.divide(slopes[0], slopes[1]);
    let one = graph.one();
    let minus_one = graph.negate(one);
    if ratio != one && ratio != minus_one {
        return None;
    }
    let zero = graph.zero();
    let symbols = [leader, follower].map(|unknown| (form.unknowns[unknown].position, zero));
    let rest = graph.substitute(residual, &symbols);
    let offset = graph.divide(rest, slopes[1]);
    Some(Relation {
        leader,
        follower,
        opposite: ratio == one,
        offset: graph.negate(offset),
    })
}
