//! Compiled mechanisms of the study, in both scalars and both formulations.

use linkwright::math::Real;
use linkwright::nalgebra::{Const, SMatrix, SVector};
use linkwright::{Blocks, Branch, Equations, Failure, Frame, Settings, Shell, Signal, Values};

use super::sample::{Outcomes, Sample, named};
use super::verdict::Way;
use crate::values::{filled, levels, pose};

/// A compiled mechanism.
pub struct Compiled {
    /// The name of its description.
    pub name: &'static str,
    /// Solution method of the solved formulation.
    pub solved: &'static str,
    /// In f64, then in f32.
    views: [&'static dyn Run; 2],
}

impl Compiled {
    /// Solves a sample; `side` is 0 in f64 and 1 in f32, and `is_negative` is true if the requested pose has a
    /// negative determinant.
    pub fn run(&self, side: usize, way: Way, sample: &Sample, is_negative: bool) -> Outcomes {
        self.views[side].run(way, sample, is_negative)
    }
}

/// Solver that can be moved through a sample.
trait Run {
    fn run(&self, way: Way, sample: &Sample, is_negative: bool) -> Outcomes;
}

/// Generated mechanism, and its equations as one dense system with their inputs.
struct Views<B: Blocks, E, const N: usize> {
    blocks: B,
    textbook: fn(B::Parameters, B::Inputs) -> E,
}

fn parameters<B: Blocks>(blocks: &B, sample: &Sample) -> B::Parameters {
    let parameters = filled(blocks.nominal_parameters(), &sample.parameters);
    assert_eq!(
        parameters.count(),
        sample.parameters.len(),
        "a value per parameter"
    );
    parameters
}

fn inputs<B: Blocks>(blocks: &B, sample: &Sample, t: f64) -> B::Inputs {
    let mut inputs = blocks.initial_inputs();
    let signals = (sample.signals)(t);
    assert_eq!(inputs.count(), signals.len(), "a signal per input");
    for (index, signal) in signals.into_iter().enumerate() {
        let [value, rate, acceleration] = signal.map(B::Scalar::from_f64);
        inputs.set(index, Signal::new(value, rate, acceleration));
    }
    inputs
}

/// Textbook formulation, with the signals of every time at which it is evaluated.
struct Moving<'a, B: Blocks, E, const N: usize> {
    views: &'a Views<B, E, N>,
    sample: &'a Sample,
}

impl<B: Blocks, E, const N: usize> Moving<'_, B, E, N> {
    fn at(&self, t: f64) -> E {
        let Views { blocks, textbook } = self.views;
        textbook(
            parameters(blocks, self.sample),
            inputs(blocks, self.sample, t),
        )
    }
}

impl<T: Real, B: Blocks<Scalar = T>, E: Equations<T, Const<N>>, const N: usize>
    Equations<T, Const<N>> for Moving<'_, B, E, N>
{
    fn dimension(&self) -> Const<N> {
        Const
    }

    fn residual(&self, q: &SVector<T, N>, t: T, phi: &mut SVector<T, N>) {
        self.at(t.to_f64()).residual(q, t, phi);
    }

    fn jacobian(&self, q: &SVector<T, N>, t: T, phi_q: &mut SMatrix<T, N, N>) {
        self.at(t.to_f64()).jacobian(q, t, phi_q);
    }

    fn time_derivative(&self, q: &SVector<T, N>, t: T, phi_t: &mut SVector<T, N>) {
        self.at(t.to_f64()).time_derivative(q, t, phi_t);
    }

    fn gamma(&self, q: &SVector<T, N>, qd: &SVector<T, N>, t: T, gamma: &mut SVector<T, N>) {
        self.at(t.to_f64()).gamma(q, qd, t, gamma);
    }

    fn row_scale(&self, row: usize) -> T {
        self.at(0.0).row_scale(row)
    }

    fn coordinate_scale(&self, column: usize) -> T {
        self.at(0.0).coordinate_scale(column)
    }
}

