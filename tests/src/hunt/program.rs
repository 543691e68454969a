//! Writes the `main.rs` of the package that runs generated modules: it reads tasks and prints answers.

use std::fmt::Write as _;

use super::motion::HUNTED;

/// Code of the package beside the generated modules, `values.rs` and `ways.rs`.
const PROGRAM: &str = r#"#[allow(dead_code)]
mod values;
mod ways;

use std::fmt::Write as _;

use linkwright::nalgebra::Const;
use linkwright::{Blocks, Equations, Mechanism, Settings};
use ways::{Answered, Task, solved, textbook};

/// All answers of a mechanism.
fn run<M, E, const N: usize>(task: &Task) -> Vec<Answered>
where
    M: Mechanism<Blocks: Default + Clone>,
    E: Equations<<M::Blocks as Blocks>::Scalar, Const<N>> + Default,
    Settings<<M::Blocks as Blocks>::Scalar>: Default,
{
    let mut answers = textbook(&E::default(), task);
    answers.extend(solved(&M::Blocks::default(), task));
    answers
}

/// The numbers of a line, each as its bits.
fn numbers(line: &str) -> Vec<f64> {
    let words = line.split_whitespace();
    words.map(|word| f64::from_bits(u64::from_str_radix(word, 16).expect("bits"))).collect()
}

/// A task, as the starting process writes it.
fn task<'a>(lines: &mut impl Iterator<Item = &'a str>) -> Option<Task> {
    let is_negative = lines.next()? == "negative";
    let mut line = || numbers(lines.next().expect("another line"));
    let (times, start) = (line(), line());
    let near = times.iter().map(|_| line()).collect();
    let scattered = times.iter().map(|_| line()).collect();
    Some(Task { times, start, near, scattered, is_negative })
}

fn print(answers: Vec<Answered>) {
    let mut text = String::new();
    for Answered { call, instant, answer } in answers {
        let _ = write!(text, "{} {instant}", call as usize);
        match answer {
            Ok(levels) => {
                for value in levels.iter().flatten() {
                    let _ = write!(text, " {:x}", value.to_bits());
                }
            }
            Err(kind) => {
                let _ = write!(text, " {kind}");
            }
        }
        text.push('\n');
    }
    print!("{text}\n");
}
"#;

/// Name of the module of a mechanism in a scalar.
pub fn module(index: usize, scalar: &str) -> String {
    format!("found_{index}_{scalar}")
}

/// `main.rs` for mechanisms; true for those with drivers in motions.
pub fn main(have_motions: &[bool]) -> String {
    let mut text = PROGRAM.to_string();
    let mut calls = String::new();
    for (index, has_motions) in have_motions.iter().enumerate() {
        for scalar in ["f64", "f32"] {
            let mut module = module(index, scalar);
            let _ = writeln!(text, "mod {module};");
            if *has_motions {
                let _ = write!(module, "::{HUNTED}");
            }
            let _ = writeln!(
                calls,
                "        run::<{module}::Found, {module}::Textbook, _>,"
            );
        }
    }
    let _ = write!(
        text,
        "\nfn main() {{
    let runs: [fn(&Task) -> Vec<Answered>; {}] = [\n{calls}    ];
    let path = std::env::args().nth(1).expect(\"the file of the tasks\");
    let tasks = std::fs::read_to_string(path).expect(\"the tasks\");
    let mut lines = tasks.lines();
    for pair in runs.chunks(2) {{
        let task = task(&mut lines).expect(\"a task\");
        pair.iter().for_each(|run| print(run(&task)));
    }}
}}\n",
        2 * have_motions.len()
    );
    text
}
