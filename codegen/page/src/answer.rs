//! Defines the answer to a question of a page, in JSON: the one form in which a page receives numbers, drawing and text.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::controls::Control;
use crate::message::Message;
use crate::players::Players;
use crate::pull::Pulled;
use crate::question::Range;

/// Answer of a page.
///
/// A page in a file holds one with columns of `f32`, whose drawing and sections are in the HTML; the server of a description and the
/// solver as WebAssembly make them from questions, with the bits of the solver.
#[derive(Debug, Serialize)]
pub struct Answer {
    /// Motions; `None` if the description cannot be solved.
    #[serde(flatten)]
    pub players: Option<Players>,
    /// First paragraph of the documentation, as HTML.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lead: Option<String>,
    /// Drawing as SVG.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub drawing: String,
    /// True if the drawing has no room for the motion, and its names have not been placed.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub sketch: bool,
    /// Parameters and inputs; `None` while one of them moves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub controls: Option<Vec<Control>>,
    /// Times of the motion.
    pub range: Range,
    /// Inputs and time to which a point has been pulled; `None` if the question does not pull.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pulled: Option<Pulled>,
    /// Errors and warnings of the description and of its motion.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub messages: Vec<Message>,
    /// Names of the motions of the description if the question names none of several; the answer is about the first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub motions: Vec<String>,
    /// Quantities of `output` statements, whose curves are displayed first, as scripts name them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub requested: Vec<String>,
    /// Sections of the page as HTML, by their ids.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub sections: BTreeMap<&'static str, String>,
}

impl Answer {
    /// Creates an answer without a motion.
    pub(crate) fn without_motion(range: Range, messages: Vec<Message>) -> Answer {
        Answer {
            players: None,
            lead: None,
            drawing: String::new(),
            sketch: false,
            controls: None,
            range,
            pulled: None,
            messages,
            requested: Vec::new(),
            motions: Vec::new(),
            sections: BTreeMap::new(),
        }
    }
}
