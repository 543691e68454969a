//! *Solution → CSV:* a line per frame, every number with the 17 significant digits that restore it exactly.
//!
//! The columns are `t`; the coordinates by name (`x1`), their rates (`x1_d`) and accelerations (`x1_dd`); for each point `K`
//! its position, velocity and acceleration `K_x, K_y, K_vx, K_vy, K_ax, K_ay`. Units are m, rad and s. What `transmission` and
//! `sensitivity` statements ask for follows, `K_x per phi(1)`, empty where Φ_q is singular. Where it is asked for,
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
        let derivatives = &solution.derivatives;
        let values = derivatives.values.get(index).and_then(Option::as_deref);
        extend(&mut fields, &derivatives.names, values);
        if let Some(monitor) = &solution.monitor {
            let measures = monitor.measures[index].as_deref();
            extend(&mut fields, &monitor.names, measures);
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
    names.extend(solution.derivatives.names.iter().cloned());
    if let Some(monitor) = &solution.monitor {
        names.extend(monitor.names.iter().cloned());
    }
    names
}

/// A field for each name: its value, or nothing.
fn extend(fields: &mut Vec<String>, names: &[String], values: Option<&[f64]>) {
    match values {
        Some(values) => fields.extend(values.iter().map(|value| number(*value))),
        None => fields.extend(names.iter().map(|_| String::new())),
    }
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
