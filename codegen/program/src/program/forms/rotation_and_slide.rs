//! Solves R(φ) p + ℓ d + c = 0 with a known direction d: a circle of radius |p| meets a line (RRP dyad).
//!
//! The rotated link w = R(φ) p has the component n = c × d across the line. Along the line, w · d = k = ±√(p² d² − n²), whose
//! sign is the assembly mode. The determinant of the block's Jacobian [Ω w, d] is −k.

use std::sync::Arc;

use super::closing::Closing;
use super::determinant::{crossed, orientation, sizes};
use super::two_rotations::turning;
use super::{Candidate, Determinant, Form, Solved, Transposed};
use crate::expr::ExprId;
use crate::joint::geometry::{Vector, perpendicular};
use crate::pool::Pool;
use crate::program::builder::Builder;
use crate::program::function::Level;
use crate::program::stretch::Stretch;
use crate::words::{Phrase, Piece, Singular, phrase};

/// Equation R(φ) p + ℓ d + c = 0.
#[derive(Clone, Debug)]
struct RotationAndSlide {
    angle: usize,
    slide: usize,
    /// Vector p, constant in its body.
    link: Vector,
    /// Direction d.
    direction: Vector,
    /// Vector c, the known vector that closes the loop.
    closure: Vector,
    /// Arrangement of the equations as components.
    arrangement: usize,
}

pub(super) fn recognize(candidate: &mut Candidate<'_>) -> Option<Arc<dyn Form>> {
    let (equations, [angle, slide]) = candidate.pair_of([true, false])?;
    let symbol = candidate.pool.position(slide);
    let zero = candidate.pool.graph.zero();
    let arrangements = candidate.arrangements(equations).into_iter().enumerate();
    for (arrangement, arranged) in arrangements {
        let pool = &mut *candidate.pool;
        let direction = arranged.map(|equation| pool.graph.derivative(equation, symbol));
        let without = arranged.map(|equation| pool.graph.substitute(equation, &[(symbol, zero)]));
        let Some((link, closure)) = pool.turned_vector(without, angle) else {
            continue;
        };
        let is_known = |part: &ExprId| {
            !candidate.mentions(*part, angle) && !candidate.pool.graph.depends_on(*part, symbol)
        };
        if direction.iter().all(is_known) {
            return Some(Arc::new(RotationAndSlide {
                angle,
                slide,
                link,
                direction,
                closure,
                arrangement,
            }));
        }
    }
    None
}

impl Form for RotationAndSlide {
    fn name(&self) -> String {
        "RRP dyad".to_string()
    }

    fn unknowns(&self) -> Vec<usize> {
        vec![self.angle, self.slide]
    }

    /// Returns the determinant of [Ω w, d], which is Ω w × d = −w · d.
    fn determinant(&self, pool: &mut Pool) -> Determinant {
        let turned = perpendicular(self.link, &mut pool.graph);
        let (turning, d) = orientation(self.direction, pool);
        let value = crossed([Some(self.angle), turning], [turned, d], pool);
        let size = sizes([self.link, d], pool);
        Determinant::closed(value, size, pool)
    }

    fn singular(&self) -> Singular {
        Singular::LinkAlongLine {
            angle: self.angle,
            slide: self.slide,
            link: self.link,
        }
    }

    fn modes(&self) -> Option<usize> {
        Some(2)
    }

    fn position(&self, builder: &mut Builder<'_>) -> Box<dyn Solved> {
        let (angle, slide, p) = (self.angle, self.slide, self.link);
        self.open(builder);
        let link = builder
            .known
            .link(angle, p, |_, _| true, builder.pool, builder.system);
        let pins = link
            .as_ref()
            .map(|it| [it.from.name.as_str(), it.to.name.as_str()]);
        builder.name_link(angle, p, pins, "p");
        // A local value has no rule of motion, so the chain below has the direction as it was written.
        let d = builder.vector("d", self.direction);
        let c = builder.vector("c", self.closure);
        let n = builder.cross(c, d);
        let n = builder.value_with("n", n, Piece::Cross("c".to_string(), "d".to_string()));
        let d_square = builder.dot(d, d);
        let d_square = builder.value("|d|^2", d_square);
        let p_square = builder.dot(p, p);
        let p_square = builder.value("|p|^2", p_square);
        let graph = builder.graph();
        let scale = graph.multiply(p_square, d_square);
        let n_square = graph.multiply(n, n);
        let excess = graph.subtract(scale, n_square);
        let excess = builder.factor("excess", excess);
        let graph = builder.graph();
        let by_length = graph.divide(n_square, d_square);
        let ends = [graph.sqrt(by_length), graph.sqrt(p_square), graph.zero()];
        builder.reach(excess, scale, ends);
        let drawn = {
            let w = builder.system.drawn_turn(angle, p, builder.pool);
            let line = self
                .direction
                .map(|part| builder.system.drawn_value(part, builder.pool));
            let lengths = w[0].hypot(w[1]) * line[0].hypot(line[1]);
            (w[0] * line[0] + w[1] * line[1]) / lengths
        };
        let name = builder.system.unknown_name(angle).to_string();
        let meaning =
            "the direction of the link: positive along the line, negative against it".to_string();
        let branch = builder.branch(name, meaning, drawn);
        let root = builder.graph().sqrt(excess);
        let k = builder.graph().multiply(branch, root);
        let k = builder.value_with("k", k, "with the sign of the design configuration");
        // w = (k d + n Ω d)/d².
        let across = builder.across(d);
        let value = builder.combined(k, d, n, across);
        let value = value.map(|part| builder.graph().divide(part, d_square));
        let w = builder.link(angle, p, value, "w", "");
        let direction = turning(angle, p, w, p_square, "w", builder);
        builder.angle(angle, direction);
        let stretch = builder.moving_link(angle, p, w, direction);
        // ℓ d² = −(c · d + k).
        let along = builder.dot(c, d);
        let graph = builder.graph();
        let total = graph.add(along, k);
        let ratio = graph.divide(total, d_square);
        let length = graph.negate(ratio);
        builder.find(slide, Level::Position, length);
        builder.say(|_| {
            phrase![
                "The sign of ",
                Piece::Local("k".to_string()),
                " is the assembly mode: positive if the link points along the line."
            ]
        });
        let length = builder.position(slide);
        let slid = self
            .direction
            .map(|part| builder.graph().multiply(length, part));
        let chain = [w, slid, self.closure];
        Box::new(Found::new(
            [angle, slide],
            w,
            d,
            k,
            (self.arrangement, false),
            &chain,
            stretch,
            builder,
        ))
    }
}

