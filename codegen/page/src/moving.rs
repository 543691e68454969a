//! Applies a question to a description: values, times, an assembly and a pull.

use linkwright_solver::{
    Assembly, Check, Instant, Interpreted, ModeSelection, Modes, Schedule, View as _,
};

use crate::answer::Answer;
use crate::controls::assignment;
use crate::forced::{begins_at, checked, is_moved_by_forces};
use crate::message::Message;
use crate::picture::picture;
use crate::players::{Chosen, DRAWN, Players};
use crate::pull::{Pulled, Scene, pulled};
use crate::question::{Detail, Question, Range};
use crate::recorded::{Examination, Precision};
use crate::restarted::restarted;

/// Mechanism with the values, the assembly and the times of a question.
pub struct Moving {
    /// Mechanism with its values.
    pub interpreted: Interpreted,
    /// Times of the motion.
    pub schedule: Schedule,
    /// Assembly; `None` for that of the design configuration.
    pub chosen: Option<Chosen>,
}

impl Moving {
    /// Applies a question to a description.
    ///
    /// # Errors
    /// A sentence: a value, the times or the assembly cannot be used.
    pub fn of(described: &Interpreted, question: &Question) -> Result<Moving, String> {
        let mut interpreted = described.clone();
        let inputs = &described.system().mechanism.inputs;
        let free = described.system().mechanism.forces.free.iter();
        let free: Vec<&str> = free.map(|it| inputs[it.input].name.as_str()).collect();
        let is_free = |name: &String| free.contains(&name.as_str());
        let (starts, others): (Vec<_>, Vec<_>) =
            question.values.iter().partition(|(name, _)| is_free(name));
        // The rate of a free coordinate may depend on parameters.
        for (name, text) in others.into_iter().chain(starts) {
            if let Some(assignment) = assignment(&interpreted, name, text)? {
                interpreted.set(name, &assignment)?;
            }
        }
        let Range { from, to, step } = question.range;
        if ![from, to, step].iter().all(|it| it.is_finite()) {
            return Err("the times need finite numbers".to_string());
        }
        let schedule = Schedule::range(from, to, step)?;
        if !free.is_empty() {
            begins_at(from)?;
        }
        let others = question.assembly.as_deref();
        let chosen = match others.filter(|label| !label.ends_with(DRAWN.trim_start())) {
            None => None,
            Some(label) => Some(Chosen {
                start: labeled(&interpreted, label, from)?,
                label: label.replace('−', "-"),
            }),
        };
        Ok(Moving {
            interpreted,
            schedule,
            chosen,
        })
    }

    /// Applies a question after its pull, if it has one.
    ///
    /// # Errors
    /// Those of [`Moving::of`] and of [`pulled`].
    pub fn pulled(
        described: &Interpreted,
        question: &Question,
    ) -> Result<(Moving, Option<Pulled>), String> {
        let moving = Moving::of(described, question)?;
        let Some(pull) = &question.pull else {
            return Ok((moving, None));
        };
        if is_moved_by_forces(described) {
            return restarted(described, moving, question, pull);
        }
        let with = |values: &[(String, f64)]| Moving::of(described, &question.with(values));
        let pulled = pulled(&moving.scene(), question, pull, |values| {
            with(values).map(|it| it.scene())
        })?;
        Ok((with(&pulled.values)?, Some(pulled)))
    }

    /// Returns the mechanism at the start of its motion.
    pub fn scene(&self) -> Scene {
        Scene {
            view: self.interpreted.clone(),
            chosen: self.chosen.as_ref().map(|it| it.start.clone()),
        }
    }

    /// Looks for assemblies and singular poses.
    pub fn check(&self) -> Check {
        checked(&self.interpreted, &self.schedule)
    }

    /// Follows the motion, and draws it.
    pub fn answer(
        &self,
        known: &[Assembly],
        examination: Examination,
        question: &Question,
        mut messages: Vec<Message>,
    ) -> Answer {
        let mut players = self.players(known, examination);
        let scale = match question.detail {
            Detail::Moving => question.scale,
            _ => None,
        };
        let start = self.schedule.start.t;
        let drawing = picture(&self.interpreted, &mut players, start, scale);
        let warnings = players.drawn().map_or(&[][..], |it| &it.warnings);
        for warning in warnings.iter().map(Message::warning) {
            if !messages.contains(&warning) {
                messages.push(warning);
            }
        }
        messages.extend(players.error().map(Message::error));
        Answer {
            players: Some(players),
            drawing,
            sketch: scale.is_some(),
            ..Answer::without_motion(question.range, messages)
        }
    }

    /// Follows the motions of the assembly and of all others that are known.
    pub fn players(&self, known: &[Assembly], examination: Examination) -> Players {
        Players::new(
            &self.interpreted,
            known,
            &self.schedule,
            self.chosen.clone(),
            Precision::Double,
            examination,
        )
    }
}

/// Returns the pose and the modes of the assembly with this label, `+-`, at `t` (s).
///
/// # Errors
/// A sentence: the label is of another mechanism, or the mechanism cannot be assembled so.
pub fn labeled(interpreted: &Interpreted, label: &str, t: f64) -> Result<(Instant, Modes), String> {
    let names = interpreted.mode_names();
    let letters: Vec<char> = label.chars().collect();
    if names.len() != letters.len() {
        return Err(format!("no assembly is labeled `{label}`"));
    }
    let wishes = names.iter().zip(&letters).map(|(name, letter)| {
        let mode = match letter {
            '+' => "positive".to_string(),
            '-' | '−' => "negative".to_string(),
            letter => letter.to_string(),
        };
        format!("{}={mode}", name.name)
    });
    let selection = ModeSelection::read(interpreted, &wishes.collect::<Vec<_>>())?;
    selection.assembled(interpreted, t).map_err(|reason| {
        let explained = reason.explained(interpreted);
        format!("the mechanism cannot be assembled in this mode: {explained}")
    })
}
