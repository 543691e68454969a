//! Lists the columns that a description requests besides coordinates and points: forces and measures, in SI units.

use linkwright_codegen::stages::expr::SymbolId;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::program::Program;
use linkwright_codegen::stages::system::System;

use crate::forces;
use crate::instant::{Instant, Layout};
use crate::reader::Reader;

/// Returns the columns, each with its unit: driving forces with their powers, then reactions, then energies, then measures. Empty if
/// none is requested.
pub fn names(pool: &Pool, system: &System) -> Vec<(String, String)> {
    let mut names = forces::names(pool, system);
    let measures = system.mechanism.measurements.iter();
    names.extend(measures.map(|it| (it.name.clone(), it.unit())));
    names
}

/// Returns the indices in instants of a program's columns; `None` for a column that the program does not compute.
pub(crate) fn of_program(
    program: &Program,
    system: &System,
    layout: &Layout,
) -> Vec<Option<usize>> {
    let fields = program.forces.asked().into_iter();
    let forces = fields.map(|field| layout.slot(field));
    let measures = (0..system.mechanism.measurements.len()).map(|place| {
        let mut measures = program.measures.iter();
        let measure = measures.find(|it| it.measurement == place)?;
        layout.slot(measure.field)
    });
    forces.chain(measures).collect()
}

/// Measures from the textbook formulation.
#[derive(Clone, Debug)]
pub(crate) struct DenseMeasures {
    values: Reader,
    /// Instants with the forces that measures contain behind their other values.
    layout: Layout,
    /// Indices of these forces among their columns.
    forces: Vec<usize>,
    /// Derivatives of each measure of positions and rates in all coordinates, in their rates, and in the parameters with requested
    /// sensitivities.
    slopes: Reader,
    /// Number of coordinates, and of these parameters.
    counts: [usize; 2],
}

impl DenseMeasures {
    /// Creates the measures; `None` if none is declared.
    pub(crate) fn new(pool: &Pool, system: &System) -> Option<DenseMeasures> {
        let measures = &system.measures;
        if measures.values.is_empty() {
            return None;
        }
        let (symbols, forces): (Vec<_>, Vec<_>) = measures.forces.iter().copied().unzip();
        let layout = Layout::new(system, &symbols);
        let mut pool = pool.draft();
        let values = measures.values.iter();
        let values = values.map(|value| {
            let value = measures.expanded(*value, &mut pool.graph);
            pool.written_out(value)
        });
        let values: Vec<_> = values.collect();
        let coordinates = system.coordinates.iter();
        let of_rates = coordinates.clone().map(|it| it.rate);
        let parameters = system.mechanism.sensitivities.iter();
        let parameters = parameters.map(|&it| system.mechanism.parameters[it].symbol);
        let symbols = coordinates.map(|it| it.position).chain(of_rates);
        let symbols: Vec<SymbolId> = symbols.chain(parameters).collect();
        let measured = values.iter().zip(&system.mechanism.measurements);
        let moving = measured.filter(|(_, it)| it.order <= 1);
        let slopes = moving.flat_map(|(value, _)| {
            let graph = &mut pool.graph;
            let slopes = symbols.iter().map(|it| graph.derivative(*value, *it));
            slopes.collect::<Vec<_>>()
        });
        let slopes: Vec<_> = slopes.collect();
        Some(DenseMeasures {
            slopes: Reader::new(&pool.graph, &layout, &slopes),
            counts: [
                system.coordinates.len(),
                system.mechanism.sensitivities.len(),
            ],
            values: Reader::new(&pool.graph, &layout, &values),
            layout,
            forces,
        })
    }

    /// Returns the measures at an instant with these forces.
    pub(crate) fn at(&self, instant: &Instant, forces: &[f64]) -> Vec<f64> {
        let mut extended = self.layout.empty();
        let solved = instant.values();
        let values = extended.values_mut();
        let (known, rest) = values.split_at_mut(values.len() - self.forces.len());
        known.copy_from_slice(&solved[..known.len()]);
        for (value, &column) in rest.iter_mut().zip(&self.forces) {
            *value = forces.get(column).copied().unwrap_or(f64::NAN);
        }
        self.values.values(&extended)
    }

    /// Returns the derivatives of the measures of positions and rates with respect to a parameter: an index among those with requested
    /// sensitivities. `response` and `rate` are the derivatives of coordinates and rates.
    pub(crate) fn along<'a>(
        &self,
        instant: &Instant,
        parameter: usize,
        [response, rate]: [impl Iterator<Item = &'a f64> + Clone; 2],
    ) -> Vec<f64> {
        let [coordinates, parameters] = self.counts;
        // Measures of positions and rates do not read the forces.
        let mut extended = self.layout.empty();
        let solved = instant.values();
        extended.values_mut()[..solved.len()].copy_from_slice(solved);
        let slopes = self.slopes.values(&extended);
        let moved = response.chain(rate);
        let along = slopes.chunks_exact(2 * coordinates + parameters);
        let along = along.map(|slopes| {
            let products = slopes.iter().zip(moved.clone());
            let products = products.map(|(slope, moved)| slope * moved);
            slopes[2 * coordinates + parameter] + products.sum::<f64>()
        });
        along.collect()
    }
}
