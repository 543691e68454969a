//! *What a program prints* → *the numbers of its frames, and what was measured*.

use std::collections::BTreeMap;
use std::io;

use super::program::Scalar;

/// The instructions of calls of one kind, and the bytes of the stack below them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// How many calls.
    pub calls: u64,
    /// The instructions of all.
    pub total: u64,
    /// The instructions of the longest.
    pub worst: u64,
    /// How far the stack went.
    pub stack: u64,
}

impl Work {
    /// The instructions of a call.
    pub fn mean(&self) -> f64 {
        self.total as f64 / self.calls.max(1) as f64
    }
}

/// What a program has printed.
#[derive(Clone, Debug, Default)]
pub struct Printed {
    /// The lines with frames, digests and failures, which are the same on every machine.
    pub lines: Vec<String>,
    /// The bytes of the mechanism.
    pub state: u64,
    /// One call of `assemble`.
    pub assemble: Work,
    /// The frames of a loop.
    pub advance: Work,
    /// Steps that are too long for one attempt, and times that are none.
    pub long: Work,
}

impl Printed {
    /// Reads what one program has printed.
    ///
    /// # Errors
    /// It has not come to its end, or prints what it should not.
    pub fn read(text: &str) -> io::Result<Self> {
        let mut printed = Printed::default();
        for line in text.lines() {
            if line.starts_with("variant ") {
                continue;
            }
            let Some(measured) = line.strip_prefix("measured ") else {
                printed.lines.push(line.to_string());
                continue;
            };
            let (what, numbers) = measured.split_once(' ').unwrap_or((measured, ""));
            let numbers: Result<Vec<u64>, _> = numbers
                .split(' ')
                .map(|word| u64::from_str_radix(word, 16))
                .collect();
            let numbers = numbers.map_err(|_| io::Error::other(format!("`{line}`")))?;
            match (what, numbers.as_slice()) {
                ("state", &[state]) => printed.state = state,
                ("assemble", &[total, stack]) => {
                    printed.assemble = Work {
                        calls: 1,
                        total,
                        worst: total,
                        stack,
                    };
                }
                ("advance", &[calls, total, worst, stack]) => {
                    printed.advance = Work {
                        calls,
                        total,
                        worst,
                        stack,
                    };
                }
                ("long", &[calls, total, worst, stack]) => {
                    printed.long = Work {
                        calls,
                        total,
                        worst,
                        stack,
                    };
                }
                _ => return Err(io::Error::other(format!("`{line}`"))),
            }
        }
        if printed.long.calls == 0 {
            let last = printed.lines.last().cloned().unwrap_or_default();
            return Err(io::Error::other(format!(
                "the program has ended after `{last}`"
            )));
        }
        Ok(printed)
    }

    /// The same of a program that moves several variants.
    ///
    /// # Errors
    /// Those of [`Printed::read`].
    pub fn read_all(text: &str) -> io::Result<BTreeMap<String, Self>> {
        let parts = text.split("variant ").skip(1);
        let parts = parts.map(|part| {
            let (variant, lines) = part.split_once('\n').unwrap_or((part, ""));
            let printed = Self::read(lines)
                .map_err(|error| io::Error::other(format!("{variant}: {error}")))?;
            Ok((variant.to_string(), printed))
        });
        parts.collect()
    }

    /// The numbers of the frames that are printed as they are: time, coordinates, rates, accelerations.
    pub fn frames(&self, scalar: Scalar) -> Vec<Vec<f64>> {
        let value = |word: &str| {
            let bits = u64::from_str_radix(word, 16).unwrap_or(u64::MAX);
            match scalar {
                Scalar::F32 => f32::from_bits(bits as u32).into(),
                Scalar::F64 => f64::from_bits(bits),
            }
        };
        let frames = self
            .lines
            .iter()
            .filter_map(|line| line.strip_prefix("frame "));
        frames
            .map(|line| line.split(' ').map(value).collect())
            .collect()
    }

    /// The first line that is not the same, if any.
    pub fn difference(&self, other: &Self) -> Option<String> {
        if self.lines.len() != other.lines.len() {
            return Some(format!(
                "{} lines, not {}",
                self.lines.len(),
                other.lines.len()
            ));
        }
        let mut both = self.lines.iter().zip(&other.lines);
        let (first, second) = both.find(|(first, second)| first != second)?;
        Some(format!("`{first}`, not `{second}`"))
    }
}
