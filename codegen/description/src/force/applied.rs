//! Forces and torques that the description writes out, as formulas of t, inputs, parameters, coordinates and rates.

use super::{Element, Exerted, Place, Rated, Shape, scaled};
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::geometry::{Mark, Vector, add, dot, perpendicular};

/// The points that a formula mentions.
#[derive(Clone, Debug, Default)]
pub struct Terms {
    /// The points.
    pub marks: Vec<Mark>,
    /// For each of them the symbols that stand for the components of its arm R s; `None` where nothing mentions the arm.
    pub arms: Vec<Option<[SymbolId; 2]>>,
    /// Formulas of these points, and of inputs and t, whose rates are mentioned.
    pub rated: Vec<ExprId>,
}

impl Terms {
    /// The components of the arms of these places, by the symbols that stand for them.
    fn arms_at(&self, places: &[Place]) -> Vec<(SymbolId, ExprId)> {
        let mut arms = Vec::new();
        for (place, symbols) in places.iter().zip(&self.arms) {
            if let Some([x, y]) = *symbols {
                arms.extend([(x, place.mark.arm[0]), (y, place.mark.arm[1])]);
            }
        }
        arms
    }

    /// A formula with the arms of these places put in.
    fn put_in(&self, formula: ExprId, places: &[Place], graph: &mut Graph) -> ExprId {
        graph.substitute(formula, &self.arms_at(places))
    }

    /// The formulas whose rates are mentioned, at these places.
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
    /// Where it acts.
    pub point: Mark,
    /// Its components, in N.
    pub components: Vector,
    /// The unit vector along the x axis of the frame of these components; `None` for the global frame.
    pub axis: Option<Mark>,
    /// What the components mention.
    pub terms: Terms,
}

impl Element for AppliedForce {
    fn shape(&self) -> Shape {
        Shape::Force
    }

    fn marks(&self) -> Vec<Mark> {
        let own = [Some(self.point), self.axis];
        let own = own.into_iter().flatten();
        own.chain(self.terms.marks.iter().copied()).collect()
    }

    fn exerted(&self, places: &[Place], _length: ExprId, graph: &mut Graph) -> Exerted {
        let own = 1 + usize::from(self.axis.is_some());
        let terms = &places[own..];
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
    /// The origin of the body's frame.
    pub body: Mark,
    /// In N·m, positive counterclockwise.
    pub value: ExprId,
    /// What the value mentions.
    pub terms: Terms,
}

impl Element for AppliedTorque {
    fn shape(&self) -> Shape {
        Shape::Torque
    }

    fn marks(&self) -> Vec<Mark> {
        let own = std::iter::once(self.body);
        own.chain(self.terms.marks.iter().copied()).collect()
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
