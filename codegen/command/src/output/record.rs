//! Names the description that an output was made from, and tells it from others.
//!
//! A record is the path of the description relative to the folder of the output, as a relative URL (RFC 3986). It is ASCII without
//! blanks, quotes, angle brackets and double hyphens. So it fits into a comment of XML, an attribute of HTML and a line of text.

use std::fs;
use std::path::{Component, Path, PathBuf};

use linkwright_codegen::stages::files;

use super::place::Why;

/// Place where outputs of a kind name their source.
#[derive(Clone, Copy, Debug)]
pub enum Record {
    /// No place: such outputs have the same text in each folder, or are not made from a description.
    None,
    /// First bytes of the output.
    Inside {
        /// Returns the record of such a file from its beginning, `None` if there is none.
        found: fn(&[u8]) -> Option<String>,
        /// Returns the contents with a record.
        added: fn(&[u8], &str) -> Vec<u8>,
    },
    /// File beside the output.
    Beside,
}

/// Number of bytes at the beginning of a file that hold its record: the longest path of common systems, each byte of it as `%FF`, and
/// what surrounds it.
pub(super) const LONGEST_RECORD: u64 = 3 * 4096 + 1024;

/// Beginning of the reason that an output has another source.
pub(super) const OTHER: &str = "it was made from ";

/// Path that stands for stdin.
const STDIN: &str = "-";

/// Description that outputs are made from.
#[derive(Clone, Debug)]
pub(super) struct Source {
    /// Path as the user named it.
    shown: PathBuf,
    /// Path without links; `None` for stdin.
    place: Option<PathBuf>,
}

impl Source {
    /// Returns the description at a path; `None` if no such file exists.
    pub fn new(path: &Path) -> Option<Source> {
        let place = match path == Path::new(STDIN) {
            true => None,
            false => Some(fs::canonicalize(path).ok()?),
        };
        Some(Source {
            shown: path.to_path_buf(),
            place,
        })
    }

    /// Returns the record for an output at `output`, a path without links.
    pub fn record(&self, output: &Path) -> String {
        match &self.place {
            None => STDIN.to_string(),
            Some(place) => encoded(&relative(place, files::folder_of(output))),
        }
    }

    /// Checks that `record`, read from an output at `output`, is that of this description. The user calls the output `shown`.
    ///
    /// # Errors
    /// The record is that of another description, which the error names.
    pub fn check(&self, record: &str, output: &Path, shown: &Path) -> Result<(), Why> {
        if record == self.record(output) {
            return Ok(());
        }
        let named = decoded(record);
        // The path may be another name of the file, or contain a link.
        let recorded = files::folder_of(output).join(&named);
        let is_same = |place: &PathBuf| same_file::is_same_file(place, &recorded).unwrap_or(false);
        if record != STDIN && self.place.as_ref().is_some_and(is_same) {
            return Ok(());
        }
        let other = match record {
            STDIN => "a description on stdin".to_string(),
            _ => {
                let path = folded(&files::folder_of(shown).join(&named));
                format!("`{}`", path.display())
            }
        };
        let expected = match &self.place {
            None => "what stdin holds".to_string(),
            Some(_) => format!("`{}`", self.shown.display()),
        };
        let why = Why::new(format!("{OTHER}{other}, not from {expected}"));
        Err(why.help("name another file, or replace this one with `--force`"))
    }
}

/// Returns the path of a file relative to a folder, both without links. Of a file on another drive, only the name remains.
fn relative(file: &Path, folder: &Path) -> PathBuf {
    let [from, to] = [folder, file].map(|it| it.components().collect::<Vec<_>>());
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    if shared == 0 {
        return PathBuf::from(file.file_name().unwrap_or_default());
    }
    let up = from[shared..].iter().map(|_| Component::ParentDir);
    up.chain(to[shared..].iter().copied()).collect()
}

/// Removes each `folder/..` from a path.
fn folded(path: &Path) -> PathBuf {
    let mut folded = PathBuf::new();
    for part in path.components() {
        let is_folder = matches!(folded.components().next_back(), Some(Component::Normal(_)));
        match part {
            Component::CurDir => {}
            Component::ParentDir if is_folder => {
                folded.pop();
            }
            _ => folded.push(part),
        }
    }
    folded
}

fn encoded(path: &Path) -> String {
    let mut text = String::new();
    for part in path.components() {
        if !text.is_empty() {
            text.push('/');
        }
        for byte in part.as_os_str().as_encoded_bytes() {
            match char::from(*byte) {
                '-' if text.ends_with('-') => text += "%2D",
                it if it.is_ascii_alphanumeric() || "-._~".contains(it) => text.push(it),
                _ => text += &format!("%{byte:02X}"),
            }
        }
    }
    text
}

fn decoded(record: &str) -> PathBuf {
    let mut bytes = Vec::new();
    let mut rest = record.as_bytes();
    while let Some((first, after)) = rest.split_first() {
        rest = after;
        let digits = after.get(..2).and_then(|it| std::str::from_utf8(it).ok());
        match digits.and_then(|it| u8::from_str_radix(it, 16).ok()) {
            Some(byte) if *first == b'%' => {
                bytes.push(byte);
                rest = &after[2..];
            }
            _ => bytes.push(*first),
        }
    }
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStringExt as _;
        PathBuf::from(std::ffi::OsString::from_vec(bytes))
    }
    #[cfg(not(unix))]
    PathBuf::from(String::from_utf8_lossy(&bytes).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_is_the_way_from_the_output_to_its_source() {
        for (file, folder, record) in [
            ("/a/b/arm.mech", "/a/b", "arm.mech"),
            ("/a/b/arm.mech", "/a/b/arm", "../arm.mech"),
            ("/a/d/arm.mech", "/a/b/c", "../../d/arm.mech"),
            ("/a/Kran  ü%.mech", "/a", "Kran%20%20%C3%BC%25.mech"),
            ("/a/---\"<>&\n.mech", "/a", "-%2D-%22%3C%3E%26%0A.mech"),
        ] {
            let path = relative(Path::new(file), Path::new(folder));
            assert_eq!(encoded(&path), record, "{file} from {folder}");
            assert_eq!(decoded(record), path, "{file} from {folder}");
            assert_eq!(folded(&Path::new(folder).join(path)), Path::new(file));
        }
        // The decoder reads only what the encoder writes, and ends on any input.
        assert_eq!(decoded("%zz%4"), Path::new("%zz%4"));
        assert_eq!(folded(Path::new("../x/./../y")), Path::new("../y"));
    }
}
