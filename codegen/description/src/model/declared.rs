//! What has been declared so far, by name.
//!
//! Names may only be used below their declaration. What they stand for is known here; how formulas use them, and what moves, is not.

use std::collections::HashMap;

use super::curve::DrawnCurve;
use super::expression::Value;
use super::namespace::Namespace;
use super::parameters::Fields;
use super::{Input, Parameter, Table};
use crate::diagnostic::{Attachment, Span, Suggestions};
use crate::expr::SymbolId;
use crate::joint::geometry::{BodyId, Vector};
use crate::syntax;

/// A point of the drawing.
#[derive(Clone, Debug)]
pub(super) struct DrawnPoint {
    pub position: Vector,
    pub docs: Vec<String>,
}

/// The names of a description.
pub(super) struct Declared<'a> {
    /// Constants, parameters and inputs.
    pub constants: Namespace<Value>,
    pub parameters: Vec<Parameter>,
    pub inputs: Vec<Input>,
    /// The place of the input that a symbol is the value of; only looked up.
    pub input_places: HashMap<SymbolId, usize>,
    pub fields: Fields,
    /// The name that first became this constant of a table; only looked up.
    pub table_fields: HashMap<String, syntax::Name>,
    /// Tables: places in the list below; nothing where the statement has an error.
    pub table_names: Namespace<Option<usize>>,
    pub tables: Vec<Table>,
    pub drawn: Namespace<DrawnPoint>,
    /// Curves; nothing where the statement has an error.
    pub curves: Namespace<Option<DrawnCurve>>,
    /// The first body in the whole description that carries a point of each name, and where it lists it; only looked up.
    pub carried: HashMap<&'a str, (&'a str, Span)>,
    pub body_ids: Namespace<BodyId>,
    /// The body whose statement is being read: its name stands for nothing before the end of the statement.
    pub unfinished_body: Option<syntax::Name>,
    /// The names that drivers were given.
    pub drivers: Namespace<()>,
    /// The names that equations were given.
    pub equations: Namespace<()>,
    /// The names that springs and dampers were given.
    pub elements: Namespace<()>,
    /// The files that the description names.
    pub attachments: &'a [Attachment],
    suggestions: Suggestions,
}

impl Declared<'_> {
    /// Nothing but the ground.
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
            attachments: &[],
            suggestions: Suggestions::default(),
        };
        let ground = syntax::Name {
            text: "ground".to_string(),
            span: Span::default(),
        };
        // The first declaration of a fresh name space cannot be a duplicate.
        let _ = declared.body_ids.declare(&ground, BodyId::GROUND);
        declared
    }

    /// The known name that was probably meant.
    pub fn nearest_known<'n>(
        &self,
        word: &str,
        known: impl IntoIterator<Item = &'n str>,
    ) -> Option<&'n str> {
        self.suggestions.nearest(word, known)
    }
}
