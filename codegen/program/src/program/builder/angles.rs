//! An angle that was found → its direction, and the arms that turn with it, each computed once in a block.

use super::Builder;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::program::function::Statement;
use crate::words::Phrase;

/// The cosine and the sine of an angle that was found.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    /// cos φ.
    pub cosine: ExprId,
    /// sin φ.
    pub sine: ExprId,
}

impl Builder<'_> {
    /// The cosine and the sine of an angle as local values, of which a page knows the functions. The remark stands beside the first.
    pub fn direction(
        &mut self,
        unknown: usize,
        cosine: ExprId,
        sine: ExprId,
        remark: impl Into<Phrase>,
    ) -> Direction {
        let cosine = self.angle_function(unknown, true, cosine, remark.into());
        let sine = self.angle_function(unknown, false, sine, Phrase::default());
        Direction { cosine, sine }
    }

    /// The angle of a direction, and the arms that turn with it.
    pub fn angle(&mut self, unknown: usize, direction: Direction) {
        if let Some(inside) = &mut self.inside {
            inside.directions.insert(unknown, direction);
            return self.arms(unknown, direction);
        }
        let target = self.system.vector_form.unknowns[unknown].position;
        self.statements.push(Statement::Angle {
            target,
            sine: direction.sine,
            cosine: direction.cosine,
        });
        self.paths.note_direction(unknown, direction, self.system);
        self.arms(unknown, direction);
    }

    /// The arms that turn with an angle.
    pub fn arms(&mut self, unknown: usize, direction: Direction) {
        let arms: Vec<_> = self
            .system
            .vector_form
            .arms_of(unknown)
            .map(|arm| (arm.symbols, arm.local))
            .collect();
        for (symbols, local) in arms {
            if self.defined.insert(symbols[0]) {
                let turned = self.turn(direction, local);
                self.assign(symbols[0], turned[0]);
                self.assign(symbols[1], turned[1]);
            }
        }
    }

    /// Sine and cosine of an angle that is known explicitly; `None` where no arm turns with it.
    pub fn explicit_angle(&mut self, unknown: usize) -> Option<Direction> {
        if self.inside.is_none() && self.system.vector_form.arms_of(unknown).next().is_none() {
            return None;
        }
        let name = self.system.unknown_name(unknown).to_string();
        let angle = self.position(unknown);
        let [sine, cosine] =
            ["sin", "cos"].map(|function| self.system.intermediate(&format!("{function}_{name}")));
        self.statements.push(Statement::SineCosine {
            sine,
            cosine,
            angle,
        });
        let direction = Direction {
            sine: self.graph().variable(sine),
            cosine: self.graph().variable(cosine),
        };
        if let Some(inside) = &mut self.inside {
            inside.directions.insert(unknown, direction);
        }
        self.arms(unknown, direction);
        Some(direction)
    }

    /// The statements that compute the arms of these unknowns from the unknowns themselves; as if nothing had been defined.
    pub fn geometry(&mut self, unknowns: &[usize]) -> Vec<Statement> {
        let before = std::mem::take(&mut self.statements);
        let defined = self.defined.clone();
        for &unknown in unknowns {
            self.explicit_angle(unknown);
        }
        self.defined = defined;
        std::mem::replace(&mut self.statements, before)
    }

    /// The turned vector R(φ) p of a form as symbols that move with the angle: an arm where p does not move. The remark stands beside
    /// its first component.
    pub fn link(
        &mut self,
        angle: usize,
        p: Vector,
        value: Vector,
        name: &str,
        remark: impl Into<Phrase>,
    ) -> Vector {
        let graph = &self.system.mechanism.graph;
        if !p.iter().all(|&part| graph.is_fixed(part)) {
            return self.vector(name, value);
        }
        let arm = self.system.arm(angle, p, name);
        let arms = &self.system.vector_form.arms;
        let own = arms
            .iter()
            .position(|it| it.angle == angle && it.local == p);
        if let Some(place) = own {
            let symbols = arms[place].symbols;
            if self.defined.insert(symbols[0]) {
                self.assign_with(symbols[0], value[0], remark);
                self.assign(symbols[1], value[1]);
            }
            self.derivatives.change_arm(place, self.system);
        }
        self.call(arm, name);
        arm
    }
}
