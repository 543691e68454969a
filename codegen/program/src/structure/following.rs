//! Angles that follow another angle of their block → that angle alone.
//!
//! Where an equation of a block says φ_j = ±φ_i + g with a known g, a function of time or of what is solved before, the vectors
//! that φ_j turns are those that φ_i turns, turned on by g: R(φ_j) s = R(g) R(φ_i) s, and mirrored where the sign is minus. So the
//! equation defines φ_j, and the others do not mention it any more. Deliberately not done: φ_j = 2 φ_i, whose sine and cosine are
//! no longer linear in those of φ_i.

use super::elimination::{BlockEquation, Definition};
use crate::expr::{ExprId, Graph, Node};
use crate::joint::Quantity;
use crate::joint::geometry::turned;
use crate::system::VectorForm;

/// A block after the angles that follow others are defined.
#[derive(Clone, Debug)]
pub(super) struct Followed {
    /// The angles that follow, in terms of the unknowns that are left.
    pub definitions: Vec<Definition>,
    /// The equations that are left.
    pub residuals: Vec<BlockEquation>,
    /// The unknowns that are left.
    pub unknowns: Vec<usize>,
}

/// φ_follower = ±φ_leader + g.
#[derive(Clone, Copy, Debug)]
struct Relation {
    leader: usize,
    follower: usize,
    opposite: bool,
    offset: ExprId,
}

/// Takes all angles out of a block that follow another one of it.
pub(super) fn follow(
    mut residuals: Vec<BlockEquation>,
    unknowns: &[usize],
    form: &mut VectorForm,
    graph: &mut Graph,
) -> Followed {
    let mut unknowns = unknowns.to_vec();
    let mut definitions = Vec::new();
    loop {
        let found = (0..residuals.len()).find_map(|at| {
            Some((
                at,
                relation(residuals[at].residual, &unknowns, form, graph)?,
            ))
        });
        let Some((at, relation)) = found else {
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
    // What was defined first may follow what was defined after it.
    definitions.reverse();
    Followed {
        definitions,
        residuals,
        unknowns,
    }
}

/// The relation that an equation states between two angles of a block, where it states nothing else.
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
