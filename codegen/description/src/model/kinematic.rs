//! Collects the points of moving bodies in an equation, a load or a measure, with symbols for their rotated local vectors.
//!
//! Every point becomes a mark, and the components of R s become symbols. The equation can thus be stated in the textbook
//! formulation and in the vector form. Sine and cosine of a body's angle are components of a rotated unit vector.

use std::collections::HashMap;

use super::measure::MeasureTerms;
use super::measurement::ArmSymbols;
use super::resolve::Resolver;
use crate::expr::{ExprId, SymbolId};
use crate::joint::geometry::{BodyId, Mark, Vector, add};
use crate::syntax::Reference;

/// Terms of the equation being resolved.
#[derive(Debug, Default)]
pub(super) struct KinematicTerms {
    /// Points of moving bodies, and origins of bodies whose coordinates are named.
    pub marks: Vec<Mark>,
    /// Symbols of the rotated local vector of each mark; `None` if they do not occur.
    pub arms: Vec<Option<[SymbolId; 2]>>,
    /// Formulas whose rates occur.
    pub rated: Vec<ExprId>,
    /// Index of each mark; never iterated.
    places: HashMap<(BodyId, Vector), usize>,
    formula: FormulaKind,
}

/// Kind of the formula being resolved, which determines the functions in it.
#[derive(Debug, Default)]
enum FormulaKind {
    #[default]
    Equation,
    /// Number of the force or torque, which may contain rates.
    Load(usize),
    /// Terms of a measure, which may contain rates, accelerations and forces.
    Measure(MeasureTerms),
}

impl KinematicTerms {
    /// Creates the terms of a force or a torque.
    pub(super) fn of_load(number: usize) -> KinematicTerms {
        KinematicTerms {
            formula: FormulaKind::Load(number),
            ..KinematicTerms::default()
        }
    }

    /// Creates the terms of a measure.
    pub(super) fn of_measure(terms: MeasureTerms) -> KinematicTerms {
        KinematicTerms {
            formula: FormulaKind::Measure(terms),
            ..KinematicTerms::default()
        }
    }

    /// Returns the terms of a measure; `None` for other formulas.
    pub(super) fn measure(&mut self) -> Option<&mut MeasureTerms> {
        match &mut self.formula {
            FormulaKind::Measure(terms) => Some(terms),
            FormulaKind::Equation | FormulaKind::Load(_) => None,
        }
    }

    /// Returns the terms of a measure with its points, and the symbols of their rotated local vectors.
    pub(super) fn into_measure(self) -> Option<(MeasureTerms, Vec<(Mark, ArmSymbols)>)> {
        match self.formula {
            FormulaKind::Measure(terms) => {
                Some((terms, self.marks.into_iter().zip(self.arms).collect()))
            }
            FormulaKind::Equation | FormulaKind::Load(_) => None,
        }
    }

    /// True for the terms of a force or a torque.
    pub(super) fn is_of_load(&self) -> bool {
        matches!(self.formula, FormulaKind::Load(_))
    }
}

impl Resolver<'_> {
    /// Returns the mark of a point in an equation. A point named without a body belongs to the first body that has it, or to
    /// the ground, if it is a global point. Otherwise it is the one point with this name on bodies.
    pub(super) fn live_point(&mut self, reference: &Reference) -> Option<Mark> {
        let name = &reference.name;
        if reference.body.is_some() {
            return self.point_mark(reference);
        }
        if self.declared.drawn.get(&name.text).is_some() {
            return match self.linkage.carriers.first_carrier(&name.text) {
                Some(carried) => Some(self.carried_mark(name, carried)),
                None => self.mark_on_ground(name),
            };
        }
        match self.linkage.carriers.carriers_of(&name.text)[..] {
            [only] => Some(self.carried_mark(name, only)),
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

    /// Returns r + R s, with the symbols of the rotated local vector.
    pub(super) fn live_position(&mut self, mark: Mark) -> Vector {
        let arm = self.live_arm(mark);
        add(mark.frame.origin, arm, &mut self.graph)
    }

    /// Returns the symbols of a mark's rotated local vector; the vector itself if it is constant.
    pub(super) fn live_arm(&mut self, mark: Mark) -> Vector {
        if mark.frame.body == BodyId::GROUND {
            self.linkage.named_on_ground.push(mark.local);
            return mark.arm;
        }
        let at = self.mention_mark(mark);
        if mark.local == [self.graph.zero(); 2] {
            return mark.arm;
        }
        // The name begins with a digit, so it differs from all coordinates.
        let formula = self.formulas.kinematic.as_ref().map(|it| &it.formula);
        let name = match formula {
            Some(FormulaKind::Load(load)) => format!("{load} load arm {at}"),
            Some(FormulaKind::Measure(_)) => {
                format!("{} measure arm {at}", self.declared.measurements.len())
            }
            Some(FormulaKind::Equation) | None => {
                format!("{} arm {at}", self.linkage.joints.len())
            }
        };
        let symbols = ["x", "y"].map(|axis| self.graph.symbol(&format!("{name} {axis}")));
        if let Some(kinematic) = &mut self.formulas.kinematic {
            kinematic.arms[at] = Some(symbols);
        }
        symbols.map(|symbol| self.graph.variable(symbol))
    }

    /// Adds a mark to the equation and returns its index.
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
