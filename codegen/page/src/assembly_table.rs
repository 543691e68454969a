//! Writes a table of assemblies: the unknowns of each block, with the signs and letters that select its pose.
//!
//! Blocks stand side by side in solve order if the width allows; the others follow below.

use std::io::{self, Write};

use linkwright_codegen::stages::emit::text::shown_width;
use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::system::{Described, System};
use linkwright_solver::number::fixed;
use linkwright_solver::{Assembly, Interpreted, View};

use crate::units::text_of;

/// Decimals of an angle in degrees, and of any other unknown.
const DECIMALS_OF_ANGLES: usize = 4;
const DECIMALS: usize = 6;

/// Mark behind the assembly of the design configuration.
const DRAWN: &str = "  as drawn";

/// Columns of one block.
struct Group {
    heading: String,
    /// Columns, the signs first if there are any.
    columns: Vec<Column>,
}

struct Column {
    name: String,
    cells: Vec<String>,
    /// True if the column holds a sign, which stands on the line of the next column.
    is_sign: bool,
}

impl Column {
    fn width(&self) -> usize {
        let texts = self.cells.iter().chain([&self.name]);
        texts.map(|it| shown_width(it)).max().unwrap_or(0)
    }
}

/// Writes the table. No line is wider than `width`, unless a single column is.
///
/// # Errors
/// Errors of `output`.
pub fn write(
    interpreted: &Interpreted,
    assemblies: &[Assembly],
    width: usize,
    output: &mut dyn Write,
) -> io::Result<()> {
    let Some(first) = assemblies.first() else {
        return Ok(());
    };
    let (system, plan) = (interpreted.system(), interpreted.plan());
    let mut groups = Vec::new();
    let mut explicit = Vec::new();
    for (place, block) in plan.blocks.iter().enumerate() {
        let unknowns = unknowns(interpreted, place);
        if block.parts.is_empty() {
            let values = unknowns.iter().filter_map(|&unknown| {
                let value = value(interpreted, first, unknown)?;
                Some(format!("{} {value}", name(system, unknown)))
            });
            explicit.extend(values);
        } else {
            groups.push(group(interpreted, assemblies, place, &unknowns));
        }
    }
    if !explicit.is_empty() {
        writeln!(output, "  explicit: {}", explicit.join(", "))?;
    }
    tables(assemblies, &groups, width, output)
}

/// Returns the unknowns of interest in a block: those that its subsystems are solved for, then the angles that follow.
fn unknowns(interpreted: &Interpreted, block: usize) -> Vec<usize> {
    let (system, block) = (interpreted.system(), &interpreted.plan().blocks[block]);
    let solved = block.parts.iter().flat_map(|part| &part.unknowns).copied();
    let follows = |unknown: &usize| match system.vector_form.unknowns[*unknown].describes {
        Described::Pose { axis, .. } => axis == 2,
        Described::Contact { .. } => true,
        Described::Auxiliary => false,
    };
    let defined = block.definitions.iter().map(|it| it.unknown);
    solved.chain(defined.filter(follows)).collect()
}

fn name(system: &System, unknown: usize) -> &str {
    &system.vector_form.unknowns[unknown].name
}

/// Returns an unknown with its unit; `None` if instants do not keep the unknown.
fn value(interpreted: &Interpreted, assembly: &Assembly, unknown: usize) -> Option<String> {
    let unknown = &interpreted.system().vector_form.unknowns[unknown];
    let slot = interpreted.layout().slot(unknown.position)?;
    let value = assembly.instant.values()[slot];
    let units = interpreted.system().mechanism.units.of_tables().or("deg");
    Some(match unknown.quantity {
        Quantity::Angle => text_of(value, &units.of("rad"), DECIMALS_OF_ANGLES),
        Quantity::Length => text_of(value, &units.of("m"), DECIMALS),
        Quantity::Power(_) => fixed(value, DECIMALS),
    })
}

