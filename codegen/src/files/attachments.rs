//! Reads the files that a description names.

use std::path::Path;

use super::{read, reason};
use crate::diagnostic::Source;
use crate::syntax;

/// Returns a description with the files that it names, read from its folder. A file that cannot be read is an error of
/// the description later.
pub fn attach_files(source: Source, folder: &Path) -> Source {
    let paths = syntax::named_files(&source.text);
    paths.into_iter().fold(source, |source, path| {
        let bytes = read(&folder.join(&path), Source::MAX_BYTES);
        source.with_attachment(path, bytes.map_err(|error| reason(&error)))
    })
}
