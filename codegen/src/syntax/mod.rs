//! Source to Document.
