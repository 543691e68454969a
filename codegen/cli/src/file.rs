//! *Contents → a file that is either complete or as it was.*
//!
//! Contents go to a file beside the destination, which then replaces it in one operation; missing folders are made. What is
//! no regular file, such as a pipe or `/dev/null`, is written to directly. Every error names the file it concerns. The
//! module does not know what is written.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// A file that could not be read or written.
#[derive(Debug)]
pub struct FileError {
    /// What was tried: `read`, `write`.
    pub action: &'static str,
    /// The file.
    pub path: PathBuf,
    /// Why it did not work.
    pub cause: io::Error,
}

impl std::fmt::Display for FileError {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            action,
            path,
            cause,
        } = self;
        write!(formatter, "cannot {action} `{}`: {cause}", path.display())
    }
}

impl std::error::Error for FileError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.cause)
    }
}

/// Replaces the file at `path` by what `write` produces.
///
/// # Errors
/// Whatever the file system refuses; the file is then as it was.
pub fn replace(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), FileError> {
    try_replace(path, write).map_err(|cause| FileError {
        action: "write",
        path: path.to_path_buf(),
        cause,
    })
}

fn try_replace(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    // A link stays a link: what it points to is replaced.
    let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let existing = fs::metadata(&path).ok();
    if existing.as_ref().is_some_and(|it| !it.is_file()) {
        // Opening a directory fails with a good message.
        return complete(File::options().write(true).open(&path)?, write).map(drop);
    }
    let name = path.file_name().ok_or(io::ErrorKind::InvalidInput)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    if !folder.as_os_str().is_empty() {
        fs::create_dir_all(folder)?;
    }
    let mut partial = std::ffi::OsString::from(".");
    partial.push(name);
    partial.push(format!(".{}.partial", std::process::id()));
    let partial = folder.join(partial);
    let written = File::create(&partial)
        .and_then(|file| complete(file, write))
        .and_then(|file| match &existing {
            Some(metadata) => file.set_permissions(metadata.permissions()),
            None => Ok(()),
        })
        .and_then(|()| fs::rename(&partial, &path));
    if written.is_err() {
        // The first error is the one to report; that the partial file may be left is its consequence.
        let _ = fs::remove_file(&partial);
    }
    written
}

fn complete(file: File, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<File> {
    let mut buffered = BufWriter::new(file);
    write(&mut buffered)?;
    buffered
        .into_inner()
        .map_err(io::IntoInnerError::into_error)
}
