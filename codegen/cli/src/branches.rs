//! *A solved view and wishes like `phi2=other` → the pose that is assembled so.*
//!
//! The result is an estimate of all coordinates, from which the textbook view is assembled. The module reads the wishes and
//! passes them on block by block; it does not know how a mode is found, and does not follow the motion from there.

use linkwright::{Branch, FailureKind};
use linkwright_codegen::diagnostic::nearest;
use nalgebra::DVector;

use crate::solved_interpreter::{SolvedInterpreter, Sought};

/// The pose at time `t` (s) with every loop in its drawn mode, but for those that `wishes` name: `LOOP=positive`,
/// `LOOP=negative` or `LOOP=other`.
///
/// # Errors
/// A sentence where a wish cannot be read, names no loop, or cannot be met.
pub fn assembled(
    solved: &SolvedInterpreter,
    t: f64,
    wishes: &[String],
) -> Result<DVector<f64>, String> {
    let wishes = read(solved, wishes)?;
    let wish = |name: &str| {
        let found = wishes.iter().find(|(wanted, _)| wanted == name);
        found.map_or(Sought::Near, |(_, wish)| *wish)
    };
    let mut values = solved.begin(t);
    for block in 0..solved.block_count() {
        let signs: Vec<bool> = solved
            .branches(block)
            .iter()
            .map(|branch| match wish(&branch.name) {
                Sought::Near => branch.positive,
                Sought::Sign(sign) => sign == Branch::Positive,
                Sought::Other => !branch.positive,
            })
            .collect();
        let [name, spoken] = solved.block_names(block);
        solved
            .run_block(block, &signs, wish(name), &mut values)
            .map_err(|failure| match failure.kind {
                FailureKind::WrongBranch => {
                    format!("{spoken}: no pose of the mode that is wanted was found at t = {t}")
                }
                _ => format!("{spoken}: {}", failure.in_block(0)),
            })?;
    }
    Ok(solved.pose(&values))
}

/// The names of the loops that have more than one assembly mode, in solve order: closed forms, then blocks without one.
fn names(solved: &SolvedInterpreter) -> Vec<&str> {
    let blocks = || 0..solved.block_count();
    let closed = blocks().flat_map(|block| solved.branches(block));
    let iterated = blocks().filter(|&block| solved.is_iterated(block));
    closed
        .map(|branch| branch.name.as_str())
        .chain(iterated.map(|block| solved.block_names(block)[0]))
        .collect()
}

/// The wishes by the names of their loops.
fn read(solved: &SolvedInterpreter, wishes: &[String]) -> Result<Vec<(String, Sought)>, String> {
    let known = names(solved);
    let mut found: Vec<(String, Sought)> = Vec::new();
    for text in wishes {
        let Some((name, mode)) = text.split_once('=') else {
            return Err(format!(
                "`{text}` is not of the form LOOP=positive, LOOP=negative or LOOP=other"
            ));
        };
        if !known.contains(&name) {
            let list = match known.as_slice() {
                [] => "every loop can be assembled in one way only".to_string(),
                known => format!("the loops with several modes are: {}", known.join(", ")),
            };
            let guess = nearest(name, known.iter().copied())
                .map_or(String::new(), |guess| format!("; did you mean `{guess}`?"));
            return Err(format!("no loop is named `{name}`{guess}\n  {list}"));
        }
        let modes = ["positive", "negative", "other"];
        let wish = match mode {
            "positive" => Sought::Sign(Branch::Positive),
            "negative" => Sought::Sign(Branch::Negative),
            "other" => Sought::Other,
            _ => {
                let guess = nearest(mode, modes)
                    .map_or(String::new(), |guess| format!("; did you mean `{guess}`?"));
                return Err(format!(
                    "no assembly mode is named `{mode}`{guess}\n  the modes are: {}",
                    modes.join(", ")
                ));
            }
        };
        if found.iter().any(|(taken, _)| taken == name) {
            return Err(format!("the mode of `{name}` is chosen twice"));
        }
        found.push((name.to_string(), wish));
    }
    Ok(found)
}
