//! Computes directions of angles, and the vectors that rotate with them, once per block.

use super::Builder;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::program::function::Statement;
use crate::words::Phrase;

/// Cosine and sine of a known angle.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    /// Cosine of φ.
    pub cosine: ExprId,
    /// Sine of φ.
    pub sine: ExprId,
}

impl Builder<'_> {
    /// Names the cosine and the sine of an angle as local values, which derivations print as functions. The remark is printed
    /// with the first.
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

    /// Finds the angle of a direction, and the vectors that rotate with it.
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
        self.paths
            .note_direction(unknown, direction, self.pool, self.system);
        self.arms(unknown, direction);
    }

    /// Computes the vectors that rotate with an angle.
    pub fn arms(&mut self, unknown: usize, direction: Direction) {
        let arms: Vec<_> = self
            .pool
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

    /// Returns cosine and sine of an explicitly known angle; `None` if no vector rotates with it.
    pub fn explicit_angle(&mut self, unknown: usize) -> Option<Direction> {
        if self.inside.is_none() && self.pool.arms_of(unknown).next().is_none() {
            return None;
        }
        let name = self.system.unknown_name(unknown).to_string();
        let angle = self.position(unknown);
        let [sine, cosine] =
            ["sin", "cos"].map(|function| self.pool.intermediate(&format!("{function}_{name}")));
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

    /// Returns the statements for the rotated vectors of these unknowns, from the unknowns alone.
    pub fn geometry(&mut self, unknowns: &[usize]) -> Vec<Statement> {
        let before = std::mem::take(&mut self.statements);
        let defined = self.defined.clone();
        for &unknown in unknowns {
            self.explicit_angle(unknown);
        }
        self.defined = defined;
        std::mem::replace(&mut self.statements, before)
    }

    /// Returns the rotated vector R(φ) p of a closed form as symbols that move with the angle: a vector of the vector form if p
    /// is constant. The remark is printed with its first component.
    pub fn link(
        &mut self,
        angle: usize,
        p: Vector,
        value: Vector,
        name: &str,
        remark: impl Into<Phrase>,
    ) -> Vector {
        let graph = &self.pool.graph;
        if !p.iter().all(|&part| graph.is_fixed(part)) {
            return self.vector(name, value);
        }
        let arm = self.pool.arm(angle, p, name);
        let arms = &self.pool.arms();
        let place_of_arm = arms
            .iter()
            .position(|it| it.angle == angle && it.local == p);
        if let Some(place) = place_of_arm {
            let symbols = arms[place].symbols;
            if self.defined.insert(symbols[0]) {
                self.assign_with(symbols[0], value[0], remark);
                self.assign(symbols[1], value[1]);
            }
            self.derivatives.change_arm(place, self.pool);
        }
        self.call(arm, name);
        arm
    }
}
