//! Sentences about the loads that a failure names.

/// Sentence about the table of their labels.
pub(in crate::emit) const LOADS: &str = "The loads that may become infinite, as the description writes them; a failure names one by its place here.";

/// Sentence about the function that finds the first that is not finite.
pub(in crate::emit) const BLAMED_LOAD: &str =
    "Ascribes a failure to the first load that is not finite, if the pose is.";
