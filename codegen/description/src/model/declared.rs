//! Holds the declared names.
//!
//! Names may only be used below their declaration.

use std::collections::HashMap;

use super::curve::DrawnCurve;
use super::expression::Value;
use super::measured_element::MeasuredElement;
use super::namespace::Namespace;
use super::parameters::Fields;
use super::{Input, Limit, Measurement, Motor, Parameter, Table};
use crate::diagnostic::{Attachment, Span, Suggestions};
use crate::expr::SymbolId;
use crate::joint::geometry::{BodyId, Vector};
use crate::syntax;

/// A global point of the design configuration.
#[derive(Clone, Debug)]
pub(super) struct DrawnPoint {
    pub position: Vector,
    pub docs: Vec<String>,
}

/// Names of a description.
pub(super) struct Declared<'a> {
    /// Constants, parameters and inputs.
    pub constants: Namespace<Value>,
    pub parameters: Vec<Parameter>,
    pub inputs: Vec<Input>,
    /// Index of the input with this symbol as its value; never iterated.
    pub input_places: HashMap<SymbolId, usize>,
    pub fields: Fields,
    /// First name with this constant of a table in the output; never iterated.
    pub table_fields: HashMap<String, syntax::Name>,
    /// Tables, as indices into `tables`; `None` for a statement with an error.
    pub table_names: Namespace<Option<usize>>,
    pub tables: Vec<Table>,
    pub drawn: Namespace<DrawnPoint>,
    /// Curves; `None` for a statement with an error.
    pub curves: Namespace<Option<DrawnCurve>>,
    /// For each point name, the first body of the whole description that lists it, and the location; never iterated.
    pub carried: HashMap<&'a str, (&'a str, Span)>,
    pub body_ids: Namespace<BodyId>,
    /// Body whose statement is being resolved; its name is undefined until the end of the statement.
    pub unfinished_body: Option<syntax::Name>,
    /// Names of drivers.
    pub drivers: Namespace<()>,
    /// Names of equations.
    pub equations: Namespace<()>,
    /// Names of springs and dampers.
    pub elements: Namespace<()>,
    /// Named springs and dampers without an error, for measures; never iterated.
    pub measured_elements: HashMap<String, MeasuredElement>,
    /// Measures, as indices into `measurements`; `None` for a statement with an error.
    pub measures: Namespace<Option<usize>>,
    pub measurements: Vec<Measurement>,
    pub limits: Vec<Limit>,
    pub motors: Vec<Motor>,
    /// True if a statement gives a joint friction.
    pub has_friction: bool,
    /// Files that the description names.
    pub attachments: &'a [Attachment],
    suggestions: Suggestions,
}

impl Declared<'_> {
    /// Creates the names with only the ground.
    pub fn new() -> Self {
        let mut declared = Declared {
            constants: Namespace::new("constant"),
            parameters: Vec::new(),
            inputs: Vec::new(),
            input_places: HashMap::new(),
            fields: Fields::new(),
            table_fields: HashMap::new(),
            table_names: Namespace::new("table"),
            tables: Vec::new(),
            drawn: Namespace::new("point"),
            curves: Namespace::new("curve"),
            carried: HashMap::new(),
            body_ids: Namespace::new("body"),
            unfinished_body: None,
            drivers: Namespace::new("driver"),
            equations: Namespace::new("equation"),
            elements: Namespace::new("spring or damper"),
            measured_elements: HashMap::new(),
            measures: Namespace::new("measure"),
            measurements: Vec::new(),
            limits: Vec::new(),
            motors: Vec::new(),
            has_friction: false,
            attachments: &[],
            suggestions: Suggestions::default(),
        };
        let ground = syntax::Name {
            text: "ground".to_string(),
            span: Span::default(),
        };
        // The first declaration of a new name space cannot be a duplicate.
        let _ = declared.body_ids.declare(&ground, BodyId::GROUND);
        declared
    }

    /// Returns the known name that was probably meant; `None` if none is near.
    pub fn nearest_known<'n>(
        &self,
        word: &str,
        known: impl IntoIterator<Item = &'n str>,
    ) -> Option<&'n str> {
        self.suggestions.nearest(word, known)
    }
}
