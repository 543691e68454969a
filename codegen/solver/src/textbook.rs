//! *A [`System`]* → *Φ and what is derived from it, as functions of pose and time*.
//!
//! [`TextbookEquations`] implements [`Equations`] by one [`Tape`] per function, so that whatever solves equations also solves a
//! description that was read a moment ago. Afterwards Φ_q holds zeros wherever the system lists no entry. The module does not know how
//! the equations are solved.

use std::cell::RefCell;

use linkwright::contact::pressure_angle;
use linkwright::{Equations, Failure, Frame, PointMotion, Settings, kinematics};
use linkwright_codegen::stages::expr::{ExprId, SymbolId, Tape};
use linkwright_codegen::stages::model::Requested;
use linkwright_codegen::stages::system::System;
use nalgebra::{DMatrix, DVector, Dyn};

use crate::supplied::{InputSignals, ParameterValues};

/// A mechanism as functions of pose and time, in SI units: m, rad, s.
///
/// Vectors follow the order of [`System::coordinates`] and [`System::rows`]; both have n entries. The functions borrow
/// internal buffers while they run, so an interpreter belongs to one thread; clone it for another.
#[derive(Clone, Debug)]
pub struct TextbookEquations {
    dimension: usize,
    residual: Tape,
    magnitudes: Tape,
    jacobian: Tape,
    /// Where each result of `jacobian` belongs in the column-major n × n matrix.
    places: Vec<usize>,
    time_derivative: Tape,
    gamma: Tape,
    /// The residuals of the rows that are not solved.
    monitored: Tape,
    monitored_count: usize,
    /// Six results per output: position, velocity, acceleration.
    outputs: Tape,
    output_names: Vec<String>,
    /// ∂Φ/∂δ of every direction, one after another: n results each.
    columns: Tape,
    directions: usize,
    // Drivers come first among them.
    driven: usize,
    /// (Φ_q q̇ + Φ_t)_p of all parameters whose sensitivities are asked for, column by column.
    rate_columns: Tape,
    /// The entries of (Φ_q q̇ + Φ_t)_q that are not zero, and their rows and columns.
    rate_jacobian: Tape,
    rate_places: Vec<(usize, usize)>,
    transmissions: Vec<Requested>,
    /// Three results per contact: the velocity of the follower along and across the normal, and the square of the sliding speed.
    pressures: Tape,
    pressure_count: usize,
    estimate: DVector<f64>,
    row_scales: Vec<f64>,
    coordinate_scales: Vec<f64>,
    /// The symbols of q, q̇, q̈ and t.
    positions: Vec<SymbolId>,
    rates: Vec<SymbolId>,
    accelerations: Vec<SymbolId>,
    time: SymbolId,
    /// Value, rate and acceleration of every input at one time, and their symbols.
    signals: Tape,
    signal_symbols: Vec<SymbolId>,
    parameter_symbols: Vec<SymbolId>,
    scratch: RefCell<Scratch>,
}

/// What an evaluation writes into and the next one overwrites.
#[derive(Clone, Debug)]
struct Scratch {
    /// A value per symbol.
    symbols: Vec<f64>,
    /// What the tapes keep intermediate values in.
    workspace: Vec<f64>,
    /// Results that are not a vector of n entries.
    results: Vec<f64>,
    /// The inputs at one time.
    signals: Vec<f64>,
    /// Whether the inputs are supplied, so that their laws do not count.
    are_supplied: bool,
}

