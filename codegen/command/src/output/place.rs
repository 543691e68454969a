//! Checks that a file can be written at a path, and resolves links in the path.

use std::fs::{self, File};
use std::io::{self, BufRead as _, BufReader, Read as _};
use std::path::{Path, PathBuf};

use linkwright_codegen::stages::files;

use super::record::{LONGEST_RECORD, Source};
use super::{Beginning, LONGEST_BEGINNING, Record, Refused, Signature};

/// Number of bytes of a first line that are read. A table of ten thousand bodies has a first line of two megabytes.
const LONGEST_LINE: u64 = 16 << 20;

/// Reason why a file cannot be written.
pub(super) struct Why {
    reason: String,
    help: Option<String>,
}

impl From<io::Error> for Why {
    fn from(error: io::Error) -> Why {
        Why::new(files::reason(&error))
    }
}

impl Why {
    pub fn new(reason: impl Into<String>) -> Why {
        Why {
            reason: reason.into(),
            help: None,
        }
    }

    pub fn help(mut self, help: impl Into<String>) -> Why {
        self.help = Some(help.into());
        self
    }

    pub fn about(self, path: &Path) -> Refused {
        Refused {
            path: path.to_path_buf(),
            reason: self.reason,
            help: self.help,
        }
    }
}

/// Returns the type of the file at a path, links followed; `None` if no file exists.
pub(super) fn existing(path: &Path) -> Result<Option<fs::FileType>, Why> {
    match fs::metadata(path) {
        Ok(found) => Ok(Some(found.file_type())),
        Err(error) if leads_nowhere(&error) => match fs::read_link(path) {
            Ok(target) => Err(Why::new(format!(
                "`{}` is a link to `{}`, which does not exist",
                path.display(),
                target.display()
            ))),
            Err(_) => Ok(None),
        },
        Err(error) => Err(Why::from(error)),
    }
}

fn leads_nowhere(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::NotFound | io::ErrorKind::NotADirectory
    )
}

/// Returns the path without links of a file that does not exist; its folders exist or can be created.
pub(super) fn missing(path: &Path) -> Result<PathBuf, Why> {
    let (Some(name), false) = (path.file_name(), ends_as_folder(path)) else {
        return Err(Why::new("this is not the name of a file"));
    };
    let mut rest = vec![name];
    let mut folder = files::folder_of(path);
    let kind = loop {
        if let Some(kind) = existing(folder)? {
            break kind;
        }
        let Some(name) = folder.file_name() else {
            return Err(Why::new(format!("`{}` does not exist", folder.display())));
        };
        rest.push(name);
        folder = files::folder_of(folder);
    };
    if !kind.is_dir() {
        return Err(Why::new(format!("`{}` is not a folder", folder.display())));
    }
    let place = fs::canonicalize(folder)?;
    may_write_in(&place, folder)?;
    Ok(rest
        .iter()
        .rev()
        .fold(place, |place, name| place.join(name)))
}

/// True if a path can only be that of a folder.
fn ends_as_folder(path: &Path) -> bool {
    let text = path.as_os_str().as_encoded_bytes();
    text.last()
        .is_some_and(|last| std::path::is_separator(char::from(*last)))
}

fn may_write_in(folder: &Path, shown: &Path) -> Result<(), Why> {
    files::may_write_in(folder).map_err(|error| {
        Why::new(format!(
            "cannot create a file in `{}`: {}",
            shown.display(),
            files::reason(&error)
        ))
    })
}

/// Checks that another file can replace an existing one.
pub(super) fn replaceable(place: &Path) -> Result<(), Why> {
    if fs::metadata(place)?.permissions().readonly() {
        return Err(Why::new("the file is write-protected"));
    }
    // Opening a file for appending changes nothing.
    File::options().append(true).open(place)?;
    let folder = files::folder_of(place);
    may_write_in(folder, folder)
}

/// Checks that a file, which the user calls `shown`, is empty, or begins like an output and is not that of another source.
pub(super) fn ours(
    place: &Path,
    shown: &Path,
    signature: Signature,
    source: Option<&Source>,
) -> Result<(), Why> {
    let mut file = BufReader::new(File::open(place)?);
    let mut start = Vec::new();
    let is_ours = match signature.beginning {
        Beginning::Line(is_first_line) => {
            file.take(LONGEST_LINE).read_until(b'\n', &mut start)?;
            let text = std::str::from_utf8(&start);
            let text = text.map(|line| line.trim_end_matches(['\n', '\r']));
            text.is_ok_and(is_first_line)
        }
        Beginning::Bytes(is_start) => {
            file.by_ref()
                .take(LONGEST_BEGINNING)
                .read_to_end(&mut start)?;
            is_start(&start)
        }
    };
    if start.is_empty() {
        return Ok(());
    }
    if is_ours {
        return same_source(place, shown, signature, source);
    }
    let why = Why::new(format!(
        "a file exists already, and it is not {}",
        signature.noun
    ));
    Err(why.help("name another file, or replace this one with `--force`"))
}

/// Checks that a file does not name another source.
fn same_source(
    place: &Path,
    shown: &Path,
    signature: Signature,
    source: Option<&Source>,
) -> Result<(), Why> {
    let (Record::Inside { found, .. }, Some(source)) = (signature.record, source) else {
        return Ok(());
    };
    let mut start = Vec::new();
    let file = File::open(place)?;
    file.take(LONGEST_RECORD).read_to_end(&mut start)?;
    match found(&start) {
        Some(record) => source.check(&record, place, shown),
        None => Ok(()),
    }
}

/// True if another program receives what is written to a file of this kind.
#[cfg(unix)]
pub(super) fn is_stream(kind: fs::FileType) -> bool {
    use std::os::unix::fs::FileTypeExt as _;
    kind.is_fifo() || kind.is_char_device()
}

#[cfg(not(unix))]
pub(super) fn is_stream(_: fs::FileType) -> bool {
    false
}

pub(super) fn is_stdout(place: &Path) -> bool {
    let same = same_file::Handle::from_path(place)
        .and_then(|place| Ok(place == same_file::Handle::stdout()?));
    same.unwrap_or(false)
}
