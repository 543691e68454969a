//! Front end for build scripts: generates the modules of a folder in `OUT_DIR`, each with the page that `rustdoc`
//! shows.
//!
//! The only module that touches the environment and the standard output. Errors become `cargo::error` lines, so that
//! a mistake in a description reads like a compiler error; bad input never panics. A module is written only if it
//! changes.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::{env, fs, io};

use crate::diagnostic::Source;
use crate::diagnostic::internal::caught;
use crate::{Generated, Language, Options, Page, files, generate};

/// Generates the module of every `.mech` file in `folder` (relative to the package) for
/// `linkwright::include_mechanism!`. Files whose names begin with a dot are left alone.
///
/// It is called from `build.rs`:
/// ```no_run
/// linkwright_codegen::build("descriptions");
/// ```
///
/// It writes to `OUT_DIR`, each module with a page that `rustdoc` shows: the picture and the derivation. It prints what
/// cargo needs: when to run again, and every error with its place. After an error it returns normally, and cargo stops
/// the build.
pub fn build(folder: impl AsRef<Path>) {
    build_with(folder, &Options::default());
}

/// Generates modules as [`build`] does, with options. Their language is Rust.
///
/// ```no_run
/// use linkwright_codegen::{Options, Scalar};
///
/// let options = Options { scalar: Scalar::F32, ..Options::default() };
/// linkwright_codegen::build_with("descriptions", &options);
/// ```
pub fn build_with(folder: impl AsRef<Path>, options: &Options) {
    let mut print = |line: &str| println!("{line}");
    match env::var_os("OUT_DIR") {
        Some(output) => {
            let output = PathBuf::from(output).join("linkwright");
            build_folder(folder.as_ref(), &output, options, &mut print);
        }
        None => say_error(
            "OUT_DIR is not set: `build` is called from a build script",
            &mut print,
        ),
    }
}

/// Prints a line for cargo.
type Say<'a> = &'a mut dyn FnMut(&str);

/// Writes the modules of a folder's descriptions to `output`.
fn build_folder(folder: &Path, output: &Path, options: &Options, say: Say<'_>) {
    // Printed first, so that a corrected description is noticed after any error.
    watch(folder, say);
    if let Err(problem) = write_modules(folder, output, options, say) {
        say_error(&problem, say);
    }
}

/// Tells cargo to run the build script again after a change of a file or a folder.
fn watch(path: &Path, say: Say<'_>) {
    let output_folder = env::var_os("OUT_DIR").map(PathBuf::from);
    if !is_written_by_script(path, output_folder.as_deref()) {
        say(&format!("cargo::rerun-if-changed={}", path.display()));
    }
}

/// True if a path lies in the script's own folder. It is then newer than the script's start, and cargo would run the
/// script each time.
fn is_written_by_script(path: &Path, own: Option<&Path>) -> bool {
    own.is_some_and(|own| path.starts_with(own))
}

fn write_modules(
    folder: &Path,
    output: &Path,
    options: &Options,
    say: Say<'_>,
) -> Result<(), String> {
    if options.language != Language::Rust {
        return Err(format!(
            "expected `Language::Rust` in the options of a build script, found `Language::{:?}`: call `generate` for files of other languages",
            options.language
        ));
    }
    let unreadable = |error: io::Error| {
        let reason = files::reason(&error);
        format!("cannot read the folder `{}`: {reason}", folder.display())
    };
    let mut descriptions = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if is_description(&path) {
            descriptions.push(path);
        }
    }
    // The order of a folder differs between file systems.
    descriptions.sort();
    if descriptions.is_empty() {
        return Err(format!(
            "the folder `{}` holds no `.mech` file",
            folder.display()
        ));
    }
    fs::create_dir_all(output)
        .map_err(|error| format!("cannot create `{}`: {error}", output.display()))?;
    files::sweep(output);
    let mut names: Vec<(String, PathBuf)> = Vec::new();
    for file in descriptions {
        let Some((generated, page)) = generate_file(&file, options, say) else {
            continue;
        };
        let (name, code) = (generated.name.as_str(), generated.code());
        // Some file systems cannot tell names apart that differ in case only.
        let same = |other: &str| other.eq_ignore_ascii_case(name);
        if let Some((other, earlier)) = names.iter().find(|(other, _)| same(other)) {
            let (earlier, file) = (earlier.display(), file.display());
            let problem = match *other == name {
                true => {
                    format!("`{earlier}` and `{file}` both describe a mechanism named `{name}`")
                }
                false => format!(
                    "the mechanisms `{other}` of `{earlier}` and `{name}` of `{file}` differ in case only"
                ),
            };
            say_error(&problem, say);
            continue;
        }
        for (ending, text) in [("rs", code), ("md", page.html.as_str())] {
            let target = output.join(format!("{name}.{ending}"));
            write_if_changed(&target, text).map_err(|error| {
                let reason = files::reason(&error);
                format!("cannot write `{}`: {reason}", target.display())
            })?;
        }
        say_module(name, &output.join(format!("{name}.rs")), say);
        names.push((generated.name, file));
    }
    Ok(())
}