fn group(
    interpreted: &Interpreted,
    assemblies: &[Assembly],
    block: usize,
    unknowns: &[usize],
) -> Group {
    let program = interpreted.program();
    let signs = program.branches.iter().map(|it| Some(it.block));
    let iterated = program.blocks.iter().filter(|it| it.newton.is_some());
    // Owners are in the order of the labels.
    let owners: Vec<Option<usize>> = signs.chain(iterated.map(|it| it.place)).collect();
    let row = |assembly: &Assembly| {
        let label = assembly.label();
        let letters = label.chars().zip(&owners);
        let letters = letters.filter(|(_, owner)| **owner == Some(block));
        letters.map(|(letter, _)| letter).collect::<String>()
    };
    let signs = Column {
        name: String::new(),
        cells: assemblies.iter().map(row).collect(),
        is_sign: true,
    };
    let values = unknowns.iter().filter_map(|&unknown| {
        let cells = assemblies.iter().map(|it| value(interpreted, it, unknown));
        Some(Column {
            name: name(interpreted.system(), unknown).to_string(),
            cells: cells.collect::<Option<_>>()?,
            is_sign: false,
        })
    });
    let has_signs = signs.width() > 0;
    let signs = has_signs.then_some(signs);
    Group {
        heading: format!("block {}", block + 1),
        columns: signs.into_iter().chain(values).collect(),
    }
}

/// Arranges the columns of all groups, as many on a line as fit.
fn tables(
    assemblies: &[Assembly],
    groups: &[Group],
    width: usize,
    output: &mut dyn Write,
) -> io::Result<()> {
    let mut labels: Vec<String> = assemblies.iter().map(Assembly::label).collect();
    labels.insert(0, "signs".to_string());
    let longest = labels.iter().map(|it| it.chars().count()).max();
    let indent = 2 + longest.unwrap_or(0);
    let mut lines: Vec<String> = Vec::new();
    let (mut headings, mut used) = (String::new(), width);
    let mut after_sign = false;
    for group in groups {
        let mut is_named = false;
        // A block that fits on one line is not divided.
        let whole = group.columns.iter().map(|it| 2 + it.width()).sum::<usize>();
        let fits = indent + whole + DRAWN.len() <= width;
        for (place, column) in group.columns.iter().enumerate() {
            let next = group.columns.get(place + 1).filter(|_| column.is_sign);
            let needed = match place == 0 && fits {
                true => whole,
                false => 2 + column.width() + next.map_or(0, |it| 2 + it.width()),
            };
            // A sign stands on the line of the first value of its block.
            let is_new = lines.is_empty() || used + needed + DRAWN.len() > width;
            if is_new && !after_sign {
                flush(assemblies, &headings, &mut lines, output)?;
                headings.clear();
                lines.extend(labels.iter().map(|it| format!("  {it:0$}", indent - 2)));
                (used, is_named) = (indent, false);
            }
            if !is_named {
                let gap = (used + 2).saturating_sub(headings.chars().count());
                headings += &" ".repeat(gap);
                headings += &group.heading;
                is_named = true;
            }
            for (line, cell) in lines
                .iter_mut()
                .zip([&column.name].into_iter().chain(&column.cells))
            {
                let gap = 2 + column.width() - shown_width(cell);
                line.push_str(&" ".repeat(gap));
                line.push_str(cell);
            }
            used += 2 + column.width();
            after_sign = column.is_sign;
        }
    }
    flush(assemblies, &headings, &mut lines, output)
}

/// Writes the columns that are collected, and removes them.
fn flush(
    assemblies: &[Assembly],
    headings: &str,
    lines: &mut Vec<String>,
    output: &mut dyn Write,
) -> io::Result<()> {
    let mut lines = lines.drain(..);
    let Some(names) = lines.next() else {
        return Ok(());
    };
    writeln!(output, "{headings}\n{names}")?;
    for (line, assembly) in lines.zip(assemblies) {
        let drawn = if assembly.drawn { DRAWN } else { "" };
        writeln!(output, "{line}{drawn}")?;
    }
    Ok(())
}
