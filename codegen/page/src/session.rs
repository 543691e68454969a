//! Answers the questions of a page, one after another.
//!
//! A description is planned once, and its parameters and inputs are values of the plan: a control that moves costs the motion and the
//! drawing alone. An answer depends on its question only, not on earlier ones.

use linkwright_codegen::diagnostic::Source;
use linkwright_solver::{
    Assembly, Check, Instant, Interpreted, ModeSelection, Modes, Opened, Schedule, Unopened,
    View as _,
};

use crate::answer::Answer;
use crate::controls::{Control, assignment, controls};
use crate::message::{Message, messages};
use crate::picture::picture;
use crate::players::{Chosen, Players};
use crate::question::{Detail, Question, Range};
use crate::recorded::{Examination, Precision};

/// Descriptions and checks that are kept for the next question.
///
/// ```
/// use linkwright_page::{Question, Session};
///
/// let text = "
///     mechanism crank {
///         param length = 40mm;
///         point O = (0, 0);
///         body arm at O { O, A: (length, 0) }
///         revolute O(ground, arm);
///         drive phi(arm) = 3*t;
///     }";
/// let mut question = Question { text: text.to_string(), ..Question::default() };
/// question.values.insert("length".to_string(), "50".to_string());
/// let answer = Session::default().answer(&question);
/// assert!(answer.messages.is_empty() && answer.drawing.starts_with("<svg"));
/// ```
#[derive(Debug, Default)]
pub struct Session {
    /// Assignments that precede those of questions.
    assignments: Vec<String>,
    opened: Option<Open>,
}

/// Description as it was opened.
#[derive(Debug)]
struct Open {
    source: Source,
    motion: Option<String>,
    result: Result<Opened, Unopened>,
    /// Controls at the values of the description, with the times for which their ranges are guessed.
    controls: Option<(Range, Vec<Control>)>,
}

impl Session {
    /// Creates a session whose descriptions have other values of parameters and inputs, as assignments: `rod = 130mm`.
    pub fn new(assignments: Vec<String>) -> Session {
        Session {
            assignments,
            opened: None,
        }
    }

    /// Answers a question about the description in it.
    pub fn answer(&mut self, question: &Question) -> Answer {
        self.answer_about(question.source(), question)
    }

    /// Answers a question about a description from elsewhere.
    pub fn answer_about(&mut self, source: Source, question: &Question) -> Answer {
        let open = self.open(source, question.motion.as_deref());
        let opened = match &open.result {
            Ok(opened) => opened,
            Err(reason) => {
                let messages = refused(reason, &open.source.name);
                return Answer::without_motion(question.range, messages);
            }
        };
        let mut found = messages(&opened.warnings);
        match Moving::of(&opened.interpreted, question) {
            Ok(moving) => {
                let mut answer = moving.answer(question, found);
                if question.detail != Detail::Moving {
                    answer.controls = Some(open.controls(question));
                }
                answer
            }
            Err(message) => {
                found.push(Message::error(message));
                Answer::without_motion(question.range, found)
            }
        }
    }

    /// Returns the description as it was opened, anew if it has changed.
    fn open(&mut self, source: Source, motion: Option<&str>) -> &mut Open {
        let is_open = |open: &Open| open.source == source && open.motion.as_deref() == motion;
        match self.opened.take().filter(is_open) {
            Some(open) => self.opened.insert(open),
            None => {
                let mut result = Opened::read(&source, motion);
                if let Ok(opened) = &mut result {
                    for assignment in &self.assignments {
                        // Descriptions without such a parameter have their own values.
                        let _ = opened.interpreted.set("value", assignment);
                    }
                }
                self.opened.insert(Open {
                    source,
                    motion: motion.map(str::to_string),
                    result,
                    controls: None,
                })
            }
        }
    }
}

impl Open {
    /// Returns the controls with the values of a question.
    fn controls(&mut self, question: &Question) -> Vec<Control> {
        let Ok(opened) = &self.result else {
            return Vec::new();
        };
        let kept = self
            .controls
            .take()
            .filter(|(range, _)| *range == question.range);
        let (_, controls) = self.controls.insert(kept.unwrap_or_else(|| {
            (
                question.range,
                controls(&opened.interpreted, question.range),
            )
        }));
        controls.clone()
    }
}

/// Mechanism with the values, the assembly and the times of a question.
struct Moving {
    interpreted: Interpreted,
    schedule: Schedule,
    chosen: Option<Chosen>,
}

impl Moving {
    /// Applies a question to a description.
    ///
    /// # Errors
    /// A sentence: a value, the times or the assembly cannot be used.
    fn of(described: &Interpreted, question: &Question) -> Result<Moving, String> {
        let mut interpreted = described.clone();
        for (name, text) in &question.values {
            let assignment = assignment(described, name, text)?;
            interpreted.set(name, &assignment)?;
        }
        let Range { from, to, step } = question.range;
        if ![from, to, step].iter().all(|it| it.is_finite()) {
            return Err("the times need finite numbers".to_string());
        }
        let schedule = Schedule::range(from, to, step)?;
        let chosen = match &question.assembly {
            None => None,
            Some(label) => Some(Chosen {
                start: selected(&interpreted, label, from)?,
                label: label.clone(),
            }),
        };
        Ok(Moving {
            interpreted,
            schedule,
            chosen,
        })
    }

    /// Follows the motion, and draws it.
    fn answer(self, question: &Question, mut messages: Vec<Message>) -> Answer {
        let start = self.schedule.start.t;
        let (mut players, scale) = match question.detail {
            Detail::Moving => (self.players(&[], Examination::None), question.scale),
            Detail::Resting | Detail::Whole => {
                let check = Check::new(self.interpreted.clone(), &self.schedule, |_| {});
                messages.extend(check.warnings.iter().map(Message::warning));
                (
                    self.players(&check.assemblies.found, Examination::Full),
                    None,
                )
            }
        };
        let drawing = picture(&self.interpreted, &mut players, start, scale);
        let warnings = players.drawn().map_or(&[][..], |it| &it.warnings);
        for warning in warnings {
            let warning = Message::warning(warning);
            if !messages.contains(&warning) {
                messages.push(warning);
            }
        }
        messages.extend(players.error().map(Message::error));
        Answer {
            players: Some(players),
            drawing,
            controls: None,
            range: question.range,
            messages,
            sections: Default::default(),
        }
    }

    fn players(&self, known: &[Assembly], examination: Examination) -> Players {
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

/// Returns the pose and the modes of an assembly with this label at `t` (s).
fn selected(interpreted: &Interpreted, label: &str, t: f64) -> Result<(Instant, Modes), String> {
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

/// Returns the messages of a description that cannot be solved.
fn refused(reason: &Unopened, name: &str) -> Vec<Message> {
    match (reason, reason.message(name)) {
        (Unopened::Findings(findings), _) => messages(findings),
        (_, Some((text, help))) => {
            let help = help.map_or(String::new(), |help| format!("\nhelp: {help}"));
            vec![Message::error(text + &help)]
        }
        (_, None) => Vec::new(),
    }
}
