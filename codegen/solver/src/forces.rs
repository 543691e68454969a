//! *What `effort`, `reaction` and `energy` statements ask for* → *named columns of numbers*, in SI units.
//!
//! The names are those of the functions of generated code: `effort_crank`, `reaction_p_x`, `kinetic_energy`. The module does not know
//! how columns are written.

use linkwright::multipliers;
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::model::Role;
use linkwright_codegen::stages::program::Program;
use linkwright_codegen::stages::system::{Carried, Component, System};
use nalgebra::{DMatrix, DVector};

use crate::instant::{Instant, Layout};
use crate::reader::Reader;

/// The columns, each with its unit: efforts with their powers, then reactions, then energies. Nothing where none is asked for.
pub fn names(system: &System) -> Vec<(String, &'static str)> {
    let wanted = &system.mechanism.forces;
    let mut names = Vec::new();
    if wanted.efforts {
        for (_, joint, quantity) in system.driven() {
            let slug = &system.mechanism.joints[joint].slug;
            let unit = match quantity.power_of_length() {
                0 => "N*m",
                _ => "N",
            };
            names.push((format!("effort_{slug}"), unit));
            names.push((format!("power_{slug}"), "W"));
        }
    }
    if !wanted.reactions.is_empty() {
        // What a joint carries is said in terms of expressions that nothing else needs.
        let mut asked = system.clone();
        for &joint in &wanted.reactions {
            let components = asked.passing(joint).carried.components();
            let slug = &system.mechanism.joints[joint].slug;
            let own = components.iter();
            names.extend(own.map(|it| (format!("reaction_{slug}_{}", it.suffix()), it.unit())));
        }
    }
    if wanted.energy {
        names.extend([
            ("kinetic_energy".to_string(), "J"),
            ("potential_energy".to_string(), "J"),
            ("added_power".to_string(), "W"),
        ]);
    }
    names
}

/// Where instants of a program keep the columns.
pub(crate) fn of_program(program: &Program, layout: &Layout) -> Vec<Option<usize>> {
    let fields = program.forces.asked().into_iter();
    fields.map(|field| layout.slot(field)).collect()
}

/// The same from the textbook's equations: Φ_qᵀ λ = Q − M q̈ as one dense system. Every column is a sum of multipliers with factors,
/// or a value of its own.
#[derive(Clone, Debug)]
pub(crate) struct DenseForces {
    /// The entries of Φ_q, then Q − M q̈, then the factors of the terms and of the magnitudes, then the values of columns.
    values: Reader,
    /// The row and the column of each entry.
    entries: Vec<(usize, usize)>,
    /// The column and the row of each term; rows that are monitored follow the others.
    terms: Vec<(usize, usize)>,
    /// The column and the row of each multiplier whose magnitude counts.
    magnitudes: Vec<(usize, usize)>,
    columns: usize,
    rows: usize,
    /// How many rows are monitored, where they carry what makes all of it smallest.
    shared: usize,
    /// The last columns, which are those that are to be smallest: what each is multiplied by.
    weights: Vec<f64>,
    /// Rows that carry nothing, since forces alone move what they would hold.
    released: Vec<usize>,
}

/// What a column is made of.
#[derive(Default)]
struct Column {
    terms: Vec<(usize, ExprId)>,
    /// The rows of multipliers whose magnitudes count, each with a factor.
    magnitudes: Vec<(usize, ExprId)>,
    value: Option<ExprId>,
}

impl DenseForces {
    /// The columns in the order of [`names`]; `None` where none is asked for.
    pub(crate) fn new(system: &System, layout: &Layout) -> Option<DenseForces> {
        let loads = system.forces.clone()?;
        let mut system = system.clone();
        let mut columns = columns(&mut system);
        if columns.is_empty() {
            return None;
        }
        let asked = columns.len();
        let shared = match system.mechanism.forces.least_norm {
            true => system.monitored.len(),
            false => 0,
        };
        let mut weights = Vec::new();
        if shared > 0 {
            let joints = system.mechanism.joints.iter().enumerate();
            let joints = joints.filter(|(_, joint)| joint.role == Role::Constraint);
            let joints: Vec<usize> = joints.map(|(joint, _)| joint).collect();
            for joint in joints {
                weights.extend(weights_of(joint, &mut system));
                columns.extend(carried(joint, &mut system));
            }
        }
        let (mut entries, mut roots) = (Vec::new(), Vec::new());
        for (row, own) in system.rows.iter().enumerate() {
            for entry in &own.jacobian {
                entries.push((row, entry.coordinate));
                roots.push(entry.value);
            }
        }
        for (place, row) in system.monitored.iter().take(shared).enumerate() {
            for entry in &row.jacobian {
                entries.push((system.rows.len() + place, entry.coordinate));
                roots.push(entry.value);
            }
        }
        let zero = system.mechanism.graph.zero();
        let own = loads.loads.iter().copied().chain(std::iter::repeat(zero));
        roots.extend(own.take(system.coordinates.len()));
        let mut terms = Vec::new();
        for (place, column) in columns.iter().enumerate() {
            terms.extend(column.terms.iter().map(|(row, _)| (place, *row)));
            roots.extend(column.terms.iter().map(|(_, factor)| *factor));
        }
        let mut magnitudes = Vec::new();
        for (place, column) in columns.iter().enumerate() {
            magnitudes.extend(column.magnitudes.iter().map(|(row, _)| (place, *row)));
            roots.extend(column.magnitudes.iter().map(|(_, factor)| *factor));
        }
        roots.extend(columns.iter().map(|it| it.value.unwrap_or(zero)));
        let form = &system.vector_form;
        let graph = &mut system.mechanism.graph;
        let roots: Vec<ExprId> = roots
            .into_iter()
            .map(|root| {
                let root = graph.substitute(root, &loads.lengths);
                form.written_out(root, graph)
            })
            .collect();
        Some(DenseForces {
            values: Reader::new(graph, layout, &roots),
            entries,
            terms,
            magnitudes,
            columns: asked,
            rows: system.coordinates.len(),
            shared,
            weights,
            released: Vec::new(),
        })
    }

