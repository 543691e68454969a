//! Evaluates the requests of `effort`, `reaction` and `energy` statements as named columns in SI units.
//!
//! The names are those of the functions of generated code: `effort_crank`, `reaction_p_x`, `kinetic_energy`.

use linkwright::generated::multipliers;
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::model::Role;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::{Carried, Component, ForceColumn, System};
use nalgebra::{DMatrix, DVector};

use crate::friction::{DenseFriction, Settled};
use crate::instant::{Instant, Layout};
use crate::product::product;
use crate::reader::Reader;

/// Returns the columns, each with its unit: driving forces with their powers, then reactions, then energies. Empty if none is requested.
pub(crate) fn names(pool: &Pool, system: &System) -> Vec<(String, String)> {
    // Reactions need expressions that nothing else needs, so a draft receives them.
    let mut pool = pool.draft();
    let slug = |joint: usize| &system.mechanism.joints[joint].slug;
    let named = |column: ForceColumn| match column {
        ForceColumn::Effort(joint) => {
            let mut driven = system.driven();
            let quantity = driven.find(|it| it.1 == joint).map(|it| it.2);
            let unit = match quantity.map_or(0, Quantity::power_of_length) {
                0 => "N*m",
                _ => "N",
            };
            (format!("effort_{}", slug(joint)), unit)
        }
        ForceColumn::Power(joint) => (format!("power_{}", slug(joint)), "W"),
        ForceColumn::Reaction(joint, component) => (
            format!("reaction_{}_{}", slug(joint), component.suffix()),
            component.unit(),
        ),
        ForceColumn::KineticEnergy => ("kinetic_energy".to_string(), "J"),
        ForceColumn::PotentialEnergy => ("potential_energy".to_string(), "J"),
        ForceColumn::AddedPower => ("added_power".to_string(), "W"),
        ForceColumn::Friction(joint) => {
            let mut frictions = system.mechanism.forces.frictions.iter();
            let is_pin = frictions.any(|it| it.joint == joint && it.is_pin());
            let unit = if is_pin { "N*m" } else { "N" };
            (format!("friction_{}", slug(joint)), unit)
        }
        ForceColumn::FrictionlessPower => ("frictionless_power".to_string(), "W"),
        ForceColumn::BackwardPower => ("backward_power".to_string(), "W"),
    };
    let columns = system.force_columns(&mut pool).into_iter();
    let columns = columns.map(named);
    columns
        .map(|(name, unit)| (name, unit.to_string()))
        .collect()
}

/// Columns from the textbook formulation: Φ_qᵀ λ = Q − M q̈ as one dense system.
///
/// A column is a sum of multipliers with factors, or a value of its own.
#[derive(Clone, Debug)]
pub(crate) struct DenseForces {
    /// Evaluator of the entries of Φ_q, then Q − M q̈, then the factors of terms and magnitudes, then the values of columns.
    values: Reader,
    /// Row and column of each entry.
    entries: Vec<(usize, usize)>,
    /// Column and row of each term; monitored rows follow the others.
    terms: Vec<(usize, usize)>,
    /// Column and row of each multiplier whose magnitude counts.
    magnitudes: Vec<(usize, usize)>,
    columns: usize,
    /// Number of columns with those that are only intermediate, and number of drivers with columns.
    all_columns: usize,
    efforts: usize,
    has_energy: bool,
    rows: usize,
    /// Number of monitored rows with multipliers, which minimize the weighted reactions; 0 without `least_norm`.
    shared: usize,
    /// Weights of the last columns, which are minimized.
    weights: Vec<f64>,
    /// Joints with friction, with the numbers of components of their reactions; `None` without any.
    friction: Option<(DenseFriction, Vec<usize>)>,
    /// Rows without a multiplier, because forces alone move the coordinates that they would hold.
    released: Vec<usize>,
}

/// Terms of a column.
#[derive(Default)]
struct Column {
    terms: Vec<(usize, ExprId)>,
    /// Rows of multipliers whose magnitudes count, each with a factor.
    magnitudes: Vec<(usize, ExprId)>,
    value: Option<ExprId>,
}

