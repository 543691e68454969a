//! Reads regular files, and writes files that are complete or unchanged.
//!
//! A pipe or a device is never read: it may have no end, or no writer. A file is written beside its destination,
//! which it then replaces in one operation, and so is a folder.

mod attachments;
mod partial;

use std::fs::{self, File, FileType};
use std::io::{self, BufWriter, Read as _, Write};
use std::path::Path;

pub use self::attachments::attach_files;
use self::partial::Partial;
pub use self::partial::sweep;

/// Reads a regular file; of one with more than `largest` bytes, `largest + 1` bytes.
///
/// # Errors
/// The file does not exist, it is a folder, a pipe or a device, or the file system refuses.
pub fn read(path: &Path, largest: usize) -> io::Result<Vec<u8>> {
    // Checked before opening: to open a pipe waits for its writer.
    let kind = fs::metadata(path)?.file_type();
    if !kind.is_file() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, noun(kind)));
    }
    let mut bytes = Vec::new();
    File::open(path)?
        .take(largest as u64 + 1)
        .read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Noun for the kind of file at a path.
pub fn noun(kind: FileType) -> &'static str {
    if kind.is_dir() {
        return "it is a folder";
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt as _;
        if kind.is_fifo() {
            return "it is a pipe, not a regular file";
        }
    }
    "it is a device, not a regular file"
}

/// Reason why a file cannot be read or written, in equal words on all operating systems for the frequent ones.
pub fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "the file does not exist".to_string(),
        io::ErrorKind::PermissionDenied => "permission denied".to_string(),
        _ => error.to_string(),
    }
}

/// Replaces the file at `path` by the output of `write`, with the permissions that it has. The target of a link is
/// replaced; the link stays.
///
/// # Errors
/// Those of `write` and of the file system; the file is then unchanged.
pub fn replace(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let partial = Partial::new(folder_of(&path))?;
    complete(&partial.file, write)?;
    if let Ok(existing) = fs::metadata(&path) {
        partial.file.set_permissions(existing.permissions())?;
    }
    partial.becomes(&path)
}

/// Makes the folder at `path` with all that `fill` writes into the folder passed to it.
///
/// # Errors
/// Those of `fill` and of the file system, also if the path exists already; nothing is left then.
pub fn make_folder(path: &Path, fill: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
    let partial = Partial::new(folder_of(path))?;
    if fs::symlink_metadata(path).is_ok() {
        return Err(io::ErrorKind::AlreadyExists.into());
    }
    let folder = partial.folder();
    fs::create_dir(&folder)?;
    fill(&folder)?;
    fs::rename(&folder, path)
}

/// Checks that [`replace`] can make a file in this folder.
///
/// # Errors
/// The reason why it cannot.
pub fn may_write_in(folder: &Path) -> io::Result<()> {
    Partial::new(folder).map(drop)
}

/// The folder that a path lies in.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

