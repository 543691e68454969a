//! Shared arguments of the programs that write a report: its environment, its files, and the end of the program.

use std::error::Error;
use std::fs;
use std::io;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::environment::Environment;
use crate::files;

/// The commit of a report, and its folder.
#[derive(Args, Clone, Debug)]
pub struct Destination {
    /// The commit that is measured [default: what git says]
    #[arg(long)]
    commit: Option<String>,
    /// The folder of what is written [default: tests/reports]
    #[arg(long)]
    output: Option<PathBuf>,
}

impl Destination {
    /// This machine, with the commit.
    pub fn environment(&self) -> Environment {
        Environment::here(self.commit.as_deref())
    }

    /// The folder, which is there afterwards.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn folder(&self) -> io::Result<PathBuf> {
        let folder = self.output.clone();
        let folder = folder.unwrap_or_else(|| files::package("reports"));
        fs::create_dir_all(&folder)?;
        Ok(folder)
    }

    /// Writes a file, and says so.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&self, name: &str, text: &str) -> io::Result<()> {
        let file = self.folder()?.join(name);
        fs::write(&file, text)?;
        println!("wrote {}", file.display());
        Ok(())
    }
}

/// The end of a program, with its error in words.
pub fn ended(found: Result<(), Box<dyn Error>>) -> ExitCode {
    match found {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Asks that no answer is wrong.
///
/// # Errors
/// The number of those that are.
pub fn none_wrong(wrong: usize) -> Result<(), Box<dyn Error>> {
    match wrong {
        0 => Ok(()),
        _ => Err(format!("{wrong} wrong answers").into()),
    }
}
