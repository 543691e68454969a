//! The committed figures of all programs, which a change may exceed by a twentieth.

use std::collections::BTreeMap;
use std::fs;
use std::io;

use crate::files;

/// How much more than what is committed is still let pass.
const TOLERANCE: f64 = 1.05;

/// Where they are.
const FILE: &str = "embedded/limits.csv";

/// Figures by program and by what was measured.
pub type Figures = BTreeMap<(String, &'static str), u64>;

/// Writes the figures of today.
///
/// # Errors
/// The file cannot be written.
pub fn write(figures: &Figures) -> io::Result<()> {
    let mut text = "program,figure,value\n".to_string();
    for ((program, figure), value) in figures {
        text += &format!("{program},{figure},{value}\n");
    }
    fs::write(files::package(FILE), text)
}

/// What exceeds the figures that are committed, or has none, or has gone.
///
/// # Errors
/// The file cannot be read.
pub fn exceeded(figures: &Figures) -> io::Result<Vec<String>> {
    let text = fs::read_to_string(files::package(FILE))?;
    let mut committed: BTreeMap<(&str, &str), u64> = BTreeMap::new();
    for line in text.lines().skip(1) {
        let mut words = line.split(',');
        let (Some(program), Some(figure), Some(value)) = (words.next(), words.next(), words.next())
        else {
            return Err(io::Error::other(format!("{FILE}: `{line}`")));
        };
        let value = value
            .parse()
            .map_err(|_| io::Error::other(format!("{FILE}: `{line}`")))?;
        committed.insert((program, figure), value);
    }
    let mut found = Vec::new();
    for ((program, figure), value) in figures {
        match committed.remove(&(program.as_str(), *figure)) {
            None => found.push(format!(
                "{program}, {figure}: {value}, for which no limit is committed"
            )),
            Some(limit) if *value as f64 > limit as f64 * TOLERANCE => {
                found.push(format!(
                    "{program}, {figure}: {value}, more than 5 % above {limit}"
                ));
            }
            Some(_) => {}
        }
    }
    found.extend(
        committed
            .keys()
            .map(|(program, figure)| format!("{program}, {figure}: not measured any more")),
    );
    Ok(found)
}
