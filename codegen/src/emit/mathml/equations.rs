//! A system → its equations, each as a row of MathML.
//!
//! How they stand on a page is for the page to say.

use super::super::formula::Printer;
use super::spelling::MathMl;
use crate::emit::named_parts::NamedParts;
use crate::expr::ExprId;
use crate::pool::SymbolRole;
use crate::system::{Cause, Derived, Row};

/// Φ, Φ_q, Φ_t and γ, and the points. What is `None` is zero.
#[derive(Clone, Debug)]
pub struct Equations {
    /// The coordinates, their rates and their accelerations.
    pub coordinates: Vec<[String; 3]>,
    /// One for each scalar equation.
    pub rows: Vec<Equation>,
    /// The watched repetitions of equations, as residuals.
    pub monitored: Vec<(usize, String)>,
    /// ∂Φ/∂s or ∂Φ/∂p for what is asked for: of what, a label or a name, and the entries by row.
    pub directions: Vec<(String, Vec<(usize, String)>)>,
    /// The name of each point and its x and y.
    pub points: Vec<(String, [String; 2])>,
    /// What names in the other formulas stand for.
    pub definitions: Vec<Definition>,
}

/// One scalar equation.
#[derive(Clone, Debug)]
pub struct Equation {
    /// The joint or driver it comes from: an index into the mechanism's joints.
    pub joint: usize,
    /// Φ_i.
    pub residual: String,
    /// The entries of Φ_q that are not zero.
    pub jacobian: Vec<JacobianEntry>,
    /// The row of Φ_t.
    pub time_derivative: Option<String>,
    /// The row of γ.
    pub gamma: Option<String>,
}

/// An entry of Φ_q.
#[derive(Clone, Debug)]
pub struct JacobianEntry {
    /// Index into the coordinates.
    pub coordinate: usize,
    /// ∂Φ_i/∂q_k.
    pub value: String,
}

/// A name and what it stands for.
#[derive(Clone, Debug)]
pub struct Definition {
    /// The name.
    pub name: String,
    /// Its value.
    pub value: String,
}

/// The equations of a system.
pub fn equations(derived: &Derived) -> Equations {
    let system = &derived.system;
    let mut pool = derived.pool.draft();
    let parts = NamedParts::of_rows(&mut pool, system);
    let zero = pool.graph.zero();
    let written = |bodies: &[usize], expr: ExprId| {
        let is_long = parts.meet(&pool.graph, expr);
        Printer::new(&pool, system, bodies, MathMl)
            .naming(&parts, is_long)
            .expression(expr)
    };
    let unless_zero = |row: &Row, expr: ExprId| (expr != zero).then(|| written(&row.bodies, expr));
    let names = Printer::new(&pool, system, &[], MathMl);
    let coordinates = (0..system.coordinates.len()).map(|index| {
        [
            SymbolRole::Position(index),
            SymbolRole::Rate(index),
            SymbolRole::Acceleration(index),
        ]
        .map(|role| names.symbol(role))
    });
    let coordinates = coordinates.collect();
    // In the order of the page, in which names are given: Φ, Φ_q, Φ_t, γ.
    let of_rows = |of: &dyn Fn(&Row) -> Option<String>| -> Vec<Option<String>> {
        system.rows.iter().map(of).collect()
    };
    let residuals = of_rows(&|row| Some(written(&row.bodies, row.residual)));
    let jacobians: Vec<Vec<JacobianEntry>> = system
        .rows
        .iter()
        .map(|row| {
            let entries = row.jacobian.iter().map(|entry| JacobianEntry {
                coordinate: entry.coordinate,
                value: written(&row.bodies, entry.value),
            });
            entries.collect()
        })
        .collect();
    let time_derivatives = of_rows(&|row| unless_zero(row, row.time_derivative));
    let gammas = of_rows(&|row| unless_zero(row, row.gamma));
    let columns = residuals
        .into_iter()
        .zip(jacobians)
        .zip(time_derivatives.into_iter().zip(gammas));
    let rows = system.rows.iter().zip(columns);
    let rows: Vec<Equation> = rows
        .map(
            |(row, ((residual, jacobian), (time_derivative, gamma)))| Equation {
                joint: row.joint,
                residual: residual.unwrap_or_default(),
                jacobian,
                time_derivative,
                gamma,
            },
        )
        .collect();
    let directions = system.directions.iter().map(|direction| {
        let name = match direction.cause {
            Cause::Parameter(place) => system.mechanism.parameters[place].name.clone(),
            Cause::Driver { joint, .. } => system.mechanism.joints[joint].label.clone(),
        };
        let entries = system.rows.iter().zip(&direction.column).enumerate();
        let entries =
            entries.filter_map(|(index, (row, &entry))| Some((index, unless_zero(row, entry)?)));
        (name, entries.collect())
    });
    let directions = directions.collect();
    let monitored = system.monitored.iter();
    let monitored = monitored.map(|row| (row.joint, written(&row.bodies, row.residual)));
    let monitored = monitored.collect();
    let points = system.outputs.iter().map(|output| {
        let place = output.position.map(|it| written(&[], it));
        (output.name.clone(), place)
    });
    let points = points.collect();
    let definitions = parts.definitions(&mut pool);
    let printer = Printer::new(&pool, system, &[], MathMl);
    Equations {
        coordinates,
        rows,
        monitored,
        directions,
        points,
        definitions: definitions
            .iter()
            .map(|it| Definition {
                name: printer.expression(it.name),
                value: printer.expression(it.value),
            })
            .collect(),
    }
}