impl TextbookEquations {
    /// The functions of `system`, which must have as many rows as coordinates: `linkwright_codegen::check` says so.
    ///
    /// # Panics
    /// If the system is not square.
    pub fn new(system: &System) -> TextbookEquations {
        let dimension = system.coordinates.len();
        assert_eq!(
            system.rows.len(),
            dimension,
            "a system must pass `check` before it is solved"
        );
        let graph = &system.mechanism.graph;
        let rows = |pick: fn(&linkwright_codegen::stages::system::Row) -> ExprId| {
            let roots: Vec<ExprId> = system.rows.iter().map(pick).collect();
            Tape::new(graph, &roots)
        };
        let mut entries = Vec::new();
        let mut places = Vec::new();
        for (index, row) in system.rows.iter().enumerate() {
            for entry in &row.jacobian {
                entries.push(entry.value);
                places.push(entry.coordinate * dimension + index);
            }
        }
        let motions: Vec<ExprId> = system
            .outputs
            .iter()
            .flat_map(|output| [output.position, output.velocity, output.acceleration])
            .flatten()
            .collect();
        let columns: Vec<ExprId> = system
            .directions
            .iter()
            .flat_map(|direction| direction.column.iter().copied())
            .collect();
        let rate_columns: Vec<ExprId> = system
            .directions
            .iter()
            .flat_map(|direction| direction.rate_column.iter().copied())
            .collect();
        let rate_rows = system.rate_jacobian.iter().enumerate();
        let (rate_places, rate_entries): (Vec<(usize, usize)>, Vec<ExprId>) = rate_rows
            .flat_map(|(row, entries)| {
                let entries = entries.iter();
                entries.map(move |entry| ((row, entry.coordinate), entry.value))
            })
            .unzip();
        let pressures: Vec<ExprId> = system
            .pressures
            .iter()
            .flat_map(|pressure| [pressure.along, pressure.across, pressure.sliding])
            .collect();
        let coordinates = &system.coordinates;
        let inputs = system.mechanism.inputs.iter();
        TextbookEquations {
            dimension,
            residual: rows(|row| row.residual),
            magnitudes: {
                let residuals = system.rows.iter().map(|row| row.residual);
                Tape::of_magnitudes(graph, &residuals.collect::<Vec<_>>())
            },
            jacobian: Tape::new(graph, &entries),
            time_derivative: rows(|row| row.time_derivative),
            gamma: rows(|row| row.gamma),
            monitored: {
                let watched = system.monitored.iter().map(|row| row.residual);
                Tape::new(graph, &watched.collect::<Vec<_>>())
            },
            monitored_count: system.monitored.len(),
            outputs: Tape::new(graph, &motions),
            pressures: Tape::new(graph, &pressures),
            pressure_count: system.pressures.len(),
            output_names: system
                .outputs
                .iter()
                .map(|output| output.name.clone())
                .collect(),
            columns: Tape::new(graph, &columns),
            directions: system.directions.len(),
            driven: system.driven().count(),
            rate_columns: Tape::new(graph, &rate_columns),
            rate_jacobian: Tape::new(graph, &rate_entries),
            rate_places,
            transmissions: system.mechanism.transmissions.clone(),
            // A drawing that is not constant has been rejected before; NaN would be reported as not finite.
            estimate: DVector::from_iterator(
                dimension,
                coordinates
                    .iter()
                    .map(|it| graph.constant_value(it.estimate).unwrap_or(f64::NAN)),
            ),
            row_scales: system
                .rows
                .iter()
                .map(|row| system.scale(row.quantity))
                .collect(),
            coordinate_scales: coordinates
                .iter()
                .map(|it| system.scale(it.quantity))
                .collect(),
            positions: coordinates.iter().map(|it| it.position).collect(),
            rates: coordinates.iter().map(|it| it.rate).collect(),
            accelerations: coordinates.iter().map(|it| it.acceleration).collect(),
            time: system.mechanism.time,
            signals: Tape::new(
                graph,
                &inputs.clone().flat_map(|it| it.signal).collect::<Vec<_>>(),
            ),
            signal_symbols: inputs.flat_map(|it| it.symbols).collect(),
            parameter_symbols: system
                .mechanism
                .parameters
                .iter()
                .map(|it| it.symbol)
                .collect(),
            scratch: RefCell::new(Scratch {
                symbols: parameters(system),
                workspace: Vec::new(),
                signals: Vec::new(),
                are_supplied: false,
                results: vec![0.0; places.len().max(motions.len()).max(pressures.len())],
            }),
            places,
        }
    }

    /// Sets parameters and inputs, whose laws do not count from then on.
    pub fn supply(&self, parameters: &ParameterValues, inputs: &InputSignals) {
        let scratch = &mut *self.scratch.borrow_mut();
        scratch.are_supplied = true;
        self.fill(&mut scratch.symbols, &self.parameter_symbols, &parameters.0);
        let signals = inputs.0.iter();
        let signals = signals.flat_map(|it| [it.value, it.rate, it.acceleration]);
        scratch.signals.clear();
        scratch.signals.extend(signals);
        for (symbol, value) in self.signal_symbols.iter().zip(&scratch.signals) {
            scratch.symbols[symbol.index()] = *value;
        }
    }

    /// The pose q (n) in which the mechanism is drawn: an estimate that need not satisfy the equations.
    pub fn estimate(&self) -> &DVector<f64> {
        &self.estimate
    }

    /// The names of the points, in the order of [`TextbookEquations::points`].
    pub fn point_names(&self) -> &[String] {
        &self.output_names
    }

    /// The pressure angle of every contact at `frame`, in rad and in the order of [`System::pressures`]; none where the follower
    /// rests.
    pub fn pressure_angles(&self, frame: &Frame<f64, Dyn>) -> Vec<Option<f64>> {
        let scratch = &mut *self.scratch.borrow_mut();
        self.fill(&mut scratch.symbols, &self.positions, frame.q.as_slice());
        self.fill(&mut scratch.symbols, &self.rates, frame.qd.as_slice());
        self.set_time(scratch, frame.t);
        let results = &mut scratch.results[..3 * self.pressure_count];
        self.pressures
            .evaluate(&scratch.symbols, &mut scratch.workspace, results);
        results
            .chunks_exact(3)
            .map(|it| pressure_angle(it[0], it[1], it[2]))
            .collect()
    }

