//! Times generated modules, alone and in lanes, for several instruction sets.

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use linkwright_codegen::{Options, Scalar, generate};

use super::Measured;
use crate::files;

/// Instruction sets: the name, and the processor that the compiler is told to compile for.
pub const SETS: [(&str, &str); 3] = [
    ("SSE2", "x86-64"),
    ("AVX2", "x86-64-v3"),
    ("AVX-512", "x86-64-v4"),
];

/// Times of one module for one instruction set (ns a pose).
#[derive(Clone, Copy, Debug)]
pub struct Times {
    /// One mechanism at a time.
    pub alone: f64,
    /// In lanes.
    pub lanes: f64,
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
    /// Writes the modules of all descriptions.
    ///
    /// # Errors
    /// A description has errors, or a file cannot be written.
    pub fn new(all: &[Measured]) -> Result<Package, Box<dyn Error>> {
        let folder = std::env::temp_dir().join(format!("linkwright-lanes-{}", std::process::id()));
        let source = folder.join("src");
        fs::create_dir_all(&source)?;
        let (mut modules, mut calls) = (String::new(), String::new());
        for it in all {
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

    /// Compiles the package for a processor and runs it; returns `None` if this machine does not have the instruction set.
    ///
    /// # Errors
    /// The package does not compile, or its program fails.
    pub fn measure(&self, processor: &str) -> Result<Option<Table>, Box<dyn Error>> {
        if !has(processor) {
            return Ok(None);
        }
        let target = self.folder.join("target").join(processor);
        let built = Command::new("cargo")
            .args(["build", "--release", "--quiet", "--offline", "--target-dir"])
            .arg(&target)
            .current_dir(&self.folder)
            .env("RUSTFLAGS", format!("-Awarnings -Ctarget-cpu={processor}"))
            .status()?;
        if !built.success() {
            return Err("the modules do not compile".into());
        }
        Ok(Some(times(&target.join("release/in_lanes"))?))
    }
}

impl Drop for Package {
    fn drop(&mut self) {
        // Remains in the folder for temporary files are harmless.
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// Runs the program and reads its lines: a name and two times.
fn times(program: &Path) -> Result<Table, Box<dyn Error>> {
    let output = Command::new(program).output()?;
    let text = String::from_utf8(output.stdout)?;
    if !output.status.success() {
        return Err(format!(
            "the program fails: {}",
            String::from_utf8_lossy(&output.stderr)
        )
        .into());
    }
    let mut table = Table::new();
    for line in text.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        let [name, alone, lanes] = words[..] else {
            return Err(format!("expected a name and two times, found `{line}`").into());
        };
        let (alone, lanes) = (alone.parse()?, lanes.parse()?);
        table.insert(name.to_string(), Times { alone, lanes });
    }
    Ok(table)
}

/// True if this machine runs code for the processor.
#[cfg(target_arch = "x86_64")]
fn has(processor: &str) -> bool {
    match processor {
        "x86-64-v4" => {
            std::is_x86_feature_detected!("avx512f") && std::is_x86_feature_detected!("avx512vl")
        }
        "x86-64-v3" => std::is_x86_feature_detected!("avx2"),
        _ => true,
    }
}

/// True if this machine runs code for the processor.
#[cfg(not(target_arch = "x86_64"))]
fn has(_processor: &str) -> bool {
    false
}
