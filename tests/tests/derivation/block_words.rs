//! Names of the blocks, and their singular poses in words, for every described mechanism.

use linkwright_codegen::stages::emit::derivation::Script;
use linkwright_codegen::stages::emit::{Notation, derivation};
use linkwright_tests::description;
use linkwright_tests::plan::solved;

/// `NAME: block NAME, singular WORDS`, a line for each block that can be singular.
fn block_words() -> String {
    let mut text = String::new();
    let mut names = description::names();
    names.extend(description::small());
    // One example of each kind of block beside those of the repository is enough to read.
    let read = [
        "crane",
        "driven_coupler",
        "ellipse",
        "held_at_distance",
        "leveled_slider",
        "pushed_apart",
        "rocking_cams",
        "slotted_link",
        "three_cranks",
        "trammel",
        "turning_guide",
        "two_guides",
    ];
    let described = description::names();
    for name in names {
        for derived in description::motions(&name) {
            let solved = solved(derived);
            let (pool, system, plan) = (solved.pool(), solved.system(), solved.plan());
            let program = solved.program();
            let script = Script::Text(Notation::Ascii);
            let poses = derivation::singular_poses(pool, system, plan, &program.forms, script);
            let words = derivation::block_words(&program.blocks, pool, system, plan, &poses);
            let is_read = described.contains(&name) || read.contains(&name.as_str());
            let mut own_text = format!("{}\n", system.mechanism.title());
            for (block, words) in program.blocks.iter().zip(&words) {
                let block_poses = poses.iter().filter(|pose| Some(pose.block) == block.place);
                for said in block_poses.filter_map(|pose| pose.said.as_ref()) {
                    // Names of unknowns are those of the generated code, and must not reach the user.
                    for unknown in ["psi_", "phi_", "length_", "offset_", " s_"] {
                        assert!(!said.contains(unknown), "{name}: {said}");
                    }
                    own_text.push_str(&format!("  {}: {said}\n", words.name));
                }
            }
            if is_read {
                text.push_str(&own_text);
            }
        }
    }
    text
}

#[test]
fn every_block_has_a_name_and_words_for_its_singular_pose() {
    let text = block_words();
    crate::assert_snapshot("messages", "block_words", &text);
}
