//! Sentences about the loads that a failure names.

/// Sentence about the table of their labels.
pub(in crate::emit) const LOADS: &str = "Loads that may become infinite, as written in the description; a failure has the index of a load in this list.";

/// Sentence about the function that finds the first that is not finite.
pub(in crate::emit) const BLAMED_LOAD: &str =
    "Ascribes a failure to the first load that is not finite, if the pose is finite.";
