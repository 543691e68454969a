//! A solved instant → the pose of a drawing.

use linkwright_codegen::stages::emit::drawing::Pose;

use crate::instant::Instant;
use crate::view::View;

/// An instant as the drawing room takes it, with what was given at it and how fast all moves.
pub fn pose<V: View>(view: &V, instant: &Instant) -> Pose {
    let symbols = view.layout().symbols().iter().copied();
    let known = symbols.zip(instant.values().iter().copied());
    Pose::new(view.system(), known)
}
