//! A solved instant → the pose of a drawing.

use linkwright_codegen::stages::emit::drawing::Pose;

use crate::instant::Instant;
use crate::view::View;

/// An instant as the drawing room takes it, with what was given at it.
pub fn pose<V: View>(view: &V, instant: &Instant) -> Pose {
    let (system, layout) = (view.system(), view.layout());
    let mechanism = &system.mechanism;
    let parameters = mechanism.parameters.iter().map(|it| it.symbol);
    let inputs = mechanism.inputs.iter().flat_map(|it| it.symbols);
    let coordinates = system.coordinates.iter().map(|it| it.position);
    let symbols = [mechanism.time].into_iter().chain(parameters);
    let symbols = symbols.chain(inputs).chain(coordinates);
    let known = symbols.filter_map(|symbol| Some((symbol, instant.values()[layout.slot(symbol)?])));
    Pose::new(system, known)
}
