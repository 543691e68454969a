//! Summarizes a plan and its solution methods in a sentence and in a table.

use std::sync::Arc;

use super::document::OutlineLine;
use super::script::Script;
use super::spelling::Spelling;
use crate::pool::{Pool, SymbolRole};
use crate::program::forms::Form;
use crate::structure::SolvedPlan;
use crate::system::System;
use crate::words::{counted, pin};

/// Numbers of unknowns by solution method.
pub(super) fn summary(system: &System, plan: &SolvedPlan, forms: &[Vec<Arc<dyn Form>>]) -> String {
    let explicit: usize = plan
        .blocks
        .iter()
        .map(|block| block.definitions.len())
        .sum();
    let unknowns = counted(system.vector_form.unknowns.len(), "unknown", "unknowns");
    let mut parts = Vec::new();
    if explicit > 0 {
        parts.push(format!("{explicit} by explicit formulas"));
    }
    let kinds: [(&str, &str, &str); 6] = [
        ("linear", "", "by a linear equation"),
        ("one angle", "angle", "in closed form"),
        ("RRR dyad", "RRR dyad", "in closed form"),
        ("RRP dyad", "RRP dyad", "in closed form"),
        ("RPR dyad", "RPR dyad", "in closed form"),
        ("PRP or RPP dyad", "PRP or RPP dyad", "in closed form"),
    ];
    let all = || forms.iter().flatten().filter(|form| form.modes().is_some());
    for (name, noun, words) in kinds {
        match (all().filter(|form| form.name() == name).count(), noun) {
            (0, _) => {}
            (number, "") => parts.push(format!("{number} {words}")),
            (number, noun) => {
                let counted = counted(number, noun, &format!("{noun}s"));
                parts.push(format!("{counted} {words}"));
            }
        }
    }
    let iterated = forms.iter().flatten().filter(|form| form.modes().is_none());
    let sizes: Vec<String> = iterated
        .map(|form| {
            let (size, guessed) = (form.unknowns().len(), form.guessed());
            match guessed < size {
                true => format!("{size} (by way of {guessed})"),
                false => size.to_string(),
            }
        })
        .collect();
    let newton = match &sizes[..] {
        [] => "no Newton-Raphson".to_string(),
        [only] => format!("Newton-Raphson for {only} at once"),
        [first @ .., last] => {
            format!("Newton-Raphson for {} and {last} at once", first.join(", "))
        }
    };
    format!("{unknowns}: {}; {newton}", parts.join(", "))
}

/// One line for each subsystem and one for the values that follow from them.
pub(super) fn outline(
    pool: &Pool,
    system: &System,
    plan: &SolvedPlan,
    forms: &[Vec<Arc<dyn Form>>],
    script: Script,
) -> Vec<OutlineLine> {
    let mut draft = pool.draft();
    let spelling = Spelling::new(&mut draft, system, script);
    let names = |unknowns: &[usize]| {
        let names = unknowns
            .iter()
            .map(|&unknown| script.inline(&spelling.symbol(SymbolRole::Position(unknown))));
        names.collect::<Vec<_>>().join(", ")
    };
    let mut lines = Vec::new();
    for (number, (block, forms)) in plan.blocks.iter().zip(forms).enumerate() {
        let mut methods: Vec<(String, String)> = forms
            .iter()
            .map(|form| (names(&form.unknowns()), form.name()))
            .collect();
        if !block.definitions.is_empty() {
            let defined: Vec<usize> = block.definitions.iter().map(|it| it.unknown).collect();
            methods.push((names(&defined), "explicit".to_string()));
        }
        let joints = block
            .joints
            .iter()
            .map(|&it| joint_name(system, it, script));
        let joints: Vec<String> = joints.collect();
        for (place, (unknowns, method)) in methods.into_iter().enumerate() {
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

/// Returns the name of a joint: a pin by its point, any other joint by its statement.
fn joint_name(system: &System, joint: usize, script: Script) -> String {
    let joint = &system.mechanism.joints[joint];
    let pin = match joint.operands.marks[..] {
        [first, second] if joint.kind.joins_points => pin(&system.mechanism, [first, second]),
        _ => None,
    };
    script.word(pin.as_ref().map_or(&joint.label, |pin| &pin.name))
}
