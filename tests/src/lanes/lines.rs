//! Runs programs that print a line for each result: its kind, names, and numbers.

use std::error::Error;
use std::process::Command;

/// Line: words, and the numbers after them.
#[derive(Clone, Debug)]
struct Line {
    words: Vec<String>,
    numbers: Vec<f64>,
    text: String,
}

/// Lines of a program.
#[derive(Clone, Debug)]
pub struct Lines(Vec<Line>);

impl Lines {
    /// Returns names and numbers of the lines of a kind. Several names are joined by a space.
    pub fn all(&self, kind: &str) -> impl Iterator<Item = (&str, &[f64])> {
        let lines = self.0.iter().filter(move |line| line.words[0] == kind);
        lines.map(|line| (line.text.as_str(), line.numbers.as_slice()))
    }

    /// Returns the first number of the line of a kind with this name.
    ///
    /// # Errors
    /// The line is missing, or it has no number.
    pub fn number(&self, kind: &str, name: &str) -> Result<f64, String> {
        let mut lines = self.all(kind).filter(|(text, _)| *text == name);
        let number = lines.next().and_then(|(_, numbers)| numbers.first());
        number
            .copied()
            .ok_or_else(|| format!("expected `{kind} {name}` with a number"))
    }
}

/// Runs a program and reads its lines.
///
/// # Errors
/// It cannot be run, fails, or prints an empty line.
pub fn of(command: &mut Command) -> Result<Lines, Box<dyn Error>> {
    let program = command.get_program().display().to_string();
    let output = command
        .output()
        .map_err(|error| format!("{program}: {error}"))?;
    if !output.status.success() {
        let text = String::from_utf8_lossy(&output.stderr);
        return Err(format!("{program} fails: {}", text.trim_end()).into());
    }
    let text = String::from_utf8(output.stdout)?;
    let lines = text.lines().map(|line| {
        let all: Vec<&str> = line.split_whitespace().collect();
        let is_number = |word: &&&str| word.parse::<f64>().is_err();
        let words: Vec<String> = all
            .iter()
            .take_while(is_number)
            .map(|word| word.to_string())
            .collect();
        let numbers = all[words.len()..].iter().map(|word| word.parse()).collect();
        match (words.split_first(), numbers) {
            (Some((_, names)), Ok(numbers)) => Ok(Line {
                text: names.join(" "),
                words,
                numbers,
            }),
            _ => Err(format!("{program} prints `{line}`").into()),
        }
    });
    lines
        .collect::<Result<Vec<Line>, Box<dyn Error>>>()
        .map(Lines)
}
