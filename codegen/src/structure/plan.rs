//! The vector form → blocks in solve order, each with its steps.

use std::collections::HashMap;

use super::elimination::{Definition, Measured, eliminate, mentions};
use super::following::follow;
use super::recognition::{newton, recognize};
use super::{Incidence, components, maximum_matching};
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::Quantity;
use crate::joint::geometry::Vector;
use crate::system::{SymbolRole, System, VectorForm};

/// How the unknowns are found, block by block.
#[derive(Clone, Debug, PartialEq)]
pub struct SolvedPlan {
    /// In solve order.
    pub blocks: Vec<SolvedBlock>,
}

/// Unknowns that have to be found together.
#[derive(Clone, Debug, PartialEq)]
pub struct SolvedBlock {
    /// The joints whose equations it uses, in written order.
    pub joints: Vec<usize>,
    /// How the tears are found; empty where everything is explicit.
    pub steps: Vec<Step>,
    /// What follows from the tears, in the order in which it can be computed.
    pub definitions: Vec<Definition>,
}

/// One step of a person's solution. Unknowns are indices into the vector form; everything else is known before the step.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// coefficient · u + rest = 0.
    Linear {
        /// u.
        unknown: usize,
        /// What it is multiplied by.
        coefficient: ExprId,
        /// The rest of the equation.
        rest: ExprId,
    },
    /// cosine · cos φ + sine · sin φ + rest = 0.
    OneAngle {
        /// φ.
        unknown: usize,
        /// The coefficient of cos φ.
        cosine: ExprId,
        /// The coefficient of sin φ.
        sine: ExprId,
        /// The rest of the equation.
        rest: ExprId,
        /// The equation as it was, in arms.
        equation: ExprId,
    },
    /// R(φ_a) p + R(φ_b) q + closure = 0: the dyad with three revolute joints, where two circles meet.
    TwoRotations {
        /// φ_a.
        first: usize,
        /// φ_b.
        second: usize,
        /// The first link, constant in its body.
        p: Vector,
        /// The second link, constant in its body.
        q: Vector,
        /// The known vector that closes the triangle.
        closure: Vector,
    },
    /// R(φ) p + ℓ d + closure = 0: a circle meets a line of known direction.
    RotationAndSlide {
        /// φ.
        angle: usize,
        /// ℓ.
        slide: usize,
        /// The turning link, constant in its body.
        p: Vector,
        /// d.
        direction: Vector,
        /// The known vector that closes the loop.
        closure: Vector,
    },
    /// R(φ) (p + ℓ u) + closure = 0: a line that turns passes through a known point.
    TurningSlide {
        /// φ.
        angle: usize,
        /// ℓ.
        slide: usize,
        /// Where the line begins, constant in its body.
        p: Vector,
        /// The line's direction, constant in its body.
        u: Vector,
        /// The known vector that closes the loop.
        closure: Vector,
    },
    /// ℓ_a d_a + ℓ_b d_b + closure = 0: two lines meet.
    TwoSlides {
        /// ℓ_a.
        first: usize,
        /// ℓ_b.
        second: usize,
        /// d_a and d_b.
        directions: [Vector; 2],
        /// The known vector that closes the loop.
        closure: Vector,
    },
    /// Newton-Raphson on what has no closed form.
    Newton {
        /// The tears.
        unknowns: Vec<usize>,
        /// As many equations.
        residuals: Vec<ExprId>,
        /// What each of them is measured in.
        quantities: Vec<Quantity>,
    },
}

impl Step {
    /// The unknowns that the step finds.
    pub fn unknowns(&self) -> Vec<usize> {
        match self {
            Step::Linear { unknown, .. } | Step::OneAngle { unknown, .. } => vec![*unknown],
            Step::TwoRotations { first, second, .. } | Step::TwoSlides { first, second, .. } => {
                vec![*first, *second]
            }
            Step::RotationAndSlide { angle, slide, .. }
            | Step::TurningSlide { angle, slide, .. } => vec![*angle, *slide],
            Step::Newton { unknowns, .. } => unknowns.clone(),
        }
    }

    /// What the kind of step is called.
    pub fn name(&self) -> String {
        match self {
            Step::Linear { .. } => "linear".to_string(),
            Step::OneAngle { .. } => "one angle".to_string(),
            Step::TwoRotations { .. } => "two rotations".to_string(),
            Step::RotationAndSlide { .. } | Step::TurningSlide { .. } => {
                "rotation and slide".to_string()
            }
            Step::TwoSlides { .. } => "two slides".to_string(),
            Step::Newton { unknowns, .. } => format!("Newton of size {}", unknowns.len()),
        }
    }
}

