//! Writes a file piece by piece, so that an interrupted run can continue it.
//!
//! Pieces go to `FILE.part`, which becomes FILE when it is complete. `FILE.part.definition` says what FILE is to hold; a run continues only what
//! has its own definition. A run holds a lock on the part.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, Seek as _, SeekFrom, Write};
use std::path::{Path, PathBuf};

use linkwright_codegen::stages::files;

use super::place::Why;
use super::{Destination, Output, Refused};

/// Ending of the name of an incomplete file.
const PART: &str = ".part";

/// Ending of the name of the file beside it.
const DEFINITION: &str = ".definition";

/// Output that is being written.
pub struct Pieces {
    /// Path as the user named the file.
    path: PathBuf,
    writer: BufWriter<File>,
    /// Complete file and its parts; `None` for a stream.
    place: Option<Place>,
    /// File that names the source.
    beside: Option<Box<Output>>,
}

struct Place {
    complete: PathBuf,
    part: PathBuf,
    definition: PathBuf,
}

impl Place {
    fn of(complete: &Path) -> Place {
        let with = |path: &Path, ending: &str| {
            let mut name = path.as_os_str().to_owned();
            name.push(ending);
            PathBuf::from(name)
        };
        let part = with(complete, PART);
        Place {
            complete: complete.to_path_buf(),
            definition: with(&part, DEFINITION),
            part,
        }
    }
}

impl Output {
    /// Begins to write a file whose contents follow from `definition`.
    ///
    /// # Errors
    /// An interrupted run has left a part, for which `help` is the help, unless its replacement is forced; or the error of the file system.
    pub fn pieces(self, definition: &str, help: &str) -> Result<Pieces, Refused> {
        let path = self.path.clone();
        self.begun(definition, help).map_err(|why| why.about(&path))
    }

    /// Opens the part that an interrupted run with this definition has left; begins a new file if there is none.
    ///
    /// # Errors
    /// The part has another definition, or the file is a stream; or the error of the file system.
    pub fn resumed_pieces(self, definition: &str) -> Result<Pieces, Refused> {
        let path = self.path.clone();
        self.resumed(definition).map_err(|why| why.about(&path))
    }

    fn begun(self, definition: &str, help: &str) -> Result<Pieces, Why> {
        let Output {
            path,
            destination,
            beside,
            is_forced,
            ..
        } = self;
        let place = match destination {
            Destination::Stream(stream) => {
                return Ok(Pieces {
                    path,
                    writer: BufWriter::new(stream),
                    place: None,
                    beside: None,
                });
            }
            Destination::File(place) => Place::of(&place),
        };
        if place.part.exists() && !is_forced {
            let why = Why::new(format!(
                "an interrupted run has left `{}`",
                shown(&path, PART).display()
            ));
            return Err(why.help(help));
        }
        fs::create_dir_all(files::folder_of(&place.part))?;
        let file = locked(&place.part)?;
        file.set_len(0)?;
        files::replace(&place.definition, |output| {
            output.write_all(definition.as_bytes())
        })?;
        Ok(Pieces {
            path,
            writer: BufWriter::new(file),
            place: Some(place),
            beside,
        })
    }

    fn resumed(self, definition: &str) -> Result<Pieces, Why> {
        let complete = match &self.destination {
            Destination::Stream(_) => {
                let why = Why::new("it is not a regular file, so that no run can continue it");
                return Err(why.help("leave out `--resume`"));
            }
            Destination::File(place) => place.clone(),
        };
        let place = Place::of(&complete);
        // A run that is killed at its begin leaves an empty part without a definition.
        match fs::metadata(&place.part) {
            Ok(part) if part.len() > 0 => {}
            _ => {
                let is_forced = true;
                return Output { is_forced, ..self }.begun(definition, "");
            }
        }
        let part = shown(&self.path, PART);
        let recorded = fs::read_to_string(&place.definition).unwrap_or_default();
        if recorded != definition {
            let differs = |(one, other): &(&str, &str)| one != other;
            let mut lines = definition.lines().zip(recorded.lines());
            let why = match lines.find(differs) {
                Some((own, other)) => format!(
                    "`{}` belongs to another sweep: expected `{own}`, found `{other}`",
                    part.display()
                ),
                None => format!("`{}` belongs to another sweep", part.display()),
            };
            let why = Why::new(why);
            return Err(why.help(
                "repeat the options of the interrupted run, or replace the part with `--force`",
            ));
        }
        let mut file = locked(&place.part)?;
        file.seek(SeekFrom::End(0))?;
        Ok(Pieces {
            path: self.path,
            writer: BufWriter::new(file),
            place: Some(place),
            beside: self.beside,
        })
    }
}

impl Pieces {
    /// Returns the part that is written so far, from its beginning; `None` for a stream.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn part(&self) -> Result<Option<File>, Refused> {
        if self.place.is_none() {
            return Ok(None);
        }
        // On some systems the lock keeps other handles from reading.
        let handle = self.writer.get_ref().try_clone();
        let rewound = handle.and_then(|mut file| file.rewind().map(|()| file));
        rewound
            .map(Some)
            .map_err(|error| Why::from(error).about(&self.path))
    }

    /// Removes all behind the first `length` bytes.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn cut(&mut self, length: u64) -> Result<(), Refused> {
        let file = self.writer.get_mut();
        let cut = file.set_len(length);
        let cut = cut.and_then(|()| file.seek(SeekFrom::Start(length)));
        cut.map(drop)
            .map_err(|error| Why::from(error).about(&self.path))
    }

    /// Refuses to continue what this command has not written.
    pub fn foreign(&self) -> Refused {
        let why = Why::new("its part has rows that this command does not write");
        why.help("replace the part with `--force`")
            .about(&self.path)
    }

    /// Writes an end that later bytes overwrite, so that an interrupted run leaves a complete file; does nothing for a stream.
    ///
    /// # Errors
    /// Errors of the file system.
    #[cfg(feature = "parquet")]
    pub fn end_so_far(&mut self, end: &[u8]) -> io::Result<()> {
        if self.place.is_none() {
            return Ok(());
        }
        self.writer.flush()?;
        let file = self.writer.get_mut();
        let length = file.stream_position()?;
        file.write_all(end)?;
        file.seek(SeekFrom::Start(length)).map(drop)
    }

    /// Ends the file: its part becomes the file itself.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn finish(mut self) -> Result<(), Refused> {
        let flushed = self.writer.flush();
        flushed.map_err(|error| Why::from(error).about(&self.path))?;
        let Some(place) = self.place else {
            return Ok(());
        };
        if let Some(beside) = self.beside {
            beside.write(|_| Ok(()))?;
        }
        let ended = fs::rename(&place.part, &place.complete)
            .and_then(|()| fs::remove_file(&place.definition));
        ended.map_err(|error| Why::from(error).about(&self.path))
    }
}

impl Write for Pieces {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

/// Returns the path of a part in the words of the user.
fn shown(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    PathBuf::from(name)
}

/// Opens a part for this run alone.
fn locked(part: &Path) -> Result<File, Why> {
    let mut options = OpenOptions::new();
    let file = options
        .read(true)
        .write(true)
        .create(true)
        .truncate(false)
        .open(part)?;
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(Why::new("another run is writing it")),
        // A file system without locks.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(file),
    }
}
