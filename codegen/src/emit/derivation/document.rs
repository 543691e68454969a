//! Parts of a derivation, independent of the page.
//!
//! Formulas and words are in the script of the page already; only their places are open.

/// A whole derivation.
#[derive(Clone, Debug)]
pub(super) struct Document {
    /// Name of the mechanism.
    pub name: String,
    /// Numbers of unknowns by solution method.
    pub summary: String,
    /// Unknowns and methods, in solve order.
    pub outline: Vec<OutlineLine>,
    /// One for each block.
    pub sections: Vec<Section>,
}

/// One step, or the explicit formulas, of a block.
#[derive(Clone, Debug)]
pub(super) struct OutlineLine {
    /// Number of the block, at its first line only.
    pub block: String,
    /// Unknowns.
    pub unknowns: String,
    /// Solution method.
    pub method: String,
    /// The joints whose equations the block uses, at its first line only.
    pub joints: String,
}

/// One block.
#[derive(Clone, Debug)]
pub(super) struct Section {
    /// Unknowns of the block, and their equations.
    pub heading: String,
    /// In reading order.
    pub items: Vec<Item>,
}

/// A part of a section.
#[derive(Clone, Debug)]
pub(super) enum Item {
    /// Words, with formulas between them.
    Paragraph(String),
    /// Displayed equations, aligned.
    Equations(Vec<DisplayedEquation>),
}

/// left = right, with a remark.
#[derive(Clone, Debug)]
pub(super) struct DisplayedEquation {
    /// Left side.
    pub left: String,
    /// Right side.
    pub right: String,
    /// Origin of the equation; may be empty.
    pub note: String,
}
