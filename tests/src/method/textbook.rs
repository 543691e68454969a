//! The generated textbook view as methods: dense Newton-Raphson at several tolerances, polished or not, with the predictor or
//! from the last pose.

use std::any::type_name;
use std::hint::black_box;

use linkwright::math::Real;
use linkwright::nalgebra::allocator::Allocator;
use linkwright::nalgebra::{Const, DefaultAllocator, Dim, OVector};
use linkwright::{Blocks, Equations, Frame, Mechanism, Settings};

use super::{Levels, Method, settings};
use crate::values::numbers;

struct Newton<T: Real, D: Dim, E>
where
    DefaultAllocator: Allocator<D>,
{
    equations: E,
    drawn: OVector<T, D>,
    settings: Settings<T>,
    setting: &'static str,
    predicts: bool,
}

/// Without and with the predictor, each with all settings.
pub(super) fn methods<M, E, const N: usize>() -> Vec<Box<dyn Method>>
where
    M: Mechanism<Blocks: Default>,
    E: Equations<<M::Blocks as Blocks>::Scalar, Const<N>> + Default + 'static,
    Settings<<M::Blocks as Blocks>::Scalar>: Default,
{
    let blocks = M::Blocks::default();
    let drawn = numbers(&blocks.drawn_pose(&blocks.nominal_parameters()));
    let drawn = drawn
        .into_iter()
        .map(<M::Blocks as Blocks>::Scalar::from_f64);
    let drawn = OVector::<_, Const<N>>::from_iterator(drawn);
    let mut methods: Vec<Box<dyn Method>> = Vec::new();
    for predicts in [false, true] {
        for (setting, settings) in settings() {
            methods.push(Box::new(Newton {
                equations: E::default(),
                drawn,
                settings,
                setting,
                predicts,
            }));
        }
    }
    methods
}

impl<T: Real, D: Dim, E: Equations<T, D>> Newton<T, D, E>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    fn assembled(&self, t: f64) -> Frame<T, D> {
        let t = T::from_f64(t);
        linkwright::Frame::assemble(&self.equations, &self.drawn, t, &self.settings)
            .unwrap_or_else(|failure| panic!("{failure}"))
    }

    fn advance(&self, state: &mut Frame<T, D>, t: f64) {
        let t = T::from_f64(t);
        let next = if self.predicts {
            state.advance(&self.equations, t, &self.settings)
        } else {
            linkwright::Frame::assemble(&self.equations, &state.q, t, &self.settings)
        };
        *state = next.unwrap_or_else(|failure| panic!("{failure}"));
    }
}

impl<T: Real, D: Dim, E: Equations<T, D>> Method for Newton<T, D, E>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
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
        type_name::<T>()
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
                records.push(
                    levels.map(|level| level.as_slice().iter().map(|it| it.to_f64()).collect()),
                );
            }
        }
        records
    }
}
