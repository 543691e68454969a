//! Differentiates a solved pose along each direction: drivers and parameters.
//!
//! All derivatives follow from one factorization of Φ_q.

use linkwright::generated::kinematics;
use linkwright::{Failure, Frame, PointMotion, Settings};
use linkwright_codegen::stages::expr::{ExprId, Tape};
use linkwright_codegen::stages::model::Requested;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;
use nalgebra::{DMatrix, DVector, Dyn};

use super::TextbookEquations;

/// Functions of all directions.
#[derive(Clone, Debug)]
pub(super) struct Directions {
    /// ∂Φ/∂δ of every direction, one after another: n results each.
    columns: Tape,
    count: usize,
    /// Number of drivers, which are the first directions.
    driven: usize,
    /// (Φ_q q̇ + Φ_t)_p of all parameters with requested sensitivities, column by column.
    rate_columns: Tape,
    /// Nonzero entries of (Φ_q q̇ + Φ_t)_q, and their rows and columns.
    rate_jacobian: Tape,
    rate_places: Vec<(usize, usize)>,
    transmissions: Vec<Requested>,
    /// Derivatives of the measures among the transmissions in all coordinates, measure by measure.
    slopes: Tape,
}

impl Directions {
    pub fn new(pool: &Pool, system: &System) -> Directions {
        let graph = &pool.graph;
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
        let mut draft = pool.draft();
        let mut slopes = Vec::new();
        for requested in &system.mechanism.transmissions {
            let Requested::Measure(measure) = *requested else {
                continue;
            };
            let value = system.measures.values[measure];
            let value = system.measures.expanded(value, &mut draft.graph);
            let value = draft.written_out(value);
            let coordinates = system.coordinates.iter();
            slopes.extend(coordinates.map(|it| draft.graph.derivative(value, it.position)));
        }
        Directions {
            slopes: Tape::new(&draft.graph, &slopes),
            columns: Tape::new(graph, &columns),
            count: system.directions.len(),
            driven: system.driven().count(),
            rate_columns: Tape::new(graph, &rate_columns),
            rate_jacobian: Tape::new(graph, &rate_entries),
            rate_places,
            transmissions: system.mechanism.transmissions.clone(),
        }
    }
}

impl TextbookEquations {
    /// Returns ∂q/∂δ (n × directions) at a solved pose: Φ_q ∂q/∂δ = −∂Φ/∂δ for each of [`System::directions`], first the drivers,
    /// then the parameters.
    ///
    /// # Errors
    /// Φ_q is singular.
    pub fn responses(&self, q: &DVector<f64>, t: f64) -> Result<DMatrix<f64>, Failure> {
        let factorization = kinematics::factorize(self, q, t, &Settings::default())?;
        let mut columns = DVector::zeros(self.dimension * self.directions.count);
        self.evaluate(&self.directions.columns, q, None, t, &mut columns);
        let mut responses = DMatrix::zeros(self.dimension, self.directions.count);
        let parts = columns.as_slice().chunks_exact(self.dimension.max(1));
        for (mut response, column) in responses.column_iter_mut().zip(parts) {
            let mut right_hand_side = -DVector::from_column_slice(column);
            factorization.solve(&mut right_hand_side);
            response.copy_from(&right_hand_side);
        }
        Ok(responses)
    }

    /// Returns ∂q̇/∂p (n × parameters with requested sensitivities) at a solved frame:
    /// Φ_q ∂q̇/∂p = −((Φ_q q̇ + Φ_t)_q ∂q/∂p + (Φ_q q̇ + Φ_t)_p). `responses` are those of [`TextbookEquations::responses`] at its pose.
    ///
    /// # Errors
    /// Φ_q is singular.
    pub fn sensitivity_rates(
        &self,
        frame: &Frame<f64, Dyn>,
        responses: &DMatrix<f64>,
    ) -> Result<DMatrix<f64>, Failure> {
        let Frame { t, q, qd, .. } = frame;
        let factorization = kinematics::factorize(self, q, *t, &Settings::default())?;
        let parameters = self.directions.count - self.directions.driven;
        let mut columns = DVector::zeros(self.dimension * parameters);
        self.evaluate(&self.directions.rate_columns, q, Some(qd), *t, &mut columns);
        let mut entries = DVector::zeros(self.directions.rate_places.len());
        self.evaluate(
            &self.directions.rate_jacobian,
            q,
            Some(qd),
            *t,
            &mut entries,
        );
        let mut rate_jacobian = DMatrix::zeros(self.dimension, self.dimension);
        for (place, entry) in self.directions.rate_places.iter().zip(&entries) {
            rate_jacobian[*place] = *entry;
        }
        let mut rates = DMatrix::zeros(self.dimension, parameters);
        let parts = columns.as_slice().chunks_exact(self.dimension.max(1));
        for (parameter, column) in parts.enumerate() {
            let response = responses.column(self.directions.driven + parameter);
            let moved = &rate_jacobian * response;
            let mut right_hand_side = -(moved + DVector::from_column_slice(column));
            factorization.solve(&mut right_hand_side);
            rates.set_column(parameter, &right_hand_side);
        }
        Ok(rates)
    }

    /// Returns the requested transmissions: a row for each component (x and y of a point), a column for each driver.
    ///
    /// Rows are in the order of the mechanism's transmissions. `responses` are those of [`TextbookEquations::responses`] at the pose.
    pub fn transmissions(
        &self,
        q: &DVector<f64>,
        t: f64,
        responses: &DMatrix<f64>,
    ) -> Vec<DMatrix<f64>> {
        // The velocity of a point is linear in q̇, so responses in place of q̇ yield the columns.
        let along: Vec<Vec<PointMotion<f64>>> = responses
            .column_iter()
            .take(self.directions.driven)
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
        let transmitted = self.directions.transmissions.iter();
        let measures = transmitted.filter(|it| matches!(it, Requested::Measure(_)));
        let mut slopes = DVector::zeros(self.dimension * measures.count());
        self.evaluate(&self.directions.slopes, q, None, t, &mut slopes);
        let mut slopes = slopes.as_slice().chunks_exact(self.dimension.max(1));
        let matrix = |quantity: &Requested| match *quantity {
            Requested::Measure(_) => {
                let slopes = slopes.next().unwrap_or_default();
                let driven = responses.columns(0, self.directions.driven);
                DMatrix::from_row_slice(1, slopes.len(), slopes) * driven
            }
            Requested::Point(place) => {
                DMatrix::from_fn(2, self.directions.driven, |row, column| {
                    along[column][place].velocity[row]
                })
            }
            Requested::Coordinate(place) => {
                let row = responses.rows(place, 1);
                row.columns(0, self.directions.driven).into_owned()
            }
        };
        self.directions.transmissions.iter().map(matrix).collect()
    }
}
