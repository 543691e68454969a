//! Describes the null space of Φ_q as free motions of bodies.
//!
//! Each free motion leaves as many coordinates as possible at rest: its coordinates are a smallest dependent set of columns.
//! Angles come last, and later bodies before earlier ones, so that a motion rotates a single body if possible. A rotation is
//! described by the instantaneous center of rotation, which is named only if it is the center in every pose.

use std::cmp::Reverse;

use linkwright_math::double;

use super::balanced;
use super::functions::{Functions, Pose};
use super::independence::Basis;
use crate::expr::Tape;
use crate::joint::Quantity;
use crate::joint::geometry::Vector;
use crate::pool::Pool;
use crate::system::{Described, System};

/// Tolerance of a center or a direction, in characteristic lengths.
const MET: f64 = 1e-6;

/// Independent motion that the equations allow at an instant.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeMotion {
    /// Body that leads the motion: an index into the mechanism's bodies. `None` if only a contact moves along its curve.
    pub leader: Option<usize>,
    /// Motion of the leader.
    pub moves: Moves,
    /// Other bodies that move with the leader, in written order.
    pub others: Vec<usize>,
}

/// Instantaneous motion of a body.
#[derive(Clone, Debug, PartialEq)]
pub enum Moves {
    /// Rotation about this point of the body.
    About(String),
    /// Rotation about its origin.
    AboutOrigin,
    /// Rotation about a point without a name.
    Turning,
    /// Translation along the line of a joint, named as by the joint.
    Along(String),
    /// Translation in this direction, a unit vector in the design configuration.
    Toward([f64; 2]),
    /// Motion along the curve of this joint: an index into the mechanism's joints.
    Contact(usize),
}

/// Motion of the whole mechanism: rates of all coordinates, in their units.
type Rates = Vec<f64>;

/// Returns the motions that all of these poses allow.
pub(super) fn free_motions(
    pool: &Pool,
    system: &System,
    functions: &Functions<'_>,
    poses: &[Pose],
) -> Vec<FreeMotion> {
    let null_spaces: Vec<Vec<(usize, Rates)>> = poses
        .iter()
        .map(|pose| null_vectors(system, functions, pose))
        .collect();
    let Some(first) = null_spaces.first() else {
        return Vec::new();
    };
    // Poses with other free coordinates do not apply to these motions.
    let alike: Vec<(&Pose, &Vec<(usize, Rates)>)> = poses
        .iter()
        .zip(&null_spaces)
        .filter(|(_, own)| {
            let columns = own.iter().map(|motion| motion.0);
            columns.eq(first.iter().map(|motion| motion.0))
        })
        .collect();
    let described = (0..first.len()).map(|place| {
        let instants: Vec<(&Pose, &Rates)> = alike
            .iter()
            .map(|(pose, own)| (*pose, &own[place].1))
            .collect();
        described(pool, system, &instants)
    });
    described.collect()
}

/// Returns the point about which a body rotates in the only motion of these poses, while another body rests. `None` if there are
/// several motions, or if the body moves otherwise.
pub(super) fn pivot(
    pool: &Pool,
    system: &System,
    functions: &Functions<'_>,
    poses: &[Pose],
    [body, resting]: [usize; 2],
) -> Option<Vector> {
    let mut instants = Vec::with_capacity(poses.len());
    for pose in poses {
        let [(_, rates)] = &null_vectors(system, functions, pose)[..] else {
            return None;
        };
        instants.push((pose, rates.clone()));
    }
    let instants: Vec<(&Pose, &Rates)> = instants
        .iter()
        .map(|(pose, rates)| (*pose, rates))
        .collect();
    let rests = |instant: &(&Pose, &Rates)| {
        let [x, y, turning] = of_body(system, resting, *instant).map(|[_, rate]| rate);
        let length = system.mechanism.characteristic_length;
        x.hypot(y).hypot(length * turning) <= MET * length
    };
    if instants.is_empty() || !instants.iter().all(rests) {
        return None;
    }
    match movement(pool, system, body, &instants) {
        Moves::About(name) => {
            let mut marks = system.mechanism.bodies[body].marks.iter();
            marks
                .find(|named| named.name == name)
                .map(|named| named.mark.local)
        }
        Moves::AboutOrigin => Some([pool.graph.zero(); 2]),
        Moves::Turning | Moves::Along(_) | Moves::Toward(_) | Moves::Contact(_) => None,
    }
}

/// Returns, for each free coordinate, the motion in which this coordinate has the rate of its scale and the other free ones rest.
fn null_vectors(system: &System, functions: &Functions<'_>, pose: &Pose) -> Vec<(usize, Rates)> {
    let (rows, factors) = balanced(functions.jacobian(pose));
    let columns = functions.columns.len();
    let mut order: Vec<usize> = (0..columns).collect();
    order.sort_by_key(|&at| {
        let coordinate = &system.coordinates[at];
        let is_angle = coordinate.quantity == Quantity::Angle;
        (coordinate.describes.body().is_none(), is_angle, Reverse(at))
    });
    let mut basis = Basis::default();
    let mut motions = Vec::new();
    for at in order {
        let column: Vec<f64> = rows.iter().map(|row| row[at]).collect();
        if let Err(parts) = basis.take(at, &column) {
            let mut rates = vec![0.0; columns];
            rates[at] = 1.0;
            for (other, factor) in parts {
                rates[other] = -factor * factors[other] / factors[at];
            }
            for (column, rate) in rates.iter_mut().enumerate() {
                *rate *= functions.column_scale(column);
            }
            motions.push((at, rates));
        }
    }
    motions.sort_by_key(|motion| motion.0);
    motions
}