impl DenseForces {
    /// Creates the columns in the order of [`names`]; `None` if none is requested.
    pub(crate) fn new(pool: &Pool, system: &System, layout: &Layout) -> Option<DenseForces> {
        let loads = system.forces.clone()?;
        let mut pool = pool.draft();
        let mut columns = columns(&mut pool, system);
        if columns.is_empty() {
            return None;
        }
        let column_count = columns.len();
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
                weights.extend(weights_of(joint, &mut pool, system));
                columns.extend(carried(joint, &mut pool, system));
            }
        }
        let friction = DenseFriction::new(system).map(|friction| {
            let mut components = Vec::new();
            for joint in friction.joints() {
                let reaction = carried(joint, &mut pool, system);
                components.push(reaction.len());
                columns.extend(reaction);
            }
            (friction, components)
        });
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
        let zero = pool.graph.zero();
        let right_side = loads.loads.iter().copied().chain(std::iter::repeat(zero));
        roots.extend(right_side.take(system.coordinates.len()));
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
        if let Some((friction, _)) = &friction {
            roots.extend(friction.roots(&mut pool, system));
        }
        let roots: Vec<ExprId> = roots
            .into_iter()
            .map(|root| {
                let root = pool.graph.substitute(root, &loads.lengths);
                pool.written_out(root)
            })
            .collect();
        Some(DenseForces {
            values: Reader::new(&pool.graph, layout, &roots),
            entries,
            terms,
            magnitudes,
            columns: column_count,
            rows: system.coordinates.len(),
            shared,
            weights,
            efforts: match system.mechanism.forces.efforts {
                true => system.driven().count(),
                false => 0,
            },
            all_columns: columns.len(),
            has_energy: system.mechanism.forces.energy,
            friction,
            released: Vec::new(),
        })
    }

    /// Removes the multipliers of these rows.
    pub(crate) fn release(&mut self, rows: Vec<usize>) {
        self.released = rows;
    }

    /// Returns the columns at an instant; `None` if Φ_q is singular.
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
        let mut multipliers = DVector::from_column_slice(loads);
        multipliers::solve(&jacobian, &mut multipliers).ok()?;
        multipliers.resize_vertically_mut(self.rows + self.shared, 0.0);
        if self.shared > 0 {
            // One unit of each monitored multiplier, with those of the other rows that balance it; `of_units` are their components.
            let mut units = DMatrix::zeros(self.rows + self.shared, self.shared);
            for place in 0..self.shared {
                let mut unit = -all.row(self.rows + place).transpose();
                multipliers::solve(&jacobian, &mut unit).ok()?;
                units.view_mut((0, place), (self.rows, 1)).copy_from(&unit);
                units[(self.rows + place, place)] = 1.0;
            }
            let mut weighed = DMatrix::zeros(self.weights.len(), multipliers.len());
            for ((column, row), factor) in self.terms.iter().zip(factors) {
                if let Some(place) = column.checked_sub(self.columns) {
                    weighed[(place, *row)] += self.weights[place] * factor;
                }
            }
            let of_units = product(&weighed, &units);
            let mut shares = -of_units.tr_mul(&(&weighed * &multipliers));
            multipliers::solve(&of_units.tr_mul(&of_units), &mut shares).ok()?;
            multipliers += units * shares;
        }
        let (own, of_friction) = own.split_at(self.all_columns);
        let mut columns = own.to_vec();
        columns.truncate(self.columns);
        if let Some((friction, components)) = &self.friction {
            let linear = |multipliers: &DVector<f64>| {
                let mut columns = vec![0.0; self.all_columns];
                for ((column, row), factor) in self.terms.iter().zip(factors) {
                    columns[*column] += factor * multipliers[*row];
                }
                columns
            };
            let settled =
                friction.settle(of_friction, &jacobian, &multipliers, linear, components)?;
            self.add_friction(&settled, &linear(&multipliers), &mut columns);
            return Some(columns);
        }
        for &row in &self.released {
            multipliers[row] = 0.0;
        }
        let terms = self.terms.iter().zip(factors);
        for ((column, row), factor) in terms.filter(|((column, _), _)| *column < self.columns) {
            columns[*column] += factor * multipliers[*row];
        }
        for ((column, row), factor) in self.magnitudes.iter().zip(of_magnitudes) {
            columns[*column] += factor * multipliers[*row].abs();
        }
        Some(columns)
    }
}

