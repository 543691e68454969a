//! The front end for build scripts: a folder of descriptions → generated modules in `OUT_DIR`.
//!
//! The only module that touches files, the environment and the standard output. Errors become `cargo::error` lines, so a
//! mistake in a description reads like a compiler error; it never panics on bad input.

use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

use crate::diagnostic::Source;
use crate::{Options, generate_with, syntax};

/// Generates the module of every `.mech` file in `folder` (relative to the package) for `linkwright::include_mechanism!`.
///
/// Called from `build.rs`. Prints what cargo needs to know: when to run again, and every error with its place. After an error
/// it returns normally and cargo stops the build.
pub fn build(folder: impl AsRef<Path>) {
    build_with(folder, &Options::default());
}

/// The same with a choice of the scalar.
pub fn build_with(folder: impl AsRef<Path>, options: &Options) {
    let folder = folder.as_ref();
    // Printed first, so that a mended description is seen whatever went wrong.
    println!("cargo::rerun-if-changed={}", folder.display());
    if let Err(problem) = build_folder(folder, options) {
        print_error(&problem);
    }
}

fn build_folder(folder: &Path, options: &Options) -> Result<(), String> {
    let output = env::var_os("OUT_DIR")
        .ok_or("OUT_DIR is not set: `build` is called from a build script")?;
    let output = PathBuf::from(output).join("linkwright");
    let unreadable =
        |error: io::Error| format!("cannot read the folder `{}`: {error}", folder.display());
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path
            .extension()
            .is_some_and(|extension| extension == "mech")
        {
            files.push(path);
        }
    }
    // The order of a folder is not the same everywhere.
    files.sort();
    if files.is_empty() {
        return Err(format!(
            "the folder `{}` holds no `.mech` file",
            folder.display()
        ));
    }
    fs::create_dir_all(&output)
        .map_err(|error| format!("cannot create `{}`: {error}", output.display()))?;
    let mut names: Vec<(String, PathBuf)> = Vec::new();
    for file in files {
        let Some((name, code)) = generate_file(&file, options) else {
            continue;
        };
        if let Some((_, earlier)) = names.iter().find(|(other, _)| *other == name) {
            print_error(&format!(
                "`{}` and `{}` both describe a mechanism named `{name}`",
                earlier.display(),
                file.display()
            ));
            continue;
        }
        let target = output.join(format!("{name}.rs"));
        write_if_changed(&target, &code)
            .map_err(|error| format!("cannot write `{}`: {error}", target.display()))?;
        names.push((name, file));
    }
    Ok(())
}

/// The module of one file; its errors are printed.
fn generate_file(file: &Path, options: &Options) -> Option<(String, String)> {
    let name = file.display().to_string();
    let bytes = match fs::read(file) {
        Ok(bytes) => bytes,
        Err(error) => {
            print_error(&format!("cannot read `{name}`: {error}"));
            return None;
        }
    };
    let source = match Source::from_bytes(&name, &bytes) {
        Ok(source) => source,
        Err(unreadable) => {
            let (source, found) = *unreadable;
            print_error(&found.render(&source));
            return None;
        }
    };
    let folder = file.parent().unwrap_or(Path::new(""));
    for path in syntax::named_files(&source.text) {
        println!("cargo::rerun-if-changed={}", folder.join(path).display());
    }
    let source = attach_files(source, folder);
    match generate_with(&source, options) {
        Ok(generated) => {
            for line in generated.warnings.render(&source).lines() {
                println!("cargo::warning={line}");
            }
            Some((generated.name, generated.code))
        }
        Err(diagnostics) => {
            print_error(&diagnostics.render(&source));
            None
        }
    }
}

/// A description with the files that it names, read from its folder.
pub fn attach_files(source: Source, folder: &Path) -> Source {
    let paths = syntax::named_files(&source.text);
    paths.into_iter().fold(source, |source, path| {
        let mut bytes = Vec::new();
        // One byte more than allowed is enough to know that there are too many.
        let read = fs::File::open(folder.join(&path)).and_then(|file| {
            file.take(Source::LARGEST as u64 + 1)
                .read_to_end(&mut bytes)
        });
        let bytes = read.map(|_| bytes).map_err(|error| match error.kind() {
            // The words of the operating system differ.
            io::ErrorKind::NotFound => "there is no such file".to_string(),
            _ => error.to_string(),
        });
        source.with_attachment(path, bytes)
    })
}

/// One directive per line: cargo drops what follows a line break.
fn print_error(text: &str) {
    for line in text.lines() {
        println!("cargo::error={line}");
    }
}

/// Leaves a file alone whose content is the same, so that nothing is compiled again.
fn write_if_changed(path: &Path, text: &str) -> io::Result<()> {
    if fs::read_to_string(path).is_ok_and(|current| current == text) {
        return Ok(());
    }
    fs::write(path, text)
}
