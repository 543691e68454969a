//! Converts a solved instant to the pose of a drawing.

use linkwright_codegen::stages::emit::drawing::Pose;

use crate::instant::Instant;
use crate::view::View;

/// Returns an instant as a pose for drawings, with parameters, inputs, rates and accelerations.
pub fn pose<V: View>(view: &V, instant: &Instant) -> Pose {
    let symbols = view.layout().symbols().iter().copied();
    let known = symbols.zip(instant.values().iter().copied());
    Pose::new(view.pool(), known)
}
