//! *A description → its Rust module, on stdout or in a file.*

use std::fs;

use linkwright_codegen::{Options, Scalar};

use super::description::source;
use super::inspect::module;
use super::{Outcome, Problem, print, say};
use crate::arguments::{Generate, Precision};
use crate::file::replace;

/// Writes the module, or compares it with the file that should hold it.
///
/// A file that already holds the module is left alone, so that nothing that depends on it is built again.
///
/// # Errors
/// The description has errors, or the file cannot be written.
pub fn run(arguments: &Generate) -> Result<Outcome, Problem> {
    let source = source(&arguments.file)?;
    let code = module(&source, &options(arguments))?;
    let Some(path) = &arguments.output else {
        print(|output| output.write_all(code.as_bytes()))?;
        return Ok(Outcome::Done);
    };
    let same = fs::read(path).is_ok_and(|existing| existing == code.as_bytes());
    match (arguments.check, same) {
        (_, true) => Ok(Outcome::Done),
        (true, false) => {
            say(&format!(
                "error: `{}` is not what `{}` generates\n  = help: run `linkwright generate {} -o {}{}`",
                path.display(),
                arguments.file.display(),
                arguments.file.display(),
                path.display(),
                match arguments.scalar {
                    Precision::F64 => "",
                    Precision::F32 => " --scalar f32",
                }
            ));
            Ok(Outcome::Failed)
        }
        (false, false) => {
            replace(path, |output| output.write_all(code.as_bytes()))?;
            Ok(Outcome::Done)
        }
    }
}

/// What the command line chooses about the code.
fn options(arguments: &Generate) -> Options {
    Options {
        scalar: match arguments.scalar {
            Precision::F64 => Scalar::F64,
            Precision::F32 => Scalar::F32,
        },
    }
}
