//! Eliminates angles that follow another angle of their block.
//!
//! Let an equation say φ_j = ±φ_i + g, where g depends only on time or on earlier results. The vectors of φ_j are those of φ_i
//! rotated by g, R(φ_j) s = R(g) R(φ_i) s, and mirrored if the sign is minus. So the equation defines φ_j, and the other
//! equations do not mention φ_j any more.
//!
//! Relations such as φ_j = 2 φ_i are excluded: sine and cosine of φ_j are not linear in those of φ_i.

use super::elimination::{BlockEquation, Definition};
use crate::expr::{ExprId, Node};
use crate::joint::Quantity;
use crate::joint::geometry::turned;
use crate::pool::Pool;
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
    form: &VectorForm,
    pool: &mut Pool,
) -> Followed {
    let mut unknowns = unknowns.to_vec();
    let mut definitions = Vec::new();
    loop {
        let candidate = (0..residuals.len())
            .find_map(|at| Some((at, relation(residuals[at].residual, &unknowns, form, pool)?)));
        let Some((at, relation)) = candidate else {
            break;
        };
        let row = residuals.remove(at).row;
        let arms: Vec<_> = pool.arms_of(relation.follower).cloned().collect();
        let mut replacements = Vec::new();
        for arm in arms {
            if residuals.iter().any(|it| {
                pool.graph.depends_on(it.residual, arm.symbols[0])
                    || pool.graph.depends_on(it.residual, arm.symbols[1])
            }) {
                let [x, y] = arm.local;
                let local = if relation.opposite {
                    [x, pool.graph.negate(y)]
                } else {
                    [x, y]
                };
                let [x, y] = pool.arm(relation.leader, local, &arm.name);
                let seen = if relation.opposite {
                    [x, pool.graph.negate(y)]
                } else {
                    [x, y]
                };
                let (cosine, sine) = (
                    pool.graph.cos(relation.offset),
                    pool.graph.sin(relation.offset),
                );
                let (cosine, sine) = (pool.graph.tidied(cosine), pool.graph.tidied(sine));
                let vector = turned(cosine, sine, seen, &mut pool.graph);
                replacements.extend(arm.symbols.into_iter().zip(vector));
            }
        }
        let leader = pool.graph.variable(form.unknowns[relation.leader].position);
        let value = if relation.opposite {
            pool.graph.subtract(relation.offset, leader)
        } else {
            pool.graph.add(leader, relation.offset)
        };
        replacements.push((form.unknowns[relation.follower].position, value));
        for it in &mut residuals {
            it.residual = pool.graph.substitute(it.residual, &replacements);
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
    pool: &mut Pool,
) -> Option<Relation> {
    let mut mentioned = pool.mentioned(residual);
    mentioned.retain(|unknown| unknowns.binary_search(unknown).is_ok());
    let &[leader, follower] = &mentioned[..] else {
        return None;
    };
    let slope = |unknown: usize, pool: &mut Pool| {
        let symbol = form.unknowns[unknown].position;
        let angle = form.unknowns[unknown].quantity == Quantity::Angle;
        let slope = pool.graph.derivative(residual, symbol);
        let constant = matches!(pool.graph.node(slope), Node::Number(_));
        (angle && constant && !pool.is_turned_by(residual, unknown)).then_some(slope)
    };
    let slopes = [slope(leader, pool)?, slope(follower, pool)?];
    let ratio = pool.graph.divide(slopes[0], slopes[1]);
    let one = pool.graph.one();
    let minus_one = pool.graph.negate(one);
    if ratio != one && ratio != minus_one {
        return None;
    }
    let zero = pool.graph.zero();
    let symbols = [leader, follower].map(|unknown| (form.unknowns[unknown].position, zero));
    let rest = pool.graph.substitute(residual, &symbols);
    let offset = pool.graph.divide(rest, slopes[1]);
    Some(Relation {
        leader,
        follower,
        opposite: ratio == one,
        offset: pool.graph.negate(offset),
    })
}
