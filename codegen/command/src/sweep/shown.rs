//! Finds the quantities that a sweep reports, by the names that `solve --show` takes, down to one component.

use linkwright_codegen::diagnostic::nearest;
use linkwright_codegen::stages::joint::Quantity as Kind;
use linkwright_codegen::stages::system::Derived;
use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::Observable;
use linkwright_solver::observable::{Named, all};

use super::varied::named;
use linkwright_page::motion;

/// Endings of names of components of points, with axis and level.
const COMPONENTS: [(&str, usize, usize); 8] = [
    ("_vx", 0, 1),
    ("_vy", 1, 1),
    ("_ax", 0, 2),
    ("_ay", 1, 2),
    ("_x", 0, 0),
    ("_y", 1, 0),
    (".x", 0, 0),
    (".y", 1, 0),
];

/// Quantity that is reported.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// Name in tables of frames.
    pub name: String,
    /// Quantity in the solver.
    pub observable: Observable,
    /// Unit of its columns.
    pub unit: OutputUnit,
}

impl Quantity {
    /// Returns the name of a column of this quantity with its unit.
    pub fn header(&self) -> String {
        named(&self.name, &self.unit.name)
    }
}

/// Returns the named quantities without repetitions; all angles if none is named.
///
/// # Errors
/// The printed message with the first unknown name.
pub fn quantities(derived: &Derived, names: &[String]) -> Result<Vec<Quantity>, String> {
    let known = all(&derived.pool, &derived.system);
    let units = derived.system.mechanism.units.of_tables();
    let mut observables = Vec::new();
    for name in names {
        for observable in named_by(derived, &known, name)? {
            if !observables.contains(&observable) {
                observables.push(observable);
            }
        }
    }
    if names.is_empty() {
        observables = default(derived);
    }
    let quantity = |observable: Observable| {
        let named = known.iter().find(|it| it.observable == observable)?;
        Some(Quantity {
            name: named.name.clone(),
            observable,
            unit: units.of(&named.unit),
        })
    };
    Ok(observables.into_iter().filter_map(quantity).collect())
}

/// Returns all angles; of a mechanism without angles all coordinates.
fn default(derived: &Derived) -> Vec<Observable> {
    let coordinates = derived.system.coordinates.iter().enumerate();
    let are_angles = coordinates
        .clone()
        .any(|(_, it)| it.quantity == Kind::Angle);
    let reported = coordinates.filter(|(_, it)| !are_angles || it.quantity == Kind::Angle);
    let reported = reported.map(|(place, _)| Observable::Coordinate { place, level: 0 });
    reported.collect()
}

/// Returns the quantities of a name: one, or both components of a point.
fn named_by(derived: &Derived, known: &[Named], name: &str) -> Result<Vec<Observable>, String> {
    if let Some(exact) = known.iter().find(|it| it.name == name) {
        return Ok(vec![exact.observable]);
    }
    let system = &derived.system;
    let names = [name.to_string()];
    let [coordinates, points] = motion::shown(system, &names).map_err(|text| {
        let all = known.iter().map(|it| it.name.as_str());
        // Names of rates, components and forces are nearer than those of points and coordinates.
        match nearest(name, all) {
            Some(meant) if !text.contains("did you mean") => {
                format!("error: {text}\n  = help: did you mean `{meant}`?")
            }
            _ => format!("error: {text}"),
        }
    })?;
    let level = match name {
        _ if name.ends_with("_dd") || name.starts_with("qdd.") => 2,
        _ if name.ends_with("_d") || name.starts_with("qd.") => 1,
        _ => 0,
    };
    if let Some(&place) = coordinates.first() {
        return Ok(vec![Observable::Coordinate { place, level }]);
    }
    let component = COMPONENTS
        .iter()
        .find(|(ending, ..)| name.ends_with(ending));
    let of_axis = ["x(", "y("].iter().position(|it| name.starts_with(it));
    let observables = points.into_iter().flat_map(|place| {
        let components = match (component, of_axis) {
            (Some(&(_, axis, level)), _) => vec![(axis, level)],
            (None, Some(axis)) => vec![(axis, 0)],
            (None, None) => vec![(0, 0), (1, 0)],
        };
        let components = components.into_iter();
        components.map(move |(axis, level)| Observable::Point { place, axis, level })
    });
    Ok(observables.collect())
}
