//! Coulomb friction in joints, against free bodies by hand, and between formulations.

mod all_descriptions;
mod by_hand;
mod press;
mod properties;

use linkwright::{Failure, Settings, Shell};
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::{Dense, Instant, Interpreted, View, reported};

/// Columns of forces along a motion, by name.
struct Columns {
    names: Vec<String>,
    rows: Vec<(Instant, Vec<f64>)>,
}

impl Columns {
    fn each(&self, wanted: &[&str], mut each: impl FnMut(&Instant, &[f64])) {
        let places = wanted.iter().map(|name| {
            let place = self.names.iter().position(|it| it == name);
            place.unwrap_or_else(|| panic!("no {name} in {:?}", self.names))
        });
        let places: Vec<usize> = places.collect();
        for (instant, row) in &self.rows {
            let values: Vec<f64> = places.iter().map(|&place| row[place]).collect();
            each(instant, &values);
        }
    }
}

fn times(end: f64) -> impl Iterator<Item = f64> {
    (0..=100).map(move |step| 0.01 * end * f64::from(step))
}

/// Columns of a view at these times, up to a failure.
fn followed<V: View>(
    view: &V,
    parameters: Option<V::Parameters>,
    end: f64,
) -> (Columns, Option<Failure>) {
    let laws = view.input_laws();
    let parameters = parameters.unwrap_or_else(|| view.nominal_parameters());
    let (pose, modes) = (view.drawn_pose(&parameters), view.drawn_branches());
    let (inputs, settings) = (laws.at(0.0), Settings::default());
    let names = reported::names(view.pool(), view.system());
    let mut columns = Columns {
        names: names.into_iter().map(|it| it.0).collect(),
        rows: Vec::new(),
    };
    let shell = Shell::assemble(
        view.clone(),
        &parameters,
        &pose,
        modes,
        0.0,
        &inputs,
        settings,
    );
    let mut shell = match shell {
        Ok(shell) => shell,
        Err(failure) => return (columns, Some(failure)),
    };
    for t in times(end) {
        if let Err(failure) = shell.advance(t, &laws.at(t)) {
            return (columns, Some(failure));
        }
        // The textbook formulation has no row where friction does not settle.
        let Some(row) = view.reported(shell.frame()) else {
            break;
        };
        columns.rows.push((shell.frame().clone(), row));
    }
    (columns, None)
}

/// Columns of a motion in both formulations, which agree to rounding.
fn solved(derived: &Derived, end: f64) -> Columns {
    let (solved, failure) = followed(&Interpreted::new(derived).expect("a motion"), None, end);
    assert_eq!(failure, None);
    let (dense, failure) = followed(&Dense::new(derived), None, end);
    assert_eq!(failure, None);
    assert_eq!(solved.rows.len(), dense.rows.len());
    let mut worst = 0.0_f64;
    for ((_, own), (_, other)) in solved.rows.iter().zip(&dense.rows) {
        let size = own.iter().fold(1.0_f64, |size, it| size.max(it.abs()));
        let differences = own
            .iter()
            .zip(other)
            .map(|(own, other)| (own - other).abs());
        worst = differences.fold(worst, |worst, it| worst.max(it / size));
    }
    println!("both formulations: {worst:e}");
    assert!(worst < 1e-12, "{worst:e}");
    solved
}
