//! Environment of a measurement: processor, compiler, commit and date.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

use crate::files;

/// Machine and date of a measurement.
#[derive(Clone, Debug)]
pub struct Environment {
    /// The processor as it calls itself, and how many of it.
    pub processor: String,
    /// The compiler.
    pub compiler: String,
    /// The profile of the running program, by the folder that holds it.
    pub profile: String,
    /// The commit that was measured.
    pub commit: String,
    /// The day (UTC).
    pub date: String,
}

impl Environment {
    /// This machine, with the given commit or that of git.
    pub fn here(commit: Option<&str>) -> Environment {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        Environment {
            processor: format!("{}, {cores} logical cores", processor()),
            compiler: output("rustc", &["--version"]),
            profile: profile(),
            commit: commit.map_or_else(from_git, str::to_string),
            date: today(),
        }
    }

    /// The lines of a list in Markdown.
    pub fn lines(&self) -> String {
        format!(
            "- machine: {}\n- compiler: {}, profile `{}`\n- commit: {}\n- date: {}\n",
            self.processor, self.compiler, self.profile, self.commit, self.date
        )
    }
}

fn processor() -> String {
    let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = text.lines().find_map(|line| {
        let (key, value) = line.split_once(':')?;
        (key.trim() == "model name").then(|| value.trim().to_string())
    });
    model.unwrap_or_else(|| std::env::consts::ARCH.to_string())
}

fn profile() -> String {
    let program = std::env::current_exe().ok();
    let folder = program.as_deref().and_then(Path::parent);
    let name = folder.and_then(|it| Some(it.file_name()?.to_string_lossy().into_owned()));
    name.unwrap_or_default()
}

fn from_git() -> String {
    let commit = output("git", &["rev-parse", "--short=12", "HEAD"]);
    // The reports themselves are what a measurement changes.
    let changes = output(
        "git",
        &["status", "--porcelain", "--", ":(exclude)tests/reports"],
    );
    if changes.is_empty() {
        commit
    } else {
        format!("{commit} with changes")
    }
}

/// First line that a program prints; `unknown` if it cannot be run.
fn output(program: &str, arguments: &[&str]) -> String {
    let run = Command::new(program)
        .args(arguments)
        .current_dir(files::repository())
        .output();
    match run {
        Ok(run) if run.status.success() => {
            let text = String::from_utf8_lossy(&run.stdout);
            text.lines().next().unwrap_or_default().to_string()
        }
        _ => "unknown".to_string(),
    }
}

/// Today as year-month-day, from the days since 1970 (Howard Hinnant, `civil_from_days`).
fn today() -> String {
    let seconds = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .map_or(0, |since| since.as_secs());
    let days = seconds / 86400 + 719_468;
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era =
        (day_of_era - day_of_era / 1460 + day_of_era / 36524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * shifted + 2) / 5 + 1;
    let month = if shifted < 10 {
        shifted + 3
    } else {
        shifted - 9
    };
    let year = year_of_era + era * 400 + u64::from(month <= 2);
    format!("{year}-{month:02}-{day:02}")
}
