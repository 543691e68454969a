//! Defines a question of a live page: a description, values of its parameters and inputs, an assembly and times.

use std::collections::BTreeMap;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::syntax;
use linkwright_codegen::stages::units::OutputUnits;
use serde::{Deserialize, Serialize};

/// Name of the description in messages.
const NAME: &str = "the description";

/// Question of a page, in JSON.
///
/// ```
/// use linkwright_page::{Detail, Question};
///
/// let question: Question = serde_json::from_str(r#"{"text": "", "values": {"rod": "130"}, "detail": "moving"}"#)?;
/// assert_eq!((question.values["rod"].as_str(), question.detail), ("130", Detail::Moving));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Question {
    /// Text of the description.
    pub text: String,
    /// Texts of the tables that the description names, by their paths.
    pub files: BTreeMap<String, String>,
    /// Name of the motion; `None` for the only one.
    pub motion: Option<String>,
    /// Units of values, `mm,deg`; `None` for those of the description.
    pub units: Option<String>,
    /// Label of the assembly; `None` for that of the design configuration.
    pub assembly: Option<String>,
    /// Values of parameters, inputs and starts of free coordinates by name: a number in the unit of its control, or a formula of the
    /// language. Those of other names are left out.
    pub values: BTreeMap<String, String>,
    /// Times of the motion.
    pub range: Range,
    /// Parts of the answer.
    pub detail: Detail,
    /// Pixels per metre of a moving drawing, those of the one before it; `None` to fill the picture.
    pub scale: Option<f64>,
    /// Point that is pulled before the rest is answered.
    pub pull: Option<Pull>,
}

/// Pull of a point.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Pull {
    /// Name of the point.
    pub point: String,
    /// Position to which it is pulled (m).
    pub to: [f64; 2],
    /// Time of the pose from which it is pulled (s).
    pub t: f64,
    /// Inputs that may move, by name, with the ends of their ranges in the units of their controls. Functions of time stay, and free
    /// coordinates move whatever their ranges.
    #[serde(default)]
    pub ranges: BTreeMap<String, [f64; 2]>,
}

/// Times of a motion (s).
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// First time.
    pub from: f64,
    /// Last time.
    pub to: f64,
    /// Time between instants.
    pub step: f64,
}

/// Parts of an answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Detail {
    /// One assembly, and a drawing without room for the motion: while a control moves.
    Moving,
    /// All assemblies, the whole drawing and the controls.
    #[default]
    Resting,
    /// The sections of the page alone.
    Sections,
}

impl Default for Range {
    fn default() -> Range {
        Range {
            from: 0.0,
            to: 5.0,
            step: 0.01,
        }
    }
}

impl Pull {
    /// Rejects numbers that are not finite.
    ///
    /// # Errors
    /// A sentence.
    pub(crate) fn require_finite(&self) -> Result<(), String> {
        let mut numbers = self.to.iter().chain([&self.t]);
        match numbers.all(|it| it.is_finite()) {
            true => Ok(()),
            false => Err("a pull needs finite numbers".to_string()),
        }
    }
}

impl Question {
    /// Returns the question with other values, in the units of their controls.
    pub(crate) fn with(&self, values: &[(String, f64)]) -> Question {
        let mut question = self.clone();
        let texts = values
            .iter()
            .map(|(name, it)| (name.clone(), format!("{it:e}")));
        question.values.extend(texts);
        question
    }

    /// Returns the description with its tables.
    pub fn source(&self) -> Source {
        let units = self.units.as_deref();
        let units = units.and_then(|it| OutputUnits::listed(it).ok());
        let source = Source::new(NAME, self.text.clone()).reported_in(units);
        let paths = syntax::named_files(&source.text);
        paths.into_iter().fold(source, |source, path| {
            let bytes = match self.files.get(&path) {
                Some(text) => Ok(text.clone().into_bytes()),
                None => Err("the page has no file of this name".to_string()),
            };
            source.with_attachment(path, bytes)
        })
    }
}
