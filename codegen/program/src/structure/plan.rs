//! The vector form → blocks in solve order, each with the part that its tears are found from.
//!
//! Deliberately unknown here: how a part is solved.

use std::collections::{BTreeSet, HashMap};

use super::elimination::{BlockEquation, Definition, eliminate, in_order};
use super::following::follow;
use super::shortening::{Addition, shorten};
use super::{Incidence, components, maximum_matching};
use crate::expr::{ExprId, Graph, SymbolId};
use crate::system::{Bound, Exceeded, System, VectorForm};

/// The most unknowns that Newton-Raphson finds together: their dense Jacobian has a million entries.
pub const LARGEST_TOGETHER: usize = 1000;

/// How the unknowns are found, block by block.
#[derive(Clone, Debug, PartialEq)]
pub struct SolvedPlan {
    /// In solve order.
    pub blocks: Vec<SolvedBlock>,
    /// What was added to the equations of parts, in order.
    pub additions: Vec<Addition>,
}

/// Unknowns that have to be found together.
#[derive(Clone, Debug, PartialEq)]
pub struct SolvedBlock {
    /// The joints whose equations it uses, in written order.
    pub joints: Vec<usize>,
    /// What the tears are found from: one part, or none where everything is explicit.
    pub parts: Vec<Subsystem>,
    /// What follows from the tears, in the order in which it can be computed.
    pub definitions: Vec<Definition>,
}

/// Equations of a block that cannot be taken apart any further, and as many unknowns. Everything else in them is known before.
#[derive(Clone, Debug, PartialEq)]
pub struct Subsystem {
    /// The equations.
    pub equations: Vec<BlockEquation>,
    /// The tears: indices into the unknowns of the vector form, ascending.
    pub unknowns: Vec<usize>,
    /// Whether some equation has lost its unknown by elimination, so that the part is singular in every pose.
    pub is_singular: bool,
}

/// The plan of the solved view, with the values of the drivers shifted where the system has directions. `None` where the
/// vector form is not structurally square, and where a bound is passed: [`System::exceeded`] says which, and with which joint.
pub fn plan(system: &mut System) -> Option<SolvedPlan> {
    system.shift_drivers();
    plan_of_motion(system)
}

/// The same for the motion alone, as a person writes it down; efforts are the work along the values of drivers, which are shifted for them.
pub fn plan_of_motion(system: &mut System) -> Option<SolvedPlan> {
    if system.mechanism.forces.need_efforts() {
        system.shift_drivers();
    }
    let form = &mut system.vector_form;
    let graph = &mut system.mechanism.graph;
    let incidence = incidence(form, graph);
    let matching = maximum_matching(&incidence);
    if matching
        .column_of
        .iter()
        .chain(&matching.row_of)
        .any(Option::is_none)
    {
        return None;
    }
    // The first block holds what follows from t, inputs, parameters and constants alone.
    let mut blocks = vec![SolvedBlock {
        joints: Vec::new(),
        parts: Vec::new(),
        definitions: Vec::new(),
    }];
    let mut additions = Vec::new();
    let mut home = vec![0; form.unknowns.len()];
    // Unknowns that turned out not to move, which later equations need not carry along.
    let mut constants: HashMap<SymbolId, ExprId> = HashMap::new();
    for rows in components(&incidence, &matching) {
        let mut unknowns: Vec<usize> = rows
            .iter()
            .filter_map(|&row| matching.column_of[row])
            .collect();
        unknowns.sort_unstable();
        let joints: Vec<usize> = rows.iter().map(|&row| form.rows[row].joint).collect();
        let mentioned = rows
            .iter()
            .flat_map(|&row| incidence.rows[row].iter().copied());
        let latest = mentioned
            .filter(|column| unknowns.binary_search(column).is_err())
            .map(|column| home[column])
            .max();
        let residuals = rows
            .iter()
            .map(|&row| BlockEquation {
                residual: with_constants(form.rows[row].residual, &constants, graph),
                row,
                quantity: form.rows[row].quantity,
            })
            .collect();
        let at = system.mechanism.joints[joints[0]].span;
        let (mut block, mut added) = block(residuals, &unknowns, joints, form, graph);
        additions.append(&mut added);
        if let Some(bound) = passed(&block, graph) {
            system.exceed(Exceeded { at, bound });
            return None;
        }
        for definition in &block.definitions {
            if graph.is_fixed(definition.value) {
                constants.insert(form.unknowns[definition.unknown].position, definition.value);
            }
        }
        // What follows without a step belongs to the block that it follows from, as a person would write it down.
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
    system.note_arms();
    Some(SolvedPlan { blocks, additions })
}

/// Each part as a block of its own: what is found in it is known with its rates to those after it. What follows belongs to the last.
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
    let mut own = joints_of(&last);
    let definitions = block.definitions.iter();
    own.extend(definitions.map(|it| form.rows[it.row].joint));
    let elsewhere: BTreeSet<usize> = blocks.iter().flat_map(|it| &it.joints).copied().collect();
    block
        .joints
        .retain(|it| own.contains(it) || !elsewhere.contains(it));
    block.parts.push(last);
    blocks.push(block);
    blocks
}

