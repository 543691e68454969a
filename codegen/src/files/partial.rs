//! Partial files and folders, and the removal of those that a killed run has left.
//!
//! A run holds a lock on each of its partial files, which ends with the run in any case. A partial file without a
//! lock is abandoned. A partial folder belongs to the partial file after which it is named, which is made before it
//! and removed after it.

use std::ffi::OsStr;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Locked file with a unique name, removed when it is dropped.
pub(super) struct Partial {
    path: PathBuf,
    /// The file, open for writing.
    pub file: File,
}

impl Partial {
    /// New partial file in a folder, with a name that no other run uses.
    ///
    /// # Errors
    /// No file can be made there.
    pub fn new(folder: &Path) -> io::Result<Partial> {
        static WRITTEN: AtomicUsize = AtomicUsize::new(0);
        loop {
            let number = WRITTEN.fetch_add(1, Ordering::Relaxed);
            let name = format!(".linkwright-{}-{number}.partial", std::process::id());
            let path = folder.join(name);
            let file = match OpenOptions::new().write(true).create_new(true).open(&path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => continue,
                file => file?,
            };
            match file.try_lock() {
                // Another run considers it abandoned, and removes it.
                Err(TryLockError::WouldBlock) => continue,
                // A file system without locks: nothing in it is ever removed.
                Ok(()) | Err(TryLockError::Error(_)) => {}
            }
            // From here on it stays; it may have been removed before.
            if path.exists() {
                return Ok(Partial { path, file });
            }
        }
    }

    /// Folder that belongs to it, which does not exist yet.
    pub fn folder(&self) -> PathBuf {
        folder(&self.path)
    }

    /// Replaces the file at `path` in the same folder by this one.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn becomes(self, path: &Path) -> io::Result<()> {
        fs::rename(&self.path, path)
    }
}

impl Drop for Partial {
    fn drop(&mut self) {
        // The result has been reported. A name that its destination has taken over leads nowhere.
        let _ = fs::remove_dir_all(self.folder());
        let _ = fs::remove_file(&self.path);
    }
}

/// Removes remains of killed runs in a folder. Failures to remove them are ignored.
pub fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
        if !is_file || !is_name(&entry.file_name()) {
            continue;
        }
        let path = entry.path();
        let Ok(file) = OpenOptions::new().write(true).open(&path) else {
            continue;
        };
        if file.try_lock().is_ok() {
            drop(Partial { path, file });
        }
    }
}

fn folder(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".folder");
    PathBuf::from(name)
}

/// True for names that [`Partial::new`] gives: `.linkwright-PROCESS-NUMBER.partial`.
fn is_name(name: &OsStr) -> bool {
    let middle = name
        .to_str()
        .and_then(|it| it.strip_prefix(".linkwright-")?.strip_suffix(".partial"));
    let parts = middle.and_then(|it| it.split_once('-'));
    let is_number = |it: &str| !it.is_empty() && it.bytes().all(|it| it.is_ascii_digit());
    parts.is_some_and(|(process, number)| is_number(process) && is_number(number))
}
