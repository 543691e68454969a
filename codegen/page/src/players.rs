//! Collects the motions of all assemblies that a page plays, as one JSON object.

use std::collections::BTreeMap;

use linkwright::math::Real;
use linkwright_codegen::stages::emit::drawing::{ActingLoads, Pose};
use linkwright_codegen::stages::emit::mathml::symbol;
use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::pool::{Pool, SymbolRole};
use linkwright_codegen::stages::system::{Described, System};
use linkwright_solver::drawn::pose;
use linkwright_solver::{Assembly, Instant, Interpreted, Modes, Schedule, View as _};
use serde::Serialize;

use super::equations::moved;
use super::forced::is_moved_by_forces;
use super::recorded::{Columns, Examination, Precision, Recorded, recorded};
use super::shown_units::{ShownUnits, grouped, shown_units};

/// Largest number of instants that are kept of the displayed motion.
const MAX_INSTANTS: usize = 1001;

/// Largest number of bytes of the motions of all other assemblies, as numbers.
const BYTES: usize = 400_000;

/// Smallest number of instants of a motion; the page interpolates between them with rates and accelerations.
const MIN_INSTANTS: usize = 21;

/// Largest number of assemblies.
const MAX_ASSEMBLIES: usize = 64;

/// Addition to the label of the assembly of the design configuration.
pub const DRAWN: &str = " as drawn";

/// Assembly that is shown first.
#[derive(Clone, Debug)]
pub struct Chosen {
    /// Label on the page.
    pub label: String,
    /// Pose and modes at the start.
    pub start: (Instant, Modes),
}

/// Data that the page plays.
#[derive(Debug, Serialize)]
pub struct Players {
    title: String,
    bodies: Vec<Body>,
    coordinates: Vec<Coordinate>,
    points: Vec<Point>,
    joints: Vec<Joint>,
    measures: Vec<String>,
    units: ShownUnits,
    /// Requested forces and measures, each with the group of its curve.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    forces: Vec<(String, String)>,
    /// True if columns hold `f64`.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    wide: bool,
    columns: Columns,
    /// Assemblies, that of the drawing first.
    pub assemblies: Vec<Player>,
}

/// Body by its number in the drawing. The ground has no coordinates, and an angle has no position.
#[derive(Debug, Serialize)]
struct Body {
    name: String,
    pose: Option<[Option<usize>; 3]>,
}

#[derive(Debug, Serialize)]
struct Coordinate {
    name: String,
    mathml: String,
    body: Option<usize>,
    /// Group of curves that the force belongs to.
    kind: &'static str,
}

/// Joint with its name in the drawing.
#[derive(Debug, Serialize)]
struct Joint {
    slug: String,
    bodies: Vec<usize>,
}

#[derive(Debug, Serialize)]
struct Point {
    name: String,
    body: usize,
    local: [f64; 2],
    /// True if no joint holds the point, whose path is then of interest.
    free: bool,
}

/// Assembly and its motion.
#[derive(Debug, Serialize)]
pub struct Player {
    /// Signs and letters of the assembly.
    pub label: String,
    /// Motion, or the reason that there is none.
    #[serde(flatten)]
    pub motion: Motion,
    /// Columns of the arrows of loads, x and y of each.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    arrows: Vec<[usize; 2]>,
    /// Elements of the drawing that differ in this assembly, by their ids.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub elements: BTreeMap<String, String>,
}

impl Player {
    /// Returns the instants that are kept of the motion.
    pub fn instants(&self) -> &[Instant] {
        match &self.motion {
            Motion::Solved(recorded) => &recorded.instants,
            Motion::None { .. } => &[],
        }
    }
}

/// Motion of an assembly.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Motion {
    /// Solved motion, which may end early.
    Solved(Recorded),
    /// No motion.
    None {
        /// Reason as a sentence.
        error: String,
    },
}

impl Players {
    /// Follows the motion of the drawing, or of a chosen assembly with its label, and those of all others that are known.
    pub fn new(
        view: &Interpreted,
        known: &[Assembly],
        schedule: &Schedule,
        chosen: Option<Chosen>,
        precision: Precision,
        examination: Examination,
    ) -> Players {
        let system = view.system();
        let mut columns = Columns::new(precision);
        let drawn = known.iter().find(|it| it.drawn);
        let label = match (&chosen, drawn) {
            (Some(chosen), _) => chosen.label.clone(),
            (None, Some(drawn)) => drawn.label() + DRAWN,
            (None, None) => DRAWN.trim_start().to_string(),
        };
        let excluded = match &chosen {
            Some(chosen) => chosen.label.clone(),
            None => drawn.map_or(String::new(), Assembly::label),
        };
        let chosen = chosen.map(|it| it.start);
        let first = recorded(
            view,
            schedule,
            chosen,
            MAX_INSTANTS,
            examination,
            &mut columns,
        );
        let mut assemblies = Vec::new();
        let mut points = Vec::new();
        if let Ok(first) = &first {
            points = self::points(view, &first.instants[0]);
        }
        assemblies.push(player(label, first));
        let others = known.iter().filter(|it| it.label() != excluded);
        let others: Vec<_> = others.take(MAX_ASSEMBLIES - 1).collect();
        let numbers = 3 * system.coordinates.len() * others.len().max(1);
        let most = (BYTES / size_of::<f32>() / numbers).clamp(MIN_INSTANTS, MAX_INSTANTS);
        for assembly in others {
            let chosen = Some((assembly.instant.clone(), assembly.modes.clone()));
            let motion = recorded(view, schedule, chosen, most, examination, &mut columns);
            assemblies.push(player(assembly.label(), motion));
        }
        arrows(view, &mut assemblies, &mut columns);
        // Forces lead through singular poses of the mechanism that is driven.
        let measures = view.measures().filter(|_| !is_moved_by_forces(view));
        Players {
            title: system.mechanism.title(),
            bodies: bodies(system),
            coordinates: coordinates(view.pool(), system),
            points,
            joints: system
                .mechanism
                .joints
                .iter()
                .map(|joint| Joint {
                    slug: joint.slug.clone(),
                    bodies: moved(joint),
                })
                .collect(),
            units: shown_units(system),
            forces: grouped(view.pool(), system),
            measures: measures.map_or(Vec::new(), |measures| {
                let parts = measures.parts();
                let several = |block| parts.iter().filter(|it| it.block == block).count() > 1;
                let named = parts.iter().map(|part| match several(part.block) {
                    true => format!("block {}.{}", part.block + 1, part.part + 1),
                    false => format!("block {}", part.block + 1),
                });
                named.collect()
            }),
            wide: columns.precision() == Precision::Double,
            columns,
            assemblies,
        }
    }

