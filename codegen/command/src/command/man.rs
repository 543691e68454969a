//! Writes manual pages: one for this command, and one for each of its subcommands.

use std::io;

use clap::Command;
use clap_mangen::Man as Page;

use super::{Outcome, Problem, print};
use crate::arguments::Man;
use crate::output::{Beginning, Outputs, Record, Signature};

/// Signature of a manual page.
const SIGNATURE: Signature = Signature {
    noun: "a manual page of this command",
    beginning: Beginning::Bytes(|start| {
        let text = String::from_utf8_lossy(start);
        text.contains(".TH linkwright")
    }),
    record: Record::None,
};

/// Writes the pages of `interface`.
///
/// # Errors
/// A page cannot be written. All pages are checked before the first is written.
pub fn run(interface: Command, arguments: &Man) -> Result<Outcome, Problem> {
    let mut command = interface.disable_help_subcommand(true);
    command.build();
    let mut pages = vec![("linkwright".to_string(), Page::new(command.clone()))];
    for sub in command.get_subcommands() {
        let name = format!("linkwright-{}", sub.get_name());
        pages.push((name, Page::new(sub.clone())));
    }
    let mut outputs = Outputs::new(arguments.force);
    let mut written = Vec::new();
    for (name, page) in pages {
        let output = outputs.file(&arguments.out.join(format!("{name}.1")), SIGNATURE)?;
        let mut text = Vec::new();
        page.render(&mut text).map_err(Problem::of)?;
        written.push((output, text));
    }
    let number = written.len();
    for (output, text) in written {
        output.write(|output| -> io::Result<()> { output.write_all(&text) })?;
    }
    let folder = arguments.out.display();
    print(|output| writeln!(output, "wrote {number} pages to {folder}"))?;
    Ok(Outcome::Done)
}
