//! Orders the vector form into blocks in solve order, each with the subsystem of its tearing variables.

use std::collections::{BTreeSet, HashMap};

use super::elimination::{BlockEquation, Definition, eliminate, in_order};
use super::following::follow;
use super::shortening::{Addition, shorten};
use super::{Incidence, components, maximum_matching};
use crate::expr::{ExprId, Graph, SymbolId};
use crate::pool::{Bound, Exceeded, Pool};
use crate::system::{Direction, System, VectorForm, VectorRow};

/// Largest number of unknowns that Newton-Raphson solves simultaneously: their dense Jacobian has a million entries.
pub const LARGEST_TOGETHER: usize = 1000;

/// Plan of the solution, block by block.
#[derive(Clone, Debug, PartialEq)]
pub struct SolvedPlan {
    /// Rows of the vector form, with shifted values of drivers.
    pub rows: Vec<VectorRow>,
    /// Blocks, in solve order.
    pub blocks: Vec<SolvedBlock>,
    /// Equations that were added to others, in order.
    pub additions: Vec<Addition>,
}

/// Unknowns that are solved simultaneously.
#[derive(Clone, Debug, PartialEq)]
pub struct SolvedBlock {
    /// Joints whose equations the block uses, in written order.
    pub joints: Vec<usize>,
    /// Subsystem of the tearing variables: one, or none if all unknowns are explicit.
    pub parts: Vec<Subsystem>,
    /// Explicit assignments from the tearing variables, in the order of evaluation.
    pub definitions: Vec<Definition>,
}

/// Irreducible equations of a block and as many unknowns; all other values in them are known earlier.
#[derive(Clone, Debug, PartialEq)]
pub struct Subsystem {
    /// Equations of the subsystem.
    pub equations: Vec<BlockEquation>,
    /// Tearing variables: indices into the unknowns of the vector form, ascending.
    pub unknowns: Vec<usize>,
    /// True if elimination has removed all unknowns from an equation, so that the subsystem is singular in every pose.
    pub is_singular: bool,
}

/// Drivers whose value is shifted in the rows of a plan, so that the pose can be differentiated along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shift {
    /// All drivers that are directions, if the system has directions.
    Directions,
    /// Those of efforts: the motion alone is planned as by hand, but efforts are derived from work along driver values.
    Efforts,
}

impl Shift {
    /// True if rows of a plan are shifted, so that the plan differs from that of the motion alone.
    pub fn applies(self, system: &System) -> bool {
        let is_requested = self == Shift::Directions || system.mechanism.forces.need_efforts();
        is_requested && !system.directions.iter().all(Direction::is_parameter)
    }
}

/// Reason that the equations have no plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unplanned {
    /// The vector form is not structurally square.
    Undetermined,
    /// A limit is exceeded; the pool has recorded it.
    Exceeded(Exceeded),
}

/// Plans the solved formulation.
///
/// # Errors
/// The equations do not determine the motion, or a limit is exceeded.
pub fn plan(pool: &mut Pool, system: &System, shift: Shift) -> Result<SolvedPlan, Unplanned> {
    let form = &system.vector_form;
    let rows = match shift.applies(system) {
        true => system.shifted_rows(pool),
        false => form.rows.clone(),
    };
    let incidence = incidence(form, &rows, pool);
    let matching = maximum_matching(&incidence);
    if matching
        .column_of
        .iter()
        .chain(&matching.row_of)
        .any(Option::is_none)
    {
        return Err(Unplanned::Undetermined);
    }
    // The first block has assignments from t, inputs, parameters and constants alone.
    let mut blocks = vec![SolvedBlock {
        joints: Vec::new(),
        parts: Vec::new(),
        definitions: Vec::new(),
    }];
    let mut additions = Vec::new();
    let mut home = vec![0; form.unknowns.len()];
    // Unknowns that turned out to be constant; later equations need not mention them.
    let mut constants: HashMap<SymbolId, ExprId> = HashMap::new();
    for own in components(&incidence, &matching) {
        let mut unknowns: Vec<usize> = own
            .iter()
            .filter_map(|&row| matching.column_of[row])
            .collect();
        unknowns.sort_unstable();
        let joints: Vec<usize> = own.iter().map(|&row| rows[row].joint).collect();
        let mentioned = own
            .iter()
            .flat_map(|&row| incidence.rows[row].iter().copied());
        let latest = mentioned
            .filter(|column| unknowns.binary_search(column).is_err())
            .map(|column| home[column])
            .max();
        let residuals = own
            .iter()
            .map(|&row| BlockEquation {
                residual: with_constants(rows[row].residual, &constants, &mut pool.graph),
                row,
                quantity: rows[row].quantity,
            })
            .collect();
        let at = system.mechanism.joints[joints[0]].span;
        let (mut block, mut added) = block(residuals, &unknowns, joints, form, pool);
        additions.append(&mut added);
        if let Some(bound) = passed(&block, &pool.graph) {
            let exceeded = Exceeded { at, bound };
            pool.exceed(exceeded);
            return Err(Unplanned::Exceeded(exceeded));
        }
        for definition in &block.definitions {
            if pool.graph.is_fixed(definition.value) {
                constants.insert(form.unknowns[definition.unknown].position, definition.value);
            }
        }
        // Explicit assignments belong to the block that they depend on, as by hand.
        let place = if block.parts.is_empty() {
            let place = latest.unwrap_or(0);
            blocks[place].joints.append(&mut block.joints);
            blocks[place].definitions.append(&mut block.definitions);
            place
        } else {
            blocks.extend(taken_apart(block, form));
            blocks.len() - 1
        };
        for &unknown in &unknowns {
            home[unknown] = place;
        }
    }
    if blocks[0].definitions.is_empty() {
        blocks.remove(0);
    }
    for block in &mut blocks {
        block.joints.sort_unstable();
        block.joints.dedup();
    }
    Ok(SolvedPlan {
        rows,
        blocks,
        additions,
    })
}

