//! The generated textbook view as methods: dense Newton-Raphson at several tolerances, polished or not, with the predictor or
//! from the last pose.

/// Implements [`super::Method`] for the textbook view of a module, given by its path in brackets, and lists its methods. The
/// other arguments are the scalar of the module and how it is called.
macro_rules! textbook {
    ([$($source:tt)*], $scalar:ty, $name:literal) => {
        use std::hint::black_box;

        use linkwright::nalgebra::{Const, SVector};
        use linkwright::{Frame, Settings};
        use $($source)*::{Coordinates, Textbook};

        use $crate::method::{Levels, Method, settings};

        type State = Frame<$scalar, Const<{ Coordinates::COUNT }>>;

        struct Newton {
            settings: Settings<$scalar>,
            setting: &'static str,
            predicts: bool,
        }

        /// Without and with the predictor, each with all settings.
        pub(in $crate::method) fn methods() -> Vec<Box<dyn Method>> {
            let mut methods: Vec<Box<dyn Method>> = Vec::new();
            for predicts in [false, true] {
                for &(setting, tolerance, polish) in settings($name) {
                    let settings = Settings {
                        tolerance: tolerance as $scalar,
                        polish,
                        ..Settings::default()
                    };
                    methods.push(Box::new(Newton {
                        settings,
                        setting,
                        predicts,
                    }));
                }
            }
            methods
        }

        impl Newton {
            fn assembled(&self, t: f64) -> State {
                let t = t as $scalar;
                let drawn = SVector::from(Coordinates::DRAWN.to_array());
                linkwright::assemble(&Textbook, &drawn, t, &self.settings)
                    .unwrap_or_else(|failure| panic!("{failure}"))
            }

            fn advance(&self, state: &mut State, t: f64) {
                let t = t as $scalar;
                let next = if self.predicts {
                    linkwright::advance(&Textbook, state, t, &self.settings)
                } else {
                    linkwright::assemble(&Textbook, &state.q, t, &self.settings)
                };
                *state = next.unwrap_or_else(|failure| panic!("{failure}"));
            }
        }

        impl Method for Newton {
            fn family(&self) -> &str {
                if self.predicts {
                    "textbook"
                } else {
                    "textbook without predictor"
                }
            }

            fn setting(&self) -> &str {
                self.setting
            }

            fn scalar(&self) -> &'static str {
                $name
            }

            fn sweep(&mut self, times: &[f64]) {
                let mut state = self.assembled(times[0]);
                black_box(&state);
                for &t in &times[1..] {
                    self.advance(&mut state, t);
                    black_box(&state);
                }
            }

            fn record(&mut self, times: &[f64], indices: &[usize]) -> Vec<Levels> {
                let mut state = self.assembled(times[0]);
                let mut records = Vec::new();
                for (index, &t) in times.iter().enumerate() {
                    if index > 0 {
                        self.advance(&mut state, t);
                    }
                    if indices.contains(&index) {
                        let levels = [&state.q, &state.qd, &state.qdd];
                        records.push(levels.map(|level| level.iter().map(|&value| f64::from(value)).collect()));
                    }
                }
                records
            }
        }
    };
}

pub(super) use textbook;