    /// Has these rows carry nothing.
    pub(crate) fn release(&mut self, rows: Vec<usize>) {
        self.released = rows;
    }

    /// The columns at an instant; `None` where Φ_q is singular.
    pub(crate) fn at(&self, instant: &Instant) -> Option<Vec<f64>> {
        let values = self.values.values(instant);
        let (entries, rest) = values.split_at(self.entries.len());
        let (loads, rest) = rest.split_at(self.rows);
        let (factors, rest) = rest.split_at(self.terms.len());
        let (of_magnitudes, own) = rest.split_at(self.magnitudes.len());
        let mut all = DMatrix::zeros(self.rows + self.shared, self.rows);
        for (place, value) in self.entries.iter().zip(entries) {
            all[*place] = *value;
        }
        let mut jacobian = all.rows(0, self.rows).into_owned();
        self.border(&mut jacobian);
        let mut found = DVector::from_column_slice(loads);
        multipliers::solve(&jacobian, &mut found).ok()?;
        found.resize_vertically_mut(self.rows + self.shared, 0.0);
        if self.shared > 0 {
            // What each monitored row makes the others carry, and the components of all.
            let mut units = DMatrix::zeros(self.rows + self.shared, self.shared);
            for place in 0..self.shared {
                let mut unit = -all.row(self.rows + place).transpose();
                multipliers::solve(&jacobian, &mut unit).ok()?;
                units.view_mut((0, place), (self.rows, 1)).copy_from(&unit);
                units[(self.rows + place, place)] = 1.0;
            }
            let mut weighed = DMatrix::zeros(self.weights.len(), found.len());
            for ((column, row), factor) in self.terms.iter().zip(factors) {
                if let Some(place) = column.checked_sub(self.columns) {
                    weighed[(place, *row)] += self.weights[place] * factor;
                }
            }
            let of_units = &weighed * &units;
            let mut shares = -of_units.tr_mul(&(&weighed * &found));
            multipliers::solve(&of_units.tr_mul(&of_units), &mut shares).ok()?;
            found += units * shares;
        }
        let mut columns = own.to_vec();
        columns.truncate(self.columns);
        for &row in &self.released {
            found[row] = 0.0;
        }
        let terms = self.terms.iter().zip(factors);
        for ((column, row), factor) in terms.filter(|((column, _), _)| *column < self.columns) {
            columns[*column] += factor * found[*row];
        }
        for ((column, row), factor) in self.magnitudes.iter().zip(of_magnitudes) {
            columns[*column] += factor * found[*row].abs();
        }
        Some(columns)
    }
}

impl DenseForces {
    /// Puts the null space of the other rows in place of those that carry nothing.
    fn border(&self, jacobian: &mut DMatrix<f64>) {
        if self.released.is_empty() {
            return;
        }
        let count = jacobian.ncols();
        let held = jacobian.clone().remove_rows_at(&self.released);
        let mut whole = DMatrix::identity(count, count);
        held.transpose().col_piv_qr().q_tr_mul(&mut whole);
        for (place, &row) in self.released.iter().enumerate() {
            let free = whole.row(count - self.released.len() + place).into_owned();
            jacobian.set_row(row, &free);
        }
    }
}

