//! *Solution → CSV:* a line per frame, every number with the 17 significant digits that restore it exactly.
//!
//! The columns are `t`; the coordinates by name (`x1`), their rates (`x1_d`) and accelerations (`x1_dd`); for each point `K`
//! its position, velocity and acceleration `K_x, K_y, K_vx, K_vy, K_ax, K_ay`. Units are m, rad and s. Where it is asked for,
//! `closeness_phi2` and the like follow, dimensionless and empty where the block cannot be solved.

use std::io::{self, Write};

use crate::solution::Solution;

/// Writes the header and a line per frame.
///
/// # Errors
/// Those of `output`.
pub fn write(solution: &Solution, output: &mut dyn Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(output);
    table.write_record(header(solution)).map_err(cause)?;
    let mut fields = Vec::new();
    for (index, frame) in solution.frames().iter().enumerate() {
        fields.clear();
        fields.push(number(frame.t));
        for vector in [&frame.q, &frame.qd, &frame.qdd] {
            fields.extend(vector.iter().map(|value| number(*value)));
        }
        for (_, motion) in solution.motions(frame) {
            let values = [motion.position, motion.velocity, motion.acceleration];
            fields.extend(values.into_iter().flatten().map(number));
        }
        if let Some(monitor) = &solution.monitor {
            match &monitor.measures[index] {
                Some(measures) => fields.extend(measures.iter().map(|it| number(*it))),
                None => fields.extend(monitor.names.iter().map(|_| String::new())),
            }
        }
        table.write_record(&fields).map_err(cause)?;
    }
    table.flush()
}

fn header(solution: &Solution) -> Vec<String> {
    let mut names = vec!["t".to_string()];
    for suffix in ["", "_d", "_dd"] {
        let coordinates = &solution.system.coordinates;
        names.extend(coordinates.iter().map(|it| format!("{}{suffix}", it.name)));
    }
    for point in &solution.points {
        let name = solution.point_name(*point);
        names.extend(["x", "y", "vx", "vy", "ax", "ay"].map(|it| format!("{name}_{it}")));
    }
    if let Some(monitor) = &solution.monitor {
        names.extend(monitor.names.iter().cloned());
    }
    names
}

/// The error of the output itself, whose kind the conversion of the standard library would hide.
fn cause(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(cause) => cause,
        other => io::Error::other(format!("{other:?}")),
    }
}

fn number(value: f64) -> String {
    format!("{value:.16e}")
}
