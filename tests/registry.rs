//! *The descriptions in a folder* → *one macro call that lists them*, for build scripts.
//!
//! Modules have no names at run time, so what the tests do with every mechanism is a macro over a list. The list is written here
//! from the descriptions: a new file is compiled, timed and compared without being named anywhere else.

use std::fs;
use std::path::Path;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::model::type_name;

/// Writes `registry.rs` into the build script's output folder: `registry! { name: Type { "K" => point_k, … } … }`, by name.
///
/// Listed are the mechanisms without motions that are not limited by `output` statements, whose frames hold all coordinates, and
/// that are given nothing but a time: no parameters and no inputs. A description with
/// errors is left out here; generating its module reports them.
pub fn write(folder: &str) {
    let mut paths: Vec<_> = fs::read_dir(folder)
        .expect("the folder of descriptions")
        .map(|entry| entry.expect("a listed file").path())
        .filter(|path| path.extension().is_some_and(|it| it == "mech"))
        .collect();
    paths.sort();
    let lines: String = paths.iter().filter_map(|path| line(path)).collect();
    let target = Path::new(&std::env::var("OUT_DIR").expect("cargo's folder")).join("registry.rs");
    fs::write(target, format!("registry! {{\n{lines}}}\n")).expect("the list is written");
}

/// `name: Type { "K" => point_k, … }`
fn line(path: &Path) -> Option<String> {
    let text = fs::read_to_string(path).ok()?;
    let source = Source::new("description", text);
    let source = linkwright_codegen::attach_files(source, path.parent()?);
    let read = linkwright_codegen::read(&source).ok()?;
    let mechanism = &read.only()?.mechanism;
    let given = !mechanism.parameters.is_empty() || !mechanism.inputs.is_empty();
    if given || mechanism.motion.is_some() || !mechanism.requests.is_empty() {
        return None;
    }
    let points: String = mechanism
        .points
        .iter()
        .map(|point| {
            let function = point.name.to_lowercase();
            format!("\"{}\" => point_{function}, ", point.name)
        })
        .collect();
    let name = &mechanism.name;
    Some(format!("    {name}: {} {{ {points}}}\n", type_name(name)))
}
