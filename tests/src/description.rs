//! *The name of a mechanism in `mechanisms/`* → *its text and its equations*.

use std::fs;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::system::System;

use crate::files;

/// The names of all described mechanisms, sorted: those of the files `mechanisms/*.mech`.
pub fn names() -> Vec<String> {
    let files = files::with_extension(&files::repository().join("mechanisms"), "mech");
    files
        .iter()
        .map(|path| files::stem(path).to_string())
        .collect()
}

/// The names of the mechanisms that are not limited by `output` statements, so that their frames hold all coordinates, and that
/// have neither parameters nor inputs.
pub fn whole() -> Vec<String> {
    let mut names = names();
    names.retain(|name| {
        let mechanism = system(name).mechanism;
        let given = !mechanism.parameters.is_empty() || !mechanism.inputs.is_empty();
        !given && mechanism.requests.is_empty()
    });
    names
}

/// The text of a described mechanism.
///
/// # Panics
/// If there is no such file.
pub fn source(name: &str) -> Source {
    let path = files::repository()
        .join("mechanisms")
        .join(format!("{name}.mech"));
    let text =
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    Source::new(format!("{name}.mech"), text)
}

/// The equations of a described mechanism, which determine its motion.
///
/// # Panics
/// If the description has errors.
pub fn system(name: &str) -> System {
    let source = source(name);
    let read = linkwright_codegen::read(&source)
        .unwrap_or_else(|errors| panic!("{}", errors.render(&source)));
    if let Err(errors) = linkwright_codegen::check(&read.system) {
        panic!("{}", errors.render(&source));
    }
    read.system
}
