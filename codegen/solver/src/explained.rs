//! Explains failures of interpreted mechanisms: the number that is not finite, and the assemblies that exist instead.

use linkwright::generated::{Conditions, Start};
use linkwright::{Blocks, Failure, FailureKind, Settings};

use crate::assemblies::assemblies;
use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::not_finite;
use crate::number::time;
use crate::ranges::outside;
use crate::view::View;

impl Interpreted {
    /// Explains why the mechanism cannot be assembled in the modes of its design configuration, and counts other assemblies.
    pub(crate) fn reason_of_start(&self, failure: &Failure) -> String {
        let cause = self.cause(failure, None);
        // A rejected value is rejected in every assembly.
        let is_refused = failure.kind.rejects_values();
        let others = match is_refused {
            true => 0,
            false => assemblies(self, failure.time).found.len(),
        };
        let others = match others {
            0 => String::new(),
            1 => "; another assembly exists (a check shows it)".to_string(),
            count => format!("; {count} other assemblies exist (a check lists them)"),
        };
        let t = time(failure.time);
        format!("cannot be assembled in the design modes at t = {t} s: {cause}{others}")
    }

    /// Explains the end of a motion with this last instant.
    pub(crate) fn reason_of_end(&self, failure: &Failure, last: &Instant) -> String {
        let (t, cause) = (time(failure.time), self.cause(failure, Some(last)));
        format!("cannot be solved beyond t = {t} s: {cause}")
    }

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
        if let Some(outside) = outside(&self.system().mechanism, failure) {
            return outside;
        }
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