impl RotationAndSlide {
    /// Describes the known values and the closed loop.
    fn open(&self, builder: &mut Builder<'_>) {
        let link = builder.known.link(
            self.angle,
            self.link,
            |_, _| true,
            builder.pool,
            builder.system,
        );
        let [angle, slide] = [self.angle, self.slide].map(Piece::Unknown);
        let names = link
            .as_ref()
            .map(|link| [&link.from, &link.to].map(|pin| Piece::Name(pin.name.clone())));
        let source = match &names {
            Some([center, end]) => {
                phrase![
                    " from the circle of ",
                    end.clone(),
                    " about ",
                    center.clone(),
                    " and a line"
                ]
            }
            None => " from a circle and a line".into(),
        };
        builder.heading(phrase![angle, " and ", slide, source]);
        builder.say(|builder| match (&link, &names) {
            (Some(link), Some([center, end])) => phrase![
                center.clone(),
                ", ",
                builder.known.whereabouts(&link.held, builder.system),
                ", is known. Sought is ",
                end.clone(),
                " on a circle about ",
                center.clone(),
                " and on a line of known direction."
            ],
            _ => Phrase::default(),
        });
        builder.say(|_| "The loop closes, as vectors and by components:".into());
        builder.show(|builder| {
            let turned = Piece::Turned(self.angle, self.link);
            let length = builder.position(self.slide);
            let tail = [0, 1].map(|axis| {
                let graph = builder.graph();
                let slid = graph.multiply(length, self.direction[axis]);
                graph.add(slid, self.closure[axis])
            });
            let link = builder.turned_by(self.angle, self.link);
            let whole = [0, 1].map(|axis| builder.graph().add(link[axis], tail[axis]));
            builder.closed_loop(phrase![turned, " + ", Piece::Sum(tail)], whole)
        });
        builder.say(|_| {
            "The part of the known vector across the line is that of the link too; so the part along the line is a square root \
             (Pythagoras):"
                .into()
        });
    }
}

/// Solved equation Ω w φ̇ + d ℓ̇ = −v, with k = w · d.
pub(super) struct Found {
    columns: [Vector; 2],
    k: ExprId,
    /// Arrangement of the equations as components, and true if the loop was reversed.
    arranged: (usize, bool),
    inverse: Option<ExprId>,
    closing: Closing,
}

impl Found {
    #[expect(clippy::too_many_arguments, reason = "the parts of one loop")]
    pub(super) fn new(
        unknowns: [usize; 2],
        w: Vector,
        d: Vector,
        k: ExprId,
        arranged: (usize, bool),
        chain: &[Vector],
        stretches: impl IntoIterator<Item = Stretch>,
        builder: &mut Builder<'_>,
    ) -> Found {
        Found {
            columns: [builder.across(w), d],
            k,
            arranged,
            inverse: None,
            closing: Closing::new(unknowns, chain, stretches, builder),
        }
    }
}

impl Solved for Found {
    /// Returns w · d, minus the determinant.
    fn determinant(&self) -> Option<ExprId> {
        Some(self.k)
    }

    fn transposed(&self, builder: &mut Builder<'_>) -> Option<Transposed> {
        let (arrangement, reversed) = self.arranged;
        Some(Transposed::Two {
            columns: self.columns,
            determinant: builder.graph().negate(self.k),
            arrangement,
            reversed,
        })
    }

    fn prepare(&mut self, builder: &mut Builder<'_>) {
        let graph = builder.graph();
        let one = graph.one();
        let inverse = graph.divide(one, self.k);
        let inverse = builder.factor("inverse_k", inverse);
        self.inverse = Some(builder.graph().negate(inverse));
        let determinant = builder.graph().negate(self.k);
        self.closing.say(Piece::Formula(determinant), builder);
    }

    fn rates(&self, level: Level, builder: &mut Builder<'_>) {
        if let Some(inverse) = self.inverse {
            self.closing.solve(self.columns, inverse, level, builder);
        }
    }
}
