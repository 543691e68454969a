//! One block of the plan → its function: positions, then rates, then accelerations, then responses to each direction.

use super::builder::Builder;
use super::evaluation::{evaluated, functions_of_time, note_constants};
use super::responses::Responses;
use super::sharing::calls_functions;
use super::spoken::spoken;
use super::{Action, BlockProgram, Level, Measured, NewtonBlock};
use crate::expr::ExprId;
use crate::program::constants::Constants;
use crate::structure::{SolvedBlock, Step};
use crate::system::System;

/// What a step's rates are found from, kept until all positions of the block are.
pub(super) enum Pending {
    TwoRotations(super::two_rotations::Triangle),
    OneAngle(super::one_angle::Root),
    Slide(super::slides::Slide),
    TwoSlides(super::slides::Lines),
    Linear {
        unknown: usize,
        coefficient: ExprId,
        equation: ExprId,
    },
}

impl Pending {
    /// The determinant of the step up to its sign, as it was computed on the way.
    pub(super) fn determinant(&self) -> ExprId {
        match self {
            Pending::TwoRotations(triangle) => triangle.determinant(),
            Pending::OneAngle(root) => root.determinant(),
            Pending::Slide(slide) => slide.determinant(),
            Pending::TwoSlides(lines) => lines.determinant(),
            Pending::Linear { coefficient, .. } => *coefficient,
        }
    }
}

/// The same with what all levels share.
enum Motion {
    TwoRotations(super::two_rotations::DyadMotion),
    OneAngle(super::one_angle::Root),
    Slide(super::slides::SlideMotion),
    TwoSlides(super::slides::Lines, super::two_rotations::Closing),
    Linear {
        unknown: usize,
        coefficient: ExprId,
        equation: ExprId,
    },
}

impl Builder<'_> {
    fn motion(&mut self, pending: Pending) -> Motion {
        match pending {
            Pending::TwoRotations(triangle) => {
                Motion::TwoRotations(self.two_rotation_motion(&triangle))
            }
            Pending::OneAngle(root) => Motion::OneAngle(root),
            Pending::Slide(slide) => Motion::Slide(self.slide_motion(&slide)),
            Pending::TwoSlides(lines) => {
                let (lines, closing) = self.two_slide_motion(&lines);
                Motion::TwoSlides(lines, closing)
            }
            Pending::Linear {
                unknown,
                coefficient,
                equation,
            } => Motion::Linear {
                unknown,
                coefficient,
                equation,
            },
        }
    }

    fn rates(&mut self, motion: &Motion, level: Level) {
        match motion {
            Motion::TwoRotations(dyad) => self.two_rotation_rates(dyad, level),
            Motion::OneAngle(root) => self.one_angle_rates(root, level),
            Motion::Slide(slide) => self.slide_rates(slide, level),
            Motion::TwoSlides(lines, closing) => self.two_slide_rates(lines, closing, level),
            Motion::Linear {
                unknown,
                coefficient,
                equation,
            } => {
                self.linear_rates(*unknown, *coefficient, *equation, level);
            }
        }
    }
}