/// Makes each subsystem a block of its own, so that its results and rates are known to later ones. Assignments belong to the last
/// block.
fn taken_apart(mut block: SolvedBlock, form: &VectorForm) -> Vec<SolvedBlock> {
    let Some(last) = block.parts.pop() else {
        return vec![block];
    };
    let joints_of = |part: &Subsystem| -> BTreeSet<usize> {
        let equations = part.equations.iter();
        equations.map(|it| form.rows[it.row].joint).collect()
    };
    let earlier = block.parts.drain(..).map(|part| SolvedBlock {
        joints: joints_of(&part).into_iter().collect(),
        parts: vec![part],
        definitions: Vec::new(),
    });
    let mut blocks: Vec<SolvedBlock> = earlier.collect();
    let mut joints = joints_of(&last);
    let definitions = block.definitions.iter();
    joints.extend(definitions.map(|it| form.rows[it.row].joint));
    let elsewhere: BTreeSet<usize> = blocks.iter().flat_map(|it| &it.joints).copied().collect();
    block
        .joints
        .retain(|it| joints.contains(it) || !elsewhere.contains(it));
    block.parts.push(last);
    blocks.push(block);
    blocks
}

/// Returns the limit that a block exceeds, if any.
fn passed(block: &SolvedBlock, graph: &Graph) -> Option<Bound> {
    let sizes = block.parts.iter().map(|part| part.unknowns.len());
    let largest = sizes.max().filter(|&size| size > LARGEST_TOGETHER);
    let of_graph = graph.excess().map(Bound::Graph);
    of_graph.or(largest.map(Bound::Together))
}

/// Returns an equation with constant unknowns substituted.
fn with_constants(
    residual: ExprId,
    constants: &HashMap<SymbolId, ExprId>,
    graph: &mut Graph,
) -> ExprId {
    let constant_symbols: Vec<(SymbolId, ExprId)> = graph
        .symbols(residual)
        .iter()
        .filter_map(|symbol| Some((*symbol, *constants.get(symbol)?)))
        .collect();
    if constant_symbols.is_empty() {
        residual
    } else {
        graph.substitute(residual, &constant_symbols)
    }
}

/// Returns the incidence of rows and unknowns, directly or through rotated vectors.
fn incidence(form: &VectorForm, rows: &[VectorRow], pool: &Pool) -> Incidence {
    Incidence {
        rows: rows
            .iter()
            .map(|row| pool.mentioned(row.residual))
            .collect(),
        columns: form.unknowns.len(),
    }
}

/// Eliminates unknowns, shortens the remaining equations, and decomposes them again.
fn block(
    residuals: Vec<BlockEquation>,
    unknowns: &[usize],
    joints: Vec<usize>,
    form: &VectorForm,
    pool: &mut Pool,
) -> (SolvedBlock, Vec<Addition>) {
    let followed = follow(residuals, unknowns, form, pool);
    let eliminated = eliminate(followed.residuals, &followed.unknowns, form, pool);
    let (mut residuals, tears) = (eliminated.residuals, eliminated.tears);
    let additions = shorten(&mut residuals, pool);
    let row = |residual: ExprId| {
        let mentioned = pool.mentioned(residual).into_iter();
        mentioned
            .filter_map(|unknown| tears.binary_search(&unknown).ok())
            .collect()
    };
    let incidence = Incidence {
        rows: residuals.iter().map(|it| row(it.residual)).collect(),
        columns: tears.len(),
    };
    let matching = maximum_matching(&incidence);
    let mut parts = Vec::new();
    if matching.column_of.iter().any(Option::is_none) {
        parts.push(Subsystem {
            equations: residuals,
            unknowns: tears,
            is_singular: true,
        });
    } else {
        for rows in components(&incidence, &matching) {
            let mut part_unknowns: Vec<usize> = rows
                .iter()
                .filter_map(|&row| matching.column_of[row])
                .map(|column| tears[column])
                .collect();
            part_unknowns.sort_unstable();
            parts.push(Subsystem {
                equations: rows.iter().map(|&row| residuals[row]).collect(),
                unknowns: part_unknowns,
                is_singular: false,
            });
        }
    }
    let block = SolvedBlock {
        joints,
        parts,
        // The leader of an angle may have been eliminated itself.
        definitions: in_order(
            [followed.definitions, eliminated.definitions].concat(),
            pool,
        ),
    };
    (block, additions)
}
