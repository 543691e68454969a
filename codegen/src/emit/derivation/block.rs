//! One block of the plan → its section.

use super::words::enumerated;
use super::writer::Writer;
use crate::expr::SymbolId;
use crate::structure::{SolvedBlock, Step};

impl Writer<'_> {
    /// Writes the block's section and returns its heading.
    pub(super) fn block(&mut self, number: usize, block: &SolvedBlock) -> String {
        let mut sources = Vec::new();
        for step in &block.steps {
            sources.push(match step {
                Step::Linear {
                    unknown,
                    coefficient,
                    rest,
                } => self.linear(*unknown, *coefficient, *rest),
                Step::OneAngle {
                    unknown,
                    cosine,
                    sine,
                    rest,
                    equation,
                } => self.one_angle(*unknown, [*cosine, *sine, *rest], *equation),
                Step::TwoRotations {
                    first,
                    second,
                    p,
                    q,
                    closure,
                } => self.two_rotations([*first, *second], [*p, *q], *closure),
                Step::RotationAndSlide {
                    angle,
                    slide,
                    p,
                    direction,
                    closure,
                } => self.rotation_and_slide([*angle, *slide], *p, *direction, *closure),
                Step::TurningSlide {
                    angle,
                    slide,
                    p,
                    u,
                    closure,
                } => self.turning_slide([*angle, *slide], *p, *u, *closure),
                Step::TwoSlides {
                    first,
                    second,
                    directions,
                    closure,
                } => self.two_slides([*first, *second], *directions, *closure),
                Step::Newton {
                    unknowns,
                    residuals,
                    ..
                } => self.newton(unknowns, residuals),
            });
            for unknown in step.unknowns() {
                self.found(unknown, number, None);
            }
        }
        if block.steps.is_empty() {
            sources.push(self.explicit_source(block));
        }
        self.definitions(number, block);
        let headings: Vec<String> = if block.steps.is_empty() {
            vec![format!("{} {}", self.what(block), sources.join(""))]
        } else {
            let pairs = block.steps.iter().zip(&sources);
            pairs
                .map(|(step, source)| {
                    let names: Vec<String> =
                        step.unknowns().iter().map(|&it| self.named(it)).collect();
                    format!("{} {source}", enumerated(&names))
                })
                .collect()
        };
        format!("Block {}. {}", number + 1, headings.join("; "))
    }

    /// What a block without a step finds: by name where they are few.
    fn what(&self, block: &SolvedBlock) -> String {
        const FEW: usize = 6;
        let names: Vec<String> = block
            .definitions
            .iter()
            .map(|definition| self.named(definition.unknown))
            .collect();
        if names.len() <= FEW {
            enumerated(&names)
        } else {
            format!("{} unknowns", names.len())
        }
    }

    /// What a block without a step starts from.
    fn explicit_source(&self, block: &SolvedBlock) -> String {
        let mechanism = &self.system.mechanism;
        let drives = |symbol: SymbolId| {
            let mut inputs = mechanism.inputs.iter();
            symbol == mechanism.time || inputs.any(|input| input.symbols[0] == symbol)
        };
        let graph = &self.system.mechanism.graph;
        let driven = block
            .definitions
            .iter()
            .any(|definition| graph.symbols(definition.value).iter().copied().any(drives));
        let constant = block
            .definitions
            .iter()
            .any(|definition| graph.is_fixed(definition.value));
        let words = match (constant, driven) {
            (true, true) => "from what is fixed and what is driven",
            (false, true) => "from the drivers",
            _ => "from what is fixed",
        };
        words.to_string()
    }
}
