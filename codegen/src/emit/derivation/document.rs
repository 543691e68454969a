//! What a derivation consists of, whatever it is printed on.
//!
//! Formulas and words are in the script of the page already; only their places are open.

/// A whole derivation.
#[derive(Clone, Debug)]
pub(super) struct Document {
    /// The mechanism's name.
    pub name: String,
    /// How many unknowns are found in which way.
    pub summary: String,
    /// What is found by which method, in solve order.
    pub outline: Vec<OutlineLine>,
    /// One for each block.
    pub sections: Vec<Section>,
}

/// One step, or the explicit formulas, of a block.
#[derive(Clone, Debug)]
pub(super) struct OutlineLine {
    /// The block's number, at its first line only.
    pub block: String,
    /// What is found.
    pub unknowns: String,
    /// How.
    pub method: String,
    /// The joints whose equations the block uses, at its first line only.
    pub joints: String,
}

/// One block.
#[derive(Clone, Debug)]
pub(super) struct Section {
    /// What it finds, and from what.
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
    /// What stands left of the sign.
    pub left: String,
    /// What stands right of it.
    pub right: String,
    /// Where it comes from; may be empty.
    pub note: String,
}
