//! Rod: two places that formulas give, in the plane or in space, have a constant distance.

use super::equation::written_row;
use super::link::refuse_length;
use super::{Feature, Kind, Operands, Refusal, Resolved, Row, Value};
use crate::expr::{ExprId, Graph};

/// |Q − P|² − ℓ² = 0.
pub struct Rod;

impl Kind for Rod {
    fn keyword(&self) -> &'static str {
        "equation"
    }

    fn operands(&self) -> Operands {
        Operands::of(&[])
    }

    fn value(&self) -> Value {
        Value::None
    }

    fn example(&self) -> &'static str {
        "`equation rod: distance((r*cos(a), 0, r*sin(a)), (0, L*cos(b), L*sin(b))) = 50mm;`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Written)
    }

    fn refusal(&self, operands: &Resolved, graph: &mut Graph) -> Option<Refusal> {
        let instead = "an `equation` for each of their components";
        refuse_length(operands.value?, instead, graph)
    }

    fn positive(&self, operands: &Resolved, _graph: &mut Graph) -> Option<(ExprId, &'static str)> {
        Some((operands.value?, "the distance"))
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        written_row(operands, graph)
    }
}
