//! Times generated modules, alone and in lanes, for several instruction sets.

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use linkwright_codegen::{Options, Scalar, generate};

use super::processor::InstructionSet;
use super::{Measured, lines};
use crate::files;

/// Times of one module for one instruction set (ns a pose).
#[derive(Clone, Copy, Debug)]
pub struct Times {
    /// One mechanism at a time.
    pub alone: f64,
    /// In lanes.
    pub lanes: f64,
    /// In lanes on two threads.
    pub on_two_threads: f64,
}

/// Times by the name of the module: `four_bar_f64_guarded`.
pub type Table = BTreeMap<String, Times>;

/// Program of the package.
const PROGRAM: &str = include_str!("program.rs");

/// Package with the modules, outside the repository.
pub struct Package {
    folder: PathBuf,
}

impl Package {
    /// Writes the modules of all descriptions that have lanes into a folder of this name.
    ///
    /// # Errors
    /// A description has errors, or a file cannot be written.
    pub fn new<'a>(
        name: &str,
        all: impl IntoIterator<Item = &'a Measured>,
    ) -> Result<Package, Box<dyn Error>> {
        let name = format!("linkwright-lanes-{}-{name}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let source = folder.join("src");
        fs::create_dir_all(&source)?;
        let (mut modules, mut calls) = (String::new(), String::new());
        for it in all.into_iter().filter(|it| it.has_lanes) {
            for (scalar, suffix) in [(Scalar::F64, "f64"), (Scalar::F32, "f32")] {
                for (kind, description) in [("guarded", &it.guarded), ("unguarded", &it.unguarded)]
                {
                    let options = Options {
                        scalar,
                        lanes: true,
                        ..Options::default()
                    };
                    let generated = generate(description, &options);
                    let generated = generated.map_err(|errors| errors.render(description))?;
                    let module = format!("{}_{suffix}_{kind}", it.name);
                    fs::write(source.join(format!("{module}.rs")), generated.code())?;
                    writeln!(modules, "#[allow(dead_code)]\nmod {module};")?;
                    writeln!(
                        calls,
                        "    measure::<{module}::Loops, {}>({module:?}, {:?});",
                        scalar.lanes(),
                        it.step
                    )?;
                }
            }
        }
        let program = format!("{PROGRAM}\nfn all() {{\n{calls}}}\n\n{modules}");
        fs::write(source.join("main.rs"), program)?;
        let runtime = files::repository().join("runtime");
        let manifest = format!(
            "[package]\nname = \"in_lanes\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[workspace]\n\n[dependencies]\nlinkwright = {{ path = {runtime:?}, features = [\"std\"] }}\n"
        );
        fs::write(folder.join("Cargo.toml"), manifest)?;
        fs::copy(
            files::repository().join("Cargo.lock"),
            folder.join("Cargo.lock"),
        )?;
        Ok(Package { folder })
    }

    /// Compiles the package for an instruction set, and runs it.
    ///
    /// # Errors
    /// The package does not compile, or its program fails.
    pub fn measure(&self, set: &InstructionSet) -> Result<Table, Box<dyn Error>> {
        let program = self.build(set)?;
        let printed = lines::of(&mut Command::new(program))?;
        let mut table = Table::new();
        for (name, times) in printed.all("time") {
            let &[alone, lanes, on_two_threads] = times else {
                return Err(format!("expected three times of {name}, found {times:?}").into());
            };
            let times = Times {
                alone,
                lanes,
                on_two_threads,
            };
            table.insert(name.to_string(), times);
        }
        Ok(table)
    }

    /// Compiles the package for an instruction set; returns the program.
    ///
    /// # Errors
    /// It does not compile.
    pub fn build(&self, set: &InstructionSet) -> Result<PathBuf, Box<dyn Error>> {
        let target = self.folder.join("target").join(set.processor);
        let flags = format!("-Awarnings -Ctarget-cpu={}{}", set.processor, set.flags);
        let built = Command::new("cargo")
            .args(["build", "--release", "--quiet", "--offline", "--target-dir"])
            .arg(&target)
            .current_dir(&self.folder)
            .env("RUSTFLAGS", flags)
            .status()?;
        match built.success() {
            true => Ok(target.join("release/in_lanes")),
            false => Err("the modules do not compile".into()),
        }
    }

    /// Changes the program, so that it is compiled again without what it depends on.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn touch(&self) -> std::io::Result<()> {
        let program = self.folder.join("src/main.rs");
        let text = fs::read_to_string(&program)?;
        fs::write(program, text + "\n")
    }
}

impl Drop for Package {
    fn drop(&mut self) {
        // Remains in the folder for temporary files are harmless.
        let _ = fs::remove_dir_all(&self.folder);
    }
}
