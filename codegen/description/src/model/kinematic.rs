//! What an equation mentions of bodies that move: points, and the symbols of their arms.
//!
//! Every point becomes a mark, and its arm R s a pair of symbols that stand for it, so that the equation can be stated with
//! the arms of the textbook as well as with those of the vector form. The sine and the cosine of a body's angle are the arm
//! of a unit vector.

use std::collections::HashMap;

use super::resolve::Resolver;
use crate::expr::{ExprId, SymbolId};
use crate::joint::geometry::{BodyId, Mark, Vector, add};
use crate::syntax::Reference;

/// What the equation that is being read mentions so far.
#[derive(Debug, Default)]
pub(super) struct KinematicTerms {
    /// Points of bodies that move, and their origins where coordinates are named.
    pub marks: Vec<Mark>,
    /// What stands for the arm of each mark; `None` where nothing mentions it.
    pub arms: Vec<Option<[SymbolId; 2]>>,
    /// Formulas whose rates it mentions.
    pub rated: Vec<ExprId>,
    /// The place of each mark; only looked up.
    places: HashMap<(BodyId, Vector), usize>,
    /// The number of the load whose formula is read, which may mention rates; `None` for an equation.
    load: Option<usize>,
}

impl KinematicTerms {
    /// Those of a force or a torque.
    pub(super) fn of_load(number: usize) -> KinematicTerms {
        KinematicTerms {
            load: Some(number),
            ..KinematicTerms::default()
        }
    }

    /// Whether they are those of a force or a torque.
    pub(super) fn is_of_load(&self) -> bool {
        self.load.is_some()
    }
}

impl Resolver<'_> {
    /// The mark of a point in an equation. One that is named without a body is, where it is drawn, a point of the first body
    /// that carries it, or of the ground; and otherwise the one point that bodies give this name.
    pub(super) fn live_point(&mut self, reference: &Reference) -> Option<Mark> {
        let name = &reference.name;
        if reference.body.is_some() {
            return self.point_mark(reference);
        }
        if self.declared.drawn.get(&name.text).is_some() {
            return match self.linkage.carriers.first_carrier(&name.text) {
                Some(carried) => Some(self.carried(carried).mark),
                None => self.mark_on_ground(name),
            };
        }
        match self.linkage.carriers.carriers_of(&name.text)[..] {
            [only] => Some(self.carried(only).mark),
            [] if self.declared.body_ids.get(&name.text).is_some() => {
                self.moving_body(name)?;
                self.origin_mark(reference)
            }
            [] => {
                let unknown = self.declared.drawn.unknown(&name.text, name.span);
                self.diagnostics.push(unknown);
                None
            }
            [_, _, ..] => {
                self.report_without_body(name);
                None
            }
        }
    }

    /// r + R s in terms of the symbols of the arm.
    pub(super) fn live_position(&mut self, mark: Mark) -> Vector {
        let arm = self.live_arm(mark);
        add(mark.frame.origin, arm, &mut self.graph)
    }

    /// The symbols that stand for the arm of a mark; the arm itself where it does not turn.
    pub(super) fn live_arm(&mut self, mark: Mark) -> Vector {
        if mark.frame.body == BodyId::GROUND {
            self.linkage.named_on_ground.push(mark.local);
            return mark.arm;
        }
        let at = self.mention_mark(mark);
        if mark.local == [self.graph.zero(); 2] {
            return mark.arm;
        }
        // No coordinate can have such a name: it begins with a digit.
        let load = self.formulas.kinematic.as_ref().and_then(|it| it.load);
        let name = match load {
            Some(load) => format!("{load} load arm {at}"),
            None => format!("{} arm {at}", self.linkage.joints.len()),
        };
        let symbols = ["x", "y"].map(|axis| self.graph.symbol(&format!("{name} {axis}")));
        if let Some(kinematic) = &mut self.formulas.kinematic {
            kinematic.arms[at] = Some(symbols);
        }
        symbols.map(|symbol| self.graph.variable(symbol))
    }

    /// Notes that the equation mentions a mark: its index.
    pub(super) fn mention_mark(&mut self, mark: Mark) -> usize {
        let Some(kinematic) = &mut self.formulas.kinematic else {
            return 0;
        };
        let place = (mark.frame.body, mark.local);
        if let Some(&known) = kinematic.places.get(&place) {
            return known;
        }
        kinematic.places.insert(place, kinematic.marks.len());
        kinematic.marks.push(mark);
        kinematic.arms.push(None);
        kinematic.marks.len() - 1
    }
}
