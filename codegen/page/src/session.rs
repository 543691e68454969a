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
use crate::check_text;
use crate::comma_separated::Table;
use crate::controls::{Control, assignment, controls};
use crate::given::leading_docs;
use crate::message::{Message, messages, refused};
use crate::motion::{Followed, Wanted};
use crate::picture::picture;
use crate::players::{Chosen, DRAWN, Players};
use crate::pull::{Pulled, Scene, pulled};
use crate::question::{Detail, Question, Range};
use crate::recorded::{Examination, Precision};
use crate::sections::sections;
use crate::whole::requested;

/// Width of tables of text, in characters.
const WIDTH: usize = 110;

/// Answers to the questions of a page, with what the next answer needs again.
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
    start: f64,
    result: Result<Opened, Unopened>,
    /// Names of the motions if there are several and none is chosen.
    motions: Vec<String>,
    /// Controls at the values of the description, with the times for which their ranges are guessed.
    controls: Option<(Range, Vec<Control>)>,
    /// Last check, for the sections of its question.
    checked: Option<Checked>,
}

/// Check of a mechanism.
#[derive(Debug)]
struct Checked {
    question: Question,
    check: Check,
    /// First instant of the motion; `None` without a motion.
    first: Option<Instant>,
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
        let range = question.range;
        let open = self.open(source, question.motion.as_deref(), range.from);
        let opened = match &open.result {
            Ok(opened) => opened,
            Err(reason) => {
                return Answer::without_motion(range, refused(reason, &open.source.name));
            }
        };
        let mut findings = messages(&opened.warnings);
        let (moving, pulled) = match Moving::pulled(&opened.interpreted, question) {
            Ok(moving) => moving,
            Err(message) => {
                findings.push(Message::error(message));
                return Answer::without_motion(range, findings);
            }
        };
        let requested = requested(&opened.requested);
        let answer = match question.detail {
            Detail::Moving => moving.answer(&[], Examination::None, question, findings),
            Detail::Resting => {
                let check = moving.check();
                findings.extend(check.warnings.iter().map(Message::warning));
                let known = &check.assemblies.found;
                let answer = moving.answer(known, Examination::Full, question, findings);
                open.checked = Some(Checked {
                    question: question.clone(),
                    first: answer.players.as_ref().and_then(Players::first).cloned(),
                    check,
                });
                Answer {
                    controls: Some(open.controls(question)),
                    lead: Some(leading_docs(&moving.interpreted.system().mechanism.docs)),
                    ..answer
                }
            }
            Detail::Sections => {
                let checked = open.checked.take().filter(|it| it.is_of(question));
                let checked = checked.unwrap_or_else(|| Checked {
                    question: question.clone(),
                    first: moving.players(&[], Examination::None).first().cloned(),
                    check: moving.check(),
                });
                let (check, first) = (&checked.check, checked.first.as_ref());
                let is_drawn = moving.chosen.is_none();
                let sections = sections(check, first, range.step, is_drawn);
                open.checked = Some(checked);
                Answer {
                    sections: sections.into_iter().map(|it| (it.id, it.html)).collect(),
                    ..Answer::without_motion(range, findings)
                }
            }
        };
        Answer {
            requested,
            motions: open.motions.clone(),
            pulled,
            ..answer
        }
    }

    /// Returns the motion of a question as CSV, as the command `solve` writes it.
    ///
    /// # Errors
    /// The messages of a description that cannot be solved.
    pub fn table(&mut self, question: &Question) -> Result<String, Vec<Message>> {
        let moving = self.moving(question)?;
        let system = moving.interpreted.system();
        let selection = Wanted {
            points: (0..system.outputs.len()).collect(),
            coordinates: (0..system.coordinates.len()).collect(),
            monitor: false,
            curves: false,
        };
        let (view, start) = (moving.interpreted.clone(), moving.schedule.start.t);
        let chosen = moving.chosen.clone().map(|it| it.start);
        let mut motion = Followed::new(view, selection, start, chosen);
        let mut text = Vec::new();
        let written = Table::new(&motion, false, &mut text).and_then(|mut table| {
            motion.follow(&moving.schedule, &mut [&mut table], |_| {})?;
            table.finish()
        });
        written.map_err(|error| vec![Message::error(error.to_string())])?;
        Ok(String::from_utf8_lossy(&text).into_owned())
    }

    /// Returns the assemblies and the closest approaches to singular poses as text, as the command `check` prints them.
    ///
    /// # Errors
    /// The messages of a description that cannot be solved.
    pub fn check(&mut self, question: &Question) -> Result<String, Vec<Message>> {
        let check = self.moving(question)?.check();
        let mut text = Vec::new();
        let written = check_text::write(&check, WIDTH, &mut text);
        written.map_err(|error| vec![Message::error(error.to_string())])?;
        Ok(String::from_utf8_lossy(&text).into_owned())
    }

    fn moving(&mut self, question: &Question) -> Result<Moving, Vec<Message>> {
        let motion = question.motion.as_deref();
        let open = self.open(question.source(), motion, question.range.from);
        match &open.result {
            Ok(opened) => Moving::of(&opened.interpreted, question)
                .map_err(|message| vec![Message::error(message)]),
            Err(reason) => Err(refused(reason, &open.source.name)),
        }
    }

    /// Returns the description as it was opened, anew if it has changed.
    fn open(&mut self, source: Source, motion: Option<&str>, start: f64) -> &mut Open {
        let is_open = |open: &Open| {
            open.source == source && open.motion.as_deref() == motion && open.start == start
        };
        let opened = self.opened.take().filter(is_open);
        let opened = opened.unwrap_or_else(|| {
            let mut result = Opened::read_to_draw(&source, motion, start);
            let mut motions = Vec::new();
            if let Err(Unopened::Several(names)) = &result {
                motions = names.clone();
                // The first one, until another is chosen.
                let first = names.first().map(String::as_str);
                result = Opened::read_to_draw(&source, first, start);
            }
            if let Ok(opened) = &mut result {
                for assignment in &self.assignments {
                    // Descriptions without such a parameter have their own values.
                    let _ = opened.interpreted.set("value", assignment);
                }
            }
            Open {
                source,
                motion: motion.map(str::to_string),
                start,
                result,
                motions,
                controls: None,
                checked: None,
            }
        });
        self.opened.insert(opened)
    }
}

