//! Reads the numbers of the frames and the measurements that a program prints.

use std::collections::BTreeMap;
use std::io;

use super::program::Scalar;

/// Instructions of calls of one kind, and the bytes of the stack below them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Number of calls.
    pub calls: u64,
    /// Instructions of all calls.
    pub total: u64,
    /// Instructions of the longest call.
    pub worst: u64,
    /// Depth of the stack, in bytes.
    pub stack: u64,
}

impl Work {
    /// Mean number of instructions of a call.
    pub fn mean(&self) -> f64 {
        self.total as f64 / self.calls.max(1) as f64
    }
}

/// Output of a program.
#[derive(Clone, Debug, Default)]
pub struct Printed {
    /// Lines with frames, digests and failures, which are equal on every machine.
    pub lines: Vec<String>,
    /// Bytes of the mechanism.
    pub state: u64,
    /// One call of `assemble`.
    pub assemble: Work,
    /// The frames of a loop.
    pub advance: Work,
    /// Steps too long for one attempt, and times that are NaN.
    pub long: Work,
}

impl Printed {
    /// Reads the output of one program.
    ///
    /// # Errors
    /// The output is incomplete, or not as expected.
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

    /// Reads the output of a program that moves several variants.
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

    /// Numbers of the frames that are printed in full: time, coordinates, rates, accelerations.
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

    /// First line that differs; `None` if all are equal.
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
