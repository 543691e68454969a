//! Dispatches requests about a document to the modules that answer them.

use std::collections::BTreeMap;
use std::rc::Rc;

use linkwright_editing::{self as editing, Description};
use lsp_server::ErrorCode;
use lsp_types as lsp;
use lsp_types::Uri;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::converted;
use super::document::Document;

/// Reason that a request has no answer.
#[derive(Debug)]
pub struct Refusal {
    /// Class of reasons.
    pub code: ErrorCode,
    /// Reason.
    pub message: String,
}

impl Refusal {
    /// Creates a refusal of a class.
    pub fn new(code: ErrorCode, message: &str) -> Refusal {
        Refusal {
            code,
            message: message.to_string(),
        }
    }

    /// Creates the refusal of a request that failed.
    pub fn failed(message: String) -> Refusal {
        Refusal {
            code: ErrorCode::RequestFailed,
            message,
        }
    }
}

/// Reads the parameters of a request.
///
/// # Errors
/// The parameters do not follow the protocol.
pub fn read<T: DeserializeOwned>(params: Value) -> Result<T, Refusal> {
    serde_json::from_value(params)
        .map_err(|error| Refusal::new(ErrorCode::InvalidParams, &error.to_string()))
}

/// Returns an answer as JSON.
///
/// # Errors
/// The answer cannot be serialized.
pub fn written(answer: &impl Serialize) -> Result<Value, Refusal> {
    serde_json::to_value(answer)
        .map_err(|error| Refusal::new(ErrorCode::InternalError, &error.to_string()))
}

/// Document and offset of a request.
struct Asked<'a> {
    document: &'a Document,
    description: Rc<Description>,
    offset: usize,
}

type Documents = BTreeMap<String, Document>;

fn opened<'a>(documents: &'a mut Documents, uri: &Uri) -> Result<&'a mut Document, Refusal> {
    documents
        .get_mut(uri.as_str())
        .ok_or_else(|| Refusal::new(ErrorCode::InvalidParams, "this document is not open"))
}

fn asked<'a>(
    documents: &'a mut Documents,
    at: &lsp::TextDocumentPositionParams,
) -> Result<Asked<'a>, Refusal> {
    let document = opened(documents, &at.text_document.uri)?;
    let description = document.description();
    let offset = document.text.offset(at.position);
    Ok(Asked {
        document,
        description,
        offset,
    })
}

/// Answers a request.
///
/// # Errors
/// The method is unknown, or the request cannot be answered.
pub fn answer(method: &str, params: Value, documents: &mut Documents) -> Result<Value, Refusal> {
    match method {
        "textDocument/hover" => {
            let params: lsp::HoverParams = read(params)?;
            let at = asked(documents, &params.text_document_position_params)?;
            let read = at.document.equations();
            let hover = editing::hover(&at.description, read, at.offset);
            written(&hover.map(|it| converted::hover(at.document, it)))
        }
        "textDocument/definition" => {
            let params: lsp::GotoDefinitionParams = read(params)?;
            let at = asked(documents, &params.text_document_position_params)?;
            let declarations = editing::definitions(&at.description.names, at.offset);
            written(&converted::locations(at.document, &declarations))
        }
        "textDocument/references" => {
            let params: lsp::ReferenceParams = read(params)?;
            let at = asked(documents, &params.text_document_position)?;
            let is_with_declaration = params.context.include_declaration;
            let names = &at.description.names;
            let mentions = editing::references(names, at.offset, is_with_declaration);
            written(&converted::locations(at.document, &mentions))
        }
        "textDocument/documentHighlight" => {
            let params: lsp::DocumentHighlightParams = read(params)?;
            let at = asked(documents, &params.text_document_position_params)?;
            let mentions = editing::references(&at.description.names, at.offset, true);
            let ranges = mentions.into_iter().map(|span| lsp::DocumentHighlight {
                range: at.document.text.range(span),
                kind: None,
            });
            written(&ranges.collect::<Vec<_>>())
        }
        "textDocument/completion" => {
            let params: lsp::CompletionParams = read(params)?;
            let at = asked(documents, &params.text_document_position)?;
            let completions = editing::completions(&at.description, at.offset);
            let items = completions.into_iter();
            let items = items.map(|it| converted::completion(at.document, it));
            written(&items.collect::<Vec<_>>())
        }
        "textDocument/prepareRename" => {
            let params: lsp::TextDocumentPositionParams = read(params)?;
            let at = asked(documents, &params)?;
            let (span, name) =
                editing::renamable(&at.description, at.offset).map_err(Refusal::failed)?;
            written(&lsp::PrepareRenameResponse::RangeWithPlaceholder {
                range: at.document.text.range(span),
                placeholder: name.to_string(),
            })
        }
        "textDocument/rename" => {
            let params: lsp::RenameParams = read(params)?;
            let at = asked(documents, &params.text_document_position)?;
            let new = params.new_name.as_str();
            // A text with equations has no errors.
            let is_sound = at.document.equations().is_some();
            let edits = editing::rename(&at.description, is_sound, at.offset, new)
                .map_err(Refusal::failed)?;
            written(&converted::workspace_edit(at.document, edits))
        }
        "textDocument/documentSymbol" => {
            let params: lsp::DocumentSymbolParams = read(params)?;
            let document = opened(documents, &params.text_document.uri)?;
            let description = document.description();
            let entries = editing::outline(&description).into_iter();
            let symbols = entries.map(|it| converted::symbol(document, it));
            written(&symbols.collect::<Vec<_>>())
        }
        "textDocument/formatting" => {
            let params: lsp::DocumentFormattingParams = read(params)?;
            let document = opened(documents, &params.text_document.uri)?;
            written(&converted::edits(
                document,
                editing::formatted(&document.source()),
            ))
        }
        _ => Err(Refusal::new(
            ErrorCode::MethodNotFound,
            &format!("`{method}` is not supported"),
        )),
    }
}
