//! Writes the derivation of the solution block by block, and the singular poses.

use std::fmt::Write as _;

use linkwright_codegen::stages::emit::derivation::{Derivation, Script, singular_poses};
use linkwright_codegen::stages::emit::markup::escaped;
use linkwright_solver::number::time;
use linkwright_solver::{Check, View as _};

use super::number::number;

/// Normalized determinant below which it counts as zero.
const ZERO_DETERMINANT: f64 = 1e-9;

/// Returns the plan as a table and the derivation of each block.
pub fn derivation(check: &Check) -> String {
    let (derived, plan) = (check.interpreted.derived(), check.interpreted.plan());
    let derived = Derivation::of_plan(derived.clone(), plan.clone()).html();
    let mut text = format!(
        "<p>{}.</p>\n<div class=\"wide\" tabindex=\"0\"><table><thead><tr><th>Block</th><th>Unknowns</th><th>Method</th><th>Joints</th></tr></thead><tbody>\n{}</tbody></table></div>\n",
        derived.summary, derived.outline
    );
    // The last section is about singular poses, which have their own section of the page.
    for (place, section) in derived.sections.iter().enumerate().take(plan.blocks.len()) {
        let joints: Vec<String> = plan.blocks[place]
            .joints
            .iter()
            .map(|joint| format!("j{joint}"))
            .collect();
        let _ = writeln!(
            text,
            "<section class=\"block\" id=\"block-{}\" data-joints=\"{}\">\n<h3>{}</h3>\n{}</section>",
            place + 1,
            joints.join(" "),
            section.heading,
            // A step is for the keyboard as well.
            section.body.replace(
                "<div class=\"equation\">",
                "<div class=\"equation\" tabindex=\"0\">"
            )
        );
    }
    text
}

/// Returns the singular poses of each block, and the closest approach of the motion to them.
///
/// The approach is left out if the displayed assembly is not the checked one.
pub fn singular(check: &Check, determinant: Option<f64>, is_checked: bool) -> String {
    let program = check.interpreted.program();
    let (system, plan) = (check.interpreted.system(), check.interpreted.plan());
    let poses = singular_poses(
        check.interpreted.pool(),
        system,
        plan,
        &program.forms,
        Script::Html,
    );
    let mut text = String::from(
        "<p>A pose is singular where det Φ<sub>q</sub> = 0. Up to its sign, det Φ<sub>q</sub> is the product of the determinants of the blocks, so that it is zero exactly where one of them is.</p>\n",
    );
    let mut measured = 0;
    for (pose, part) in poses.iter().zip(&check.parts) {
        let verdict = match &part.approach {
            _ if pose.meaning.is_none() || !is_checked => String::new(),
            None => String::new(),
            Some(approach) => {
                let at = time(approach.instant.t());
                let attribute = format!(" data-is=\"m{measured}\"");
                measured += 1;
                if approach.crosses || approach.measure < ZERO_DETERMINANT {
                    format!(" <b{attribute}>The motion reaches such a pose at t = {at} s.</b>")
                } else {
                    let range = check.range.unwrap_or([check.start; 2]).map(time);
                    format!(
                        " <span{attribute}>From t = {} s to {} s it is not zero: divided by the lengths of its columns it is smallest at t = {at} s, where it is {} (0: singular, 1: as far from singular as possible).</span>",
                        range[0],
                        range[1],
                        number(approach.measure)
                    )
                }
            }
        };
        let _ = writeln!(
            text,
            "<p class=\"pose\" tabindex=\"0\"><b>Block {}</b>, {}, {}: {}{verdict}</p>",
            pose.block + 1,
            pose.unknowns,
            escaped(&pose.method),
            pose.sentence(),
        );
    }
    if let Some(determinant) = determinant {
        let _ = writeln!(
            text,
            "<p>At t = {} s, det Φ<sub>q</sub> = <b>{}</b> in SI units, with the rows in the order of Φ.</p>",
            time(check.start),
            number(determinant)
        );
    }
    text
}
