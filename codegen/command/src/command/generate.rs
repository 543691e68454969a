//! Writes the files of a generated module on stdout or in a folder.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::emit::Conventions;
use linkwright_codegen::stages::files;
use linkwright_codegen::{Language, Options, OutputFile, Scalar};

use super::description::{outputs, source};
use super::inspect::written;
use super::{Outcome, Problem, print, say};
use crate::arguments::{Generate, Precision};
use crate::output::{Beginning, Record, Signature};

/// Writes the module, or compares it with existing files.
///
/// A file with the same contents is left alone, so that nothing that depends on it is built again.
///
/// # Errors
/// The description has errors, or a file cannot be written.
pub fn run(arguments: &Generate) -> Result<Outcome, Problem> {
    check_lanes(arguments)?;
    let conventions = arguments.lang.conventions();
    let extension = conventions.extensions[0];
    let source = source(&arguments.file)?;
    let to_stdout = |path: &&Path| *path == Path::new("-");
    let Some(path) = arguments.output.as_deref().filter(|it| !to_stdout(it)) else {
        if arguments.check {
            return Err(Problem(
                "error: `--check` compares with a file, and `-` is stdout".to_string(),
            ));
        }
        let Conventions { name, beside, .. } = conventions;
        if let Some(others) = beside {
            return Err(Problem(format!(
                "error: {name} is written to several files, and stdout is one\n  = help: name the source with `-o NAME.{extension}`; {others} are written beside it"
            )));
        }
        let module = generated(arguments, &source, "")?;
        print(|output| {
            let mut texts = module.iter().map(|file| &file.text);
            texts.try_for_each(|text| output.write_all(text.as_bytes()))
        })?;
        return Ok(Outcome::Done);
    };
    let stem = match conventions.beside {
        None => stem(path),
        Some(_) => source_stem(path, conventions)?,
    };
    let paths = paths(path, &arguments.lang.file_names(&stem));
    if arguments.check {
        check_extension(arguments, path)?;
        let module = generated(arguments, &source, &stem)?;
        return Ok(compared(arguments, path, &paths, &module));
    }
    let mut named = outputs(&arguments.file, &source, arguments.force);
    let outputs = paths
        .iter()
        .map(|path| Ok(named.file(path, signature(conventions))?));
    let outputs = outputs.collect::<Result<Vec<_>, Problem>>()?;
    check_extension(arguments, path)?;
    let module = generated(arguments, &source, &stem)?;
    for (output, file) in outputs.into_iter().zip(&module) {
        if !output.holds(file.text.as_bytes()) {
            output.write(|output| output.write_all(file.text.as_bytes()))?;
        }
    }
    Ok(Outcome::Done)
}

/// Rejects another number of lanes than that of the scalar.
fn check_lanes(arguments: &Generate) -> Result<(), Problem> {
    let name = match arguments.scalar {
        Precision::F64 => "f64",
        Precision::F32 => "f32",
    };
    let count = scalar(arguments).lanes();
    match arguments.lanes {
        Some(lanes) if lanes != count => Err(Problem(format!(
            "error: {name} has {count} lanes, found `--lanes {lanes}`\n  = help: write `--lanes {count}`"
        ))),
        _ => Ok(()),
    }
}

/// Rejects a file with an extension of another language.
fn check_extension(arguments: &Generate, path: &Path) -> Result<(), Problem> {
    let language = arguments.lang.conventions();
    let is_own = |it: &&OsStr| {
        language
            .extensions
            .iter()
            .any(|extension| *it == *extension)
    };
    let Some(extension) = path.extension().filter(|it| !is_own(it)) else {
        return Ok(());
    };
    let others = Language::ALL.into_iter().filter(|it| *it != arguments.lang);
    let others: Vec<&Conventions> = others.map(Language::conventions).collect();
    let suffix = language.extensions[0];
    let writes = |it: &&&Conventions| it.extensions.iter().any(|other| extension == *other);
    let help = match others.iter().find(writes) {
        Some(other) => format!(
            "`--lang {}` writes {}; a module of {} ends in `.{suffix}`",
            other.option, other.name, language.name
        ),
        None => {
            let others = others.iter();
            let others = others.map(|it| {
                format!(
                    "`--lang {}` writes one that ends in `.{}`",
                    it.option, it.extensions[0]
                )
            });
            let others = others.collect::<Vec<_>>().join(", ");
            format!("name a file that ends in `.{suffix}`; {others}")
        }
    };
    Err(Problem(format!(
        "error: cannot write `{}`: modules cannot be written as `.{}`\n  = help: {help}",
        path.display(),
        extension.display()
    )))
}