pub(super) fn lower_block(
    system: &mut System,
    block: &SolvedBlock,
    drawn: &[f64],
    branches: &mut Vec<super::Branch>,
    responses: &mut Responses,
    constants: &mut Constants,
) -> BlockProgram {
    let first_branch = branches.len();
    let mut builder = Builder {
        system,
        actions: Vec::new(),
        branches,
        drawn,
        defined: Vec::new(),
        responses,
        stretched: 0,
    };
    let mut pending = Vec::new();
    let mut newton: Option<NewtonBlock> = None;
    let mut measured = Vec::new();
    for step in &block.steps {
        let names: Vec<String> = step
            .unknowns()
            .into_iter()
            .map(|unknown| builder.system.unknown_name(unknown).to_string())
            .collect();
        builder.comment(format!(
            "Position: {} for {}.",
            step.name(),
            names.join(" and ")
        ));
        match step {
            Step::Linear {
                unknown,
                coefficient,
                rest,
            } => {
                let position = builder.position(*unknown);
                let product = builder.graph().multiply(*coefficient, position);
                let equation = builder.graph().add(product, *rest);
                let coefficient = builder.linear(*unknown, *coefficient, *rest);
                pending.push(Pending::Linear {
                    unknown: *unknown,
                    coefficient,
                    equation,
                });
            }
            Step::OneAngle {
                unknown,
                cosine,
                sine,
                rest,
                equation,
            } => {
                pending.push(Pending::OneAngle(
                    builder.one_angle(*unknown, *cosine, *sine, *rest, *equation),
                ));
            }
            Step::TwoRotations {
                first,
                second,
                p,
                q,
                closure,
            } => {
                pending.push(Pending::TwoRotations(builder.two_rotations(
                    [*first, *second],
                    *p,
                    *q,
                    *closure,
                )));
            }
            Step::RotationAndSlide {
                angle,
                slide,
                p,
                direction,
                closure,
            } => {
                pending.push(Pending::Slide(builder.rotation_and_slide(
                    [*angle, *slide],
                    *p,
                    *direction,
                    *closure,
                )));
            }
            Step::TurningSlide {
                angle,
                slide,
                p,
                u,
                closure,
            } => {
                pending.push(Pending::Slide(builder.turning_slide(
                    [*angle, *slide],
                    *p,
                    *u,
                    *closure,
                )));
            }
            Step::TwoSlides {
                first,
                second,
                directions,
                closure,
            } => {
                pending.push(Pending::TwoSlides(builder.two_slides(
                    [*first, *second],
                    *directions,
                    *closure,
                )));
            }
            Step::Newton {
                unknowns,
                residuals,
                quantities,
            } => newton = Some(builder.newton(unknowns, residuals, quantities)),
        }
        if builder.system.mechanism.monitor {
            match &mut newton {
                Some(newton) if matches!(step, Step::Newton { .. }) => {
                    let measure = builder.measured_block(step);
                    newton.measure = Some(measure);
                    measured.push(Measured::Block(measure));
                }
                _ => {
                    let found = pending.last();
                    measured.extend(found.and_then(|found| builder.measured(step, found)));
                }
            }
        }
    }
    for definition in &block.definitions {
        let symbol = builder.system.vector_form.unknowns[definition.unknown].position;
        builder.assign(symbol, definition.value);
        builder.explicit_angle(definition.unknown);
    }
    builder.actions.push(Action::Section(Level::Velocity));
    let motions: Vec<Motion> = pending
        .into_iter()
        .map(|step| builder.motion(step))
        .collect();
    for level in builder.levels() {
        if level != Level::Velocity {
            builder.actions.push(Action::Section(level));
        }
        if let Some(newton) = &newton {
            builder.newton_response(newton, level);
        }
        for motion in &motions {
            builder.rates(motion, level);
        }
        for definition in &block.definitions {
            let rate = builder.rate_at(definition.value, level);
            builder.find(definition.unknown, level, rate);
        }
    }
    builder.without_shifts(newton.as_mut());
    let actions = builder.actions;
    let expressions = evaluated(&actions, newton.as_ref());
    let time = functions_of_time(&expressions, system, constants);
    // Where functions of unknowns are shared, what is written out is known only then.
    if !calls_functions(expressions.iter().copied(), &time, &system.mechanism.graph) {
        note_constants(&expressions, system, &time, constants);
    }
    let joints: Vec<&str> = block
        .joints
        .iter()
        .map(|&joint| system.mechanism.joints[joint].slug.as_str())
        .collect();
    let how = block
        .steps
        .first()
        .map_or("explicit".to_string(), Step::name);
    let labels: Vec<&str> = block
        .joints
        .iter()
        .map(|&joint| system.mechanism.joints[joint].label.as_str())
        .collect();
    BlockProgram {
        name: block_name(block, system, &joints),
        title: format!("{}: {}.", capitalized(&how), labels.join(", ")),
        spoken: spoken(block, system),
        place: None,
        joints: block.joints.clone(),
        time,
        shared: None,
        actions,
        newton,
        reads_branch: branches.len() > first_branch,
        measured,
    }
}

/// `loop_l_g_h`: named joints, or else the first of the others.
fn block_name(block: &SolvedBlock, system: &System, slugs: &[&str]) -> String {
    let pins: Vec<&str> = block
        .joints
        .iter()
        .zip(slugs)
        .filter(|(joint, _)| system.mechanism.joints[**joint].kind.joins_points())
        .map(|(_, slug)| *slug)
        .collect();
    if block.steps.is_empty() {
        return "explicit".to_string();
    }
    let named = if pins.is_empty() { slugs } else { &pins[..] };
    format!("loop_{}", named[..named.len().min(6)].join("_"))
}

fn capitalized(text: &str) -> String {
    let mut characters = text.chars();
    characters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(characters).collect()
    })
}
