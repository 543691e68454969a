//! The compiled mechanisms of the study, in both scalars and both views.

use super::sample::Runner;

/// A compiled mechanism, solved in three ways in each scalar.
pub struct Compiled {
    /// The name of its description.
    pub name: &'static str,
    /// What the solved view does.
    pub solved: &'static str,
    /// The textbook view on its path and plain, and the solved view, in f64, then in f32.
    pub runners: [Runner; 6],
}

macro_rules! scalar {
    ($module:ident: $mechanism:ident, $scalar:ident, [$($parameter:ident),*], [$($input:ident),*]) => {
        mod generated {
            linkwright::include_mechanism!($module);
        }

        use generated::{Branches, Coordinates, $mechanism, Inputs, Parameters, Textbook};

        use crate::stability::sample::{Outcomes, Sample, named};
        use linkwright::nalgebra::{Const, SMatrix, SVector};
        use linkwright::{Branch, Equations, Settings, Signal};

        const N: usize = Coordinates::COUNT;

        fn parameters(sample: &Sample) -> Parameters {
            let mut values = sample.parameters.iter();
            Parameters { $($parameter: *values.next().expect("a value per parameter") as $scalar),* }
        }

        fn inputs(sample: &Sample, t: $scalar) -> Inputs {
            let signals = (sample.signals)(f64::from(t));
            let mut signals = signals.into_iter();
            Inputs { $($input: {
                let [value, rate, acceleration] = signals.next().expect("a signal per input");
                Signal {
                    value: value as $scalar,
                    rate: rate as $scalar,
                    acceleration: acceleration as $scalar,
                }
            }),* }
        }

        fn estimate(sample: &Sample) -> [$scalar; N] {
            std::array::from_fn(|place| sample.estimate[place] as $scalar)
        }

        fn levels(q: &[$scalar], qd: &[$scalar], qdd: &[$scalar]) -> [Vec<f64>; 3] {
            [q, qd, qdd].map(|level| level.iter().map(|value| f64::from(*value)).collect())
        }

        /// The textbook view, with the signals of every time it is evaluated at.
        struct Moving<'a> {
            sample: &'a Sample,
            parameters: Parameters,
        }

        impl Moving<'_> {
            fn at(&self, t: $scalar) -> Textbook {
                Textbook::new(&self.parameters, &inputs(self.sample, t))
            }
        }

        impl Equations<$scalar, Const<N>> for Moving<'_> {
            fn dimension(&self) -> Const<N> {
                Const
            }

            fn residual(&self, q: &SVector<$scalar, N>, t: $scalar, phi: &mut SVector<$scalar, N>) {
                self.at(t).residual(q, t, phi);
            }

            fn jacobian(&self, q: &SVector<$scalar, N>, t: $scalar, phi_q: &mut SMatrix<$scalar, N, N>) {
                self.at(t).jacobian(q, t, phi_q);
            }

            fn time_derivative(&self, q: &SVector<$scalar, N>, t: $scalar, phi_t: &mut SVector<$scalar, N>) {
                self.at(t).time_derivative(q, t, phi_t);
            }

            fn gamma(
                &self,
                q: &SVector<$scalar, N>,
                qd: &SVector<$scalar, N>,
                t: $scalar,
                gamma: &mut SVector<$scalar, N>,
            ) {
                self.at(t).gamma(q, qd, t, gamma);
            }

            fn row_scale(&self, row: usize) -> $scalar {
                self.at(0.0).row_scale(row)
            }

            fn coordinate_scale(&self, column: usize) -> $scalar {
                self.at(0.0).coordinate_scale(column)
            }
        }

        pub(super) fn followed(sample: &Sample, negative: bool) -> Outcomes {
            let branch = if negative { Branch::Negative } else { Branch::Positive };
            textbook(
                sample,
                |equations, start, t, settings| {
                    linkwright::assemble_from_afar(equations, start, Some(branch), t, settings)
                },
                |equations, frame, t, settings| linkwright::follow(equations, frame, branch, t, settings),
            )
        }

        pub(super) fn plain(sample: &Sample, _: bool) -> Outcomes {
            textbook(
                sample,
                |equations, start, t, settings| linkwright::assemble(equations, start, t, settings),
                |equations, frame, t, settings| linkwright::advance(equations, frame, t, settings),
            )
        }

        type Moved = linkwright::Frame<$scalar, Const<N>>;
        type Solved = Result<Moved, linkwright::Failure<$scalar>>;

        fn textbook(
            sample: &Sample,
            assemble: impl Fn(&Moving<'_>, &SVector<$scalar, N>, $scalar, &Settings<$scalar>) -> Solved,
            advance: impl Fn(&Moving<'_>, &Moved, $scalar, &Settings<$scalar>) -> Solved,
        ) -> Outcomes {
            let equations = Moving {
                sample,
                parameters: parameters(sample),
            };
            let settings = Settings::default();
            let mut outcomes = Outcomes::new();
            let mut last: Option<Moved> = None;
            for t in sample.times.iter().map(|t| *t as $scalar) {
                let solved = match &last {
                    None => assemble(&equations, &SVector::from(estimate(sample)), t, &settings),
                    Some(frame) => advance(&equations, frame, t, &settings),
                };
                match solved {
                    Ok(frame) => {
                        outcomes.push(Ok(levels(frame.q.as_slice(), frame.qd.as_slice(), frame.qdd.as_slice())));
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

        pub(super) fn solved(sample: &Sample, _: bool) -> Outcomes {
            let mut outcomes = Outcomes::new();
            let mut mechanism = None;
            for t in sample.times.iter().map(|t| *t as $scalar) {
                let inputs = inputs(sample, t);
                let moved = match mechanism.take() {
                    None => $mechanism::assemble_with(
                        &parameters(sample),
                        &Coordinates::from_array(estimate(sample)),
                        Branches::DRAWN,
                        t,
                        &inputs,
                        Settings::default(),
                    ),
                    Some(mut before) => {
                        let before: &mut $mechanism = &mut before;
                        before.advance(t, &inputs).map(|_| ()).map(|()| *before)
                    }
                };
                match moved {
                    Ok(moved) => {
                        let frame = moved.frame();
                        let (q, qd, qdd) = (frame.q.to_array(), frame.qd.to_array(), frame.qdd.to_array());
                        outcomes.push(Ok(levels(&q, &qd, &qdd)));
                        mechanism = Some(moved);
                    }
                    Err(failure) => {
                        outcomes.push(Err(named(failure.kind).to_string()));
                        break;
                    }
                }
            }
            outcomes
        }
    };
}

macro_rules! compiled {
    ($(pub const $constant:ident = $double:ident: $mechanism:ident, $single:ident: $single_mechanism:ident,
        $solved:literal, $parameters:tt, $inputs:tt;)+) => {
        $(
            #[allow(missing_docs)]
            mod $double {
                scalar!($double: $mechanism, f64, $parameters, $inputs);
            }

            #[allow(missing_docs)]
            mod $single {
                scalar!($single: $single_mechanism, f32, $parameters, $inputs);
            }

            #[doc = concat!("`", stringify!($double), "`.")]
            pub const $constant: Compiled = Compiled {
                name: stringify!($double),
                solved: $solved,
                runners: [
                    $double::followed, $double::plain, $double::solved,
                    $single::followed, $single::plain, $single::solved,
                ],
            };
        )+
    };
}

compiled! {
    pub const EXAM = study_exam: StudyExam, single_study_exam: SingleStudyExam,
        "closed form", [crank, rod, wall], [angle];
    pub const EXAM_BY_ROD = study_exam_by_rod: StudyExamByRod, single_study_exam_by_rod: SingleStudyExamByRod,
        "closed form", [crank, rod, wall], [angle];
    pub const FOUR_BAR = study_four_bar: StudyFourBar, single_study_four_bar: SingleStudyFourBar,
        "closed form", [g, l1, l2, l3, x0, y0, slow, ripple, fast, kick, growth, jump, width], [angle];
    pub const SLIDER = study_slider: StudySlider, single_study_slider: SingleStudySlider,
        "closed form", [r, l], [position];
    pub const PLATFORM = study_platform: StudyPlatform, single_study_platform: SingleStudyPlatform,
        "block Newton", [size, x0, y0], [first, second, third];
}