    /// The motion of every declared point at `frame`, in the order of [`System::outputs`].
    pub fn points(&self, frame: &Frame<f64, Dyn>) -> Vec<PointMotion<f64>> {
        let scratch = &mut *self.scratch.borrow_mut();
        self.fill(&mut scratch.symbols, &self.positions, frame.q.as_slice());
        self.fill(&mut scratch.symbols, &self.rates, frame.qd.as_slice());
        self.fill(
            &mut scratch.symbols,
            &self.accelerations,
            frame.qdd.as_slice(),
        );
        self.set_time(scratch, frame.t);
        let results = &mut scratch.results[..6 * self.output_names.len()];
        self.outputs
            .evaluate(&scratch.symbols, &mut scratch.workspace, results);
        results
            .chunks_exact(6)
            .map(|it| PointMotion {
                position: [it[0], it[1]],
                velocity: [it[2], it[3]],
                acceleration: [it[4], it[5]],
            })
            .collect()
    }

    /// ∂q/∂δ (n × directions) at a pose that is solved: Φ_q ∂q/∂δ = −∂Φ/∂δ for each of [`System::directions`], first the drivers,
    /// then the parameters.
    ///
    /// # Errors
    /// Where Φ_q is singular.
    pub fn responses(&self, q: &DVector<f64>, t: f64) -> Result<DMatrix<f64>, Failure> {
        let factorization = kinematics::factorize(self, q, t, &Settings::default())?;
        let mut columns = DVector::zeros(self.dimension * self.directions);
        self.evaluate(&self.columns, q, None, t, &mut columns);
        let mut responses = DMatrix::zeros(self.dimension, self.directions);
        let parts = columns.as_slice().chunks_exact(self.dimension.max(1));
        for (mut response, column) in responses.column_iter_mut().zip(parts) {
            let mut right_hand_side = -DVector::from_column_slice(column);
            factorization.solve(&mut right_hand_side);
            response.copy_from(&right_hand_side);
        }
        Ok(responses)
    }

    /// ∂q̇/∂p (n × parameters whose sensitivities are asked for) at a frame that is solved:
    /// Φ_q ∂q̇/∂p = −((Φ_q q̇ + Φ_t)_q ∂q/∂p + (Φ_q q̇ + Φ_t)_p). `responses` is what [`TextbookEquations::responses`] says of its pose.
    ///
    /// # Errors
    /// Where Φ_q is singular.
    pub fn sensitivity_rates(
        &self,
        frame: &Frame<f64, Dyn>,
        responses: &DMatrix<f64>,
    ) -> Result<DMatrix<f64>, Failure> {
        let Frame { t, q, qd, .. } = frame;
        let factorization = kinematics::factorize(self, q, *t, &Settings::default())?;
        let parameters = self.directions - self.driven;
        let mut columns = DVector::zeros(self.dimension * parameters);
        self.evaluate(&self.rate_columns, q, Some(qd), *t, &mut columns);
        let mut entries = DVector::zeros(self.rate_places.len());
        self.evaluate(&self.rate_jacobian, q, Some(qd), *t, &mut entries);
        let mut rate_jacobian = DMatrix::zeros(self.dimension, self.dimension);
        for (place, entry) in self.rate_places.iter().zip(&entries) {
            rate_jacobian[*place] = *entry;
        }
        let mut rates = DMatrix::zeros(self.dimension, parameters);
        let parts = columns.as_slice().chunks_exact(self.dimension.max(1));
        for (parameter, column) in parts.enumerate() {
            let response = responses.column(self.driven + parameter);
            let moved = &rate_jacobian * response;
            let mut right_hand_side = -(moved + DVector::from_column_slice(column));
            factorization.solve(&mut right_hand_side);
            rates.set_column(parameter, &right_hand_side);
        }
        Ok(rates)
    }

    /// What the drivers transmit, in the order of the mechanism's transmissions: a row for each component (x and y of a
    /// point), a column for each driver. `responses` is what [`TextbookEquations::responses`] says of the same pose.
    pub fn transmissions(
        &self,
        q: &DVector<f64>,
        t: f64,
        responses: &DMatrix<f64>,
    ) -> Vec<DMatrix<f64>> {
        // The velocity of a point is linear in q̇, so responses in place of q̇ give the columns.
        let along: Vec<Vec<PointMotion<f64>>> = responses
            .column_iter()
            .take(self.driven)
            .map(|response| {
                let (qd, qdd) = (response.into_owned(), DVector::zeros(self.dimension));
                self.points(&Frame {
                    t,
                    q: q.clone(),
                    qd,
                    qdd,
                })
            })
            .collect();
        let matrix = |quantity: &Requested| match *quantity {
            Requested::Point(place) => DMatrix::from_fn(2, self.driven, |row, column| {
                along[column][place].velocity[row]
            }),
            Requested::Coordinate(place) => {
                let row = responses.rows(place, 1);
                row.columns(0, self.driven).into_owned()
            }
        };
        self.transmissions.iter().map(matrix).collect()
    }

