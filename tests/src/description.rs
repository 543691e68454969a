//! Texts and equations of the described mechanisms, by name.

use std::fs;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::system::Derived;

use crate::files;

/// Names of all described mechanisms, sorted: those of the files `mechanisms/*.mech`.
pub fn names() -> Vec<String> {
    let files = files::with_extension(&files::repository().join("mechanisms"), "mech");
    files
        .iter()
        .map(|path| files::stem(path).to_string())
        .collect()
}

/// Names of the mechanisms with one motion, without `output` statements and without inputs: their frames hold all
/// coordinates, and the time alone determines them.
pub fn whole() -> Vec<String> {
    let mut names = names();
    names.retain(|name| {
        let [only] = &motions(name)[..] else {
            return false;
        };
        let mechanism = &only.system.mechanism;
        let has_inputs = !mechanism.parameters.is_empty() || !mechanism.inputs.is_empty();
        !has_inputs && mechanism.motion.is_none() && mechanism.requests.is_empty()
    });
    names
}

/// Names of the mechanisms that only tests need, sorted: those of the files `tests/descriptions/*.mech`.
pub fn of_tests() -> Vec<String> {
    let files = files::with_extension(&files::package("descriptions"), "mech");
    let names = files.iter().map(|path| files::stem(path).to_string());
    names.collect()
}

/// Names of the mechanisms with one motion that only tests need, sorted.
pub fn small() -> Vec<String> {
    let mut names = of_tests();
    names.retain(|name| motions(name).len() == 1);
    names
}

/// Text of a described mechanism, of the repository's or of those that only tests and the study of stability need.
/// Each of `fixtures/plans/` shows one solution method alone.
///
/// # Panics
/// If the file is missing.
pub fn source(name: &str) -> Source {
    let file = format!("{name}.mech");
    let paths = ["descriptions", "stability", "fixtures/plans"]
        .map(|folder| files::package(folder).join(&file));
    let path = paths
        .into_iter()
        .find(|path| path.is_file())
        .unwrap_or_else(|| files::repository().join("mechanisms").join(&file));
    let text =
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let folder = path.parent().expect("a folder");
    linkwright_codegen::stages::files::attach_files(
        Source::new(format!("{name}.mech"), text),
        folder,
    )
}

/// Equations of every motion of a described mechanism, which determine it.
///
/// # Panics
/// If the description has errors.
pub fn motions(name: &str) -> Vec<Derived> {
    let source = source(name);
    let read = linkwright_codegen::read(&source)
        .unwrap_or_else(|errors| panic!("{}", errors.render(&source)));
    if let Err(errors) = linkwright_codegen::stages::check_all(&read.motions) {
        panic!("{}", errors.render(&source));
    }
    read.motions
}

/// Equations of a described mechanism with one motion.
///
/// # Panics
/// If the description has errors or several motions.
pub fn system(name: &str) -> Derived {
    let [only] = <[Derived; 1]>::try_from(motions(name))
        .unwrap_or_else(|several| panic!("{name} has {} motions", several.len()));
    only
}

/// Equations of a description with one motion, which need not determine it.
///
/// # Panics
/// If the description has errors or several motions.
pub fn written(text: &str) -> Derived {
    let source = Source::new("written.mech", text.to_string());
    let read = linkwright_codegen::read(&source)
        .unwrap_or_else(|errors| panic!("{}", errors.render(&source)));
    read.only().expect("one motion")
}
