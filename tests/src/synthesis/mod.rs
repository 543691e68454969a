//! Published cases of path synthesis with a four-bar: points, bounds and the errors of others.
//!
//! The error is the sum of the squared distances from the points. Lengths have no unit in the papers and are taken for m.

mod cases;

use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use linkwright_calibrate::{
    Bounds, Candidate, SearchCounts, StartSampling, Synthesis, Target, Targets,
};
use linkwright_codegen::Read;
use linkwright_codegen::diagnostic::Source;
use linkwright_solver::Observable;

pub use cases::CASES;

/// Number of frames in which the mechanism moves.
const FRAMES: usize = 73;

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
    /// Position and angle of the ground link at the origin, so that these are not sought.
    pub is_grounded: bool,
    /// Bounds of links, and of the coordinates of pins and of the coupler point.
    pub bounds: [[f64; 2]; 2],
    /// Best published error.
    pub published: f64,
    /// Source of the published error.
    pub source: &'static str,
}

impl Case {
    /// Returns the description, with the crank turning once in 2π s about the ground link.
    pub fn text(&self) -> String {
        let drive = match (self.timing, self.seeks_start) {
            (None, _) => "theta0 + t*1rad/1s".to_string(),
            (Some(_), true) => "theta0 + theta1 + t*1rad/1s".to_string(),
            (Some([first, _]), false) => format!("theta0 + {first}deg + t*1rad/1s"),
        };
        format!(
            "mechanism four_bar {{
    param r1 = 30m;
    param r2 = 10m;
    param r3 = 30m;
    param r4 = 25m;
    param cx = 10m;
    param cy = 10m;
    param x0 = 0m;
    param y0 = 0m;
    param theta0 = 0deg;
    param theta1 = 0deg;

    point A = (x0, y0);
    point D = (x0 + r1*cos(theta0), y0 + r1*sin(theta0));
    body crank   at (x0, y0, 40deg)       {{ A: (0, 0), B: (r2, 0) }}
    body coupler at (8m, 6m, 20deg) {{ B: (0, 0), C: (r3, 0), P: (cx, cy) }}
    body rocker  at (30m, 0, 90deg)   {{ D: (0, 0), C: (r4, 0) }}
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(crank) = {drive};
}}
"
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
            sought.extend([("x0", places), ("y0", places), ("theta0", turn)]);
        }
        if self.seeks_start {
            sought.push(("theta1", turn));
        }
        let sought = sought.into_iter();
        sought.map(|(name, it)| (name.to_string(), it)).collect()
    }

    /// Returns the search of the case.
    ///
    /// # Panics
    /// If the description has errors.
    pub fn synthesis(&self, threads: usize) -> Synthesis {
        let source = Source::new("four_bar.mech", &self.text());
        let sought = self.sought();
        let names: Vec<&str> = sought.iter().map(|it| it.0.as_str()).collect();
        let derived = |names: &[&str]| {
            let read = Read::along(&source, names);
            let read = read.unwrap_or_else(|found| panic!("{}", found.render(&source)));
            read.only().expect("one motion")
        };
        let (plain, along) = (derived(&[]), derived(&names));
        let columns = ["P_x", "P_y"]
            .into_iter()
            .enumerate()
            .map(|(axis, name)| Target {
                name: name.to_string(),
                observable: Observable::named(&plain, name).expect("a point"),
                values: self.points.iter().map(|it| Some(it[axis])).collect(),
                size: 1.0,
                is_angle: false,
            });
        let times = self.timing.map(|[_, step]| {
            let rows = 0..self.points.len();
            rows.map(|row| (row as f64 * step).to_radians()).collect()
        });
        let targets = Targets {
            columns: columns.collect(),
            rows: self.points.len(),
            times,
        };
        let frames = (0..FRAMES).map(|it| TAU * it as f64 / (FRAMES - 1) as f64);
        let synthesis = Synthesis::new(&plain, &along, targets, &sought, frames.collect(), threads);
        synthesis.expect("a search")
    }

    /// Returns the best candidates.
    pub fn solved(
        &self,
        sampling: StartSampling,
        threads: usize,
    ) -> (Vec<Candidate>, SearchCounts) {
        self.synthesis(threads)
            .search(sampling, 8, &AtomicBool::new(false), &|_| ())
    }
}
