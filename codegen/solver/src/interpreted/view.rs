//! Provides an interpreted motion to solutions and reports.

use linkwright::{Failure, PointMotion};
use linkwright_codegen::stages::emit::derivation::SingularPose;
use linkwright_codegen::stages::system::Derived;

use super::Interpreted;
use crate::derivatives::Derivative;
use crate::emitted::Emitted;
use crate::instant::{Instant, Layout};
use crate::measures::Measures;
use crate::supplied::ModeName;
use crate::view::View;

impl View for Interpreted {
    fn derived(&self) -> &Derived {
        self.compiled.solved.derived()
    }

    fn layout(&self) -> &Layout {
        &self.compiled.layout
    }

    fn emitted(&self) -> Option<&Emitted<Interpreted>> {
        self.emitted.as_deref()
    }

    fn mode_names(&self) -> Vec<ModeName> {
        let program = self.compiled.solved.program();
        let closed = program
            .branches
            .iter()
            .enumerate()
            .map(|(place, branch)| ModeName {
                name: branch.name.clone(),
                place,
                is_closed: true,
            });
        let iterated = program.blocks.iter().filter(|block| block.newton.is_some());
        let iterated = iterated.enumerate().map(|(place, block)| ModeName {
            name: block.name.clone(),
            place,
            is_closed: false,
        });
        closed.chain(iterated).collect()
    }

    fn newton_steps(&self) -> [u64; 2] {
        let solves = self.solves.get();
        [self.residuals.get().saturating_sub(solves), solves]
    }

    fn points(&self, instant: &Instant) -> Vec<PointMotion> {
        self.points.all(instant)
    }

    fn derivatives(&self, instant: &Instant) -> Option<Vec<f64>> {
        let derivatives = self.derivatives.iter();
        let value = |it: &Derivative| match *it {
            Derivative::Kept(slot) => instant.values()[slot],
            Derivative::Constant(value) => value,
        };
        Some(derivatives.map(value).collect())
    }

    fn reported(&self, instant: &Instant) -> Option<Vec<f64>> {
        let slots = self.reported.iter();
        let value = |slot: &Option<usize>| slot.map_or(f64::NAN, |slot| instant.values()[slot]);
        Some(slots.map(value).collect())
    }

    fn measures(&self) -> Option<Measures> {
        Some(self.measured())
    }

    fn singular_poses(&self) -> &[SingularPose] {
        &self.compiled.poses
    }

    fn not_assembled(&self, failure: &Failure) -> String {
        self.reason_of_start(failure)
    }

    fn ended(&self, failure: &Failure, last: &Instant) -> String {
        self.reason_of_end(failure, last)
    }
}