/// The plan of the solved view, with the values of the drivers shifted where the system has directions. `None` where the
/// vector form is not structurally square.
pub fn plan(system: &mut System) -> Option<SolvedPlan> {
    system.shift_drivers();
    plan_of_motion(system)
}

/// The same for the motion alone, as a person writes it down.
pub fn plan_of_motion(system: &mut System) -> Option<SolvedPlan> {
    let coordinates = system.coordinates.len();
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
        steps: Vec::new(),
        definitions: Vec::new(),
    }];
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
            .filter(|column| !unknowns.contains(column))
            .map(|column| home[column])
            .max();
        let residuals = rows
            .iter()
            .map(|&row| Measured {
                residual: with_constants(form.rows[row].residual, &constants, graph),
                quantity: form.rows[row].quantity,
            })
            .collect();
        let mut block = block(residuals, &unknowns, joints, form, graph);
        for definition in &block.definitions {
            if graph.is_fixed(definition.value) {
                constants.insert(form.unknowns[definition.unknown].position, definition.value);
            }
        }
        // What follows without a step belongs to the block that it follows from, as a person would write it down.
        let place = if block.steps.is_empty() {
            latest.unwrap_or(0)
        } else {
            blocks.len()
        };
        if place < blocks.len() {
            blocks[place].joints.append(&mut block.joints);
            blocks[place].definitions.append(&mut block.definitions);
        } else {
            blocks.push(block);
        }
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
    // Arms that were made for angles that follow others have roles too.
    system.roles.resize(
        system.mechanism.graph.symbol_count(),
        SymbolRole::Intermediate,
    );
    system
        .vector_form
        .note_roles(&mut system.roles, coordinates);
    Some(SolvedPlan { blocks })
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
    // Symbol → unknown, once for all rows.
    let mut unknown_of = vec![None; graph.symbol_count()];
    for (index, unknown) in form.unknowns.iter().enumerate() {
        unknown_of[unknown.position.index()] = Some(index);
    }
    for arm in &form.arms {
        for symbol in arm.symbols {
            unknown_of[symbol.index()] = Some(arm.angle);
        }
    }
    let pattern = |residual: ExprId| {
        let mut columns: Vec<usize> = graph
            .symbols(residual)
            .iter()
            .filter_map(|symbol| unknown_of[symbol.index()])
            .collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    };
    Incidence {
        rows: form.rows.iter().map(|row| pattern(row.residual)).collect(),
        columns: form.unknowns.len(),
    }
}

/// Eliminates what can be, takes the rest apart once more, and recognises each part.
fn block(
    residuals: Vec<Measured>,
    unknowns: &[usize],
    joints: Vec<usize>,
    form: &mut VectorForm,
    graph: &mut Graph,
) -> SolvedBlock {
    let followed = follow(residuals, unknowns, form, graph);
    let form = &*form;
    let eliminated = eliminate(followed.residuals, &followed.unknowns, form, graph);
    let (residuals, tears) = (eliminated.residuals, eliminated.tears);
    let row = |residual: ExprId| {
        (0..tears.len())
            .filter(|&tear| mentions(residual, tears[tear], form, graph))
            .collect()
    };
    let incidence = Incidence {
        rows: residuals.iter().map(|it| row(it.residual)).collect(),
        columns: tears.len(),
    };
    let matching = maximum_matching(&incidence);
    let mut steps = Vec::new();
    if matching.column_of.iter().any(Option::is_none) {
        // Elimination made an equation lose its unknown: the block is singular in every pose, which Newton will report.
        steps.push(newton(&residuals, tears));
    } else {
        for rows in components(&incidence, &matching) {
            let part: Vec<Measured> = rows.iter().map(|&row| residuals[row]).collect();
            let mut found: Vec<usize> = rows
                .iter()
                .filter_map(|&row| matching.column_of[row])
                .map(|column| tears[column])
                .collect();
            found.sort_unstable();
            steps.push(recognize(&part, &found, form, graph));
        }
    }
    SolvedBlock {
        joints,
        steps,
        definitions: [followed.definitions, eliminated.definitions].concat(),
    }
}
