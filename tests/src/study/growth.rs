//! *A number of dyads* → *what it costs*: time of the generator, size of the Rust, time of the compiler, time per frame.
//!
//! The generated module is compiled in a package of its own outside the repository, so that the compiler's time is that of
//! this module alone; its dependencies are built before.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use linkwright_codegen::diagnostic::Source;

use crate::{dyad_chain, files};

/// What a chain of some size costs; `None` for what took longer than the limit or did not run.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// The number of dyads.
    pub dyads: usize,
    /// The fastest run of the generator (s).
    pub generator: f64,
    /// The size of the generated Rust (bytes).
    pub bytes: usize,
    /// The time of `cargo build --release` for the module and a main function (s).
    pub compiler: Option<f64>,
    /// The time per frame (ns), the mean over a second or 500 frames.
    pub frame: Option<f64>,
}

/// Generates a chain: the fastest time (s) of several runs, and the code.
///
/// # Panics
/// If the description has errors.
pub fn generate(dyads: usize) -> (f64, String) {
    const ENOUGH: Duration = Duration::from_millis(300);
    let source = Source::new("dyad_chain.mech", dyad_chain::description(dyads));
    let begin = Instant::now();
    let mut fastest = f64::INFINITY;
    loop {
        let start = Instant::now();
        let generated = linkwright_codegen::generate(&source)
            .unwrap_or_else(|errors| panic!("{}", errors.render(&source)));
        fastest = fastest.min(start.elapsed().as_secs_f64());
        if begin.elapsed() > ENOUGH {
            return (fastest, generated.code);
        }
    }
}

/// A package outside the repository with a generated module and a main function that times it.
pub struct Scratch {
    folder: PathBuf,
}

/// Advances the chain for at most a second and prints the frames and the seconds they took. Frames of large chains are large,
/// and lie on the stack.
const MAIN: &str = r#"mod dyad_chain;

use std::hint::black_box;
use std::time::Instant;

use dyad_chain::DyadChain;

fn main() {
    let thread = std::thread::Builder::new().stack_size(256 << 20).spawn(run);
    thread.unwrap().join().unwrap();
}

fn run() {
    let mut chain = DyadChain::assemble(0.0).unwrap();
    let start = Instant::now();
    let mut frames = 0;
    while frames < 500 && start.elapsed().as_secs_f64() < 1.0 {
        frames += 1;
        black_box(chain.advance(f64::from(frames) / 100.0).unwrap());
    }
    println!("{frames} {}", start.elapsed().as_secs_f64());
}
"#;

impl Scratch {
    /// Creates the package and builds its dependencies.
    ///
    /// # Errors
    /// If a file cannot be written or the dependencies cannot be built.
    pub fn new() -> io::Result<Scratch> {
        let folder = std::env::temp_dir().join(format!("linkwright-growth-{}", std::process::id()));
        fs::create_dir_all(folder.join("src"))?;
        let runtime = files::repository().join("runtime");
        let manifest = format!(
            "[package]\nname = \"growth\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[workspace]\n\n[dependencies]\nlinkwright = {{ path = {:?}, features = [\"std\"] }}\n",
            runtime
        );
        fs::write(folder.join("Cargo.toml"), manifest)?;
        fs::copy(
            files::repository().join("Cargo.lock"),
            folder.join("Cargo.lock"),
        )?;
        fs::write(folder.join("src/main.rs"), "fn main() {}\n")?;
        let scratch = Scratch { folder };
        match scratch.build(Duration::from_secs(600))? {
            Some(_) => Ok(scratch),
            None => Err(io::Error::other("the dependencies cannot be built")),
        }
    }

    /// The compiler's time (s) and the time per frame (ns) of a generated chain.
    ///
    /// # Errors
    /// If a file cannot be written or a process cannot be started.
    pub fn measure(&self, code: &str, limit: Duration) -> io::Result<(Option<f64>, Option<f64>)> {
        fs::write(self.folder.join("src/dyad_chain.rs"), code)?;
        fs::write(self.folder.join("src/main.rs"), MAIN)?;
        let compiler = self.build(limit)?;
        let frame = if compiler.is_some() {
            self.run(limit)?
        } else {
            None
        };
        Ok((compiler, frame))
    }

    fn build(&self, limit: Duration) -> io::Result<Option<f64>> {
        let mut command = Command::new("cargo");
        command
            .args(["build", "--release", "--quiet", "--target-dir"])
            .arg(self.folder.join("target"))
            .current_dir(&self.folder);
        let start = Instant::now();
        let output = within(&mut command, &self.folder.join("output"), limit)?;
        Ok(output.map(|_| start.elapsed().as_secs_f64()))
    }

    fn run(&self, limit: Duration) -> io::Result<Option<f64>> {
        let mut command = Command::new(self.folder.join("target/release/growth"));
        let output = within(&mut command, &self.folder.join("output"), limit)?;
        let numbers = output.and_then(|text| {
            let (frames, seconds) = text.trim().split_once(' ')?;
            Some((frames.parse::<f64>().ok()?, seconds.parse::<f64>().ok()?))
        });
        Ok(numbers.map(|(frames, seconds)| seconds * 1e9 / frames))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // What is left in the folder for temporary files does no harm.
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// What a process prints; `None` if it fails, or does not end within the limit and is ended.
fn within(command: &mut Command, file: &Path, limit: Duration) -> io::Result<Option<String>> {
    let output = fs::File::create(file)?;
    let mut child = command
        .stdin(Stdio::null())
        .stdout(output)
        .stderr(Stdio::inherit())
        .spawn()?;
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            let text = fs::read_to_string(file)?;
            return Ok(status.success().then_some(text));
        }
        if start.elapsed() > limit {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}
