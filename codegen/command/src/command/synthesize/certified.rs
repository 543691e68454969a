//! Writes a candidate as a description, and certifies the motion of what is written.

use linkwright_calibrate::{Candidate, Synthesis};
use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::comparison::difference;
use linkwright_solver::proof::Proof;
use linkwright_solver::{Batch, Check, Interpreted, Observable, Schedule, View as _, opened};
use nalgebra::DVector;

use super::super::rewritten::{BodyPose, rewritten};
use super::task::MotionRange;

/// Difference of a residual, in sizes of its column, that the rounding of written values explains.
const ROUNDING: f64 = 1e-7;

/// Candidate whose description moves over the whole range, within all limits.
pub struct Certified {
    /// Candidate.
    pub candidate: Candidate,
    /// Text of its description.
    pub text: String,
    /// Checked motion of that description.
    pub check: Check,
    /// Proof of the motion.
    pub proof: Proof,
    /// Names of limited measures whose limits hold between frames by located extremes alone, without a proof.
    pub unproven_limits: Vec<String>,
}

/// Context of certificates.
pub struct Certifier<'a> {
    /// Description with the initial values.
    pub source: &'a Source,
    /// Its equations.
    pub derived: &'a Derived,
    /// Name of the motion, if it is selected.
    pub motion: Option<&'a str>,
    /// Search that has found the candidates.
    pub synthesis: &'a Synthesis,
    /// Range of the motion.
    pub range: &'a MotionRange,
    /// Largest time between frames (s).
    pub step: f64,
}

impl Certifier<'_> {
    /// Certifies a candidate.
    ///
    /// # Errors
    /// The reason for which it is left out, which completes "a candidate …".
    pub fn certified(&self, candidate: Candidate) -> Result<Certified, String> {
        let (text, interpreted) = self.written(&candidate)?;
        let [from, to] = self.range.ends;
        let schedule = Schedule::whole(from, to, self.step)
            .map_err(|reason| format!("cannot be checked: {reason}"))?;
        let check = Check::new(interpreted, &schedule, |_| ());
        if let Some(error) = &check.error {
            return Err(error.clone());
        }
        if let Some(broken) = check.measured.broken.first() {
            let mechanism = &check.interpreted.system().mechanism;
            let limit = &mechanism.limits[broken.limit];
            let name = &mechanism.measurements[limit.measurement].name;
            return Err(format!("breaks the limit of `{name}`"));
        }
        let proof = check.prove(&schedule, &[]);
        if let Some(unproven) = &proof.unproven {
            return Err(format!(
                "moves in all frames, and is not proven to move near t = {} s: {}",
                linkwright_solver::number::time(unproven.window[0]),
                unproven.reason
            ));
        }
        Ok(Certified {
            unproven_limits: unproven_limits(&check, &proof),
            candidate,
            text,
            check,
            proof,
        })
    }

    /// Returns the description of a candidate with its blocks. Bodies are drawn in the pose of the candidate if its assembly modes need that.
    fn written(&self, candidate: &Candidate) -> Result<(String, Interpreted), String> {
        let names = self.synthesis.names().iter().map(String::as_str);
        let values: Vec<(&str, f64)> = names.zip(candidate.values.iter().copied()).collect();
        let poses = self.poses(candidate);
        for poses in [&[][..], &poses[..]] {
            let text = rewritten(self.source, &values, poses, self.derived);
            let text = text.map_err(|_| "cannot be written into the description".to_string())?;
            if let Some(interpreted) = self.read(&text)
                && self.repeats(candidate, &interpreted)
            {
                return Ok((text, interpreted));
            }
        }
        Err("is in an assembly mode that its description does not draw".to_string())
    }

    fn read(&self, text: &str) -> Option<Interpreted> {
        let source = Source {
            text: text.to_string(),
            ..self.source.clone()
        };
        let derived = opened::determined(&source, self.motion, &mut Diagnostics::new()).ok()?;
        opened::solvable(&derived, &mut Diagnostics::new()).ok()
    }

    /// Returns the poses of all bodies at the start.
    fn poses(&self, candidate: &Candidate) -> Vec<BodyPose<'_>> {
        let Some(instant) = self.synthesis.assembled(candidate, self.range.ends[0]) else {
            return Vec::new();
        };
        let q = DVector::from_column_slice(instant.q());
        let bodies = self.derived.system.mechanism.moving_bodies().iter();
        let poses = bodies.filter_map(|body| {
            let mut pose = [0.0; 3];
            for (value, coordinate) in pose.iter_mut().zip(&body.coordinates) {
                *value = q[coordinate.as_ref()?.place];
            }
            Some((body.name.as_str(), pose))
        });
        poses.collect()
    }

    /// True if a description moves as its candidate does.
    fn repeats(&self, candidate: &Candidate, interpreted: &Interpreted) -> bool {
        use linkwright::Blocks as _;
        let targets = self.synthesis.targets();
        let observables: Vec<Observable> = targets.columns.iter().map(|it| it.observable).collect();
        let mut order: Vec<usize> = (0..candidate.times.len()).collect();
        order.sort_by(|a, b| candidate.times[*a].total_cmp(&candidate.times[*b]));
        let mut times = vec![self.range.ends[0]];
        times.extend(order.iter().map(|row| candidate.times[*row]));
        let batch = Batch::new(interpreted, &times, &observables);
        let mut solved = vec![f64::NAN; times.len() * observables.len()];
        let parameters = interpreted.nominal_parameters().0;
        let Ok(outcomes) = batch.solve(&parameters, &[], &mut solved) else {
            return false;
        };
        let rows = solved.chunks_exact(observables.len()).skip(1).zip(&order);
        let mut pairs = rows.flat_map(|(values, row)| {
            let columns = targets.columns.iter().zip(&candidate.residuals).zip(values);
            columns.map(move |((column, residuals), value)| (column, residuals[*row], *row, *value))
        });
        let is_alike = pairs.all(|(column, residual, row, value)| {
            let (Some(target), Some(residual)) = (column.values[row], residual) else {
                return true;
            };
            let repeated = difference(target, value, column.is_angle);
            (repeated - residual).abs() <= ROUNDING * column.size.max(target.abs())
        });
        is_alike && outcomes.iter().all(|it| it.failure.is_none())
    }
}

/// Returns the names of limited measures whose proven bounds do not keep their limits.
fn unproven_limits(check: &Check, proof: &Proof) -> Vec<String> {
    let mechanism = &check.interpreted.system().mechanism;
    let proven = proof.proven.iter().flat_map(|it| &it.measures);
    let proven: Vec<_> = proven.collect();
    let unproven = mechanism.limits.iter().filter(|limit| {
        let mut bounds = proven.iter().filter(|it| it.0 == limit.measurement);
        let holds = |ends: [f64; 2]| ends.iter().all(|it| limit.margin(*it) >= 0.0);
        !bounds.any(|it| holds(it.1.bounds))
    });
    let names = unproven.map(|limit| mechanism.measurements[limit.measurement].name.clone());
    names.collect()
}
