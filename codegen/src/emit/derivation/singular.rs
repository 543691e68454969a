//! Singular poses of each subsystem, as a formula and in geometric words.
//!
//! The words state the equation det = 0 of the solution method. They do not tell which of its poses a motion reaches.

use std::sync::Arc;

use super::page::names;
use super::spelling::Spelling;
use crate::emit::named_parts::LONGEST_FORMULA;
use crate::expr::ExprId;
use crate::program::forms::Form;
use crate::structure::SolvedPlan;
use crate::words::{Known, enumerated};

/// Longest determinant that is printed, in characters.
const MAX_DETERMINANT_LENGTH: usize = 400;

/// Singular poses of a subsystem of the plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SingularPose {
    /// Index of the block.
    pub block: usize,
    /// Index of the subsystem in its block.
    pub part: usize,
    /// Unknowns of the subsystem: `phi2`, `phi_c3 and phi_c10`.
    pub unknowns: String,
    /// Solution method.
    pub method: String,
    /// Determinant of the subsystem's Jacobian up to its sign; `None` without a closed form, or if it is too long to
    /// read.
    pub determinant: Option<String>,
    /// Condition of points in a singular pose: `A-B and B-C are collinear`. `None` if the subsystem is never singular.
    pub meaning: Option<String>,
    /// Condition of bodies in a singular pose, for messages. `None` if the subsystem is never singular.
    pub said: Option<String>,
    /// Pins of the loop that two links close: `B-C-D`. `None` for other subsystems, and if a pin has no name.
    pub pins: Option<String>,
}

impl SingularPose {
    /// Sentence about unknowns, method, determinant and condition.
    pub fn sentence(&self) -> String {
        match (&self.determinant, &self.meaning) {
            (_, None) => "never singular.".to_string(),
            (Some(formula), Some(meaning)) => {
                format!("singular where {formula} = 0: {meaning}.")
            }
            (None, Some(meaning)) => {
                format!("no closed form of the determinant; singular where {meaning}.")
            }
        }
    }
}

/// Singular poses of each subsystem, in solve order.
pub(super) fn singular_poses(
    spelling: &mut Spelling<'_>,
    plan: &SolvedPlan,
    forms: &[Vec<Arc<dyn Form>>],
) -> Vec<SingularPose> {
    let mut known = Known::nothing(spelling.system);
    // Shifts of drivers for the sake of derivatives are zero.
    let directions = spelling.system.directions.iter();
    let drivers = directions.filter(|direction| !direction.is_parameter());
    let shifts: Vec<_> = drivers.map(|direction| direction.symbol).collect();
    let zero = spelling.graph().zero();
    for shift in shifts {
        spelling.replace(shift, zero);
    }
    let mut poses = Vec::new();
    for (number, (block, forms)) in plan.blocks.iter().zip(forms).enumerate() {
        for (place, form) in forms.iter().enumerate() {
            let value = form.determinant(spelling.pool).value;
            let value = value.map(|value| spelling.written(value));
            let never = value.is_some_and(|value| {
                let graph = &spelling.pool.graph;
                graph.is_fixed(value) && value != zero
            });
            let words = (!never).then(|| {
                known.singular_words(&form.singular(), block, spelling.pool, spelling.system)
            });
            let pins = known.loop_pins(&form.singular(), block, spelling.pool, spelling.system);
            poses.push(SingularPose {
                pins: pins.map(|pins| pins.join("-")),
                block: number,
                part: place,
                unknowns: spelling.phrase(&enumerated(&names(&form.unknowns()))),
                method: form.name(),
                determinant: value.and_then(|value| unsigned(value, spelling)),
                meaning: words.as_ref().map(|words| spelling.phrase(&words.points)),
                said: words.map(|words| spelling.phrase(&words.bodies)),
            });
            for unknown in form.unknowns() {
                known.find(unknown, number);
            }
        }
        for definition in &block.definitions {
            let value = spelling.written(definition.value);
            known.find(definition.unknown, number);
            if spelling.graph().is_fixed(value) {
                let symbol = spelling.system.vector_form.unknowns[definition.unknown].position;
                spelling.replace(symbol, value);
            }
        }
    }
    poses
}

/// Determinant as a formula without its sign; `None` if it is too long.
fn unsigned(value: ExprId, spelling: &mut Spelling<'_>) -> Option<String> {
    if !spelling
        .parts
        .is_within(&spelling.pool.graph, value, LONGEST_FORMULA)
    {
        return None;
    }
    let mut text = spelling.formula_as_is(value);
    if text.starts_with(spelling.script.minus()) {
        let minus = spelling.graph().negate(value);
        text = spelling.formula_as_is(minus);
    }
    (spelling.script.length_of(&text) <= MAX_DETERMINANT_LENGTH)
        .then(|| spelling.script.inline(&text))
}
