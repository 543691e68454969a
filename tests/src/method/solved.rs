//! The solved view of generated modules as methods: closed forms, and Newton-Raphson on the blocks that have none.

/// Implements [`super::Method`] for a module, given by its path in brackets, with the type of its mechanism, and lists its methods.
/// The arguments after the mechanism are the scalar of the module and how it is called.
macro_rules! solved {
    ([$($source:tt)*], $mechanism:ident, $scalar:ty, $name:literal) => {
        use std::hint::black_box;

        use linkwright::Settings;
        use $($source)*::{Coordinates, $mechanism};

        use $crate::method::{Levels, Method, settings};

        struct Solved {
            settings: Settings<$scalar>,
            family: &'static str,
            setting: &'static str,
        }

        /// One method where all blocks have closed forms, otherwise one per setting.
        pub(in $crate::method) fn methods(iterates: bool) -> Vec<Box<dyn Method>> {
            if !iterates {
                return vec![Box::new(Solved {
                    settings: Settings::default(),
                    family: "closed form",
                    setting: "",
                })];
            }
            let mut methods: Vec<Box<dyn Method>> = Vec::new();
            for &(setting, tolerance, polish) in settings($name) {
                methods.push(Box::new(Solved {
                    settings: Settings {
                        tolerance: tolerance as $scalar,
                        polish,
                        ..Settings::default()
                    },
                    family: "block Newton",
                    setting,
                }));
            }
            methods
        }

        impl Solved {
            fn assembled(&self, t: f64) -> $mechanism {
                $mechanism::assemble_from(&Coordinates::DRAWN, t as $scalar, self.settings)
                    .unwrap_or_else(|failure| panic!("{failure}"))
            }
        }

        impl Method for Solved {
            fn family(&self) -> &str {
                self.family
            }

            fn setting(&self) -> &str {
                self.setting
            }

            fn scalar(&self) -> &'static str {
                $name
            }

            fn sweep(&mut self, times: &[f64]) {
                let mut mechanism = self.assembled(times[0]);
                black_box(mechanism.frame());
                for &t in &times[1..] {
                    if let Err(failure) = mechanism.advance(t as $scalar) {
                        panic!("{failure}");
                    }
                    black_box(mechanism.frame());
                }
            }

            fn record(&mut self, times: &[f64], indices: &[usize]) -> Vec<Levels> {
                let mut mechanism = self.assembled(times[0]);
                let mut records = Vec::new();
                for (index, &t) in times.iter().enumerate() {
                    if index > 0 {
                        if let Err(failure) = mechanism.advance(t as $scalar) {
                            panic!("{failure}");
                        }
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

pub(super) use solved;