/// Returns the signature of the files that this command writes.
fn signature(conventions: &Conventions) -> Signature {
    Signature {
        noun: conventions.noun,
        beginning: Beginning::Line(conventions.is_first_line),
        record: Record::None,
    }
}

/// Returns the stem of the names of a module's files.
fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

/// Returns the stem of a source, which is also that of the files beside it.
///
/// # Errors
/// The file has no extension of a source, or a name to which the language objects.
fn source_stem(path: &Path, conventions: &Conventions) -> Result<String, Problem> {
    let (language, extension) = (conventions.name, conventions.extensions[0]);
    let refused = |why: &str| {
        let file = path.display();
        Problem(format!(
            "error: cannot write {language} to `{file}`: {why}\n  = help: name it after the mechanism, such as `-o arm.{extension}`"
        ))
    };
    if path.extension().is_none_or(|it| it != extension) {
        return Err(refused(&format!(
            "a source of {language} ends in `.{extension}`"
        )));
    }
    let stem = stem(path);
    match (conventions.objection)(&stem) {
        Some(why) => Err(refused(why)),
        None => Ok(stem),
    }
}

/// Returns the paths of a module's files: the requested one, and the others beside it.
fn paths(path: &Path, names: &[String]) -> Vec<PathBuf> {
    let folder = files::folder_of(path);
    let others = names.iter().skip(1).map(|name| folder.join(name));
    [path.to_path_buf()].into_iter().chain(others).collect()
}

/// Returns the files of the module.
fn generated(
    arguments: &Generate,
    source: &Source,
    stem: &str,
) -> Result<Vec<OutputFile>, Problem> {
    let options = Options {
        stem: Some(stem.to_string()),
        ..options(arguments)
    };
    written(source, &options)
}

/// Reports files that differ from what is generated.
fn compared(
    arguments: &Generate,
    path: &Path,
    paths: &[PathBuf],
    module: &[OutputFile],
) -> Outcome {
    let differs = |(path, file): &(&PathBuf, &OutputFile)| {
        let text = file.text.as_bytes();
        !files::read(path, text.len()).is_ok_and(|existing| existing == text)
    };
    let Some((different, _)) = paths.iter().zip(module).find(differs) else {
        return Outcome::Done;
    };
    let (description, path) = (arguments.file.display(), path.display());
    let scalar = match arguments.scalar {
        Precision::F64 => "",
        Precision::F32 => " --scalar f32",
    };
    let lanes = match arguments.lanes {
        Some(count) => format!(" --lanes {count}"),
        None => String::new(),
    };
    let lang = match arguments.lang {
        it if it == Language::default() => String::new(),
        other => format!(" --lang {}", other.conventions().option),
    };
    say(&format!(
        "error: `{}` is not what `{description}` generates\n  = help: run `linkwright generate{lang} {description} -o {path}{scalar}{lanes}`",
        different.display()
    ));
    Outcome::Failed
}

fn scalar(arguments: &Generate) -> Scalar {
    match arguments.scalar {
        Precision::F64 => Scalar::F64,
        Precision::F32 => Scalar::F32,
    }
}

/// Returns the options of the code that the arguments select.
fn options(arguments: &Generate) -> Options {
    Options {
        language: arguments.lang,
        scalar: scalar(arguments),
        lanes: arguments.lanes.is_some(),
        ..Options::default()
    }
}
