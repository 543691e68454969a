//! Paths of the repository's files, and files by extension in a stable order.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The root of the repository.
pub fn repository() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package
        .parent()
        .expect("the package lies in the repository")
        .to_path_buf()
}

/// A path in this package.
pub fn package(relative: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(relative)
}

/// The files of a folder with this extension, sorted by name.
///
/// # Panics
/// If the folder cannot be read.
pub fn with_extension(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let entries =
        fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("a listed file").path())
        .filter(|path| path.extension().is_some_and(|it| it == extension))
        .collect();
    files.sort();
    files
}

/// Files with this extension in a folder and in all folders in it except for those in `skip`, each folder sorted by
/// name.
///
/// # Panics
/// If a folder cannot be read.
pub fn below(folder: &Path, extension: &str, skip: &[&str]) -> Vec<PathBuf> {
    let mut paths = with_extension(folder, extension);
    let mut folders: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap_or_else(|error| panic!("{}: {error}", folder.display()))
        .map(|entry| entry.expect("a listed file").path())
        .filter(|path| path.is_dir() && !skip.iter().any(|it| path.ends_with(it)))
        .collect();
    folders.sort();
    paths.extend(folders.iter().flat_map(|it| below(it, extension, skip)));
    paths
}

/// Writes a file unless it has this text already; cargo and compilers see no change then.
///
/// # Errors
/// The file or its folder is not written.
pub fn write_if_changed(path: &Path, text: &str) -> io::Result<()> {
    if fs::read_to_string(path).is_ok_and(|before| before == text) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(path, text)
}

/// The name of a file without its extension.
///
/// # Panics
/// If it is not UTF-8.
pub fn stem(path: &Path) -> &str {
    path.file_stem()
        .and_then(|stem| stem.to_str())
        .expect("a file name in UTF-8")
}
