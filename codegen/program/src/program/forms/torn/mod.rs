//! Solves equations by a sequence of closed forms after iterating a few unknowns, the tearing variables.
//!
//! For given tearing variables z, all other unknowns follow, and as many equations g(z) = 0 remain as there are tearing
//! variables. Newton-Raphson iterates these alone. Each closed form is differentiated in the direction of each tearing variable,
//! so the derivative dg/dz is exact (Elmqvist and Otter, Methods for tearing systems of equations in object-oriented modeling,
//! 1994).
//!
//! The same matrix gives the rates: first those at constant tearing variables, then those of the tearing variables, then the
//! total. If a closed form inside is nearly singular, although the whole need not be, all equations are solved at once.

mod completed;
mod functions;
mod levels;
mod rests;
mod sequence;
mod stated;
mod three_circles;
mod turned_link;
mod two_pins;

use std::sync::Arc;

use super::newton::{Found, Newton};
use super::{Candidate, Determinant, Form, Solved};
use crate::pool::Pool;
use crate::program::builder::{Builder, Direction};
use crate::program::function::Statement;
use crate::system::System;
use crate::words::{Phrase, Piece, Singular, enumerated, phrase};

pub(in crate::program::forms) use sequence::Sequence;
use sequence::{Remaining, Search, Step};

/// Residuals g(z) = 0, and all other unknowns from z.
#[derive(Clone, Debug)]
struct Torn {
    whole: Newton,
    sequence: Sequence,
}

/// Smallest sine of a closed form in the design configuration for use as a step; nearer to its singular pose, all equations are
/// solved at once.
const CLEAR: f64 = 0.125;

/// Returns the sequences for a subsystem without a closed form, the cheapest first.
pub(super) fn sequences(candidate: &mut Candidate<'_>) -> Vec<Sequence> {
    Search::new(candidate).sequences()
}

/// Returns the solution method of a subsystem without a closed form: the first of these sequences that is clear of singular
/// poses, otherwise Newton-Raphson on all equations.
pub(super) fn form(
    whole: Newton,
    sequences: Vec<Sequence>,
    pool: &mut Pool,
    system: &System,
) -> Arc<dyn Form> {
    let mut sequences = sequences.into_iter();
    match sequences.find(|sequence| is_clear(sequence, pool, system)) {
        Some(sequence) => Arc::new(Torn { whole, sequence }),
        None => Arc::new(whole),
    }
}

/// True if all closed forms are clear of singular poses in the design configuration.
fn is_clear(sequence: &Sequence, pool: &mut Pool, system: &System) -> bool {
    sequence.steps.iter().all(|step| {
        let form = match step {
            Step::Closed(form) => form,
            Step::TwoPins(_) => return true,
            Step::ThreeCircles(circles) => return circles.drawn_sine(pool, system).abs() >= CLEAR,
        };
        let normalized = form.determinant(pool).normalized;
        // NaN must not count as clear, hence this comparison.
        normalized.is_none_or(|sine| system.drawn_value(sine, pool).abs() >= CLEAR)
    })
}

impl Form for Torn {
    fn name(&self) -> String {
        let size = self.whole.unknowns.len();
        let tears = self.sequence.tears.len();
        format!("Newton of size {tears} for {size} unknowns")
    }

    fn unknowns(&self) -> Vec<usize> {
        self.whole.unknowns.clone()
    }

    fn determinant(&self, pool: &mut Pool) -> Determinant {
        self.whole.determinant(pool)
    }

    fn singular(&self) -> Singular {
        self.whole.singular()
    }

    fn modes(&self) -> Option<usize> {
        None
    }

    fn guessed(&self) -> usize {
        self.sequence.tears.len()
    }

    fn position(&self, builder: &mut Builder<'_>) -> Box<dyn Solved> {
        let before = builder.statements.len();
        let mut block = self.whole.equations(builder);
        let remarks = builder.statements.split_off(before);
        let Some(tearing) = functions::tearing(self, &block, builder) else {
            return self.whole.position(builder);
        };
        self.open(builder);
        builder.statements.extend(remarks);
        let unknowns = self.whole.found(builder);
        let torn = completed::found(self, &tearing, builder);
        let directions = torn.directions.clone();
        block.tearing = Some(tearing);
        builder.state(Statement::Newton {
            found: unknowns,
            measure: None,
            torn: Some(torn),
        });
        for (&unknown, direction) in self.whole.unknowns.iter().zip(directions) {
            if let Some(symbols) = direction {
                let [sine, cosine] = symbols.map(|symbol| builder.graph().variable(symbol));
                builder.arms(unknown, Direction { cosine, sine });
            }
        }
        Box::new(Found::new(block, self.whole.residuals.clone()))
    }
}

