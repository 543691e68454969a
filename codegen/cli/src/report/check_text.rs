//! *Check → what a person reads.*

use std::io::{self, Write};

use crate::check::{Check, CheckedStep};
use crate::diagnosis::time;
use crate::number::{fixed, scientific};
use crate::solved_interpreter::STARTS;

/// How many assemblies are listed.
const LISTED: usize = 64;

/// How many angles a line of the table shows.
const ANGLES: usize = 8;

/// Writes everything that was checked.
///
/// # Errors
/// Those of `output`.
pub fn write(check: &Check, output: &mut dyn Write) -> io::Result<()> {
    writeln!(output, "{}", check.solution.title())?;
    let coordinates = check.solution.system.coordinates.len() as i64;
    let (kinematic, net) = (check.kinematic_freedom, check.net_freedom);
    writeln!(
        output,
        "degrees of freedom: KDOF = {coordinates} - {} = {kinematic} (coordinates less equations of joints), \
         NDOF = {kinematic} - {} = {net} (less equations of drivers)",
        coordinates - kinematic,
        kinematic - net
    )?;
    blocks(check, output)?;
    assemblies(check, output)?;
    approaches(check, output)
}

fn blocks(check: &Check, output: &mut dyn Write) -> io::Result<()> {
    writeln!(output, "\nblocks, with their determinants up to the sign")?;
    if check.steps.is_empty() {
        return writeln!(output, "  everything is explicit: no pose is singular");
    }
    for step in &check.steps {
        let pose = &step.pose;
        let modes = match step.solutions {
            Some(1) => "one solution".to_string(),
            Some(count) => format!("{count} solutions"),
            None => "number of solutions unknown".to_string(),
        };
        writeln!(
            output,
            "  block {}, {}: {}, {modes}; {}",
            pose.block + 1,
            pose.unknowns,
            pose.method,
            pose.sentence()
        )?;
    }
    Ok(())
}

fn assemblies(check: &Check, output: &mut dyn Write) -> io::Result<()> {
    let Some(all) = &check.assemblies else {
        return Ok(());
    };
    let start = match &check.solution.trajectory.start {
        Some(frame) => time(frame.t),
        None => "the start".to_string(),
    };
    let combinations = 2_f64.powi(all.modes.min(1000) as i32);
    let signs = format!(
        "of 2^{} = {combinations} that the signs of closed forms allow",
        all.modes
    );
    let starts = format!("{STARTS} starts at random find for each block without a closed form");
    let allowed = match (all.modes, all.iterated) {
        (_, 0) => signs,
        (0, _) => format!("that {starts}"),
        _ => format!("{signs}, times what {starts}"),
    };
    writeln!(
        output,
        "\nassemblies at t = {start} s: {}{} {allowed}",
        match all.cut_short || all.iterated > 0 {
            true => "at least ",
            false => "",
        },
        all.found.len(),
    )?;
    let system = &check.solution.system;
    let angles: Vec<usize> = (0..system.coordinates.len())
        .filter(|&place| system.coordinates[place].name.starts_with("phi"))
        .take(ANGLES)
        .collect();
    let names: String = angles
        .iter()
        .map(|&place| format!("  {:>12}", system.coordinates[place].name))
        .collect();
    if !all.found.is_empty() {
        writeln!(
            output,
            "  signs{:width$}{names}",
            "",
            width = signs_width(all.modes + all.iterated)
        )?;
    }
    for assembly in all.found.iter().take(LISTED) {
        let signs = assembly.label();
        let values: String = angles
            .iter()
            .map(|&place| {
                let degrees = assembly.frame.q[place].to_degrees();
                format!("  {:>11}°", fixed(degrees, 4))
            })
            .collect();
        let drawn = if assembly.drawn { "  as drawn" } else { "" };
        let width = 5 + signs_width(all.modes + all.iterated);
        writeln!(output, "  {signs:width$}{values}{drawn}")?;
    }
    match all.found.len().saturating_sub(LISTED) {
        0 => Ok(()),
        more => writeln!(output, "  and {more} more"),
    }
}

/// How much wider than its heading the column of signs and letters is.
fn signs_width(characters: usize) -> usize {
    characters.saturating_sub(5)
}

fn approaches(check: &Check, output: &mut dyn Write) -> io::Result<()> {
    let measured: Vec<&CheckedStep> = check
        .steps
        .iter()
        .filter(|it| it.approach.is_some())
        .collect();
    let (Some(first), Some(last)) = (
        check.solution.frames().first(),
        check.solution.frames().last(),
    ) else {
        return Ok(());
    };
    if measured.is_empty() {
        return Ok(());
    }
    writeln!(
        output,
        "\nclosest to singular from t = {} s to {} s (0 is singular, 1 as far from it as can be)",
        time(first.t),
        time(last.t)
    )?;
    let closest = check.closest().map(|it| (it.pose.block, it.pose.step));
    for step in measured {
        if let Some(approach) = &step.approach {
            let mark = match closest == Some((step.pose.block, step.pose.step)) {
                true => "*",
                false => " ",
            };
            let end = if approach.at_end {
                ", an end of the range"
            } else {
                ""
            };
            let times = match approach.times {
                1 => String::new(),
                2 => ", and once more".to_string(),
                count => format!(", and {} more times", count - 1),
            };
            let reciprocal = step.reciprocal.map_or(String::new(), |it| {
                format!("; reciprocal condition of Φ_q {}", scientific(it, 2))
            });
            writeln!(
                output,
                "{mark} block {}, {}: {} at t = {} s{end}{times}{reciprocal}",
                step.pose.block + 1,
                step.pose.unknowns,
                fixed(approach.measure, 9),
                time(approach.t),
            )?;
        }
    }
    match check.closest().and_then(|it| it.pose.meaning.as_ref()) {
        Some(meaning) => writeln!(
            output,
            "* is the closest of all; it would be singular where {meaning}"
        ),
        None => Ok(()),
    }
}
