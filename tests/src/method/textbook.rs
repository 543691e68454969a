//! The generated textbook view as methods: dense Newton-Raphson at several tolerances, polished or not, with the predictor or
//! from the last pose.

/// The settings under which the textbook view is measured: label, tolerance, polish.
pub(super) const SETTINGS: [(&str, f64, bool); 4] = [
    ("1e-6", 1e-6, false),
    ("1e-9", 1e-9, false),
    ("1e-12", 1e-12, false),
    ("1e-12, polished", 1e-12, true),
];

/// Implements [`super::Method`] for a module with the type of its mechanism, and lists its methods.
macro_rules! textbook {
    ($module:ident, $mechanism:ident) => {
        use std::hint::black_box;

        use linkwright::Settings;
        use linkwright_mechanisms::$module::{Coordinates, $mechanism};

        use $crate::method::textbook::SETTINGS;
        use $crate::method::{Levels, Method};

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
            fn assembled(&self, t: f64) -> $mechanism {
                $mechanism::assemble_from(&Coordinates::DRAWN, t, self.settings)
                    .unwrap_or_else(|failure| panic!("{failure}"))
            }

            fn advance(&self, mechanism: &mut $mechanism, t: f64) {
                if self.predicts {
                    if let Err(failure) = mechanism.advance(t) {
                        panic!("{failure}");
                    }
                } else {
                    *mechanism = $mechanism::assemble_from(&mechanism.frame().q, t, self.settings)
                        .unwrap_or_else(|failure| panic!("{failure}"));
                }
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
                let mut mechanism = self.assembled(times[0]);
                black_box(mechanism.frame());
                for &t in &times[1..] {
                    self.advance(&mut mechanism, t);
                    black_box(mechanism.frame());
                }
            }

            fn record(&mut self, times: &[f64], indices: &[usize]) -> Vec<Levels> {
                let mut mechanism = self.assembled(times[0]);
                let mut records = Vec::new();
                for (index, &t) in times.iter().enumerate() {
                    if index > 0 {
                        self.advance(&mut mechanism, t);
                    }
                    if indices.contains(&index) {
                        let frame = mechanism.frame();
                        let levels = [&frame.q, &frame.qd, &frame.qdd];
                        records
                            .push(levels.map(|level| {
                                level.to_array().into_iter().map(f64::from).collect()
                            }));
                    }
                }
                records
            }
        }
    };
}

pub(super) use textbook;
