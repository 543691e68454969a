//! *A motion* → *CSV*: a line per frame, every number with the 17 significant digits that restore it exactly.
//!
//! The columns are `t`; the coordinates by name (`x1`), their rates (`x1_d`) and accelerations (`x1_dd`); for each point `K`
//! its position, velocity and acceleration `K_x, K_y, K_vx, K_vy, K_ax, K_ay`. Units are m, rad and s. What `transmission` and
//! `sensitivity` statements ask for follows, `K_x per phi(1)`, empty where Φ_q is singular. Where it is asked for,
//! `normalized_determinant_phi2` and the like follow, dimensionless.

use std::io::{self, Write};

use linkwright_solver::view::View;

use crate::motion::{Followed, Shown, Sink};
use crate::output::{Beginning, Signature};

/// What follows the name of a coordinate, its rate and its acceleration.
const RATES: [&str; 3] = ["", "_d", "_dd"];

/// What follows the name of a point.
const OF_POINT: [&str; 6] = ["_x", "_y", "_vx", "_vy", "_ax", "_ay"];

/// How such a table is known again, also that of another mechanism.
pub const SIGNATURE: Signature = Signature {
    noun: "a table of frames that this command has written",
    beginning: Beginning::Line(is_header),
};

/// The table of a motion, to which frames are added one by one.
pub struct Table<'a> {
    writer: csv::Writer<&'a mut dyn Write>,
    fields: Vec<String>,
    derivatives: usize,
}

impl<'a> Table<'a> {
    /// The table with its header.
    ///
    /// # Errors
    /// Those of `output`.
    pub fn new<V: View>(motion: &Followed<V>, output: &'a mut dyn Write) -> io::Result<Table<'a>> {
        let mut writer = csv::Writer::from_writer(output);
        writer.write_record(header(motion)).map_err(cause)?;
        Ok(Table {
            writer,
            fields: Vec::new(),
            derivatives: motion.derivative_names.len(),
        })
    }

    /// Ends the table.
    ///
    /// # Errors
    /// Those of the output.
    pub fn finish(mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

impl Sink for Table<'_> {
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()> {
        let fields = &mut self.fields;
        fields.clear();
        fields.push(number(shown.instant.t()));
        for level in [shown.instant.q(), shown.instant.qd(), shown.instant.qdd()] {
            fields.extend(level.iter().map(|value| number(*value)));
        }
        for motion in shown.motions {
            let values = [motion.position, motion.velocity, motion.acceleration];
            fields.extend(values.into_iter().flatten().map(number));
        }
        match shown.derivatives {
            Some(values) => fields.extend(values.iter().map(|value| number(*value))),
            None => fields.extend((0..self.derivatives).map(|_| String::new())),
        }
        fields.extend(shown.measures.iter().map(|value| number(*value)));
        self.writer.write_record(fields).map_err(cause)
    }
}

fn header<V: View>(motion: &Followed<V>) -> Vec<String> {
    let mut names = vec!["t".to_string()];
    for suffix in RATES {
        let coordinates = &motion.system().coordinates;
        names.extend(coordinates.iter().map(|it| format!("{}{suffix}", it.name)));
    }
    for name in motion.point_names() {
        names.extend(OF_POINT.map(|suffix| format!("{name}{suffix}")));
    }
    names.extend(motion.derivative_names.iter().cloned());
    names.extend(motion.measure_names.iter().cloned());
    names
}

/// Whether these are the names of the columns, in their order.
fn is_header(line: &str) -> bool {
    let mut table = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(line.as_bytes());
    let Some(Ok(names)) = table.records().next() else {
        return false;
    };
    let names: Vec<&str> = names.iter().collect();
    let Some((&"t", names)) = names.split_first() else {
        return false;
    };
    // What follows the coordinates is the rate of the first of them.
    let is_first_rate = |name: &&str| name.strip_suffix(RATES[1]) == names.first().copied();
    let Some(count) = names.iter().position(is_first_rate) else {
        return false;
    };
    let (coordinates, names) = names.split_at(count);
    let (rates, names) = names.split_at(names.len().min(2 * count));
    let of = |suffix| coordinates.iter().map(move |it| format!("{it}{suffix}"));
    if !of(RATES[1]).chain(of(RATES[2])).eq(rates.iter().copied()) {
        return false;
    }
    let points = names.chunks(OF_POINT.len()).take_while(|columns| {
        let name = columns[0].strip_suffix(OF_POINT[0]);
        name.is_some_and(|name| {
            let expected = OF_POINT.map(|suffix| format!("{name}{suffix}"));
            expected == *columns
        })
    });
    let others = &names[OF_POINT.len() * points.count()..];
    others
        .iter()
        .all(|name| name.contains(" per ") || name.starts_with("normalized_determinant_"))
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

#[cfg(test)]
mod tests {
    use super::is_header;

    #[test]
    fn a_header_is_known_by_all_of_its_columns() {
        let crank = "t,x1,y1,phi1,x1_d,y1_d,phi1_d,x1_dd,y1_dd,phi1_dd";
        let point = ",P_x,P_y,P_vx,P_vy,P_ax,P_ay";
        for rest in [
            "",
            point,
            &point.repeat(2),
            &format!("{point},\"P_x per distance(A, B)\",normalized_determinant_phi1"),
        ] {
            assert!(is_header(&format!("{crank}{rest}")), "{rest}");
        }
        for other in [
            "",
            "t",
            "t,x,y",
            "0,0,0,0",
            "time,x1,x1_d,x1_dd",
            "t,x1,x1_d",
            "t,x1_d,x1_dd",
            "t,x1,x1_d,y1_dd",
            &format!("{crank},mark"),
            &format!("{crank},P_x,P_y"),
            &format!("{crank}{point},P"),
        ] {
            assert!(!is_header(other), "{other}");
        }
    }
}
