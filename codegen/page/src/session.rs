//! Answers the questions of a page, one after another.
//!
//! A description is planned once, and its parameters and inputs are values of the plan: a control that moves costs the motion and the
//! drawing alone. An answer depends on its question only, not on earlier ones.

use linkwright_codegen::diagnostic::Source;
use linkwright_solver::{Check, Instant, Opened, Unopened, View as _};

use crate::answer::Answer;
use crate::check_text;
use crate::comma_separated::Table;
use crate::controls::{Control, controls};
use crate::forced::{OPTIONS, is_moved_by_forces, limited};
use crate::given::leading_docs;
use crate::message::{Message, messages, refused};
use crate::motion::{Followed, Listeners, Sink, Wanted};
use crate::moving::Moving;
use crate::players::Players;
use crate::question::{Detail, Question, Range};
use crate::recorded::Examination;
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
                let is_drawn = moving.chosen.is_none();
                let Checked { check, first, .. } = open.checked(&moving, question);
                let sections = sections(check, first.as_ref(), range.step, is_drawn);
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

    /// Returns the motion of a question as CSV, as the command `solve` writes it, or under forces the command `simulate`.
    ///
    /// # Errors
    /// The messages of a description that cannot be solved.
    pub fn table(&mut self, question: &Question) -> Result<String, Vec<Message>> {
        let (_, moving) = self.moving(question)?;
        let system = moving.interpreted.system();
        let selection = Wanted {
            points: (0..system.outputs.len()).collect(),
            coordinates: (0..system.coordinates.len()).collect(),
            ..Wanted::default()
        };
        let (view, schedule) = (&moving.interpreted, &moving.schedule);
        let chosen = moving.chosen.clone().map(|it| it.start);
        let mut text = Vec::new();
        let written = match is_moved_by_forces(view) {
            true => {
                let mut motion = Followed::moved_by_forces(view, selection, chosen.clone());
                Table::new(&motion, false, &mut text).and_then(|mut table| {
                    let listeners = Listeners {
                        reached: &mut |_| {},
                        taken: &mut limited,
                    };
                    let sinks: &mut [&mut dyn Sink] = &mut [&mut table];
                    motion.simulate((view, chosen), schedule, OPTIONS, sinks, listeners)?;
                    table.finish()
                })
            }
            false => {
                let mut motion = Followed::new(view.clone(), selection, schedule.start.t, chosen);
                Table::new(&motion, false, &mut text).and_then(|mut table| {
                    motion.follow(schedule, &mut [&mut table], |_| {})?;
                    table.finish()
                })
            }
        };
        written.map_err(|error| vec![Message::error(error.to_string())])?;
        Ok(String::from_utf8_lossy(&text).into_owned())
    }

    /// Returns the assemblies and the closest approaches to singular poses as text, as the command `check` prints them.
    ///
    /// # Errors
    /// The messages of a description that cannot be solved.
    pub fn check(&mut self, question: &Question) -> Result<String, Vec<Message>> {
        let (open, moving) = self.moving(question)?;
        let mut text = Vec::new();
        let check = &open.checked(&moving, question).check;
        let written = check_text::write(check, WIDTH, &mut text);
        written.map_err(|error| vec![Message::error(error.to_string())])?;
        Ok(String::from_utf8_lossy(&text).into_owned())
    }

    fn moving(&mut self, question: &Question) -> Result<(&mut Open, Moving), Vec<Message>> {
        let motion = question.motion.as_deref();
        let open = self.open(question.source(), motion, question.range.from);
        let moving = match &open.result {
            Ok(opened) => Moving::of(&opened.interpreted, question)
                .map_err(|message| vec![Message::error(message)])?,
            Err(reason) => return Err(refused(reason, &open.source.name)),
        };
        Ok((open, moving))
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

    /// Returns the check of a question: the last one, if it is that.
    fn checked(&mut self, moving: &Moving, question: &Question) -> &Checked {
        let last = self.checked.take().filter(|it| it.is_of(question));
        self.checked.insert(last.unwrap_or_else(|| Checked {
            question: question.clone(),
            first: moving.players(&[], Examination::None).first().cloned(),
            check: moving.check(),
        }))
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
