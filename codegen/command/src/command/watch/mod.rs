//! Serves the page of a description on the loopback address while the description is edited.
//!
//! The file and its tables are read again several times per second. A browser that shows the page holds a connection, on which it
//! receives the number of a newer version. The page shows errors of the description as the terminal does. Only this machine is answered,
//! with the page and with answers to the page's questions. A request under another name than the loopback address, or with another
//! origin, comes from a foreign page, and is refused.

mod server;
mod timed;

use std::io;
use std::net::{Ipv4Addr, TcpListener};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, SystemTime};

use linkwright_codegen::diagnostic::internal::caught;
use linkwright_codegen::stages::files;

use self::server::{Current, Shared, on_thread, serve};
use super::description::{is_stdin, source};
use super::view::made;
use super::{Outcome, Problem, print, say};
use crate::arguments::View;
use linkwright_page::{Live, problem};

/// Interval between checks of the files.
const PAUSE: Duration = Duration::from_millis(100);

/// Serves the page until it is interrupted.
///
/// # Errors
/// The address cannot be used, or the description is not a file.
pub fn run(arguments: &View) -> Result<Outcome, Problem> {
    if is_stdin(&arguments.described.file) {
        return Err(Problem(
            "error: `--watch` follows a file, and `-` is stdin".to_string(),
        ));
    }
    let refused = |error: io::Error| {
        let port = arguments.port;
        let text = format!("error: cannot serve at port {port}: {error}");
        match port {
            0 => Problem(text),
            _ => Problem(format!("{text}\n  = help: `--port 0` takes a free one")),
        }
    };
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, arguments.port)).map_err(refused)?;
    let address = listener.local_addr().map_err(refused)?;
    let shared = Arc::new(Shared::new(
        arguments.described.motion.clone(),
        arguments.setting.set.clone(),
    ));
    let mut seen = renew(arguments, &shared);
    print(|output| {
        let name = arguments.described.file.display();
        writeln!(
            output,
            "{name} is at http://{address}/ until this is interrupted"
        )
    })?;
    let listener = Arc::new(listener);
    let mut is_served = false;
    loop {
        if !is_served {
            let (listener, shared) = (listener.clone(), shared.clone());
            let port = address.port();
            // Without a thread, new connections wait until one is available.
            is_served = on_thread(Box::new(move || serve(&listener, port, &shared))).is_ok();
        }
        thread::sleep(PAUSE);
        if seen.iter().any(|(path, stamp)| stamp_of(path) != *stamp) {
            seen = renew(arguments, &shared);
        }
    }
}

/// Time and size of a file, by which changes are detected; `None` without a file.
type Stamp = Option<(SystemTime, u64)>;

fn stamp_of(path: &Path) -> Stamp {
    let metadata = std::fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

/// Runs some work; an internal error becomes a [`Problem`], so that the server continues.
fn survived<T>(work: impl FnOnce() -> Result<T, Problem>) -> Result<T, Problem> {
    caught(work).unwrap_or_else(|error| Err(Problem(error.to_string())))
}

/// Makes a new page, and returns the stamps of its files from before they were read.
fn renew(arguments: &View, shared: &Shared) -> Vec<(PathBuf, Stamp)> {
    let version = shared.current().version + 1;
    let stamped = |path: PathBuf| {
        let stamp = stamp_of(&path);
        (path, stamp)
    };
    let mut seen = vec![stamped(arguments.described.file.clone())];
    let mut read = None;
    let made = survived(|| {
        let source =
            source(&arguments.described.file)?.reported_in(arguments.reported_in.units.clone());
        read = Some(source.clone());
        let folder = files::folder_of(&arguments.described.file);
        let tables = source.attachments.iter().map(|it| folder.join(&it.path));
        seen.extend(tables.map(stamped));
        made(arguments, &source, Live::Version(version))
    });
    let html = match made {
        Ok(made) => {
            if let Some(error) = &made.error {
                say(&format!("error: `{}` {error}", made.name));
            }
            made.html
        }
        Err(Problem(text)) => {
            say(&text);
            problem(
                &arguments.described.file.display().to_string(),
                &text,
                version,
            )
        }
    };
    shared.set(Current {
        version,
        html,
        source: read,
    });
    seen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_of_linkwright_itself_is_shown_and_survived() {
        let Err(Problem(text)) = survived::<()>(|| panic!("a defect")) else {
            unreachable!("it panics")
        };
        assert!(
            text.starts_with("error[K90]: internal error: a defect"),
            "{text}"
        );
        assert_eq!(survived(|| Ok(7)), Ok(7));
    }
}
