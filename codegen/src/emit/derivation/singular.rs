//! The determinant of each step → where the step is singular, as a formula and in the geometry's own words.
//!
//! Words name pins and bodies as the description does. What they say is the equation det = 0 of the closed form and nothing
//! else: which of the poses where it holds a motion comes to is not known here.

use super::document::{Item, Section};
use super::writer::Writer;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::structure::{Step, determinant};
use crate::system::Arm;

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
                found.push(self.singular_pose(number, place, step));
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

    fn singular_pose(&mut self, block: usize, place: usize, step: &Step) -> SingularPose {
        let names: Vec<String> = step.unknowns().iter().map(|&it| self.named(it)).collect();
        let value = {
            let graph = &mut self.system.mechanism.graph;
            determinant(step, &self.system.vector_form, graph).value
        };
        let value = value.map(|value| self.with_numbers(value));
        let never = value.is_some_and(|value| {
            let graph = self.graph();
            graph.is_fixed(value) && value != graph.zero()
        });
        SingularPose {
            block,
            step: place,
            unknowns: super::words::enumerated(&names),
            method: step.name(),
            determinant: value.and_then(|value| self.unsigned(value)),
            meaning: (!never).then(|| self.meaning(step)),
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

    fn meaning(&mut self, step: &Step) -> String {
        match step {
            Step::Linear { unknown, .. } => {
                format!("{} drops out of its equation", self.named(*unknown))
            }
            Step::OneAngle {
                unknown, equation, ..
            } => self.meaning_of_one_angle(*unknown, *equation),
            Step::TwoRotations {
                first,
                second,
                p,
                q,
                ..
            } => match self.triangle([*first, *second], [*p, *q]) {
                Some(triangle) => {
                    let [a, b] = [0, 1].map(|side| &triangle.outer[side].0.name);
                    let [a, apex, b] = [a, &triangle.apex.name, b].map(|it| self.script.word(it));
                    format!("{a}-{apex} and {apex}-{b} are in line")
                }
                None => format!(
                    "{} and {} are in line",
                    self.turning_vector(*first),
                    self.turning_vector(*second)
                ),
            },
            Step::RotationAndSlide {
                angle, slide, p, ..
            } => {
                let link = self.link_or_vector(*angle, *p);
                let slide = self.named(*slide);
                format!("{link} is perpendicular to the line along which {slide} is measured")
            }
            Step::TurningSlide {
                angle, slide, p, ..
            } => {
                let zero = self.graph().zero();
                let (angle, slide) = (self.named(*angle), self.named(*slide));
                if *p == [zero, zero] {
                    format!("the points between which {slide} is measured coincide")
                } else {
                    format!(
                        "the line that {angle} turns is perpendicular to the vector between the two points that {slide} keeps on it"
                    )
                }
            }
            Step::TwoSlides { first, second, .. } => format!(
                "the lines along which {} and {} are measured are parallel",
                self.named(*first),
                self.named(*second)
            ),
            Step::Newton { unknowns, .. } => {
                let names: Vec<String> = unknowns.iter().map(|&it| self.named(it)).collect();
                format!(
                    "{} can move although {} stands still",
                    super::words::enumerated(&names),
                    match names.len() {
                        1 => "everything before it",
                        _ => "everything before them",
                    }
                )
            }
        }
    }

    /// An equation measures a turned vector along one direction; it is stationary where both are parallel.
    fn meaning_of_one_angle(&mut self, unknown: usize, equation: ExprId) -> String {
        let arms: Vec<Arm> = self.system.vector_form.arms_of(unknown).cloned().collect();
        let zero = self.graph().zero();
        let mut measured = Vec::new();
        for arm in arms {
            let slopes = arm
                .symbols
                .map(|symbol| self.graph().derivative(equation, symbol));
            if slopes != [zero, zero] {
                measured.push((arm.local, slopes));
            }
        }
        let name = self.named(unknown);
        let &[(local, slopes)] = &measured[..] else {
            return format!("{name} is at an end of its range, where its two solutions meet");
        };
        let link = self.link_or_vector(unknown, local);
        let direction = match slopes.map(|slope| slope == zero) {
            [false, true] => "the x axis".to_string(),
            [true, false] => "the y axis".to_string(),
            _ => {
                let slopes = slopes.map(|slope| self.with_numbers(slope));
                let pair = self.pair_text(slopes);
                format!("the direction {}", self.script.inline(&pair))
            }
        };
        format!("{link} is parallel to {direction}")
    }

    /// `K-L`, or what turns with the angle where the ends have no names.
    fn link_or_vector(&mut self, angle: usize, p: Vector) -> String {
        match self.link(angle, p, |_, _| true) {
            Some((link, _, _)) => format!(
                "{}-{}",
                self.script.word(&link.from.name),
                self.script.word(&link.to.name)
            ),
            None => match self.known_pins(angle).first() {
                Some((pin, _)) => {
                    let pin = self.script.word(&pin.name);
                    format!("{} from {pin}", self.turning_vector(angle))
                }
                None => self.turning_vector(angle),
            },
        }
    }

    /// `the link of crank`.
    fn turning_vector(&self, angle: usize) -> String {
        match self.turned_body(angle) {
            Some(body) => format!("the link of {body}"),
            None => format!("the link that {} turns", self.named(angle)),
        }
    }

    /// The body whose angle an unknown is.
    fn turned_body(&self, angle: usize) -> Option<String> {
        let coordinate = self.system.coordinates.get(angle)?;
        let body = coordinate.describes.body()?;
        Some(self.script.word(&self.system.mechanism.bodies[body].name))
    }
}