fn complete(file: &File, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut buffered = BufWriter::new(file);
    write(&mut buffered)?;
    buffered.flush()
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;

    /// Temporary folder that is removed in the end.
    struct Folder(PathBuf);

    impl Folder {
        fn new(name: &str) -> Folder {
            let name = format!("linkwright-files-{name}-{}", std::process::id());
            let path = std::env::temp_dir().join(name);
            fs::create_dir_all(&path).expect("a folder of the test");
            Folder(path)
        }

        fn names(&self) -> Vec<String> {
            let entries = fs::read_dir(&self.0).expect("the folder exists");
            let name = |entry: io::Result<fs::DirEntry>| entry.expect("an entry").file_name();
            let mut names: Vec<String> = entries
                .map(|it| name(it).to_string_lossy().into_owned())
                .collect();
            names.sort();
            names
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn a_file_is_replaced_as_a_whole_or_not_at_all() {
        let folder = Folder::new("replace");
        let path = folder.0.join("a.rs");
        replace(&path, |output| output.write_all(b"one")).expect("it can be written");
        assert_eq!(fs::read(&path).expect("it is there"), b"one");
        let failed = replace(&path, |output| {
            output.write_all(b"half of it")?;
            Err(io::Error::other("no more"))
        });
        assert_eq!(failed.expect_err("it fails").to_string(), "no more");
        assert_eq!(fs::read(&path).expect("it is there"), b"one");
        assert_eq!(folder.names(), ["a.rs"], "no partial file is left");
        may_write_in(&folder.0).expect("it may");
        assert!(may_write_in(&path).is_err());
        assert_eq!(folder.names(), ["a.rs"]);
    }

    #[test]
    fn a_folder_is_made_as_a_whole_or_not_at_all() {
        let folder = Folder::new("make");
        let path = folder.0.join("crate");
        let failed = make_folder(&path, |inside| {
            fs::write(inside.join("a"), "half of it")?;
            Err(io::Error::other("no more"))
        });
        assert_eq!(failed.expect_err("it fails").to_string(), "no more");
        assert!(folder.names().is_empty(), "{:?}", folder.names());
        let fill = |inside: &Path| {
            // The name exists only once the file is complete.
            assert!(!path.exists());
            fs::write(inside.join("a"), "all of it")
        };
        make_folder(&path, fill).expect("it can be made");
        assert_eq!(folder.names(), ["crate"]);
        assert_eq!(fs::read(path.join("a")).expect("it is there"), b"all of it");
        let failed = make_folder(&path, |_| Ok(())).expect_err("it exists");
        assert_eq!(failed.kind(), io::ErrorKind::AlreadyExists);
        assert_eq!(folder.names(), ["crate"]);
    }

    #[test]
    fn only_remains_of_killed_runs_are_removed() {
        let folder = Folder::new("sweep");
        // Names of a run that has been killed, one of them with the folder that it was filling.
        for name in [".linkwright-1-0.partial", ".linkwright-1-7.partial"] {
            fs::write(folder.0.join(name), "half of it").expect("it can be written");
        }
        fs::create_dir_all(folder.0.join(".linkwright-1-7.partial.folder/src")).expect("a folder");
        let kept = [
            ".linkwright-.partial",
            ".linkwright-1-a.partial",
            ".linkwright-notes.partial",
            "linkwright-1-0.partial",
        ];
        for name in kept {
            fs::write(folder.0.join(name), "of another program").expect("it can be written");
        }
        let path = folder.0.join("a.rs");
        replace(&path, |output| {
            // Another run meanwhile, or this one elsewhere: what is being written stays.
            let during = folder.names();
            sweep(&folder.0);
            assert_eq!(folder.names().len(), during.len() - 3);
            output.write_all(b"one")
        })
        .expect("it can be written");
        let mut expected = Vec::from(kept);
        expected.push("a.rs");
        expected.sort_unstable();
        assert_eq!(folder.names(), expected);
    }

    #[test]
    fn only_as_much_is_read_as_is_wanted() {
        let folder = Folder::new("read");
        let path = folder.0.join("a.csv");
        fs::write(&path, "12345").expect("it can be written");
        assert_eq!(read(&path, 5).expect("it is there"), b"12345");
        assert_eq!(read(&path, 3).expect("it is there"), b"1234");
        let refused = |path: &Path| reason(&read(path, 5).expect_err("it is refused"));
        assert_eq!(refused(&folder.0), "it is a folder");
        assert_eq!(
            refused(&path.with_extension("none")),
            "the file does not exist"
        );
    }

    #[cfg(unix)]
    #[test]
    fn links_stay_and_permissions_are_kept() {
        use std::os::unix::fs::{PermissionsExt as _, symlink};
        let folder = Folder::new("links");
        let (path, link) = (folder.0.join("a.rs"), folder.0.join("link"));
        fs::write(&path, "one").expect("it can be written");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).expect("it is ours");
        symlink("a.rs", &link).expect("a link");
        replace(&link, |output| output.write_all(b"two")).expect("it can be written");
        assert_eq!(fs::read_link(&link).expect("a link"), Path::new("a.rs"));
        assert_eq!(fs::read(&path).expect("it is there"), b"two");
        let mode = fs::metadata(&path)
            .expect("it is there")
            .permissions()
            .mode();
        assert_eq!(mode & 0o777, 0o640);
        let device = read(Path::new("/dev/null"), 5).expect_err("it is refused");
        assert_eq!(device.to_string(), "it is a device, not a regular file");
    }
}
