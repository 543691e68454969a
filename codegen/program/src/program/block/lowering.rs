//! Lowers the blocks of a plan to functions: positions, then rates, then accelerations, then responses to each direction.

use std::sync::Arc;

use super::{Block, Branch};
use crate::diagnostic::internal::work_at;
use crate::pool::Pool;
use crate::program::builder::Builder;
use crate::program::directional_derivatives::DirectionalDerivatives;
use crate::program::forms::{Form, recognize};
use crate::program::function::{Function, Level};
use crate::program::path::{Path, Paths};
use crate::structure::{SolvedBlock, SolvedPlan};
use crate::system::System;
use crate::words::Known;

/// State that the blocks of a mechanism share while they are lowered.
pub(in crate::program) struct Lowering<'a> {
    pub pool: &'a mut Pool,
    pub system: &'a System,
    pub plan: &'a SolvedPlan,
    pub branches: Vec<Branch>,
    pub driven: Vec<usize>,
    pub derivatives: DirectionalDerivatives,
    pub known: Known,
    pub paths: Paths,
    /// True if derivations and remarks are requested too.
    pub writes_prose: bool,
    names: Vec<String>,
}

impl<'a> Lowering<'a> {
    pub(in crate::program) fn new(
        pool: &'a mut Pool,
        system: &'a System,
        plan: &'a SolvedPlan,
        writes_prose: bool,
    ) -> Lowering<'a> {
        Lowering {
            derivatives: DirectionalDerivatives::new(pool, system),
            known: Known::nothing(system),
            paths: Paths::new(pool, system),
            branches: Vec::new(),
            driven: Vec::new(),
            names: Vec::new(),
            writes_prose,
            pool,
            system,
            plan,
        }
    }

    /// Returns the function of the next block, which is the block `place` of the plan.
    pub(in crate::program) fn block(&mut self, place: usize, block: &SolvedBlock) -> Block {
        let first = block.joints.first();
        let _work = first.map(|&joint| work_at(self.system.mechanism.joints[joint].span));
        let forms: Vec<Arc<dyn Form>> = block
            .parts
            .iter()
            .map(|part| recognize(part, self.pool, self.system))
            .collect();
        let name = self.set_apart(block_name(block, self.system));
        let how = forms.first().map_or("explicit".to_string(), |it| it.name());
        let labels = block.joints.iter();
        let labels = labels.map(|&joint| self.system.mechanism.joints[joint].label.as_str());
        let title = format!(
            "{}: {}.",
            capitalized(&how),
            labels.collect::<Vec<_>>().join(", ")
        );
        let monitor = self.system.mechanism.monitor;
        let mut builder = Builder::new(self, place);
        if !forms.is_empty() {
            builder.positive(&block.joints);
        }
        let mut solved = Vec::with_capacity(forms.len());
        for form in &forms {
            let solution = form.position(&mut builder);
            for unknown in form.unknowns() {
                builder.known.find(unknown, place);
            }
            if monitor {
                builder.measure(form.as_ref(), solution.as_ref());
            }
            solved.push(solution);
        }
        builder.definitions(block);
        builder.positive(&block.joints);
        builder.section(Level::Velocity);
        for found in &mut solved {
            found.prepare(&mut builder);
        }
        for level in builder.levels() {
            if level != Level::Velocity {
                builder.section(level);
            }
            for found in &solved {
                found.rates(level, &mut builder);
            }
            builder.definition_rates(block, level);
        }
        let transposed = match builder.system.mechanism.forces.need_multipliers() {
            true => solved
                .iter()
                .map(|it| it.transposed(&mut builder))
                .collect(),
            false => Vec::new(),
        };
        let mut newton = solved.into_iter().find_map(|found| found.newton());
        builder.without_shifts(newton.as_mut());
        let (function, measured, page_names, written_out) = builder.finish();
        Block {
            name,
            title,
            place: Some(place),
            joints: block.joints.clone(),
            forms,
            function,
            newton,
            measured,
            transposed,
            page_names,
            written_out,
        }
    }

    /// Returns the verification that these blocks of the plan stay on their path.
    pub(in crate::program) fn path<'b>(
        &mut self,
        blocks: impl Iterator<Item = (usize, &'b SolvedBlock)>,
    ) -> Path {
        Builder::new(self, 0).path(blocks)
    }

    /// Returns the verification for closed forms in series; `None` if a block has another solution method.
    pub(in crate::program) fn closed_path<'b>(
        &mut self,
        blocks: impl Iterator<Item = (usize, &'b SolvedBlock)> + Clone,
    ) -> Option<Function> {
        Builder::new(self, 0).two_links(blocks)
    }

    /// Returns a name that no other block has.
    fn set_apart(&mut self, base: String) -> String {
        let mut name = base.clone();
        let mut number = 2;
        while self.names.contains(&name) {
            name = format!("{base}_{number}");
            number += 1;
        }
        self.names.push(name.clone());
        name
    }
}

/// Names a block after its named joints, otherwise after its first joint: `loop_l_g_h`.
fn block_name(block: &SolvedBlock, system: &System) -> String {
    const NAMED: usize = 6;
    const MAX_NAME_LENGTH: usize = 48;
    if block.parts.is_empty() {
        return "explicit".to_string();
    }
    let joints = || {
        block
            .joints
            .iter()
            .map(|&joint| &system.mechanism.joints[joint])
    };
    let pins: Vec<&str> = joints()
        .filter(|joint| joint.kind.joins_points)
        .map(|joint| joint.slug.as_str())
        .collect();
    let all: Vec<&str> = joints().map(|joint| joint.slug.as_str()).collect();
    let named = if pins.is_empty() { all } else { pins };
    let mut length = 0;
    let fitting = named
        .iter()
        .take(NAMED)
        .enumerate()
        .take_while(|(place, name)| {
            length += name.len() + 1;
            *place == 0 || length <= MAX_NAME_LENGTH
        });
    let count = fitting.count();
    format!("loop_{}", named[..count].join("_"))
}

fn capitalized(text: &str) -> String {
    let mut characters = text.chars();
    characters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(characters).collect()
    })
}
