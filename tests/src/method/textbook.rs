//! The generated textbook view as methods: dense Newton-Raphson at several tolerances, polished or not, with the predictor or
//! from the last pose.

/// Implements [`super::Method`] for the textbook view of a module, and lists its methods.
macro_rules! textbook {
    ($module:ident) => {
        use std::hint::black_box;

        use linkwright::nalgebra::{Const, SVector};
        use linkwright::{Frame, Settings};
        use linkwright_mechanisms::$module::{Coordinates, Textbook};

        use $crate::method::{Levels, Method, SETTINGS};

        type State = Frame<f64, Const<{ Coordinates::COUNT }>>;

        struct Newton {
            settings: Settings,
            setting: &'static str,
            predicts: bool,
        }

        /// Without and with the predictor, each with all settings.
        pub(in $crate::method) fn methods() -> Vec<Box<dyn Method>> {
            let mut methods: Vec<Box<dyn Method>> = Vec::new();
            for predicts in [false, true] {
                for (setting, tolerance, polish) in SETTINGS {
                    let settings = Settings {
                        tolerance,
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
                let drawn = SVector::from(Coordinates::DRAWN.to_array());
                linkwright::assemble(&Textbook, &drawn, t, &self.settings)
                    .unwrap_or_else(|failure| panic!("{failure}"))
            }

            fn advance(&self, state: &mut State, t: f64) {
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
                "f64"
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
                        records.push(levels.map(|level| level.as_slice().to_vec()));
                    }
                }
                records
            }
        }
    };
}

pub(super) use textbook;
