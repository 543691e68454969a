//! Converts panics into findings at the location of the description being processed.
//!
//! Each thread records the text that it reads and the location that it processes. A panic leaves both records unchanged for the
//! handler. No result depends on them.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::fmt;
use std::panic::{self, AssertUnwindSafe, catch_unwind};
use std::thread;

use super::{Code, Diagnostic, Diagnostics, Source, Span};

thread_local! {
    static SOURCE: RefCell<Option<Source>> = const { RefCell::new(None) };
    static PLACE: Cell<Option<Span>> = const { Cell::new(None) };
    static ORIGIN: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Request to the user, for help lines.
const HELP: &str = "this is an error of Linkwright, not of the description; please report it with the description \
                    to the distributor of your copy of Linkwright";

/// Record of the location being processed, until it is dropped.
#[must_use]
#[derive(Debug)]
pub struct WorkAt(Option<Span>);

/// Records the location being processed.
pub fn work_at(span: Span) -> WorkAt {
    WorkAt(PLACE.replace(Some(span)))
}

impl Drop for WorkAt {
    fn drop(&mut self) {
        // The innermost location is reported.
        if !thread::panicking() {
            PLACE.set(self.0);
        }
    }
}

/// Records the text being read.
pub fn reads(source: &Source) {
    let noted = Source::new(source.name.as_str(), source.text.as_str());
    SOURCE.set(Some(noted));
}

/// Records the source line of panics instead of printing them. Only for programs: the hook affects the whole process.
pub fn note_panics() {
    panic::set_hook(Box::new(|info| {
        let origin = info.location().map(ToString::to_string);
        // An ending thread has no record.
        let _ = ORIGIN.try_with(|noted| noted.replace(origin));
    }));
}

/// A caught panic: an error of Linkwright itself.
#[derive(Clone, Debug, PartialEq)]
pub struct InternalError {
    message: String,
    source: Option<Box<Source>>,
    place: Option<Span>,
}

/// Runs some work and catches its panics.
///
/// # Errors
/// Returns an error if the work panicked.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, InternalError> {
    let outer = PLACE.take();
    ORIGIN.set(None);
    // Values that the work leaves behind are dropped, or replaced as a whole by every caller.
    let result = catch_unwind(AssertUnwindSafe(work));
    let place = PLACE.replace(outer);
    result.map_err(|payload| {
        let origin = ORIGIN.take().map_or(String::new(), |it| format!(" ({it})"));
        InternalError {
            message: format!("internal error: {}{origin}", words(payload.as_ref())),
            source: SOURCE.with_borrow(Clone::clone).map(Box::new),
            place,
        }
    })
}

/// Returns the message of a panic in one line.
fn words(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    let text = text.unwrap_or("a panic without a message");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

impl InternalError {
    /// Returns the finding in the text that was read last.
    pub fn finding(&self) -> Diagnostic {
        let place = self.place.unwrap_or_default();
        let finding = Diagnostic::error(Code::InternalError, place, self.message.as_str());
        match self.place {
            Some(_) => finding.label("while this was processed").help(HELP),
            None => finding
                .note("the place in the description is unknown")
                .help(HELP),
        }
    }

    /// Returns a sink that contains only this finding.
    pub fn findings(&self) -> Diagnostics {
        let mut findings = Diagnostics::new();
        findings.push(self.finding());
        findings
    }
}

/// Formats the error for printing, with the location if it is known.
impl fmt::Display for InternalError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.source, self.place) {
            (Some(source), Some(_)) => {
                formatter.write_str(self.finding().render(source).trim_end())
            }
            (source, _) => {
                let (code, message) = (Code::InternalError, &self.message);
                write!(formatter, "error[{code}]: {message}")?;
                if let Some(source) = source {
                    write!(formatter, "\n  --> {}", source.name)?;
                }
                write!(formatter, "\n  = help: {HELP}")
            }
        }
    }
}

impl std::error::Error for InternalError {}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "mechanism m {\n    body a at (0, 0);\n}\n";

    #[test]
    fn reports_the_innermost_place_and_goes_on() {
        reads(&Source::new("m.mech", TEXT));
        let failing = || {
            let _outer = work_at(Span::new(0, 11));
            drop(work_at(Span::new(10, 11)));
            let _inner = work_at(Span::new(18, 35));
            let none: [u8; 0] = [];
            none[TEXT.len()]
        };
        let error = caught(failing).expect_err("it panics");
        let text = error.to_string();
        for part in [
            "error[K90]: internal error: index out of bounds: the len is 0 but the index is 38",
            "m.mech:2:5",
            "body a at (0, 0);",
            "please report it with the description",
        ] {
            assert!(text.contains(part), "{part} in\n{text}");
        }
        // The next panic has no record of the previous location.
        let error = caught(|| panic!("{}\n{}", "two", "lines")).expect_err("it panics");
        assert_eq!(error.place, None);
        assert!(
            error
                .to_string()
                .starts_with("error[K90]: internal error: two lines\n  --> m.mech\n"),
            "{error}"
        );
        assert_eq!(caught(|| 7), Ok(7));
    }

    #[test]
    fn keeps_the_place_of_the_work_around_it() {
        let _outer = work_at(Span::new(1, 2));
        assert!(caught(|| panic!("inside")).is_err());
        let place = PLACE.get();
        assert_eq!(place, Some(Span::new(1, 2)));
    }
}
