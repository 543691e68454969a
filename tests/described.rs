//! Reads the descriptions of a folder, and adds statements to them, for build scripts.

use std::path::{Path, PathBuf};
use std::{env, fs};

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::system::Derived;

/// Description without errors, with one motion.
pub struct Described {
    /// Text.
    pub text: String,
    /// Equations.
    pub derived: Derived,
    /// True if it names files, which a copy in another folder would not find.
    pub reads_files: bool,
}

/// Empties a folder of the build script's own.
pub fn empty_folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it")).join(name);
    if folder.exists() {
        fs::remove_dir_all(&folder).expect("a folder of its own");
    }
    fs::create_dir_all(&folder).expect("a folder of its own");
    folder
}

/// Descriptions in a folder, by the names of their files. Those with errors are left out: generating their modules
/// reports them.
pub fn in_folder(folder: &str) -> Vec<Described> {
    let paths = paths_in(folder);
    let described = paths.iter().filter_map(|path| {
        let text = fs::read_to_string(path).ok()?;
        let source = Source::new(path.display().to_string(), text.clone());
        let reads_files = linkwright_codegen::read(&source).is_err();
        let source = linkwright_codegen::stages::files::attach_files(source, path.parent()?);
        let read = linkwright_codegen::read(&source).ok()?;
        let derived = read.only()?;
        Some(Described {
            text,
            derived,
            reads_files,
        })
    });
    described.collect()
}

/// Motions of each description in a folder, by the names of their files. Those with errors are left out.
pub fn motions_in_folder(folder: &str) -> Vec<Vec<Derived>> {
    let paths = paths_in(folder);
    let described = paths.iter().filter_map(|path| {
        let text = fs::read_to_string(path).ok()?;
        let source = Source::new(path.display().to_string(), text);
        let source = linkwright_codegen::stages::files::attach_files(source, path.parent()?);
        let motions = linkwright_codegen::read(&source).ok()?.motions;
        (!motions.is_empty()).then_some(motions)
    });
    described.collect()
}

/// Files of the descriptions in a folder, sorted.
fn paths_in(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(Path::new(folder)).expect("the folder of descriptions");
    let mut paths: Vec<_> = entries
        .map(|entry| entry.expect("a listed file").path())
        .filter(|path| path.extension().is_some_and(|it| it == "mech"))
        .collect();
    paths.sort();
    paths
}

impl Described {
    /// Text with another name and one more statement.
    pub fn extended(&self, name: &str, statement: &str) -> String {
        let declaration = format!("mechanism {}", self.derived.system.mechanism.name);
        let renamed = self
            .text
            .replacen(&declaration, &format!("mechanism {name}"), 1);
        let end = renamed.rfind('}').expect("a mechanism ends in a brace");
        format!("{}\n    {statement}\n{}", &renamed[..end], &renamed[end..])
    }
}
