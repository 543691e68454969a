//! Writes the results of `check` as text.

use std::io::{self, Write};

use linkwright_solver::checked_part::CheckedPart;
use linkwright_solver::every_pose::Undecided;
use linkwright_solver::number::{fixed, scientific, time};
use linkwright_solver::search::STARTS;
use linkwright_solver::warnings::times;
use linkwright_solver::{Check, View};

use crate::assembly_table;
use crate::losses;
use crate::measured;
use crate::motors;
use crate::units::{enclosing, si_of};

/// Largest number of listed assemblies.
const MAX_LISTED: usize = 64;

/// Part of the candidate volume that must be decided before the list of assemblies is called complete.
const PROVEN: f64 = 0.999;

/// Largest number of listed undecided ranges.
const MAX_LISTED_PARTS: usize = 8;

/// Writes all results; no line of a table is wider than `width`.
///
/// # Errors
/// Errors of `output`.
pub fn write(check: &Check, width: usize, output: &mut dyn Write) -> io::Result<()> {
    writeln!(output, "{}", check.interpreted.system().mechanism.title())?;
    let coordinates = check.interpreted.system().coordinates.len() as i64;
    let (kinematic, net) = (check.kinematic_freedom, check.net_freedom);
    writeln!(
        output,
        "degrees of freedom: KDOF = {coordinates} - {} = {kinematic} (coordinates less equations of joints), \
         NDOF = {kinematic} - {} = {net} (less equations of drivers)",
        coordinates - kinematic,
        kinematic - net
    )?;
    blocks(check, output)?;
    if check.is_refused {
        return Ok(());
    }
    assemblies(check, width, output)?;
    approaches(check, output)?;
    measured::write(check, output)?;
    let units = check.interpreted.system().mechanism.units.of_tables();
    motors::write(&check.measured.motors, |_| None, &units, output)?;
    losses::write(check.losses.as_ref(), output)
}

fn blocks(check: &Check, output: &mut dyn Write) -> io::Result<()> {
    writeln!(output, "\nblocks, with their determinants up to the sign")?;
    if check.parts.is_empty() {
        return writeln!(output, "  everything is explicit: no pose is singular");
    }
    for part in &check.parts {
        let pose = &part.pose;
        let modes = match part.solutions {
            Some(1) => "one solution".to_string(),
            Some(count) => format!("{count} solutions"),
            None if check.assemblies.are_all() => "solutions as listed below".to_string(),
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

fn assemblies(check: &Check, width: usize, output: &mut dyn Write) -> io::Result<()> {
    let all = &check.assemblies;
    let start = time(check.start);
    let combinations = 2_f64.powi(all.modes.min(1000) as i32);
    let signs = format!(
        "of 2^{} = {combinations} that the signs of closed forms allow",
        all.modes
    );
    // A proof replaces the count of starting values.
    let is_proven = all.iterated > 0 && all.decided >= PROVEN;
    let starts = format!("{STARTS} starts at random find for each block without a closed form");
    let allowed = match (all.modes, all.iterated) {
        _ if is_proven && all.are_all() => "; these are all".to_string(),
        _ if is_proven => "; no others except where it is undecided".to_string(),
        (_, 0) => signs,
        (0, _) => format!("that {starts}"),
        _ => format!("{signs}, times what {starts}"),
    };
    if all.iterated > 0 && all.found.is_empty() && all.are_all() {
        return writeln!(
            output,
            "\nassemblies at t = {start} s: none, which is proven"
        );
    }
    writeln!(
        output,
        "\nassemblies at t = {start} s: {}{}{}{allowed}",
        match all.cut_short || all.iterated > 0 && !is_proven {
            true => "at least ",
            false => "",
        },
        all.found.len(),
        if is_proven { "" } else { " " },
    )?;
    if all.iterated > 0 && all.proven {
        undecided(check, output)?;
    }
    let listed = &all.found[..all.found.len().min(MAX_LISTED)];
    assembly_table::write(&check.interpreted, listed, width, output)?;
    match all.found.len().saturating_sub(MAX_LISTED) {
        0 => Ok(()),
        more => writeln!(output, "  and {more} more"),
    }
}

/// Writes the ranges in which existence of assemblies is undecided.
fn undecided(check: &Check, output: &mut dyn Write) -> io::Result<()> {
    let all = &check.assemblies;
    if all.decided < PROVEN {
        let percent = 100.0 * all.decided;
        writeln!(
            output,
            "  no others in {percent:.1} % of the possible poses; undecided are:"
        )?;
    }
    let units = check.interpreted.system().mechanism.units.of_tables();
    for Undecided(ranges) in all.undecided.iter().take(MAX_LISTED_PARTS) {
        let ranges = ranges.iter().map(|(unknown, [low, high])| {
            let system = check.interpreted.system();
            let unit = units.of(si_of(system.vector_form.unknowns[*unknown].quantity));
            let [low, high] = enclosing(&unit, [*low, *high]);
            let name = system.unknown_name(*unknown);
            let high = unit.labeled(format_args!("{high:.9}"));
            format!("{name} from {low:.9} to {high}")
        });
        let ranges: Vec<String> = ranges.collect();
        writeln!(output, "  undecided: {}", ranges.join(" with "))?;
    }
    match all.undecided.len().saturating_sub(MAX_LISTED_PARTS) {
        0 => Ok(()),
        more => writeln!(output, "  and {more} more parts"),
    }
}

fn approaches(check: &Check, output: &mut dyn Write) -> io::Result<()> {
    let measured: Vec<&CheckedPart> = check
        .parts
        .iter()
        .filter(|it| it.approach.is_some())
        .collect();
    let Some([first, last]) = check.range.filter(|_| !measured.is_empty()) else {
        return Ok(());
    };
    writeln!(
        output,
        "\nclosest to singular from t = {} s to {} s (0: singular, 1: as far from singular as possible)",
        time(first),
        time(last)
    )?;
    let closest = check.closest().map(|it| (it.pose.block, it.pose.part));
    for part in measured {
        if let Some(approach) = &part.approach {
            let mark = match closest == Some((part.pose.block, part.pose.part)) {
                true => "*",
                false => " ",
            };
            let end = if approach.at_end {
                ", an end of the range"
            } else {
                ""
            };
            let times = times(approach.times);
            let reciprocal = part.reciprocal.map_or(String::new(), |it| {
                format!("; reciprocal condition of Φ_q {}", scientific(it, 2))
            });
            writeln!(
                output,
                "{mark} block {}, {}: {} at t = {} s{end}{times}{reciprocal}",
                part.pose.block + 1,
                part.pose.unknowns,
                fixed(approach.measure, 9),
                time(approach.instant.t()),
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
