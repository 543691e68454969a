//! Holds an open document: its text in the editor, and what has been derived from the text.

use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;

use linkwright_codegen::Read;
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::files;
use linkwright_codegen::stages::syntax::named_files;
use linkwright_editing::Description;
use lsp_types::{TextDocumentContentChangeEvent, TextDocumentItem, Uri};

use super::text::{Encoding, Text};

/// Reason that a document without a file has no tables.
const UNSAVED: &str = "the description is not saved yet";

/// Open document.
pub struct Document {
    /// Name for the client.
    pub uri: Uri,
    /// Text in the editor, which may be unsaved.
    pub text: Text,
    /// Number that the client gives to the text; `None` if the client does not count.
    pub version: Option<i32>,
    /// Number that the server gives to the text.
    pub number: u64,
    /// Equations of a text without errors, perhaps an older one; `None` if there was none yet.
    pub equations: Option<Arc<Equations>>,
    path: Option<PathBuf>,
    description: Option<Rc<Description>>,
}

/// Equations of a text.
pub struct Equations {
    /// Text.
    pub text: String,
    /// Motions of the description.
    pub read: Read,
}

impl Document {
    /// Creates a document that the client opens.
    pub fn new(item: TextDocumentItem, encoding: Encoding) -> Document {
        Document {
            path: path(&item.uri),
            uri: item.uri,
            text: Text::new(item.text, encoding),
            version: Some(item.version),
            number: 0,
            equations: None,
            description: None,
        }
    }

    /// Applies changes to the text.
    pub fn change(&mut self, version: i32, changes: &[TextDocumentContentChangeEvent]) {
        for change in changes {
            self.text.replace(change.range, &change.text);
        }
        self.version = Some(version);
        self.description = None;
    }

    /// Returns the text with the files that it names, from the folder of the document.
    pub fn source(&self) -> Source {
        let text = self.text.as_str();
        match &self.path {
            Some(path) => {
                let source = Source::new(path.display().to_string(), text);
                linkwright_codegen::stages::files::attach_files(source, files::folder_of(path))
            }
            None => {
                let source = Source::new(self.uri.as_str(), text);
                let named = named_files(text).into_iter();
                named.fold(source, |source, path| {
                    source.with_attachment(path, Err(UNSAVED.to_string()))
                })
            }
        }
    }

    /// Returns the text as a description, which is read once for each text.
    pub fn description(&mut self) -> Rc<Description> {
        if let Some(known) = &self.description {
            return Rc::clone(known);
        }
        let description = Rc::new(Description::of(self.source()));
        self.description = Some(Rc::clone(&description));
        description
    }

    /// Returns the equations of the current text; `None` if they have not been derived.
    pub fn equations(&self) -> Option<&Read> {
        let equations = self.equations.as_ref()?;
        (equations.text == self.text.as_str()).then_some(&equations.read)
    }
}

/// Returns the file of an address; `None` for addresses that are not files.
fn path(uri: &Uri) -> Option<PathBuf> {
    let is_file = uri.scheme()?.as_str().eq_ignore_ascii_case("file");
    let path = uri.path().as_estr().decode().into_string().ok()?;
    // On Windows, a drive follows the first slash.
    let has_drive = path.as_bytes().get(2) == Some(&b':') && path.starts_with('/');
    let path = if has_drive { &path[1..] } else { &path };
    is_file.then(|| PathBuf::from(path))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn addresses_of_files_are_paths() {
        let of = |address: &str| path(&address.parse().expect("an address"));
        assert_eq!(
            of("file:///home/a%20b/arm.mech").as_deref(),
            Some(Path::new("/home/a b/arm.mech"))
        );
        assert_eq!(
            of("file:///c%3A/arm.mech").as_deref(),
            Some(Path::new("c:/arm.mech"))
        );
        assert_eq!(of("untitled:Untitled-1"), None);
    }
}
