//! The module of a mechanism, or one module for each of its motions, as formatted source.

use quote::quote;

use super::code::comment;
use super::docs::docs;
use super::layout::laid_out;
use super::lints;
use super::names::{WORDS, identifier};
use super::pieces::{Around, block, formatted};
use crate::emit::module::{Module, documentation, facts};
use crate::emit::scalar::Scalar;
use crate::solved::Solved;

/// The formatted source of the generated file, with a header of comments. A mechanism with motions becomes one module for each.
/// Its elementary functions are the runtime's, or those of the module at the path `math`.
pub fn file(motions: &[Solved], scalar: Scalar, math: Option<&str>) -> String {
    let motions = motions.iter();
    let modules = motions.map(|solved| Module::new(solved, scalar, WORDS));
    let modules: Vec<Module<'_>> = modules.collect();
    let Some(first) = modules.first() else {
        return String::new();
    };
    let mechanism = &first.system.mechanism;
    let mut lines = vec![facts::origin(first), String::new()];
    let items = match mechanism.motion {
        None => {
            lines.extend(facts::facts(first));
            first.items(math, &[])
        }
        Some(_) => {
            let names = modules
                .iter()
                .filter_map(|module| module.system.mechanism.motion.as_ref());
            let names: Vec<String> = names.map(|motion| format!("`{}`", motion.name)).collect();
            lines.push(format!("A module for each motion: {}.", names.join(", ")));
            let motions = modules.iter().map(|module| motion(module, math));
            let motions: Vec<String> = motions.collect();
            motions.join("\n")
        }
    };
    format!("{}\n{items}", header(&lines))
}

/// The module of one motion. Who drives the mechanism in one way need not use the other ways.
fn motion(module: &Module<'_>, math: Option<&str>) -> String {
    let Some(motion) = &module.system.mechanism.motion else {
        return String::new();
    };
    let text = docs(documentation::of_motion(module.system));
    let name = identifier(&motion.name);
    let facts = facts::facts(module);
    let comments = facts.iter().map(|line| comment(line));
    let around = [Around::Module];
    let facts = laid_out(&formatted(comments.collect(), &around));
    let inner = facts + &module.items(math, &around);
    let allow = lints::of_module(&motion.name);
    let head = quote! {
        #text
        #allow
        #[allow(dead_code)]
        pub mod #name
    };
    block(head, &[], &inner)
}

fn header(lines: &[String]) -> String {
    lines
        .iter()
        .map(|line| format!("// {line}").trim_end().to_string() + "\n")
        .collect()
}