type Moved<T, const N: usize> = Result<Frame<T, Const<N>>, Failure<T>>;

impl<T: Real, B: Blocks<Scalar = T> + Clone, E: Equations<T, Const<N>>, const N: usize> Run
    for Views<B, E, N>
where
    Settings<T>: Default,
{
    fn run(&self, way: Way, sample: &Sample, is_negative: bool) -> Outcomes {
        let branch = if is_negative {
            Branch::Negative
        } else {
            Branch::Positive
        };
        match way {
            Way::Followed => self.textbook(
                sample,
                |equations, start, t, settings| {
                    linkwright::Frame::assemble_from_rough_estimate(
                        equations,
                        start,
                        Some(branch),
                        t,
                        settings,
                    )
                },
                |equations, frame, t, settings| frame.follow(equations, branch, t, settings),
            ),
            Way::Plain => self.textbook(
                sample,
                |equations, start, t, settings| {
                    linkwright::Frame::assemble(equations, start, t, settings)
                },
                |equations, frame, t, settings| frame.advance(equations, t, settings),
            ),
            Way::Solved => self.solved(sample),
        }
    }
}

impl<T: Real, B: Blocks<Scalar = T> + Clone, E: Equations<T, Const<N>>, const N: usize>
    Views<B, E, N>
where
    Settings<T>: Default,
{
    fn textbook(
        &self,
        sample: &Sample,
        assemble: impl Fn(&Moving<'_, B, E, N>, &SVector<T, N>, T, &Settings<T>) -> Moved<T, N>,
        advance: impl Fn(&Moving<'_, B, E, N>, &Frame<T, Const<N>>, T, &Settings<T>) -> Moved<T, N>,
    ) -> Outcomes {
        let equations = Moving {
            views: self,
            sample,
        };
        let settings = Settings::default();
        let estimate = SVector::from_iterator(sample.estimate.iter().map(|it| T::from_f64(*it)));
        let mut outcomes = Outcomes::new();
        let mut last: Option<Frame<T, Const<N>>> = None;
        for t in sample.times.iter().map(|t| T::from_f64(*t)) {
            let solved = match &last {
                None => assemble(&equations, &estimate, t, &settings),
                Some(frame) => advance(&equations, frame, t, &settings),
            };
            match solved {
                Ok(frame) => {
                    let levels = [&frame.q, &frame.qd, &frame.qdd];
                    outcomes.push(Ok(
                        levels.map(|level| level.iter().map(|it| it.to_f64()).collect())
                    ));
                    last = Some(frame);
                }
                Err(failure) => {
                    outcomes.push(Err(named(failure.kind).to_string()));
                    break;
                }
            }
        }
        outcomes
    }

    fn solved(&self, sample: &Sample) -> Outcomes {
        let blocks = &self.blocks;
        let parameters = parameters(blocks, sample);
        let mut outcomes = Outcomes::new();
        let mut mechanism: Option<Shell<B>> = None;
        for t in sample.times.iter().map(|t| T::from_f64(*t)) {
            let inputs = inputs(blocks, sample, t.to_f64());
            let failed = match &mut mechanism {
                None => {
                    let (estimate, modes) =
                        (pose(blocks, &sample.estimate), blocks.drawn_branches());
                    let settings = Settings::default();
                    let blocks = blocks.clone();
                    Shell::assemble(blocks, &parameters, &estimate, modes, t, &inputs, settings)
                        .map(|assembled| mechanism = Some(assembled))
                }
                Some(mechanism) => mechanism.advance(t, &inputs).map(|_| ()),
            };
            match (failed, &mechanism) {
                (Ok(()), Some(mechanism)) => outcomes.push(Ok(levels(blocks, mechanism.frame()))),
                (Ok(()), None) => unreachable!("what is assembled is kept"),
                (Err(failure), _) => {
                    outcomes.push(Err(named(failure.kind).to_string()));
                    break;
                }
            }
        }
        outcomes
    }
}

#[allow(missing_docs)]
mod double {
    pub mod exam {
        linkwright::include_mechanism!(study_exam);
    }
    pub mod exam_by_rod {
        linkwright::include_mechanism!(study_exam_by_rod);
    }
    pub mod four_bar {
        linkwright::include_mechanism!(study_four_bar);
    }
    pub mod slider {
        linkwright::include_mechanism!(study_slider);
    }
    pub mod platform {
        linkwright::include_mechanism!(study_platform);
    }
}

#[allow(missing_docs)]
mod single {
    pub mod exam {
        linkwright::include_mechanism!(single_study_exam);
    }
    pub mod exam_by_rod {
        linkwright::include_mechanism!(single_study_exam_by_rod);
    }
    pub mod four_bar {
        linkwright::include_mechanism!(single_study_four_bar);
    }
    pub mod slider {
        linkwright::include_mechanism!(single_study_slider);
    }
    pub mod platform {
        linkwright::include_mechanism!(single_study_platform);
    }
}

/// `study_exam`.
pub const EXAM: Compiled = Compiled {
    name: "study_exam",
    solved: "closed form",
    views: [
        &Views::<_, _, { double::exam::Coordinates::COUNT }> {
            blocks: double::exam::Loops,
            textbook: |parameters, inputs| double::exam::Textbook { parameters, inputs },
        },
        &Views::<_, _, { single::exam::Coordinates::COUNT }> {
            blocks: single::exam::Loops,
            textbook: |parameters, inputs| single::exam::Textbook { parameters, inputs },
        },
    ],
};

/// `study_exam_by_rod`.
pub const EXAM_BY_ROD: Compiled = Compiled {
    name: "study_exam_by_rod",
    solved: "closed form",
    views: [
        &Views::<_, _, { double::exam_by_rod::Coordinates::COUNT }> {
            blocks: double::exam_by_rod::Loops,
            textbook: |parameters, inputs| double::exam_by_rod::Textbook { parameters, inputs },
        },
        &Views::<_, _, { single::exam_by_rod::Coordinates::COUNT }> {
            blocks: single::exam_by_rod::Loops,
            textbook: |parameters, inputs| single::exam_by_rod::Textbook { parameters, inputs },
        },
    ],
};

/// `study_four_bar`.
pub const FOUR_BAR: Compiled = Compiled {
    name: "study_four_bar",
    solved: "closed form",
    views: [
        &Views::<_, _, { double::four_bar::Coordinates::COUNT }> {
            blocks: double::four_bar::Loops,
            textbook: |parameters, inputs| double::four_bar::Textbook { parameters, inputs },
        },
        &Views::<_, _, { single::four_bar::Coordinates::COUNT }> {
            blocks: single::four_bar::Loops,
            textbook: |parameters, inputs| single::four_bar::Textbook { parameters, inputs },
        },
    ],
};

/// `study_slider`.
pub const SLIDER: Compiled = Compiled {
    name: "study_slider",
    solved: "closed form",
    views: [
        &Views::<_, _, { double::slider::Coordinates::COUNT }> {
            blocks: double::slider::Loops,
            textbook: |parameters, inputs| double::slider::Textbook { parameters, inputs },
        },
        &Views::<_, _, { single::slider::Coordinates::COUNT }> {
            blocks: single::slider::Loops,
            textbook: |parameters, inputs| single::slider::Textbook { parameters, inputs },
        },
    ],
};

/// `study_platform`.
pub const PLATFORM: Compiled = Compiled {
    name: "study_platform",
    solved: "block Newton",
    views: [
        &Views::<_, _, { double::platform::Coordinates::COUNT }> {
            blocks: double::platform::Loops,
            textbook: |parameters, inputs| double::platform::Textbook { parameters, inputs },
        },
        &Views::<_, _, { single::platform::Coordinates::COUNT }> {
            blocks: single::platform::Loops,
            textbook: |parameters, inputs| single::platform::Textbook { parameters, inputs },
        },
    ],
};