impl DenseForces {
    /// Adds the columns of multipliers with friction, and those of friction itself; `alone` are those without friction.
    fn add_friction(&self, settled: &Settled, alone: &[f64], columns: &mut [f64]) {
        let [forward, backward] = &settled.columns;
        let pairs = columns.iter_mut().zip(forward);
        pairs.for_each(|(column, value)| *column += value);
        let powers = |columns: &[f64]| -> f64 {
            let powers = columns[..2 * self.efforts].chunks_exact(2);
            powers.map(|it| it[1]).sum()
        };
        let count = settled.forces.len();
        let first = columns.len() - count - 2;
        if self.has_energy {
            columns[first - 1] += settled.power;
        }
        columns[first..first + count].copy_from_slice(&settled.forces);
        columns[first + count] = powers(alone);
        columns[first + count + 1] = powers(backward);
    }

    /// Replaces rows without a multiplier by the null space of the other rows.
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

/// Returns the terms of every column.
fn columns(pool: &mut Pool, system: &System) -> Vec<Column> {
    let requests = system.mechanism.forces.clone();
    let mut columns = Vec::new();
    if requests.efforts {
        let driven: Vec<(usize, usize)> = system
            .driven()
            .map(|(place, joint, _)| (place, joint))
            .collect();
        for (direction, joint) in driven {
            let column = system.directions[direction].column.clone();
            let value = system.mechanism.joints[joint].operands.value;
            let value = value.filter(|_| !requests.at_rest);
            let rate = value.map_or(pool.graph.zero(), |value| pool.rate(value));
            let graph = &mut pool.graph;
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
    for joint in requests.reactions {
        let mut reaction = carried(joint, pool, system);
        add_teeth(joint, &mut reaction, pool, system);
        columns.extend(reaction);
    }
    if let (true, Some(forces)) = (requests.energy, &system.forces) {
        let values = [forces.kinetic, forces.potential, forces.added];
        columns.extend(values.map(|value| Column {
            value: Some(value),
            ..Column::default()
        }));
    }
    let frictions = requests.frictions.len();
    if frictions > 0 {
        // Of the joints, and two powers.
        columns.resize_with(columns.len() + frictions + 2, Column::default);
    }
    columns
}

/// Adds the tooth forces to the columns x and y of a joint.
fn add_teeth(joint: usize, columns: &mut [Column], pool: &mut Pool, system: &System) {
    for (place, is_opposite) in system.teeth_of(joint) {
        let gear = system.mechanism.forces.teeth[place].gear;
        let mut rows = system.rows.iter().chain(&system.monitored);
        let row = rows.position(|row| row.joint == gear);
        let (Some(row), Some(force)) = (row, system.tooth_force(place, pool)) else {
            continue;
        };
        let graph = &mut pool.graph;
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

/// Returns the columns of a joint's reaction without tooth forces, with the terms of monitored rows.
fn carried(joint: usize, pool: &mut Pool, system: &System) -> Vec<Column> {
    let passing = system.passing(joint, &system.vector_form.rows, pool);
    let direction = passing.carried.direction();
    let coordinates = system.mechanism.bodies[passing.body.0].coordinates;
    let graph = &mut pool.graph;
    let rows = system.rows.iter().chain(&system.monitored).enumerate();
    let rows: Vec<_> = rows.filter(|(_, row)| row.joint == joint).collect();
    // A wrench is the action of one unit of a multiplier: forces, and a moment about the joint.
    let mut wrenches = Vec::new();
    for (row, stated) in rows {
        let mut wrench = [0, 1, 2].map(|axis| {
            let coordinate = coordinates[axis].map(|it| it.place);
            let mut entries = stated.jacobian.iter();
            let entry = entries.find(|it| Some(it.coordinate) == coordinate);
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
                // The row of meshing wheels has the slope 1 in the angle of the second one.
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

/// Returns the weights of a reaction's components: moments are divided by the characteristic length.
fn weights_of(joint: usize, pool: &mut Pool, system: &System) -> Vec<f64> {
    let length = system.mechanism.characteristic_length;
    let mut rows = system.rows.iter().chain(&system.monitored);
    let measured = rows.find(|row| row.joint == joint);
    let power = measured.map_or(1, |row| row.quantity.power_of_length());
    let components = system
        .passing(joint, &system.vector_form.rows, pool)
        .carried
        .components()
        .iter();
    let weights = components.map(|component| match component {
        Component::Moment => 1.0 / length,
        Component::Multiplier => length.powi(power - 1),
        _ => 1.0,
    });
    weights.collect()
}