    /// Fills `magnitudes` (n) with the sum of the absolute values of the terms of each Φ_i: what its residual is the
    /// difference of, so that `ε · magnitude` is the rounding that must be expected in it.
    pub fn residual_magnitudes(&self, q: &DVector<f64>, t: f64, magnitudes: &mut DVector<f64>) {
        let scratch = &mut *self.scratch.borrow_mut();
        self.fill(&mut scratch.symbols, &self.positions, q.as_slice());
        self.set_time(scratch, t);
        self.magnitudes.evaluate(
            &scratch.symbols,
            &mut scratch.workspace,
            magnitudes.as_mut_slice(),
        );
    }

    /// The residuals of the redundant equations, in the order of [`System::monitored`].
    pub fn monitored(&self, q: &DVector<f64>, t: f64) -> DVector<f64> {
        let mut residuals = DVector::zeros(self.monitored_count);
        self.evaluate(&self.monitored, q, None, t, &mut residuals);
        residuals
    }

    /// Puts in the time and what the inputs are then.
    fn set_time(&self, scratch: &mut Scratch, t: f64) {
        scratch.symbols[self.time.index()] = t;
        if self.signal_symbols.is_empty() || scratch.are_supplied {
            return;
        }
        scratch.signals.resize(self.signal_symbols.len(), 0.0);
        self.signals.evaluate(
            &scratch.symbols,
            &mut scratch.workspace,
            &mut scratch.signals,
        );
        for (symbol, value) in self.signal_symbols.iter().zip(&scratch.signals) {
            scratch.symbols[symbol.index()] = *value;
        }
    }

    fn fill(&self, symbols: &mut [f64], places: &[SymbolId], values: &[f64]) {
        for (symbol, value) in places.iter().zip(values) {
            symbols[symbol.index()] = *value;
        }
    }

    /// Evaluates one of the lists with n results at (q, t), and q̇ where it is needed.
    fn evaluate(
        &self,
        tape: &Tape,
        q: &DVector<f64>,
        qd: Option<&DVector<f64>>,
        t: f64,
        results: &mut DVector<f64>,
    ) {
        let scratch = &mut *self.scratch.borrow_mut();
        self.fill(&mut scratch.symbols, &self.positions, q.as_slice());
        if let Some(qd) = qd {
            self.fill(&mut scratch.symbols, &self.rates, qd.as_slice());
        }
        self.set_time(scratch, t);
        tape.evaluate(
            &scratch.symbols,
            &mut scratch.workspace,
            results.as_mut_slice(),
        );
    }
}

/// A value per symbol: parameters at their nominal values, and zero for all others.
fn parameters(system: &System) -> Vec<f64> {
    let graph = &system.mechanism.graph;
    let mut symbols = vec![0.0; graph.symbol_count()];
    graph.fill_nominal(&mut symbols);
    symbols
}

impl Equations<f64, Dyn> for TextbookEquations {
    fn dimension(&self) -> Dyn {
        Dyn(self.dimension)
    }

    fn residual(&self, q: &DVector<f64>, t: f64, phi: &mut DVector<f64>) {
        self.evaluate(&self.residual, q, None, t, phi);
    }

    fn jacobian(&self, q: &DVector<f64>, t: f64, phi_q: &mut DMatrix<f64>) {
        let scratch = &mut *self.scratch.borrow_mut();
        self.fill(&mut scratch.symbols, &self.positions, q.as_slice());
        self.set_time(scratch, t);
        let entries = &mut scratch.results[..self.places.len()];
        self.jacobian
            .evaluate(&scratch.symbols, &mut scratch.workspace, entries);
        phi_q.fill(0.0);
        let matrix = phi_q.as_mut_slice();
        for (place, entry) in self.places.iter().zip(entries) {
            matrix[*place] = *entry;
        }
    }

    fn time_derivative(&self, q: &DVector<f64>, t: f64, phi_t: &mut DVector<f64>) {
        self.evaluate(&self.time_derivative, q, None, t, phi_t);
    }

    fn gamma(&self, q: &DVector<f64>, qd: &DVector<f64>, t: f64, gamma: &mut DVector<f64>) {
        self.evaluate(&self.gamma, q, Some(qd), t, gamma);
    }

    fn row_scale(&self, row: usize) -> f64 {
        self.row_scales[row]
    }

    fn coordinate_scale(&self, column: usize) -> f64 {
        self.coordinate_scales[column]
    }
}
