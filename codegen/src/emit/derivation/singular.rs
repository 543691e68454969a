//! The determinant of each part → where the part is singular, as a formula and in the geometry's own words.
//!
//! What the words say is the equation det = 0 of the form and nothing else: which of the poses where it holds a motion comes to is
//! not known here.

use std::sync::Arc;

use super::page::names;
use super::spelling::Spelling;
use crate::emit::named_parts::LONGEST_FORMULA;
use crate::expr::ExprId;
use crate::program::forms::Form;
use crate::structure::SolvedPlan;
use crate::words::{Known, enumerated};

/// The longest formula that is shown.
const LONGEST: usize = 400;

/// Where a part of the plan is singular.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SingularPose {
    /// The block, from 0.
    pub block: usize,
    /// The part in its block, from 0.
    pub part: usize,
    /// What the part finds: `phi2`, `phi_c3 and phi_c10`.
    pub unknowns: String,
    /// How: `two rotations`.
    pub method: String,
    /// The determinant of the part's Jacobian up to its sign; `None` where there is no closed form, or none that a person would
    /// read.
    pub determinant: Option<String>,
    /// What the pose is like where the determinant is zero: `A-B and B-C are in line`. `None` where it never is.
    pub meaning: Option<String>,
    /// The same of bodies, as a message says it: `crank and coupler are in line`. `None` where it never is.
    pub said: Option<String>,
    /// Pins of the loop that two links close: `B-C-D`. `None` for other parts, and where a pin has no name.
    pub pins: Option<String>,
}

impl SingularPose {
    /// One sentence for all of it.
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

/// Where each part is singular, in solve order.
pub(super) fn singular_poses(
    spelling: &mut Spelling<'_>,
    plan: &SolvedPlan,
    forms: &[Vec<Arc<dyn Form>>],
) -> Vec<SingularPose> {
    let mut known = Known::nothing(spelling.system);
    // What moves a driver for the sake of a derivative is zero.
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

/// A determinant as a formula without its sign; `None` where it is too long to be read.
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
    (spelling.script.length_of(&text) <= LONGEST).then(|| spelling.script.inline(&text))
}
