//! Checks texts on its own thread, so that requests are answered while equations are derived.
//!
//! Of each document only the newest text waits. Text and names are checked first. The equations and their solution are checked
//! afterwards, unless a newer text has arrived meanwhile.

use std::collections::BTreeMap;
use std::sync::mpsc::Sender;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

use linkwright_codegen::diagnostic::internal::caught;
use linkwright_codegen::diagnostic::{Diagnostics, Source, merged};
use linkwright_codegen::stages::check;
use linkwright_codegen::{Read, read};

use super::document::Equations;
use super::session::Event;

/// Findings about a text.
pub struct Found {
    /// Name of the document.
    pub name: String,
    /// Number of the text.
    pub number: u64,
    /// Findings.
    pub findings: Diagnostics,
    /// Equations of the text; `None` if they could not be derived.
    pub equations: Option<Arc<Equations>>,
    /// True if the findings are complete.
    pub is_final: bool,
}

/// Texts that wait, by document.
#[derive(Default)]
struct Waiting {
    texts: Mutex<BTreeMap<String, (u64, Source)>>,
    more: Condvar,
}

impl Waiting {
    fn texts(&self) -> MutexGuard<'_, BTreeMap<String, (u64, Source)>> {
        // A text is replaced as a whole: the state of a thread that panicked is complete.
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

/// Handle of the checking thread.
pub struct Checker {
    waiting: Arc<Waiting>,
}

impl Checker {
    /// Starts a thread that waits for texts and sends its findings.
    pub fn start(events: Sender<Event>) -> Checker {
        let waiting = Arc::new(Waiting::default());
        let queue = Arc::clone(&waiting);
        thread::spawn(move || {
            loop {
                let (name, number, source) = queue.next();
                let say = |findings, equations, is_final| {
                    let message = Found {
                        name: name.clone(),
                        number,
                        findings,
                        equations,
                        is_final,
                    };
                    // After the end of the session, the receiver is gone.
                    let _ = events.send(Event::Found(message));
                };
                let is_stale = || queue.texts().contains_key(&name);
                look(&source, is_stale, say);
            }
        });
        Checker { waiting }
    }

    /// Queues a text of a document, instead of an older one.
    pub fn check(&self, name: &str, number: u64, source: Source) {
        self.waiting
            .texts()
            .insert(name.to_string(), (number, source));
        self.waiting.more.notify_one();
    }

    /// Removes a document from the queue.
    pub fn forget(&self, name: &str) {
        self.waiting.texts().remove(name);
    }
}

/// Reports the findings about text and names, then those about equations.
fn look(
    source: &Source,
    is_stale: impl Fn() -> bool,
    say: impl Fn(Diagnostics, Option<Arc<Equations>>, bool),
) {
    let outcome = caught(|| read(source)).unwrap_or_else(|error| Err(error.findings()));
    let read = match outcome {
        Ok(read) => read,
        Err(findings) => return say(findings, None, true),
    };
    let equations = Arc::new(Equations {
        text: source.text.clone(),
        read,
    });
    let read = &equations.read;
    let warnings = read.warnings.clone();
    say(warnings.clone(), Some(Arc::clone(&equations)), false);
    let Some(more) = of_equations(read, is_stale) else {
        return;
    };
    let mut findings = warnings;
    findings.extend(more);
    say(findings, None, true);
}

/// Returns the findings about equations and their solution; `None` if a newer text has arrived.
fn of_equations(read: &Read, is_stale: impl Fn() -> bool) -> Option<Diagnostics> {
    let mut by_motion = Vec::new();
    for derived in &read.motions {
        if is_stale() {
            return None;
        }
        let motion = derived.system.mechanism.motion.as_ref();
        let name = motion.map_or("", |motion| motion.name.as_str());
        let checked = caught(|| check(derived).unwrap_or_else(|found| found));
        by_motion.push((name, None, checked.unwrap_or_else(|error| error.findings())));
    }
    Some(merged(by_motion))
}
