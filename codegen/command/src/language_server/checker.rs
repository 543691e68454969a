//! *Texts → findings*, on a thread of its own, so that questions are answered while equations are derived.
//!
//! Of every document only the newest text waits. The text and its names are checked first; whether the equations determine the motion,
//! and what solves them, is checked afterwards, if no newer text has come meanwhile.

use std::collections::BTreeMap;
use std::sync::mpsc::Sender;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

use linkwright_codegen::diagnostic::internal::caught;
use linkwright_codegen::diagnostic::{Diagnostics, Source, merged};
use linkwright_codegen::{Read, check, read};

use super::document::Equations;
use super::session::Event;

/// What was found about a text.
pub struct Found {
    /// The document.
    pub name: String,
    /// Which of its texts.
    pub number: u64,
    /// What is to be said about it.
    pub findings: Diagnostics,
    /// Its equations, where they could be derived.
    pub equations: Option<Arc<Equations>>,
    /// Whether nothing more will be found.
    pub is_final: bool,
}

/// The texts that wait, by their documents.
#[derive(Default)]
struct Waiting {
    texts: Mutex<BTreeMap<String, (u64, Source)>>,
    more: Condvar,
}

impl Waiting {
    fn texts(&self) -> MutexGuard<'_, BTreeMap<String, (u64, Source)>> {
        // A text is replaced as a whole: what another thread left is complete.
        self.texts.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn next(&self) -> (String, u64, Source) {
        let mut texts = self.texts();
        loop {
            if let Some((name, (number, source))) = texts.pop_first() {
                return (name, number, source);
            }
            texts = self
                .more
                .wait(texts)
                .unwrap_or_else(PoisonError::into_inner);
        }
    }
}

/// Whoever checks.
pub struct Checker {
    waiting: Arc<Waiting>,
}

impl Checker {
    /// Waits for texts, and says what it finds about them.
    pub fn start(events: Sender<Event>) -> Checker {
        let waiting = Arc::new(Waiting::default());
        let own = Arc::clone(&waiting);
        thread::spawn(move || {
            loop {
                let (name, number, source) = own.next();
                let say = |findings, equations, is_final| {
                    let found = Found {
                        name: name.clone(),
                        number,
                        findings,
                        equations,
                        is_final,
                    };
                    // Nobody listens any more where the session has ended.
                    let _ = events.send(Event::Found(found));
                };
                let is_stale = || own.texts().contains_key(&name);
                look(&source, is_stale, say);
            }
        });
        Checker { waiting }
    }

    /// Has a text of a document checked, and no older one.
    pub fn check(&self, name: &str, number: u64, source: Source) {
        self.waiting
            .texts()
            .insert(name.to_string(), (number, source));
        self.waiting.more.notify_one();
    }

    /// Checks nothing more of a document.
    pub fn forget(&self, name: &str) {
        self.waiting.texts().remove(name);
    }
}

/// Says what is found about a text: first about the text and its names, then about its equations.
fn look(
    source: &Source,
    is_stale: impl Fn() -> bool,
    say: impl Fn(Diagnostics, Option<Arc<Equations>>, bool),
) {
    let found = caught(|| read(source)).unwrap_or_else(|error| Err(error.findings()));
    let read = match found {
        Ok(read) => read,
        Err(findings) => return say(findings, None, true),
    };
    let equations = Arc::new(Equations {
        text: source.text.clone(),
        read,
    });
    let read = &equations.read;
    let found = read.warnings.clone();
    say(found.clone(), Some(Arc::clone(&equations)), false);
    let Some(more) = of_equations(read, is_stale) else {
        return;
    };
    let mut findings = found;
    findings.extend(more);
    say(findings, None, true);
}

/// What the equations and what solves them give; `None` where a newer text has come.
fn of_equations(read: &Read, is_stale: impl Fn() -> bool) -> Option<Diagnostics> {
    let mut found = Vec::new();
    for system in &read.motions {
        if is_stale() {
            return None;
        }
        let motion = system.mechanism.motion.as_ref();
        let name = motion.map_or("", |motion| motion.name.as_str());
        let checked = caught(|| check(system).unwrap_or_else(|found| found));
        found.push((name, None, checked.unwrap_or_else(|error| error.findings())));
    }
    Some(merged(found))
}