impl Open {
    /// Returns the controls, whose ranges are guessed once.
    fn controls(&mut self, question: &Question) -> Vec<Control> {
        let Ok(opened) = &self.result else {
            return Vec::new();
        };
        let range = question.range;
        let kept = self.controls.take().filter(|(of, _)| *of == range);
        let kept = kept.unwrap_or_else(|| (range, controls(&opened.interpreted, range)));
        self.controls.insert(kept).1.clone()
    }
}

impl Checked {
    /// True if this is the check of a question, whatever parts it asks for.
    fn is_of(&self, question: &Question) -> bool {
        let question = Question {
            detail: self.question.detail,
            scale: self.question.scale,
            ..question.clone()
        };
        self.question == question
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
            if let Some(assignment) = assignment(described, name, text)? {
                interpreted.set(name, &assignment)?;
            }
        }
        let Range { from, to, step } = question.range;
        if ![from, to, step].iter().all(|it| it.is_finite()) {
            return Err("the times need finite numbers".to_string());
        }
        let schedule = Schedule::range(from, to, step)?;
        let others = question.assembly.as_deref();
        let chosen = match others.filter(|label| !label.ends_with(DRAWN.trim_start())) {
            None => None,
            Some(label) => Some(Chosen {
                start: selected(&interpreted, label, from)?,
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
    fn pulled(
        described: &Interpreted,
        question: &Question,
    ) -> Result<(Moving, Option<Pulled>), String> {
        let moving = Moving::of(described, question)?;
        let Some(pull) = &question.pull else {
            return Ok((moving, None));
        };
        let with = |values: &[(String, f64)]| Moving::of(described, &question.with(values));
        let pulled = pulled(&moving.scene(), question, pull, |values| {
            with(values).map(|it| it.scene())
        })?;
        Ok((with(&pulled.values)?, Some(pulled)))
    }

    fn scene(&self) -> Scene {
        Scene {
            view: self.interpreted.clone(),
            chosen: self.chosen.as_ref().map(|it| it.start.clone()),
        }
    }

    /// Looks for assemblies and singular poses.
    fn check(&self) -> Check {
        Check::new(self.interpreted.clone(), &self.schedule, |_| {})
    }

    /// Follows the motion, and draws it.
    fn answer(
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
