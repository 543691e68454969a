//! The solved view of a generated module as methods: closed forms, and Newton-Raphson on the blocks that have none.

use std::any::type_name;
use std::hint::black_box;

use linkwright::math::Real;
use linkwright::{Blocks, Mechanism, Settings, Shell};

use super::{Levels, Method, settings};
use crate::values::{assembled_from, levels};

struct Solved<B: Blocks> {
    blocks: B,
    settings: Settings<B::Scalar>,
    family: &'static str,
    setting: &'static str,
}

/// One method where all blocks have closed forms, otherwise one per setting.
pub(super) fn methods<M>(iterates: bool) -> Vec<Box<dyn Method>>
where
    M: Mechanism<Blocks: Default + Clone + 'static>,
    Settings<<M::Blocks as Blocks>::Scalar>: Default,
{
    if !iterates {
        return vec![Box::new(Solved {
            blocks: M::Blocks::default(),
            settings: Settings::default(),
            family: "closed form",
            setting: "",
        })];
    }
    let mut methods: Vec<Box<dyn Method>> = Vec::new();
    for (setting, settings) in settings() {
        methods.push(Box::new(Solved {
            blocks: M::Blocks::default(),
            settings,
            family: "block Newton",
            setting,
        }));
    }
    methods
}

impl<B: Blocks + Clone> Solved<B> {
    fn assembled(&self, t: f64) -> Shell<B> {
        assembled_from(self.blocks.clone(), &[], t, self.settings)
            .unwrap_or_else(|failure| panic!("{failure}"))
    }
}

impl<B: Blocks + Clone> Method for Solved<B> {
    fn family(&self) -> &str {
        self.family
    }

    fn setting(&self) -> &str {
        self.setting
    }

    fn scalar(&self) -> &'static str {
        type_name::<B::Scalar>()
    }

    fn sweep(&mut self, times: &[f64]) {
        let mut mechanism = self.assembled(times[0]);
        let inputs = self.blocks.initial_inputs();
        black_box(mechanism.frame());
        for &t in &times[1..] {
            if let Err(failure) = mechanism.advance(B::Scalar::from_f64(t), &inputs) {
                panic!("{failure}");
            }
            black_box(mechanism.frame());
        }
    }

    fn record(&mut self, times: &[f64], indices: &[usize]) -> Vec<Levels> {
        let mut mechanism = self.assembled(times[0]);
        let inputs = self.blocks.initial_inputs();
        let mut records = Vec::new();
        for (index, &t) in times.iter().enumerate() {
            if index > 0
                && let Err(failure) = mechanism.advance(B::Scalar::from_f64(t), &inputs)
            {
                panic!("{failure}");
            }
            if indices.contains(&index) {
                records.push(levels(&self.blocks, mechanism.frame()));
            }
        }
        records
    }
}
