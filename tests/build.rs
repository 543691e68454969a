//! Generates the modules of the tests, and lists of them.
//!
//! The mechanisms are those that only tests need and the repository's; two of the former and those of the study of
//! stability are generated in single precision too. Variants of all have the transmissions of their drivers, those
//! with parameters their sensitivities, and some are monitored. A list compares every module with the interpreter.
//! Some of the repository's mechanisms are written into the middle of Rust code.

mod chains;
mod comparing;
mod described;
mod monitoring;
#[path = "src/pantograph.rs"]
mod pantograph;
mod registry;
mod sensing;
mod single_study;
mod transmitting;

use std::fs;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Options, Scalar, generate, write_module};
use registry::Listed;

fn main() {
    linkwright_codegen::build("descriptions");
    let single = Options {
        scalar: Scalar::F32,
        ..Options::default()
    };
    linkwright_codegen::build_with("../mechanisms", &single);
    linkwright_codegen::build("stability");
    linkwright_codegen::build_with(single_study::write("stability"), &single);
    for name in ["tables", "winch"] {
        let file = format!("{name}.mech");
        let text = fs::read_to_string(format!("descriptions/{file}")).expect("the description");
        // A mechanism with errors is reported by its own build.
        if let Ok(module) = generate(&Source::new(&file, text), &single) {
            write_module(&format!("{name}_single"), module.code()).expect("the module is written");
        }
    }
    write_counted();
    monitoring::write(&["descriptions", "../mechanisms"]);
    list_modules();
    write_in_code();
    chains::write();
    sensing::write("descriptions");
    transmitting::write(&["descriptions", "../mechanisms"]);
    comparing::write("descriptions", "../mechanisms");
}

/// A mechanism whose module calls elementary functions of the test that includes it.
fn write_counted() {
    let options = Options {
        math: Some("crate::math::Counting".to_string()),
        ..Options::default()
    };
    let text = fs::read_to_string("../mechanisms/four_bar.mech").expect("the description");
    if let Ok(module) = generate(&Source::new("four_bar.mech", text), &options) {
        write_module("counted_four_bar", module.code()).expect("the module is written");
    }
}

/// Writes descriptions of the repository as a user of the macro would.
fn write_in_code() {
    let invocations = [
        "four_bar",
        "excavator",
        "cam_dwell",
        "rack_steering",
        "platform_3rpr",
        "jansen",
    ]
    .map(|name| {
        let path = format!("../mechanisms/{name}.mech");
        let text = fs::read_to_string(path).expect("the description");
        let text = text.replacen("\nmechanism ", "\npub mechanism ", 1);
        format!("linkwright_macros::mechanism! {{\n{text}}}\n")
    });
    registry::write("in_code.rs", &invocations.concat());
}

/// Lists the repository's mechanisms, and generates each in single precision.
fn list_modules() {
    let (mut double, mut single) = (String::new(), String::new());
    for Listed {
        name, mechanism, ..
    } in registry::listed("../mechanisms")
    {
        let module = format!("linkwright_mechanisms::{name}");
        double +=
            &format!("    Module::of::<{module}::{mechanism}, {module}::Textbook, _>({name:?}),\n");
        single += &format!(
            "/// `{name}` in single precision.\npub mod {name} {{\n    linkwright::include_mechanism!({name});\n}}\n"
        );
    }
    let list =
        format!("/// Every compiled module.\npub const MODULES: &[Module] = &[\n{double}];\n");
    registry::write("modules.rs", &list);
    registry::write("single_modules.rs", &single);
}
