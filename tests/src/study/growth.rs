//! Measures the cost of chains of dyads: time of the generator, size of the Rust, time of the compiler, time per
//! frame.
//!
//! The generated module is compiled in a package of its own outside the repository, so that the compiler's time is
//! that of this module alone; its dependencies are built before.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use linkwright_codegen::Options;
use linkwright_codegen::diagnostic::Source;

use crate::files;

/// Cost of a chain; `None` for a value over the limit or without a run.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// Number of dyads.
    pub dyads: usize,
    /// Fastest run of the generator (s).
    pub generator: f64,
    /// Size of the generated Rust (bytes).
    pub bytes: usize,
    /// Time of `cargo build --release` for the module and a main function (s).
    pub compiler: Option<f64>,
    /// Times of frames in steps of 1 ms and of 10 ms.
    pub guarded: Option<[Frames; 2]>,
    /// Times of frames without the path guard.
    pub unguarded: Option<[Frames; 2]>,
}

/// Times of the frames of one motion (ns).
#[derive(Clone, Copy, Debug)]
pub struct Frames {
    /// Mean.
    pub mean: f64,
    /// Longest.
    pub worst: f64,
}

impl Frames {
    /// Reads both numbers of one line.
    fn of(line: &str) -> Option<Frames> {
        let (mean, worst) = line.split_once(' ')?;
        Some(Frames {
            mean: mean.parse().ok()?,
            worst: worst.parse().ok()?,
        })
    }
}

/// Generates a chain: the fastest time (s) of several runs, and the code.
///
/// # Panics
/// If the description has errors.
pub fn generate(description: String) -> (f64, String) {
    const ENOUGH: Duration = Duration::from_millis(300);
    let source = Source::new("dyad_chain.mech", description);
    let begin = Instant::now();
    let mut fastest = f64::INFINITY;
    loop {
        let start = Instant::now();
        let generated = linkwright_codegen::generate(&source, &Options::default())
            .unwrap_or_else(|errors| panic!("{}", errors.render(&source)));
        fastest = fastest.min(start.elapsed().as_secs_f64());
        if begin.elapsed() > ENOUGH {
            return (fastest, generated.code().to_string());
        }
    }
}

/// Package outside the repository with a generated module and a main function that times it.
pub struct Scratch {
    folder: PathBuf,
}

/// Program that advances the chain for 5 s in steps of 1 ms and of 10 ms, and prints the mean and the longest time of
/// a frame for each. The fastest of three runs of each frame counts, which excludes other work of the machine. Frames
/// of large chains are large, and lie on the stack.
const MAIN: &str = r#"mod dyad_chain;

use std::hint::black_box;
use std::time::Instant;

use dyad_chain::DyadChain;

fn main() {
    let thread = std::thread::Builder::new().stack_size(256 << 20).spawn(run);
    thread.unwrap().join().unwrap();
}

fn run() {
    for (step, count) in [(0.001, 5000), (0.01, 500)] {
        let mut fastest = vec![f64::INFINITY; count];
        for _ in 0..3 {
            let mut chain = DyadChain::assemble(0.0).unwrap();
            for (place, fastest) in fastest.iter_mut().enumerate() {
                let t = (place + 1) as f64 * step;
                let start = Instant::now();
                black_box(chain.advance(black_box(t)).unwrap());
                *fastest = fastest.min(start.elapsed().as_secs_f64() * 1e9);
            }
        }
        let mean = fastest.iter().sum::<f64>() / count as f64;
        let worst = fastest.iter().copied().fold(0.0, f64::max);
        println!("{mean} {worst}");
    }
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

    /// Time of the compiler (s) and times of frames of a generated chain in steps of 1 ms and of 10 ms.
    ///
    /// # Errors
    /// If a file cannot be written or a process cannot be started.
    pub fn measure(
        &self,
        code: &str,
        limit: Duration,
    ) -> io::Result<(Option<f64>, Option<[Frames; 2]>)> {
        fs::write(self.folder.join("src/dyad_chain.rs"), code)?;
        fs::write(self.folder.join("src/main.rs"), MAIN)?;
        let compiler = self.build(limit)?;
        let frames = if compiler.is_some() {
            self.run(limit)?
        } else {
            None
        };
        Ok((compiler, frames))
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

    fn run(&self, limit: Duration) -> io::Result<Option<[Frames; 2]>> {
        let mut command = Command::new(self.folder.join("target/release/growth"));
        let output = within(&mut command, &self.folder.join("output"), limit)?;
        Ok(output.and_then(|text| {
            let (first, second) = text.trim().split_once('\n')?;
            Some([Frames::of(first)?, Frames::of(second)?])
        }))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // Remains in the folder for temporary files are harmless.
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// Output of a process; `None` if the process fails, or exceeds the limit and is killed.
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
