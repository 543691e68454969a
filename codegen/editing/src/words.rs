//! Words findings for an editor.

use linkwright_codegen::diagnostic::Diagnostic;

/// Returns the text of a finding, a line each: message, label, background, help.
pub fn words(found: &Diagnostic) -> String {
    let mut lines = vec![found.message.clone()];
    lines.extend((!found.primary.text.is_empty()).then(|| found.primary.text.clone()));
    lines.extend(found.notes.iter().map(|note| format!("note: {note}")));
    lines.extend(found.help.iter().map(|help| format!("help: {help}")));
    lines.join("\n")
}
