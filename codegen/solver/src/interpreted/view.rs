//! Reports an interpreted motion: points, derivatives, forces, measures, and failures in words.

use linkwright::generated::{Conditions, Start};
use linkwright::{Blocks, Failure, FailureKind, PointMotion, Settings};
use linkwright_codegen::stages::emit::derivation::SingularPose;
use linkwright_codegen::stages::system::Derived;

use super::Interpreted;
use crate::assemblies::assemblies;
use crate::derivatives::Derivative;
use crate::instant::{Instant, Layout};
use crate::measures::Measures;
use crate::not_finite;
use crate::number::time;
use crate::supplied::ModeName;
use crate::view::View;

impl View for Interpreted {
    fn derived(&self) -> &Derived {
        &self.compiled.derived
    }

    fn layout(&self) -> &Layout {
        &self.compiled.layout
    }

    fn mode_names(&self) -> Vec<ModeName> {
        let program = &self.compiled.program;
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
        let values = self.points.values(instant);
        let motion = |it: &[f64]| PointMotion {
            position: [it[0], it[1]],
            velocity: [it[2], it[3]],
            acceleration: [it[4], it[5]],
        };
        values.chunks_exact(6).map(motion).collect()
    }

    fn derivatives(&self, instant: &Instant) -> Option<Vec<f64>> {
        let derivatives = self.derivatives.iter();
        let value = |it: &Derivative| match *it {
            Derivative::Kept(slot) => instant.values()[slot],
            Derivative::Constant(value) => value,
        };
        Some(derivatives.map(value).collect())
    }

    fn forces(&self, instant: &Instant) -> Option<Vec<f64>> {
        let slots = self.forces.iter();
        slots.map(|slot| Some(instant.values()[(*slot)?])).collect()
    }

    fn measures(&self) -> Option<Measures> {
        Some(Measures::new(self))
    }

    fn singular_poses(&self) -> &[SingularPose] {
        &self.compiled.poses
    }

    fn not_assembled(&self, failure: &Failure) -> String {
        let cause = self.cause(failure, None);
        // A rejected value is rejected in every assembly.
        let is_refused = matches!(failure.kind, FailureKind::NotPositive { .. });
        let others = match is_refused {
            true => 0,
            false => assemblies(self, failure.time).found.len(),
        };
        let others = match others {
            0 => String::new(),
            1 => "; another assembly exists (`linkwright check` shows it)".to_string(),
            count => format!("; {count} other assemblies exist (`linkwright check` lists them)"),
        };
        let t = time(failure.time);
        format!("cannot be assembled as drawn at t = {t} s: {cause}{others}")
    }

    fn ended(&self, failure: &Failure, last: &Instant) -> String {
        let (t, cause) = (time(failure.time), self.cause(failure, Some(last)));
        format!("cannot be solved beyond t = {t} s: {cause}")
    }
}

impl Interpreted {
    /// Describes a failure without the time. A number that is not finite is attributed to its load or its block.
    fn cause(&self, failure: &Failure, last: Option<&Instant>) -> String {
        if let FailureKind::LoadNotFinite { load } = failure.kind {
            let load = self.load_name(usize::from(load)).unwrap_or_default();
            return format!("`{load}` is not finite there");
        }
        let refused = self.refused(failure, last);
        let named = refused.and_then(|refused| {
            let block = not_finite::block(self, &refused)?;
            Some(format!("{block}: {}", failure.kind.words()))
        });
        named.unwrap_or_else(|| self.reported(failure))
    }

    /// Describes a failure without the time, with lengths in the unit of messages.
    pub(crate) fn reported(&self, failure: &Failure) -> String {
        let unit = self.system().mechanism.units.of_messages().of("m");
        let explained = self.explained(failure);
        let cause = explained.cause_in(&unit.name, unit.of_si(1.0));
        cause.to_string()
    }

    /// Returns the frame after the last one that was rejected for a number that is not finite, in the modes of the design configuration.
    ///
    /// `None` for other failures, and without a frame in these modes.
    fn refused(&self, failure: &Failure, last: Option<&Instant>) -> Option<Instant> {
        if failure.kind != FailureKind::NotFinite || failure.input.is_some() {
            return None;
        }
        let t = failure.time;
        let parameters = self.nominal_parameters();
        let (start, last) = match last {
            Some(last) => (Start::LastFrame, last.clone()),
            None => {
                let drawn = self.drawn_pose(&parameters);
                (Start::Estimate, self.estimate(&drawn, &parameters, t))
            }
        };
        let conditions = Conditions {
            t,
            start,
            parameters: &parameters,
            inputs: &self.input_laws().at(t),
            settings: &Settings::default(),
        };
        let mut refused = self.layout().empty();
        let solved = self.solve(&mut refused, &last, &mut self.drawn_branches(), &conditions);
        let is_refused = solved.is_err_and(|again| again.kind == FailureKind::NotFinite);
        is_refused.then_some(refused)
    }
}
