//! Writes the modules of all variants for the build script of `tests/embedded`, which needs no generator of its own then.
//!
//! A variant is a mechanism in a scalar, with or without the guard: `four_bar_f32`, `four_bar_f32_unguarded`.

use std::fs;
use std::io;
use std::path::PathBuf;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Options, Scalar as Precision, generate};

use super::program::{MECHANISMS, Scalar};
use super::tools::folder;
use crate::files;

/// Modules, and `list`: a line `VARIANT TYPE SCALAR` for each.
///
/// # Errors
/// A description is not read, has errors, or a file is not written.
pub fn write() -> io::Result<()> {
    let modules = modules();
    let mut list = String::new();
    for (mechanism, type_name) in MECHANISMS {
        let description = files::repository()
            .join("mechanisms")
            .join(mechanism)
            .with_extension("mech");
        let text = fs::read_to_string(description)?;
        for (scalar, precision) in [(Scalar::F32, Precision::F32), (Scalar::F64, Precision::F64)] {
            for (guard, text) in [("", text.clone()), ("_unguarded", unguarded(&text)?)] {
                let real = scalar.name();
                let variant = format!("{mechanism}_{real}{guard}");
                let source = Source::new(format!("{variant}.mech"), text);
                let options = Options {
                    scalar: precision,
                    ..Options::default()
                };
                let generated = generate(&source, &options)
                    .map_err(|found| io::Error::other(found.render(&source)))?;
                let file = modules.join(format!("{variant}.rs"));
                files::write_if_changed(&file, generated.code())?;
                list += &format!("{variant} {type_name} {real}\n");
            }
        }
    }
    files::write_if_changed(&modules.join("list"), &list)
}

/// The folder of the modules, which the environment variable `MODULES` names to the build script.
pub fn modules() -> PathBuf {
    folder().join("modules")
}

/// The description with one more statement.
fn unguarded(text: &str) -> io::Result<String> {
    let end = text.rfind('}');
    let end = end.ok_or_else(|| io::Error::other("a mechanism ends in a brace"))?;
    Ok(format!("{}    unguarded;\n{}", &text[..end], &text[end..]))
}