/// Modules that this build script has generated so far, for the error of `include_mechanism!` about an unknown one.
/// Cargo takes the last value of a variable, so that it must hold all earlier ones.
static GENERATED: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// Tells `linkwright::include_mechanism!` the path of a module, and the names of all.
fn say_module(name: &str, path: &Path, say: Say<'_>) {
    let mut names = GENERATED.lock().unwrap_or_else(PoisonError::into_inner);
    names.push(format!("`{name}`"));
    names.sort();
    names.dedup();
    say(&format!(
        "cargo::rustc-env=LINKWRIGHT_{name}={}",
        path.display()
    ));
    say(&format!(
        "cargo::rustc-env=LINKWRIGHT_MECHANISMS=build.rs has generated {}",
        names.join(", ")
    ));
}

/// Writes a module that a build script got from [`generate`](crate::generate), so that
/// `linkwright::include_mechanism!` finds it by its name.
///
/// # Errors
/// Returns the error of the file system if the module cannot be written, or if `OUT_DIR` is not set.
pub fn write_module(name: &str, code: &str) -> io::Result<()> {
    let output = env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?;
    let folder = PathBuf::from(output).join("linkwright");
    fs::create_dir_all(&folder)?;
    let path = folder.join(format!("{name}.rs"));
    write_if_changed(&path, code)?;
    say_module(name, &path, &mut |line| println!("{line}"));
    Ok(())
}

/// True if a file of the folder is a description. Names that begin with a dot do not count: editors write such files
/// beside open ones.
fn is_description(path: &Path) -> bool {
    let name = path.file_name().map(OsStr::as_encoded_bytes);
    path.extension() == Some(OsStr::new("mech")) && name.is_some_and(|it| !it.starts_with(b"."))
}

/// Generates the module of one file and its page; prints its errors.
fn generate_file(file: &Path, options: &Options, say: Say<'_>) -> Option<(Generated, Page)> {
    let name = file.display().to_string();
    let bytes = match files::read(file, Source::MAX_BYTES) {
        Ok(bytes) => bytes,
        Err(error) => {
            let reason = files::reason(&error);
            say_error(&format!("cannot read `{name}`: {reason}"), say);
            return None;
        }
    };
    let source = match Source::from_bytes(&name, &bytes) {
        Ok(source) => source,
        Err(unreadable) => {
            let (source, found) = *unreadable;
            say_error(&found.render(&source), say);
            return None;
        }
    };
    let folder = files::folder_of(file);
    let source = files::attach_files(source, folder);
    for attachment in &source.attachments {
        watch(&folder.join(&attachment.path), say);
    }
    // An error of the generator itself is one of this description: the others are generated all the same.
    let generated = caught(|| {
        generate(&source, options).map(|generated| {
            let page = generated.page();
            (generated, page)
        })
    });
    match generated.unwrap_or_else(|error| Err(error.findings())) {
        Ok((generated, page)) => {
            for line in generated.warnings.render(&source).lines() {
                say(&format!("cargo::warning={line}"));
            }
            Some((generated, page))
        }
        Err(diagnostics) => {
            say_error(&diagnostics.render(&source), say);
            None
        }
    }
}

/// One directive per line: cargo drops what follows a line break.
fn say_error(text: &str, say: Say<'_>) {
    for line in text.lines() {
        say(&format!("cargo::error={line}"));
    }
}