/// What every column is made of.
fn columns(system: &mut System) -> Vec<Column> {
    let wanted = system.mechanism.forces.clone();
    let mut columns = Vec::new();
    if wanted.efforts {
        let driven: Vec<(usize, usize)> = system
            .driven()
            .map(|(place, joint, _)| (place, joint))
            .collect();
        for (direction, joint) in driven {
            let column = system.directions[direction].column.clone();
            let value = system.mechanism.joints[joint].operands.value;
            let graph = &mut system.mechanism.graph;
            let value = value.filter(|_| !wanted.at_rest);
            let rate = value.map_or(graph.zero(), |value| system.vector_form.rate(value, graph));
            let zero = graph.zero();
            let terms: Vec<(usize, ExprId)> = column
                .into_iter()
                .enumerate()
                .filter(|(_, factor)| *factor != zero)
                .collect();
            let powers = terms.iter();
            let powers = powers.map(|&(row, factor)| (row, graph.multiply(factor, rate)));
            let powers = powers.collect();
            for terms in [terms, powers] {
                columns.push(Column {
                    terms,
                    ..Column::default()
                });
            }
        }
    }
    for joint in wanted.reactions {
        let mut own = carried(joint, system);
        add_teeth(joint, &mut own, system);
        columns.extend(own);
    }
    if let (true, Some(forces)) = (wanted.energy, &system.forces) {
        let values = [forces.kinetic, forces.potential, forces.added];
        columns.extend(values.map(|value| Column {
            value: Some(value),
            ..Column::default()
        }));
    }
    columns
}

/// Adds the forces of teeth to the columns x and y of a joint.
fn add_teeth(joint: usize, columns: &mut [Column], system: &mut System) {
    for (place, is_opposite) in system.teeth_of(joint) {
        let gear = system.mechanism.forces.teeth[place].gear;
        let mut rows = system.rows.iter().chain(&system.monitored);
        let row = rows.position(|row| row.joint == gear);
        let (Some(row), Some(force)) = (row, system.tooth_force(place)) else {
            continue;
        };
        let graph = &mut system.mechanism.graph;
        let mut signed = |factor| match is_opposite {
            true => graph.negate(factor),
            false => factor,
        };
        for (axis, column) in columns.iter_mut().take(2).enumerate() {
            column.terms.push((row, signed(force.of_multiplier[axis])));
            let of_magnitude = signed(force.of_magnitude[axis]);
            column.magnitudes.push((row, of_magnitude));
        }
    }
}

/// The columns of what a joint carries without the forces of teeth, those of rows that are monitored among them.
fn carried(joint: usize, system: &mut System) -> Vec<Column> {
    let passing = system.passing(joint);
    let direction = passing.carried.direction();
    let coordinates = system.mechanism.bodies[passing.body.0].coordinates;
    let graph = &mut system.mechanism.graph;
    let own = system.rows.iter().chain(&system.monitored).enumerate();
    let own: Vec<_> = own.filter(|(_, row)| row.joint == joint).collect();
    // What one unit of each multiplier exerts: forces, and a moment about the place of the joint.
    let mut wrenches = Vec::new();
    for (row, stated) in own {
        let mut wrench = [0, 1, 2].map(|axis| {
            let wanted = coordinates[axis].map(|it| it.place);
            let mut entries = stated.jacobian.iter();
            let entry = entries.find(|it| Some(it.coordinate) == wanted);
            let value = entry.map_or(graph.zero(), |it| it.value);
            match passing.is_opposite {
                true => value,
                false => graph.negate(value),
            }
        });
        let parts = [(0, 1, false), (1, 0, true)];
        for (arm, force, adds) in parts {
            let moment = graph.multiply(passing.arm[arm], wrench[force]);
            wrench[2] = match adds {
                true => graph.add(wrench[2], moment),
                false => graph.subtract(wrench[2], moment),
            };
        }
        wrenches.push((row, wrench));
    }
    let components = passing.carried.components().iter();
    let columns = components.map(|component| {
        let terms = wrenches.iter().map(|&(row, [x, y, moment])| {
            let factor = match (component, direction) {
                (Component::X, _) => x,
                (Component::Y, _) => y,
                // The row of wheels has the slope 1 in the angle of the second one.
                (Component::Moment, _) if passing.carried.turns_wheel() => {
                    let one = graph.one();
                    graph.negate(one)
                }
                (Component::Moment, _) => moment,
                (Component::Multiplier, _) | (_, None) => match passing.carried {
                    Carried::Rod(per_multiplier) => per_multiplier,
                    _ => graph.one(),
                },
                (_, Some([along_x, along_y])) => {
                    let parts = [graph.multiply(x, along_x), graph.multiply(y, along_y)];
                    graph.sum(&parts)
                }
            };
            (row, factor)
        });
        Column {
            terms: terms.collect(),
            ..Column::default()
        }
    });
    columns.collect()
}

/// What the components of what a joint carries are multiplied by to be forces: moments are divided by the characteristic length.
fn weights_of(joint: usize, system: &mut System) -> Vec<f64> {
    let length = system.mechanism.characteristic_length;
    let mut rows = system.rows.iter().chain(&system.monitored);
    let measured = rows.find(|row| row.joint == joint);
    let power = measured.map_or(1, |row| row.quantity.power_of_length());
    let components = system.passing(joint).carried.components().iter();
    let weights = components.map(|component| match component {
        Component::Moment => 1.0 / length,
        Component::Multiplier => length.powi(power - 1),
        _ => 1.0,
    });
    weights.collect()
}
