//! Solves published cases of path synthesis with a four-bar, and certifies the designs.
//!
//! The error is the sum of the squared distances from the points, computed by a closed form of its own. Lengths have no unit in the papers and
//! are taken for m.

mod cases;
mod closed_form;

use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use linkwright::Branch;
use linkwright_calibrate::{Bounds, Candidate, StartSampling, Synthesis, Target, Targets};
use linkwright_codegen::Read;
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::proof::Proof;
use linkwright_solver::{Check, Interpreted, Observable, Schedule};

pub use cases::CASES;
pub use closed_form::{Design, Pose};

/// Number of frames in which the mechanism moves.
const FRAMES: usize = 73;

/// Time between frames of a certificate (s), at a rate of one radian in a second.
const STEP: f64 = 0.01;

/// Published case.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Name in reports.
    pub name: &'static str,
    /// Points to pass.
    pub points: &'static [[f64; 2]],
    /// Angle of the crank at the first point, and from point to point (deg); `None` if points are passed in their order only.
    pub timing: Option<[f64; 2]>,
    /// True if the angle at the first point is sought, too.
    pub seeks_start: bool,
    /// True if the ground link is fixed at the origin along x.
    pub is_grounded: bool,
    /// Bounds of links, and of the coordinates of pins and of the coupler point.
    pub bounds: [[f64; 2]; 2],
    /// True if there are as many unknowns as equations, so that points can be passed exactly.
    pub is_exact: bool,
    /// Best published design.
    pub published: Published,
}

/// Published design.
#[derive(Clone, Copy, Debug)]
pub struct Published {
    /// Authors and year.
    pub source: &'static str,
    /// Design.
    pub design: Design,
    /// Angles of the crank at the points (rad), if they were sought; the first one if only that was.
    pub angles: &'static [f64],
}

/// Solution of a case.
pub struct Solved {
    /// Candidate.
    pub candidate: Candidate,
    /// Its design.
    pub design: Design,
    /// Angles of the crank against the ground link at the points (rad).
    pub angles: Vec<f64>,
    /// Sum of squared distances by the closed form.
    pub error: f64,
}

/// Certificate of a design over a full turn.
pub struct Certificate {
    /// Check.
    pub check: Check,
    /// Proof.
    pub proof: Proof,
}

impl Case {
    /// Returns the angles of the crank at the points, the first of which is `first` if it is sought (rad).
    fn angles(&self, first: f64) -> Option<Vec<f64>> {
        let [start, step] = self.timing?;
        let start = if self.seeks_start {
            first
        } else {
            start.to_radians()
        };
        let rows = 0..self.points.len();
        Some(
            rows.map(|row| start + (row as f64 * step).to_radians())
                .collect(),
        )
    }

    /// Returns the error of the published design, by the closed form.
    pub fn published_error(&self) -> f64 {
        let Published { design, angles, .. } = self.published;
        let first = angles.first().copied().unwrap_or(0.0);
        let angles = self.angles(first).unwrap_or_else(|| angles.to_vec());
        design.error(self, &angles)
    }