impl Torn {
    /// Describes how the unknowns follow from the tearing variables.
    fn open(&self, builder: &mut Builder<'_>) {
        let names = |unknowns: &[usize]| -> Phrase {
            let pieces: Vec<Phrase> = unknowns
                .iter()
                .map(|&it| Piece::Unknown(it).into())
                .collect();
            enumerated(&pieces)
        };
        let tears = names(&self.sequence.tears);
        let all = names(&self.whole.unknowns);
        builder.heading(phrase![all, " with ", tears.clone(), " guessed"]);
        if let Some(loops) = self.whole.loops(builder) {
            builder.say(|_| "The loops as vectors:".into());
            builder.show(|_| {
                let equations = loops
                    .into_iter()
                    .map(|it| [Piece::Sum(it).into(), "0".into(), "".into()]);
                equations.collect()
            });
        }
        let count = self.sequence.tears.len();
        builder.say(|_| {
            phrase![
                "No closed form is known for all of them. Guess ",
                tears.clone(),
                format!(
                    ", starting from the last pose; then everything else follows step by step, and {} to be met:",
                    match count {
                        1 => "one equation remains".to_string(),
                        _ => format!("{count} equations remain"),
                    }
                ),
            ]
        });
        for (place, step) in self.sequence.steps.iter().enumerate() {
            let number = format!("{}. ", place + 1);
            builder.say(|builder| match step {
                Step::Closed(form) => {
                    phrase![
                        number,
                        names(&form.unknowns()),
                        format!(" from {}.", form.name())
                    ]
                }
                Step::TwoPins(link) => {
                    let place = builder.negated(link.closure);
                    phrase![
                        number,
                        Piece::Unknown(link.angle),
                        ": the link points along ",
                        Piece::Sum(place),
                        "."
                    ]
                }
                Step::ThreeCircles(circles) => {
                    phrase![
                        number,
                        names(&circles.angles),
                        " from three circles through one point: their equations subtracted pairwise are linear."
                    ]
                }
            });
        }
        for remaining in &self.sequence.remaining {
            match *remaining {
                Remaining::Equation(at) => {
                    let residual = self.whole.residuals[at];
                    builder.say(|_| "This must be met:".into());
                    builder
                        .show(|_| vec![["0".into(), Piece::Formula(residual).into(), "".into()]]);
                }
                Remaining::Length { step, .. } => {
                    let (angle, shown) = match &self.sequence.steps[step] {
                        Step::TwoPins(link) => (link.angle, Some((link.link, link.closure))),
                        Step::ThreeCircles(circles) => (circles.angles[0], None),
                        Step::Closed(_) => continue,
                    };
                    builder.say(|_| {
                        let end = if shown.is_some() { ":" } else { "." };
                        phrase![
                            "The distance that remains must be the length of the link of ",
                            Piece::Unknown(angle),
                            end
                        ]
                    });
                    let Some((p, c)) = shown else { continue };
                    builder.show(|builder| {
                        let squares = [builder.dot(c, c), builder.dot(p, p)];
                        vec![[
                            Piece::Formula(squares[1]).into(),
                            Piece::Formula(squares[0]).into(),
                            "".into(),
                        ]]
                    });
                }
            }
        }
        builder.say(|_| {
            phrase![
                "Newton-Raphson changes ",
                tears,
                " until that is so. Where one of the steps comes near a singular pose of its own, or rounding is amplified, \
                 all equations are solved at once instead; these are the residuals:"
            ]
        });
        builder.show(|_| {
            let numbered = self.whole.residuals.iter().enumerate();
            let equations = numbered.map(|(place, &residual)| {
                let name = Piece::Numbered("g", place + 1);
                [name.into(), Piece::Formula(residual).into(), "".into()]
            });
            equations.collect()
        });
    }
}