/// Returns x, y and φ of a body, and their rates.
fn of_body(system: &System, body: usize, instant: (&Pose, &Rates)) -> [[f64; 2]; 3] {
    let (pose, rates) = instant;
    std::array::from_fn(|axis| {
        let declared = &system.mechanism.bodies[body];
        match declared.coordinates[axis] {
            Some(it) => [pose.symbols[it.symbol.index()], rates[it.place]],
            None => [0.0; 2],
        }
    })
}

fn described(pool: &Pool, system: &System, instants: &[(&Pose, &Rates)]) -> FreeMotion {
    let (_, rates) = instants[0];
    let mut bodies: Vec<usize> = Vec::new();
    let mut contact = None;
    for (coordinate, rate) in system.coordinates.iter().zip(rates) {
        if *rate == 0.0 {
            continue;
        }
        match coordinate.describes {
            Described::Pose { body, .. } if !bodies.contains(&body) => bodies.push(body),
            Described::Pose { .. } | Described::Auxiliary => {}
            Described::Contact { joint } => contact = Some(joint),
        }
    }
    let moves: Vec<Moves> = bodies
        .iter()
        .map(|&body| movement(pool, system, body, instants))
        .collect();
    // A body that turns about a pin leads before a body that slides on a line.
    let rank = |moves: &Moves| match moves {
        Moves::About(_) => 0,
        Moves::Along(_) => 1,
        Moves::AboutOrigin => 2,
        Moves::Toward(_) | Moves::Contact(_) => 3,
        Moves::Turning => 4,
    };
    let leader = (0..bodies.len()).min_by_key(|&place| rank(&moves[place]));
    match leader {
        Some(place) => FreeMotion {
            leader: Some(bodies[place]),
            moves: moves[place].clone(),
            others: bodies
                .iter()
                .copied()
                .filter(|&body| body != bodies[place])
                .collect(),
        },
        None => FreeMotion {
            leader: None,
            moves: Moves::Contact(contact.unwrap_or_default()),
            others: Vec::new(),
        },
    }
}

fn movement(pool: &Pool, system: &System, body: usize, instants: &[(&Pose, &Rates)]) -> Moves {
    let length = system.mechanism.characteristic_length;
    let turns = |instant: &(&Pose, &Rates)| {
        let [[_, x], [_, y], [_, turning]] = of_body(system, body, *instant);
        turning.abs() * length > MET * x.hypot(y)
    };
    if instants.iter().all(turns) {
        let is_centre = |local: Vector| {
            instants.iter().all(|&instant| {
                let [[_, x], [_, y], [angle, turning]] = of_body(system, body, instant);
                let [[px, py]] = [values(pool, local, instant.0)];
                // The point p rests where ṙ + φ̇ Ω R p = 0.
                let (sine, cosine) = double::sin_cos(angle);
                let (ax, ay) = (cosine * px - sine * py, sine * px + cosine * py);
                let rest = (x - turning * ay).hypot(y + turning * ax);
                rest <= MET * length * turning.abs()
            })
        };
        let marks = &system.mechanism.bodies[body].marks;
        if let Some(named) = marks.iter().find(|named| is_centre(named.mark.local)) {
            return Moves::About(named.name.clone());
        }
        let zero = pool.graph.zero();
        if is_centre([zero, zero]) {
            return Moves::AboutOrigin;
        }
        return Moves::Turning;
    }
    let direction = |&instant: &(&Pose, &Rates)| {
        let [[_, x], [_, y], _] = of_body(system, body, instant);
        let size = x.hypot(y);
        [x / size, y / size]
    };
    let along = system.mechanism.joints.iter().find(|joint| {
        let concerns = joint
            .operands
            .marks
            .iter()
            .any(|mark| mark.frame.body.0 == body);
        let axis = joint.operands.axis.filter(|_| concerns);
        axis.is_some_and(|axis| {
            instants.iter().all(|instant| {
                let [ux, uy] = values(pool, axis.turned, instant.0);
                let [x, y] = direction(instant);
                (ux * y - uy * x).abs() <= MET
            })
        })
    });
    let line = along.and_then(|joint| joint.label.split_once(" along "));
    match line {
        Some((_, line)) => Moves::Along(line.to_string()),
        None => Moves::Toward(direction(&instants[0])),
    }
}

/// Returns the value of a vector in a pose.
fn values(pool: &Pool, vector: Vector, pose: &Pose) -> [f64; 2] {
    let mut values = [0.0; 2];
    Tape::new(&pool.graph, &vector).evaluate(&pose.symbols, &mut Vec::new(), &mut values);
    values
}