    /// Returns the description of a design, whose crank turns once in 2π s about the ground link, in the pose of an angle of the crank.
    fn text(&self, design: &Design, start: f64, pose: &Pose) -> String {
        let [r1, r2, r3, r4] = design.links;
        let [cx, cy] = design.point;
        let [x0, y0, tilt] = design.ground;
        let (turned, pin) = (tilt + start, [tilt.cos(), tilt.sin()].map(|it| it * r1));
        format!(
            "mechanism four_bar {{
    param r1 = {r1}m;
    param r2 = {r2}m;
    param r3 = {r3}m;
    param r4 = {r4}m;
    param cx = {cx}m;
    param cy = {cy}m;
    param x0 = {x0}m;
    param y0 = {y0}m;
    param tilt = {tilt}rad;
    param start = {start}rad;

    point A = (x0, y0), D = (x0 + r1*cos(tilt), y0 + r1*sin(tilt));
    body crank at ({x0}m, {y0}m, {turned}rad) {{ A: (0, 0), B: (r2, 0) }}
    body coupler at ({}m, {}m, {}rad) {{ B: (0, 0), C: (r3, 0), P: (cx, cy) }}
    body rocker at ({}m, {}m, {}rad) {{ D: (0, 0), C: (r4, 0) }}
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(crank) = tilt + start + t*1rad/1s;
}}
",
            x0 + r2 * turned.cos(),
            y0 + r2 * turned.sin(),
            tilt + pose.coupler,
            x0 + pin[0],
            y0 + pin[1],
            tilt + pose.rocker,
        )
    }

    /// Returns the bounds of the sought parameters.
    fn sought(&self) -> Vec<(String, Bounds)> {
        let [links, places] = self.bounds.map(|[low, high]| Bounds { low, high });
        let turn = Bounds {
            low: 0.0,
            high: TAU,
        };
        let mut sought = vec![("r1", links), ("r2", links), ("r3", links), ("r4", links)];
        sought.extend([("cx", places), ("cy", places)]);
        if !self.is_grounded {
            sought.extend([("x0", places), ("y0", places), ("tilt", turn)]);
        }
        if self.seeks_start {
            sought.push(("start", turn));
        }
        let sought = sought.into_iter();
        sought.map(|(name, it)| (name.to_string(), it)).collect()
    }

    /// Returns the search of the case.
    fn synthesis(&self, threads: usize) -> Synthesis {
        let start = self.angles(0.0).map_or(0.0, |it| it[0]);
        let initial = Design {
            links: [30.0, 10.0, 30.0, 25.0],
            point: [10.0, 10.0],
            ground: [0.0; 3],
        };
        let pose = initial.pose(start, 1.0).expect("a crank-rocker");
        let source = Source::new("four_bar.mech", self.text(&initial, start, &pose));
        let sought = self.sought();
        let names: Vec<&str> = sought.iter().map(|it| it.0.as_str()).collect();
        let (plain, along) = (derived(&source, &[]), derived(&source, &names));
        let columns = ["P_x", "P_y"].into_iter().enumerate();
        let columns = columns.map(|(axis, name)| Target {
            name: name.to_string(),
            observable: Observable::named(&plain, name).expect("a point"),
            values: self.points.iter().map(|it| Some(it[axis])).collect(),
            size: 1.0,
            is_angle: false,
        });
        let times = self.angles(0.0);
        let times = times.map(|it| it.iter().map(|angle| angle - it[0]).collect());
        let targets = Targets {
            columns: columns.collect(),
            rows: self.points.len(),
            times,
        };
        let frames = (0..FRAMES).map(|it| TAU * it as f64 / (FRAMES - 1) as f64);
        let frames = frames.collect();
        let synthesis = Synthesis::new(&plain, &along, targets, &sought, frames, threads);
        synthesis.expect("a search")
    }

    /// Returns the best solution among minima of `most` fits; `None` if none is found.
    ///
    /// # Panics
    /// If the description of the case has errors.
    pub fn solved(&self, sampling: StartSampling, most: usize, threads: usize) -> Option<Solved> {
        let synthesis = self.synthesis(threads);
        let stop = AtomicBool::new(false);
        let (candidates, _) = synthesis.search(sampling, most, &stop, &|_| ());
        let candidate = candidates.into_iter().next()?;
        let value = |name: &str| {
            let place = synthesis.names().iter().position(|it| it == name);
            place.map_or(0.0, |it| candidate.values[it])
        };
        let design = Design {
            links: ["r1", "r2", "r3", "r4"].map(value),
            point: ["cx", "cy"].map(value),
            ground: ["x0", "y0", "tilt"].map(value),
        };
        let angles = self.angles(value("start"));
        let angles = angles.unwrap_or_else(|| candidate.times.clone());
        Some(Solved {
            error: design.error(self, &angles),
            candidate,
            design,
            angles,
        })
    }

    /// Returns the certificate of a solution over a full turn of its crank.
    ///
    /// # Panics
    /// If the design cannot be assembled at its first point.
    pub fn certificate(&self, solved: &Solved) -> Certificate {
        let start = solved.angles[0];
        let side = match solved.candidate.modes.closed[0] {
            Branch::Positive => -1.0,
            Branch::Negative => 1.0,
        };
        let pose = solved.design.pose(start, side).expect("an assembly");
        let source = Source::new("four_bar.mech", self.text(&solved.design, start, &pose));
        let interpreted = Interpreted::new(&derived(&source, &[])).expect("an order");
        let schedule = Schedule::whole(0.0, TAU, STEP).expect("a range");
        let check = Check::new(interpreted, &schedule, |_| ());
        let proof = check.prove(&schedule, &[]);
        Certificate { check, proof }
    }
}

/// Returns the equations with the sensitivities to these parameters.
fn derived(source: &Source, names: &[&str]) -> Derived {
    let read = Read::along(source, names);
    let read = read.unwrap_or_else(|found| panic!("{}", found.render(source)));
    read.only().expect("one motion")
}