/// Keeps a file with equal content, so that nothing is compiled again.
fn write_if_changed(path: &Path, text: &str) -> io::Result<()> {
    if files::read(path, text.len()).is_ok_and(|current| current == text.as_bytes()) {
        return Ok(());
    }
    files::replace(path, |output| output.write_all(text.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CRANK: &str = "mechanism crank {
    body 1 at (0, 0);
    absolute_x(1) = 0;
    absolute_y(1) = 0;
    drive phi(1) = t;
}";

    /// Folder of descriptions, and one of modules, both removed in the end.
    struct Folders(PathBuf);

    impl Folders {
        fn new(name: &str) -> Folders {
            let name = format!("linkwright-build-{name}-{}", std::process::id());
            let path = env::temp_dir().join(name);
            fs::create_dir_all(path.join("descriptions")).expect("a folder of the test");
            Folders(path)
        }

        fn description(&self, name: &str) -> PathBuf {
            self.0.join("descriptions").join(name)
        }

        fn write(&self, name: &str, text: &str) {
            fs::write(self.description(name), text).expect("it can be written");
        }

        /// Printed lines except for those about running again, without the path of the folder.
        fn build(&self) -> Vec<String> {
            self.build_with(&Options::default())
        }

        fn build_with(&self, options: &Options) -> Vec<String> {
            let mut lines = Vec::new();
            let descriptions = self.0.join("descriptions");
            let output = self.0.join("out");
            build_folder(&descriptions, &output, options, &mut |line| {
                let line = line.replace(&format!("{}/", descriptions.display()), "");
                let is_usual = ["cargo::rerun-if-changed=", "cargo::rustc-env="];
                if !is_usual.iter().any(|it| line.starts_with(it)) {
                    lines.push(line);
                }
            });
            lines
        }

        fn modules(&self) -> Vec<String> {
            let entries = fs::read_dir(self.0.join("out")).expect("the folder exists");
            let name = |entry: io::Result<fs::DirEntry>| entry.expect("an entry").file_name();
            let mut names: Vec<String> = entries
                .map(|entry| name(entry).to_string_lossy().into_owned())
                .collect();
            names.sort();
            names
        }
    }

    impl Drop for Folders {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn files_of_the_script_are_not_watched() {
        let output_folder = Path::new("target/build/crate/out");
        assert!(is_written_by_script(
            &output_folder.join("descriptions"),
            Some(output_folder)
        ));
        assert!(!is_written_by_script(
            Path::new("descriptions"),
            Some(output_folder)
        ));
        assert!(!is_written_by_script(
            &output_folder.join("descriptions"),
            None
        ));
    }

    #[test]
    fn a_module_is_written_when_it_changes_and_is_never_partial() {
        let folders = Folders::new("changes");
        folders.write("crank.mech", CRANK);
        let none: [&str; 0] = [];
        assert_eq!(folders.build(), none);
        let path = folders.0.join("out/crank.rs");
        let modified = || {
            fs::metadata(&path)
                .and_then(|it| it.modified())
                .expect("a module")
        };
        let before = modified();
        assert_eq!(folders.build(), none);
        assert_eq!(modified(), before, "an unchanged module is left alone");
        // A reader of the old module during its replacement reads it to the end.
        let open = fs::File::open(&path).expect("a module");
        let written = fs::read_to_string(&path).expect("a module");
        folders.write("crank.mech", &CRANK.replace("= t", "= 2*t"));
        assert_eq!(folders.build(), none);
        assert_ne!(fs::read_to_string(&path).expect("a module"), written);
        assert_eq!(
            io::read_to_string(open).expect("it is still there"),
            written
        );
        assert_eq!(folders.modules(), ["crank.md", "crank.rs"]);
    }

    #[test]
    fn other_files_are_reported_or_left_alone() {
        let folders = Folders::new("others");
        folders.write("crank.mech", CRANK);
        folders.write("crank.mech~", "the editor's");
        folders.write(".#crank.mech", "the editor's");
        folders.write("again.mech", CRANK);
        folders.write("upper.mech", &CRANK.replace("crank", "Crank"));
        folders.write("wide.mech", &" ".repeat(Source::MAX_BYTES + 9));
        fs::create_dir(folders.description("folder.mech")).expect("a folder");
        let lines = folders.build();
        for expected in [
            "cargo::error=`again.mech` and `crank.mech` both describe a mechanism named `crank`",
            "cargo::error=the mechanisms `crank` of `again.mech` and `Crank` of `upper.mech` differ in case only",
            "cargo::error=error[K00]: the file is larger than 4 MiB",
            "cargo::error=cannot read `folder.mech`: it is a folder",
        ] {
            assert!(
                lines.iter().any(|line| line == expected),
                "{expected} in {lines:#?}"
            );
        }
        assert!(!lines.iter().any(|line| line.contains('#')), "{lines:#?}");
        assert_eq!(folders.modules(), ["crank.md", "crank.rs"]);
    }

    #[test]
    fn rejects_a_language_that_is_not_included() {
        let folders = Folders::new("language");
        folders.write("crank.mech", CRANK);
        let options = Options {
            language: Language::C,
            ..Options::default()
        };
        assert_eq!(
            folders.build_with(&options),
            [
                "cargo::error=expected `Language::Rust` in the options of a build script, found `Language::C`: call `generate` for files of other languages"
            ]
        );
        assert!(!folders.0.join("out").exists(), "nothing is written");
    }

    #[cfg(unix)]
    #[test]
    fn a_pipe_is_not_waited_for() {
        let folders = Folders::new("pipe");
        let made = std::process::Command::new("mkfifo")
            .arg(folders.description("pipe.mech"))
            .status();
        assert!(made.is_ok_and(|it| it.success()));
        assert_eq!(
            folders.build(),
            ["cargo::error=cannot read `pipe.mech`: it is a pipe, not a regular file"]
        );
    }
}
