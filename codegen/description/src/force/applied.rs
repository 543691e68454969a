//! Applied forces and torques: formulas of t, inputs, parameters, coordinates and rates.

use super::{Element, Exerted, Place, Rated, Shape, scaled};
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::geometry::{Mark, Vector, add, dot, perpendicular};

/// Points and rates in a formula.
#[derive(Clone, Debug, Default)]
pub struct Terms {
    /// Points of the formula.
    pub marks: Vec<Mark>,
    /// For each point, the symbols of the components of its rotated local vector R s; `None` if they do not occur.
    pub arms: Vec<Option<[SymbolId; 2]>>,
    /// Formulas of these points, inputs and t whose rates occur.
    pub rated: Vec<ExprId>,
}

impl Terms {
    /// Returns the components of the rotated local vectors at these places, by symbol.
    fn arms_at(&self, places: &[Place]) -> Vec<(SymbolId, ExprId)> {
        let mut arms = Vec::new();
        for (place, symbols) in places.iter().zip(&self.arms) {
            if let Some([x, y]) = *symbols {
                arms.extend([(x, place.mark.arm[0]), (y, place.mark.arm[1])]);
            }
        }
        arms
    }

    /// Substitutes the rotated local vectors at these places in a formula.
    fn put_in(&self, formula: ExprId, places: &[Place], graph: &mut Graph) -> ExprId {
        graph.substitute(formula, &self.arms_at(places))
    }

    /// Returns the formulas whose rates occur, at these places.
    fn rated(&self, places: &[Place]) -> Vec<Rated> {
        let formulas = self.rated.iter();
        let rated = formulas.map(|formula| Rated {
            formula: *formula,
            arms: self.arms_at(places),
        });
        rated.collect()
    }
}

/// A force on a point.
#[derive(Clone, Debug)]
pub struct AppliedForce {
    /// Point of application.
    pub point: Mark,
    /// Components, in N.
    pub components: Vector,
    /// Unit vector along the x axis of the frame of the components; `None` for the global frame.
    pub axis: Option<Mark>,
    /// Points and rates in the components.
    pub terms: Terms,
}

impl Element for AppliedForce {
    fn shape(&self) -> Shape {
        Shape::Force
    }

    fn marks(&self) -> Vec<Mark> {
        let marks = [Some(self.point), self.axis];
        let marks = marks.into_iter().flatten();
        marks.chain(self.terms.marks.iter().copied()).collect()
    }

    fn exerted(&self, places: &[Place], _length: ExprId, graph: &mut Graph) -> Exerted {
        let count = 1 + usize::from(self.axis.is_some());
        let terms = &places[count..];
        let [x, y] = self
            .components
            .map(|component| self.terms.put_in(component, terms, graph));
        let force = match self.axis {
            None => [x, y],
            Some(_) => {
                let along = places[1].mark.arm;
                let across = perpendicular(along, graph);
                let parts = [scaled(along, x, graph), scaled(across, y, graph)];
                add(parts[0], parts[1], graph)
            }
        };
        let power = dot(force, places[0].velocity, graph);
        Exerted {
            forces: vec![(places[0].mark, force)],
            added: Some(power),
            rated: self.terms.rated(terms),
            ..Exerted::default()
        }
    }
}

/// A torque on a body.
#[derive(Clone, Debug)]
pub struct AppliedTorque {
    /// Origin of the body's frame.
    pub body: Mark,
    /// Torque in N·m, positive counterclockwise.
    pub value: ExprId,
    /// Points and rates in the value.
    pub terms: Terms,
}

impl Element for AppliedTorque {
    fn shape(&self) -> Shape {
        Shape::Torque
    }

    fn marks(&self) -> Vec<Mark> {
        let body_mark = std::iter::once(self.body);
        body_mark.chain(self.terms.marks.iter().copied()).collect()
    }

    fn exerted(&self, places: &[Place], _length: ExprId, graph: &mut Graph) -> Exerted {
        let torque = self.terms.put_in(self.value, &places[1..], graph);
        Exerted {
            torques: vec![(places[0].mark.frame.body, torque)],
            added: Some(graph.multiply(torque, places[0].turning)),
            rated: self.terms.rated(&places[1..]),
            ..Exerted::default()
        }
    }
}