    /// Returns the first motion; `None` if there is none.
    pub fn drawn(&self) -> Option<&Recorded> {
        match &self.assemblies.first()?.motion {
            Motion::Solved(recorded) => Some(recorded),
            Motion::None { .. } => None,
        }
    }

    /// Returns the first instant of the first motion; `None` if there is none.
    pub fn first(&self) -> Option<&Instant> {
        self.drawn()?.instants.first()
    }

    /// Returns the reason that the first motion ends early or does not begin; `None` if it is complete.
    pub fn error(&self) -> Option<&str> {
        match &self.assemblies.first()?.motion {
            Motion::Solved(recorded) => recorded.error.as_deref(),
            Motion::None { error } => Some(error),
        }
    }
}

fn player(label: String, motion: Result<Recorded, String>) -> Player {
    Player {
        label: label.replace('-', "−"),
        motion: match motion {
            Ok(recorded) => Motion::Solved(recorded),
            Err(error) => Motion::None { error },
        },
        arrows: Vec::new(),
        elements: BTreeMap::new(),
    }
}

/// Records the arrows of loads in all motions, relative to the longest of all.
fn arrows(view: &Interpreted, players: &mut [Player], columns: &mut Columns) {
    let system = view.system();
    let count = system.mechanism.forces.loads.len();
    if count == 0 {
        return;
    }
    let instants = players.iter().flat_map(|it| it.instants());
    let poses: Vec<Pose> = instants.map(|it| pose(view, it)).collect();
    let acting = ActingLoads::new(view.pool(), system).arrows(&poses);
    let mut rest = &acting[..];
    for player in players {
        let (own, others) = rest.split_at(player.instants().len());
        rest = others;
        if own.is_empty() {
            continue;
        }
        let column = |load: usize| {
            [0, 1].map(|axis| columns.place(own.iter().map(|arrows| arrows[load][axis])))
        };
        player.arrows = (0..count).map(column).collect();
    }
}

fn bodies(system: &System) -> Vec<Body> {
    let place = |body: usize, axis: usize| {
        let coordinate = Described::Pose { body, axis };
        system
            .coordinates
            .iter()
            .position(|it| it.describes == coordinate)
    };
    let bodies = system.mechanism.bodies.iter().enumerate();
    bodies
        .map(|(body, own)| Body {
            name: own.name.clone(),
            pose: match [0, 1, 2].map(|axis| place(body, axis)) {
                [.., None] => None,
                pose => Some(pose),
            },
        })
        .collect()
}

fn coordinates(pool: &Pool, system: &System) -> Vec<Coordinate> {
    let coordinates = system.coordinates.iter().enumerate();
    coordinates
        .map(|(place, own)| Coordinate {
            name: own.name.clone(),
            mathml: symbol(pool, system, SymbolRole::Position(place)),
            body: own.describes.body(),
            kind: match own.quantity {
                Quantity::Angle => "angles",
                Quantity::Length => "lengths",
                Quantity::Power(_) => "contacts",
            },
        })
        .collect()
}

/// Returns the points by their positions in the frames of their bodies.
fn points(view: &Interpreted, instant: &Instant) -> Vec<Point> {
    let system = view.system();
    let bodies = bodies(system);
    let mechanism = &system.mechanism;
    let motions = view.points(instant);
    let declared = mechanism.points.iter().zip(motions);
    declared
        .map(|(point, motion)| {
            let body = point.mark.frame.body.0;
            let [x, y] = motion.position;
            let local = match bodies[body].pose {
                Some([Some(at_x), Some(at_y), Some(angle)]) => {
                    let q = instant.q();
                    let (sine, cosine) = Real::sin_cos(q[angle]);
                    let [x, y] = [x - q[at_x], y - q[at_y]];
                    [cosine * x + sine * y, cosine * y - sine * x]
                }
                _ => [x, y],
            };
            let held = mechanism.joints.iter().flat_map(|it| &it.operands.marks);
            let mut held = held.filter(|it| it.frame.body == point.mark.frame.body);
            Point {
                name: point.name.clone(),
                body,
                local,
                free: body > 0 && held.all(|it| it.local != point.mark.local),
            }
        })
        .collect()
}
