//! A plan → its summary in a sentence and in a table.

use super::document::OutlineLine;
use super::geometry::pin;
use super::words::{counted, enumerated};
use super::writer::Writer;
use crate::structure::Step;

impl Writer<'_> {
    /// How many unknowns are found in which way.
    pub(super) fn summary(&self) -> String {
        let blocks = &self.plan.blocks;
        let explicit: usize = blocks.iter().map(|block| block.definitions.len()).sum();
        let steps = || blocks.iter().flat_map(|block| &block.steps);
        let count = |is: fn(&Step) -> bool| steps().filter(|step| is(step)).count();
        let linear = count(|step| matches!(step, Step::Linear { .. }));
        let angles = count(|step| matches!(step, Step::OneAngle { .. }));
        let dyads = count(|step| matches!(step, Step::TwoRotations { .. }));
        let slides = count(|step| {
            matches!(
                step,
                Step::RotationAndSlide { .. } | Step::TurningSlide { .. }
            )
        });
        let lines = count(|step| matches!(step, Step::TwoSlides { .. }));
        let mut parts = Vec::new();
        let mut part = |number: usize, words: String| {
            if number > 0 {
                parts.push(words);
            }
        };
        part(explicit, format!("{explicit} by explicit formulas"));
        part(linear, format!("{linear} by a linear equation"));
        part(
            angles,
            format!("{} in closed form", counted(angles, "angle", "angles")),
        );
        part(
            dyads,
            format!(
                "{} of two angles in closed form",
                counted(dyads, "dyad", "dyads")
            ),
        );
        part(
            slides,
            format!(
                "{} of an angle and a slide in closed form",
                counted(slides, "pair", "pairs")
            ),
        );
        part(
            lines,
            format!(
                "{} of slides in closed form",
                counted(lines, "pair", "pairs")
            ),
        );
        let unknowns = counted(
            self.system.vector_form.unknowns.len(),
            "unknown",
            "unknowns",
        );
        let sizes: Vec<String> = steps()
            .filter_map(|step| match step {
                Step::Newton { unknowns, .. } => Some(unknowns.len().to_string()),
                _ => None,
            })
            .collect();
        let newton = match sizes[..] {
            [] => "no Newton-Raphson".to_string(),
            _ => format!("Newton-Raphson for {} at once", enumerated(&sizes)),
        };
        format!("{unknowns}: {}; {newton}", parts.join(", "))
    }

    /// One line for each step and one for what follows from them.
    pub(super) fn outline(&self) -> Vec<OutlineLine> {
        let mut lines = Vec::new();
        for (number, block) in self.plan.blocks.iter().enumerate() {
            let names = |unknowns: &[usize]| {
                let names = unknowns.iter().map(|&unknown| self.named(unknown));
                names.collect::<Vec<_>>().join(", ")
            };
            let mut found: Vec<(String, String)> = block
                .steps
                .iter()
                .map(|step| (names(&step.unknowns()), step.name()))
                .collect();
            if !block.definitions.is_empty() {
                let defined: Vec<usize> = block.definitions.iter().map(|it| it.unknown).collect();
                found.push((names(&defined), "explicit".to_string()));
            }
            let joints: Vec<String> = block.joints.iter().map(|&it| self.joint_name(it)).collect();
            for (place, (unknowns, method)) in found.into_iter().enumerate() {
                let first = |text: String| if place == 0 { text } else { String::new() };
                lines.push(OutlineLine {
                    block: first((number + 1).to_string()),
                    unknowns,
                    method,
                    joints: first(joints.join(", ")),
                });
            }
        }
        lines
    }

    /// A pin by its point, any other joint by its statement.
    pub(super) fn joint_name(&self, joint: usize) -> String {
        let joint = &self.system.mechanism.joints[joint];
        let pin = match joint.operands.marks[..] {
            [first, second] if joint.kind.joins_points() => {
                pin(&self.system.mechanism, [first, second])
            }
            _ => None,
        };
        self.script
            .word(pin.as_ref().map_or(&joint.label, |pin| &pin.name))
    }
}