/// The bound that a block passes.
fn passed(block: &SolvedBlock, graph: &Graph) -> Option<Bound> {
    let sizes = block.parts.iter().map(|part| part.unknowns.len());
    let largest = sizes.max().filter(|&size| size > LARGEST_TOGETHER);
    let of_graph = graph.excess().map(Bound::Graph);
    of_graph.or(largest.map(Bound::Together))
}

/// An equation with the unknowns that do not move put in.
fn with_constants(
    residual: ExprId,
    constants: &HashMap<SymbolId, ExprId>,
    graph: &mut Graph,
) -> ExprId {
    let found: Vec<(SymbolId, ExprId)> = graph
        .symbols(residual)
        .iter()
        .filter_map(|symbol| Some((*symbol, *constants.get(symbol)?)))
        .collect();
    if found.is_empty() {
        residual
    } else {
        graph.substitute(residual, &found)
    }
}

/// Which row mentions which unknown, through arms or directly.
fn incidence(form: &VectorForm, graph: &Graph) -> Incidence {
    let rows = form.rows.iter();
    Incidence {
        rows: rows
            .map(|row| form.mentioned(row.residual, graph))
            .collect(),
        columns: form.unknowns.len(),
    }
}

/// Eliminates what can be, shortens what is left, and takes it apart once more.
fn block(
    residuals: Vec<BlockEquation>,
    unknowns: &[usize],
    joints: Vec<usize>,
    form: &mut VectorForm,
    graph: &mut Graph,
) -> (SolvedBlock, Vec<Addition>) {
    let followed = follow(residuals, unknowns, form, graph);
    let form = &*form;
    let eliminated = eliminate(followed.residuals, &followed.unknowns, form, graph);
    let (mut residuals, tears) = (eliminated.residuals, eliminated.tears);
    let additions = shorten(&mut residuals, form, graph);
    let row = |residual: ExprId| {
        let mentioned = form.mentioned(residual, graph).into_iter();
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
            let mut found: Vec<usize> = rows
                .iter()
                .filter_map(|&row| matching.column_of[row])
                .map(|column| tears[column])
                .collect();
            found.sort_unstable();
            parts.push(Subsystem {
                equations: rows.iter().map(|&row| residuals[row]).collect(),
                unknowns: found,
                is_singular: false,
            });
        }
    }
    let block = SolvedBlock {
        joints,
        parts,
        // What an angle follows may have been eliminated itself.
        definitions: in_order(
            [followed.definitions, eliminated.definitions].concat(),
            form,
            graph,
        ),
    };
    (block, additions)
}
