//! Defines the arguments of formatting, new crates, the language server, completions and manual pages.

use std::path::PathBuf;

use clap::Args;
use clap_complete::Shell;

/// Formats descriptions: a line for each statement, four blanks for each brace, one blank between words. Comments,
/// the line breaks inside a statement, single blank lines and columns stay.
///
/// A file with an error is left unchanged. Formatted files are not touched.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  linkwright fmt mechanisms/two_body.mech
  linkwright fmt descriptions --check        all descriptions of a folder, for a build
  linkwright fmt - < arm.mech                the formatted text on stdout, for an editor

Exit codes: 0 formatted, 1 `--check` found an unformatted file, 2 bad input.")]
pub struct Fmt {
    /// Descriptions, or folders of them; `-` is stdin, and is printed
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// Write nothing; name the files that are not formatted, and exit with 1 if there are any
    #[arg(long)]
    pub check: bool,
}

/// Writes a crate with a mechanism, a loop that moves it and a test, as a start.
///
/// NAME may be a path, whose last part is the name of the crate. Existing files are not touched.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  linkwright new walker
  linkwright new walker --path ~/linkwright      with the crates of a clone instead of published ones

Exit codes: 0 written, 2 bad input.")]
pub struct New {
    /// Name of the crate, which is also its folder
    pub name: PathBuf,
    /// Clone of the repository of Linkwright, whose crates are used
    #[arg(long, value_name = "DIR")]
    pub path: Option<PathBuf>,
}

/// Serves an editor in the language server protocol, on stdin and stdout.
///
/// An editor starts and ends it. It reports the findings of every open description at once, with the texts and at the
/// places of the other commands. It shows the kind and value of a name and the equations of a joint, finds
/// declarations and uses, completes and renames names, lists the statements, and formats the text as `linkwright fmt`
/// does. Texts need not be saved; tables are read from the folder of the description.
#[derive(Args, Debug)]
#[command(after_help = "\
The guide, codegen/guide/editors.md, describes the setup of editors.

Exit codes: 0 the editor has sent `shutdown`, 1 it ended without.")]
pub struct Lsp {
    /// Use stdin and stdout, which is always the case; some editors pass this option
    #[arg(long)]
    pub stdio: bool,
}

/// Prints a script that completes this command's arguments in a shell.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  linkwright completions bash > ~/.local/share/bash-completion/completions/linkwright
  linkwright completions zsh > ~/.zfunc/_linkwright
  linkwright completions fish > ~/.config/fish/completions/linkwright.fish")]
pub struct Completions {
    /// Shell
    pub shell: Shell,
}

/// Writes a manual page for this command, and one for each of its commands.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  linkwright man --out ~/.local/share/man/man1
  man linkwright-solve")]
pub struct Man {
    /// Folder for the pages
    #[arg(short, long, value_name = "DIR")]
    pub out: PathBuf,
    /// Replace files that this command has not written
    #[arg(long)]
    pub force: bool,
}
