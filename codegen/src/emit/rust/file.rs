//! Writes the file: the module of a mechanism, or one module for each of its motions.

use super::lints;
use super::names::{WORDS, identifier};
use crate::emit::code::Code;
use crate::emit::language::Form;
use crate::emit::layout::Lists;
use crate::emit::module::{Module, documentation, facts};
use crate::solved::Solved;

/// The source of the generated file, with a header of comments. A mechanism with motions becomes one module for each.
pub fn file(motions: &[Solved], form: Form<'_>) -> String {
    let motions = motions.iter();
    let modules = motions.map(|solved| Module::new(solved, form.scalar, WORDS));
    let modules: Vec<Module<'_>> = modules.collect();
    let Some(first) = modules.first() else {
        return String::new();
    };
    let mechanism = &first.system.mechanism;
    let mut code = Code::default();
    code.header(&facts::origin(first));
    code.header("");
    match mechanism.motion {
        None => {
            facts::facts(first)
                .iter()
                .for_each(|line| code.header(line));
            code.gap();
            first.items(form, &mut code);
        }
        Some(_) => {
            let names = modules
                .iter()
                .filter_map(|module| module.system.mechanism.motion.as_ref());
            let names: Vec<String> = names.map(|motion| format!("`{}`", motion.name)).collect();
            code.header(&format!("A module for each motion: {}.", names.join(", ")));
            for module in &modules {
                motion(module, form, &mut code);
            }
        }
    }
    code.finish(Lists::Apart)
}

/// Writes the module of one motion. Users may leave modules of other motions unused.
fn motion(module: &Module<'_>, form: Form<'_>, code: &mut Code) {
    let Some(motion) = &module.system.mechanism.motion else {
        return;
    };
    let mut inside = Code::default();
    facts::facts(module)
        .iter()
        .for_each(|line| inside.remark(line));
    module.items(form, &mut inside);
    let mut item = Code::default();
    item.block(&format!("pub mod {}", identifier(&motion.name)), inside);
    let allow = lints::of_module(&motion.name).into_iter();
    let allow = allow.chain(["#[allow(dead_code)]"]);
    code.item(documentation::of_motion(module.system), allow, item);
}

impl Code {
    /// Adds a line to the comment at the head of a file.
    fn header(&mut self, line: &str) {
        self.whole(format!("// {line}").trim_end());
    }
}
