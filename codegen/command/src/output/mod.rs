//! *Paths, before the work → files, after it.*
//!
//! A command names all files that it will write before it begins, so that what cannot be written is said at once. Nothing is
//! replaced that was not written by a command like it, which its first line shows, unless that is forced; and nothing at all
//! that the command reads. A file is complete or as it was, and missing folders are made. What is no regular file, such as a
//! pipe or `/dev/null`, is written to directly. The module does not know what is written.

mod place;

use std::collections::HashSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use linkwright_codegen::stages::files;

use self::place::{Why, existing, is_stdout, is_stream, missing, ours, replaceable};

/// How what a command writes is known again.
#[derive(Clone, Copy, Debug)]
pub struct Signature {
    /// What it is, as in "this is not …".
    pub noun: &'static str,
    /// How such a file begins.
    pub beginning: Beginning,
}

/// What tells a file of ours from others.
#[derive(Clone, Copy, Debug)]
pub enum Beginning {
    /// Whether this first line is that of such a file.
    Line(fn(&str) -> bool),
    /// Whether such a file has these first bytes, of which there are at most [`LONGEST_BEGINNING`].
    Bytes(fn(&[u8]) -> bool),
}

/// How many bytes are looked at of a file that is no text.
pub const LONGEST_BEGINNING: u64 = 256;

/// A file that cannot be written: why, and what can be done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// The file as it was named.
    pub path: PathBuf,
    /// Why it cannot be written.
    pub reason: String,
    /// What to do.
    pub help: Option<String>,
}

impl std::fmt::Display for Refused {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            formatter,
            "cannot write `{}`: {}",
            self.path.display(),
            self.reason
        )?;
        match &self.help {
            Some(help) => write!(formatter, "\n  = help: {help}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Refused {}

impl Refused {
    /// The same, saying what to do where that is not said yet.
    pub fn or_help(mut self, help: &str) -> Refused {
        self.help.get_or_insert_with(|| help.to_string());
        self
    }
}

/// The files that one command will write.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    /// What the command reads: the description, and the tables that it names.
    read: Vec<PathBuf>,
    /// Where what was named so far will be, without links; only looked up.
    places: HashSet<PathBuf>,
    /// The folders above.
    folders: HashSet<PathBuf>,
    is_forced: bool,
}

impl Outputs {
    /// None yet; `read` is never replaced, and other files only if `is_forced`.
    pub fn new(read: Vec<PathBuf>, is_forced: bool) -> Outputs {
        Outputs {
            read,
            places: HashSet::new(),
            folders: HashSet::new(),
            is_forced,
        }
    }

    /// One more file, known again by `signature`.
    ///
    /// # Errors
    /// It cannot be written, or it would replace what is not ours to replace.
    pub fn file(&mut self, path: &Path, signature: Signature) -> Result<Output, Refused> {
        let destination = self.destination(path, signature);
        let destination = destination.map_err(|why| why.about(path))?;
        Ok(Output {
            path: path.to_path_buf(),
            destination,
            signature,
            is_forced: self.is_forced,
        })
    }

    fn destination(&mut self, path: &Path, signature: Signature) -> Result<Destination, Why> {
        let place = match existing(path)? {
            None => missing(path)?,
            Some(kind) if kind.is_file() => fs::canonicalize(path)?,
            // A pipe waits here until somebody reads it.
            Some(kind) if is_stream(kind) => {
                return Ok(Destination::Stream(File::options().write(true).open(path)?));
            }
            Some(kind) => return Err(Why::new(files::noun(kind))),
        };
        self.take(&place)?;
        if place.exists() {
            replaceable(&place)?;
            if !self.is_forced {
                ours(&place, signature)?;
            }
        }
        Ok(Destination::File(place))
    }

    /// Notes where a file will be.
    fn take(&mut self, place: &Path) -> Result<(), Why> {
        let same = |other: &&PathBuf| same_file::is_same_file(place, other).unwrap_or(false);
        if let Some(read) = self.read.iter().find(same) {
            let why = format!("it is `{}`, which is read", read.display());
            return Err(Why::new(why).help("name another file"));
        }
        if is_stdout(place) {
            let why = Why::new("stdout goes to this file");
            return Err(why.help("name another file, or `-` for stdout"));
        }
        if self.places.contains(place) {
            let why = Why::new("something else is to be written to this file");
            return Err(why.help("name another file"));
        }
        let above = || place.ancestors().skip(1);
        let crossed = match self.folders.contains(place) {
            true => Some((place, "something else")),
            false => above()
                .find(|it| self.places.contains(*it))
                .map(|it| (it, "this")),
        };
        if let Some((file, what)) = crossed {
            let why = format!(
                "`{}` is to be a file, and {what} to lie in it",
                file.display()
            );
            return Err(Why::new(why).help("name another file"));
        }
        self.folders.extend(above().map(Path::to_path_buf));
        self.places.insert(place.to_path_buf());
        Ok(())
    }
}

/// A file that can be written.
#[derive(Debug)]
pub struct Output {
    path: PathBuf,
    destination: Destination,
    signature: Signature,
    is_forced: bool,
}

#[derive(Debug)]
enum Destination {
    /// Without links.
    File(PathBuf),
    Stream(File),
}

impl Output {
    /// The file as it was named.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether the file holds just this.
    pub fn holds(&self, contents: &[u8]) -> bool {
        let Destination::File(place) = &self.destination else {
            return false;
        };
        files::read(place, contents.len()).is_ok_and(|existing| existing == contents)
    }

    /// Writes what `contents` produces.
    ///
    /// # Errors
    /// Whatever the file system refuses; the file is then as it was.
    pub fn write(
        self,
        contents: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Refused> {
        let written = match self.destination {
            Destination::Stream(stream) => stream_to(stream, contents).map_err(Why::from),
            Destination::File(place) => {
                // Meanwhile somebody else may have written there.
                match place.exists() && !self.is_forced {
                    true => ours(&place, self.signature),
                    false => Ok(()),
                }
                .and_then(|()| Ok(fs::create_dir_all(files::folder_of(&place))?))
                .and_then(|()| Ok(files::replace(&place, contents)?))
            }
        };
        written.map_err(|why| why.about(&self.path))
    }
}

/// A reader of a pipe that goes away early is no error.
fn stream_to(
    stream: File,
    contents: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut buffered = BufWriter::new(stream);
    match contents(&mut buffered).and_then(|()| buffered.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
            let _ = buffered.into_parts();
            Ok(())
        }
        ended => ended,
    }
}
