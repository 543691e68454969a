//! What joints can carry, and what is said of it.

use crate::expr::ExprId;
use crate::joint::geometry::Vector;

/// What a joint can carry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carried {
    /// A force through a point.
    Force,
    /// A force and a moment.
    ForceAndMoment,
    /// A force along this unit vector, across a line, and a moment.
    NormalAndMoment(Vector),
    /// A force along this unit vector alone, across a line.
    Normal(Vector),
    /// A force along this unit vector, with which a link pulls.
    Tension(Vector),
    /// A force of so much per multiplier, with which a rod between places that formulas give pulls them together.
    Rod(ExprId),
    /// A force along this unit vector, which teeth pass on.
    Tooth(Vector),
    /// A force along this unit vector, with which bodies press on one another.
    Pressure(Vector),
    /// A force along x (0) or y (1).
    Component(usize),
    /// A moment.
    Moment,
    /// The moment with which a wheel turns another.
    WheelMoment,
    /// The force of teeth, and its moment about the axis of the wheel.
    Teeth,
    /// The multiplier of an equation: what is conjugate to its residual.
    Multiplier,
}

impl Carried {
    /// What is said of it, component by component.
    pub fn components(self) -> &'static [Component] {
        match self {
            Carried::Force => &[Component::X, Component::Y],
            Carried::ForceAndMoment | Carried::Teeth => {
                &[Component::X, Component::Y, Component::Moment]
            }
            Carried::NormalAndMoment(_) => &[Component::Normal, Component::Moment],
            Carried::Normal(_) => &[Component::Normal],
            Carried::Tension(_) | Carried::Rod(_) => &[Component::Tension],
            Carried::Tooth(_) => &[Component::Tooth],
            Carried::Pressure(_) => &[Component::Pressure],
            Carried::Component(0) => &[Component::X],
            Carried::Component(_) => &[Component::Y],
            Carried::Moment | Carried::WheelMoment => &[Component::Moment],
            Carried::Multiplier => &[Component::Multiplier],
        }
    }

    /// True if it is the moment with which a wheel turns another, which its multiplier balances wherever the wheels are.
    pub fn turns_wheel(self) -> bool {
        matches!(self, Carried::WheelMoment | Carried::Teeth)
    }

    /// The direction of the force that is said.
    pub fn direction(self) -> Option<Vector> {
        match self {
            Carried::NormalAndMoment(direction)
            | Carried::Normal(direction)
            | Carried::Tension(direction)
            | Carried::Tooth(direction)
            | Carried::Pressure(direction) => Some(direction),
            _ => None,
        }
    }
}

/// A component of a reaction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// The force along x, in N.
    X,
    /// The force along y, in N.
    Y,
    /// The force to the left of the joint's line, in N.
    Normal,
    /// The force with which a link pulls the points together, in N.
    Tension,
    /// The force that teeth pass on along their line, in N.
    Tooth,
    /// The force with which bodies press on one another, in N: where it is negative they would have to pull.
    Pressure,
    /// The moment, in N·m.
    Moment,
    /// The multiplier of an equation, in J per unit of its residual.
    Multiplier,
}

impl Component {
    /// What follows the name of the joint: `x`, `moment`; empty where it is all that the joint carries.
    pub fn suffix(self) -> &'static str {
        match self {
            Component::X => "x",
            Component::Y => "y",
            Component::Normal => "normal",
            Component::Tension => "tension",
            Component::Tooth => "tooth",
            Component::Pressure => "pressure",
            Component::Moment => "moment",
            Component::Multiplier => "multiplier",
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Component::Moment => "N*m",
            Component::Multiplier => "J",
            _ => "N",
        }
    }
}
