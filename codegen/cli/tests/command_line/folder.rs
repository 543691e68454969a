//! Folder for each test, and the command run in it.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The exam of the design: a crank of length 1 and a rod of length √3 whose end moves on x = √3.
pub const EXAM: &str = "\
//! ME 451 midterm, problem B.
mechanism two_body {
    body 1 at (0, 0, 30deg)      { P: (1, 0) }
    body 2 at (1.7, 2, 1)        { P: (-sqrt(3), 0), Q: (-sqrt(3)/2, 0) }
    absolute_x(1) = 0;
    absolute_y(1) = 0;
    revolute P(1, 2);
    absolute_x(2) = sqrt(3);
    drive phi(1) = pi/6 + sin(2*t);
}
";

/// The exam with another driver.
pub fn driven_by(expression: &str) -> String {
    let text = EXAM.replace("pi/6 + sin(2*t)", expression);
    assert_ne!(text, EXAM, "the driver is replaced");
    text
}

/// Folder that is removed at the end.
pub struct Folder(PathBuf);

impl Folder {
    /// Creates the folder of the test `name`, with `text` as `a.mech`.
    pub fn new(name: &str, text: impl AsRef<[u8]>) -> Folder {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).expect("the test's folder can be made");
        std::fs::write(path.join("a.mech"), text).expect("the description can be written");
        Folder(path)
    }

    /// Path of a file in the folder.
    pub fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// Text of a file in the folder.
    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.file(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Contents of the folder, sorted.
    pub fn list(&self, name: &str) -> Vec<String> {
        let entries = std::fs::read_dir(self.file(name)).expect("the folder exists");
        let name = |entry: std::io::Result<std::fs::DirEntry>| {
            entry
                .expect("it can be read")
                .file_name()
                .to_string_lossy()
                .into_owned()
        };
        let mut names: Vec<String> = entries.map(name).collect();
        names.sort();
        names
    }

    /// Command that runs in the folder.
    pub fn command(&self) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_linkwright"));
        command.current_dir(&self.0);
        command
    }

    /// Runs the command with arguments separated by spaces.
    pub fn run(&self, arguments: &str) -> Ran {
        let mut command = self.command();
        Ran::from(
            command
                .args(arguments.split_whitespace())
                .output()
                .expect("the command starts"),
        )
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Result of a run.
#[derive(Debug)]
pub struct Ran {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl From<Output> for Ran {
    fn from(output: Output) -> Ran {
        let text = |bytes| String::from_utf8(bytes).expect("output is UTF-8");
        Ran {
            code: output.status.code(),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }
}

impl Ran {
    /// Requires the exit code.
    pub fn exits_with(self, code: i32) -> Ran {
        assert_eq!(self.code, Some(code), "{self:#?}");
        self
    }
}
