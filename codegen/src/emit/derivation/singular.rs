//! The determinant of each step → where the step is singular, as a formula and in the geometry's own words.
//!
//! Words name pins and bodies as the description does. What they say is the equation det = 0 of the closed form and nothing
//! else: which of the poses where it holds a motion comes to is not known here.

use super::document::{Item, Section};
use super::writer::Writer;
use crate::expr::ExprId;
use crate::structure::{SolvedBlock, Step, determinant};

/// The longest formula that is shown.
const LONGEST: usize = 400;

/// Where a step of the plan is singular.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SingularPose {
    /// The block, from 0.
    pub block: usize,
    /// The step in its block, from 0.
    pub step: usize,
    /// What the step finds: `phi2`, `phi_c3 and phi_c10`.
    pub unknowns: String,
    /// How: `two rotations`.
    pub method: String,
    /// The determinant of the step's Jacobian up to its sign; `None` where there is no closed form, or none that a person would
    /// read.
    pub determinant: Option<String>,
    /// What the pose is like where the determinant is zero: `A-B and B-C are in line`. `None` where it never is.
    pub meaning: Option<String>,
    /// The same of bodies, as a message says it: `crank and coupler are in line`. `None` where it never is.
    pub said: Option<String>,
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

impl Writer<'_> {
    /// The last section of a derivation; none where everything is explicit.
    pub(super) fn singular_section(&self) -> Option<Section> {
        let mut writer = Writer::new(&self.system, self.plan, self.script);
        writer.parts = self.parts.clone();
        let poses = writer.singular_poses();
        let items = poses.iter().map(|pose| {
            Item::Paragraph(format!(
                "Block {}, {}: {}",
                pose.block + 1,
                pose.unknowns,
                pose.sentence()
            ))
        });
        (!poses.is_empty()).then(|| Section {
            heading: "Singular poses, by the determinant of each block up to its sign".to_string(),
            items: items.collect(),
        })
    }

    /// Where each step is singular, in solve order.
    pub(super) fn singular_poses(mut self) -> Vec<SingularPose> {
        let plan = self.plan;
        // A determinant stands alone: only what the page has defined already may be written by its name.
        self.parts = self.parts.settled();
        let mut found = Vec::new();
        for (number, block) in plan.blocks.iter().enumerate() {
            for (place, step) in block.steps.iter().enumerate() {
                found.push(self.singular_pose(number, place, step, block));
                for unknown in step.unknowns() {
                    self.found(unknown, number, None);
                }
            }
            for definition in &block.definitions {
                let value = self.with_numbers(definition.value);
                self.found(definition.unknown, number, Some(value));
            }
        }
        found
    }

    fn singular_pose(
        &mut self,
        block: usize,
        place: usize,
        step: &Step,
        solved: &SolvedBlock,
    ) -> SingularPose {
        let names: Vec<String> = step.unknowns().iter().map(|&it| self.named(it)).collect();
        let value = {
            let graph = &mut self.system.mechanism.graph;
            determinant(step, &self.system.vector_form, graph).value
        };
        let value = value.map(|value| self.with_numbers(value));
        // What moves a driver for the sake of a derivative is zero.
        let shifts: Vec<_> = {
            let directions = self.system.directions.iter();
            let drivers = directions.filter(|direction| !direction.is_parameter());
            drivers.map(|direction| direction.symbol).collect()
        };
        let value = value.map(|value| {
            let zero = self.graph().zero();
            let replaced: Vec<_> = shifts.iter().map(|&symbol| (symbol, zero)).collect();
            self.graph().substitute(value, &replaced)
        });
        let never = value.is_some_and(|value| {
            let graph = self.graph();
            graph.is_fixed(value) && value != graph.zero()
        });
        let words = (!never).then(|| self.singular_words(step, solved));
        SingularPose {
            block,
            step: place,
            unknowns: super::words::enumerated(&names),
            method: step.name(),
            determinant: value.and_then(|value| self.unsigned(value)),
            meaning: words.as_ref().map(|words| words.points.clone()),
            said: words.map(|words| words.bodies),
        }
    }

    /// A determinant as a formula without its sign; `None` where it is too long to be read.
    fn unsigned(&mut self, value: ExprId) -> Option<String> {
        let text = self.formula(value);
        let text = if text.starts_with(['-', '−']) {
            let minus = self.graph().negate(value);
            self.formula(minus)
        } else {
            text
        };
        (text.chars().count() <= LONGEST).then(|| self.script.inline(&text))
    }
}
