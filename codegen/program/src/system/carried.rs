//! Describes the reactions that joints can carry.

use crate::expr::ExprId;
use crate::joint::geometry::Vector;

/// Reaction that a joint can carry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carried {
    /// Force through a point.
    Force,
    /// Force and moment.
    ForceAndMoment,
    /// Force along this unit vector, across a line, and moment.
    NormalAndMoment(Vector),
    /// Force along this unit vector, across a line, without moment.
    Normal(Vector),
    /// Tension of a link along this unit vector.
    Tension(Vector),
    /// Tension of a rod between points that formulas give; the value is the force per unit of the multiplier.
    Rod(ExprId),
    /// Force of teeth along this unit vector.
    Tooth(Vector),
    /// Contact force along this unit vector.
    Pressure(Vector),
    /// Force along x (0) or y (1).
    Component(usize),
    /// Moment.
    Moment,
    /// Moment of a wheel on another wheel.
    WheelMoment,
    /// Force of teeth, and its moment about the axis of the wheel.
    Teeth,
    /// Multiplier of an equation, conjugate to its residual.
    Multiplier,
}

impl Carried {
    /// Returns the components of the reaction, in the order of the outputs.
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

    /// True if the reaction is the moment on a wheel, which its multiplier balances wherever the wheels are.
    pub fn turns_wheel(self) -> bool {
        matches!(self, Carried::WheelMoment | Carried::Teeth)
    }

    /// Returns the direction of the force; `None` if it has no fixed direction.
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

/// Component of a reaction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// Force along x, in N.
    X,
    /// Force along y, in N.
    Y,
    /// Force to the left of the joint's line, in N.
    Normal,
    /// Tension of a link between the points, in N.
    Tension,
    /// Force of teeth along their line of action, in N.
    Tooth,
    /// Contact force between bodies, in N; negative if the bodies would have to pull.
    Pressure,
    /// Moment, in N·m.
    Moment,
    /// Multiplier of an equation, in J per unit of its residual.
    Multiplier,
}

impl Component {
    /// Returns the suffix after the joint's name: `x`, `moment`; empty if the joint carries nothing else.
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

    /// Returns the unit of the component.
    pub fn unit(self) -> &'static str {
        match self {
            Component::Moment => "N*m",
            Component::Multiplier => "J",
            _ => "N",
        }
    }
}
