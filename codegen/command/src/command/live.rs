//! Makes a live page of a description: the built playground with the description inside.

#[cfg(feature = "live")]
use std::collections::BTreeMap;

use linkwright_codegen::diagnostic::Source;
#[cfg(feature = "live")]
use linkwright_page::{Question, Range, Session, live};

use super::Problem;
use crate::arguments::View;

/// Playground, as `codegen/web/build` has built it.
#[cfg(feature = "live")]
const PLAYGROUND: &str = include_str!("../../live.html");

/// Returns the live page of a description with the arguments' values, assembly and times.
///
/// # Errors
/// An option or a table cannot be put into a page.
#[cfg(feature = "live")]
pub fn live_page(
    arguments: &View,
    source: &Source,
    assembly: Option<String>,
) -> Result<String, Problem> {
    let refused = |text: String, help: &str| Problem(format!("error: {text}\n  = help: {help}"));
    let mut files = BTreeMap::new();
    for attachment in &source.attachments {
        let bytes = attachment.bytes.clone().unwrap_or_default();
        let text = String::from_utf8(bytes).map_err(|_| {
            let text = format!("`{}` is not UTF-8 text", attachment.path);
            refused(text, "save the file as UTF-8")
        })?;
        files.insert(attachment.path.clone(), text);
    }
    let mut question = Question {
        text: source.text.clone(),
        files,
        motion: arguments.described.motion.clone(),
        units: arguments.reported_in.units.as_ref().map(|it| it.listing()),
        assembly,
        range: Range {
            from: arguments.from,
            to: arguments.to,
            step: arguments.step,
        },
        ..Question::default()
    };
    let mut session = Session::new(arguments.setting.set.clone());
    let controls = session.answer(&question).controls.unwrap_or_default();
    for assignment in &arguments.setting.set {
        let name = assignment.split('=').next().unwrap_or_default().trim();
        let control = controls.iter().find(|it| it.name == name);
        let value = control.and_then(|it| it.value).ok_or_else(|| {
            refused(
                format!("`--set {assignment}` does not set a number"),
                "a live page sets numbers; write a function of t into the description",
            )
        })?;
        question.values.insert(name.to_string(), value.to_string());
    }
    live(PLAYGROUND, &question).ok_or_else(|| {
        refused(
            "the live page of this build is incomplete".to_string(),
            "build it again with `codegen/web/build`",
        )
    })
}

/// Returns the error about the feature that is left out.
///
/// # Errors
/// Always.
#[cfg(not(feature = "live"))]
pub fn live_page(_: &View, _: &Source, _: Option<String>) -> Result<String, Problem> {
    let effect = "writes pages that solve mechanisms themselves";
    Err(super::left_out::refusal("live", effect))
}
