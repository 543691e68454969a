//! Draws a mechanism at an instant, as an SVG, a PNG or a DXF.

use std::io;
use std::path::{Path, PathBuf};

use linkwright_codegen::diagnostic::{Source, nearest};
use linkwright_codegen::stages::emit::drawing::{self, Options, Pose, Traced, Undrawable};
use linkwright_codegen::stages::system::{Derived, System};
use linkwright_solver::drawn::pose;
use linkwright_solver::opened::{Unopened, names};
use linkwright_solver::{Instant, Interpreted, Schedule};

use super::description::{
    chosen, determined, interpreted, motions, outputs, set_all, source, unopened,
};
use super::picture_format::{PictureFormat, Printer};
use super::{Outcome, Problem, print, say};
use crate::arguments::Draw;
use crate::progress::Progress;
use crate::report::drawing::{tick_steps, traced};
use crate::report::dxf::signed;
use linkwright_page::motion::{self, Followed, Shown, Sink, Wanted};

/// Largest number of poses for which a drawing has room, besides the displayed one.
const POSES: usize = 200;

/// Largest number of positions on a path.
const PLACES: usize = 2000;

/// Draws the mechanism.
///
/// # Errors
/// The description has errors, an option cannot be used, or the picture cannot be written. An [`Outcome`] reports a mechanism that
/// cannot be assembled or whose motion ends before the requested time.
pub fn run(arguments: &Draw) -> Result<Outcome, Problem> {
    let format = PictureFormat::of(arguments)?;
    let source =
        source(&arguments.described.file)?.reported_in(arguments.reported_in.units.clone());
    let motion = arguments.described.motion.as_deref();
    let derived = match arguments.initial_estimate {
        false => determined(&source, motion)?,
        true => {
            let mut all = motions(&source, motion)?;
            if all.len() > 1 {
                return Err(unopened(&Unopened::Several(names(&all)), &source));
            }
            // A description has at least one motion.
            all.remove(0)
        }
    };
    let derived = set_all(derived, &arguments.setting.set)?;
    let mut options = Options {
        size: arguments.size,
        frames: frames(&derived.system, &arguments.frame)?,
        caption: derived.system.mechanism.title(),
        has_dimensions: arguments.dimensions,
        ..Options::default()
    };
    let path = path(arguments, &derived.system);
    let output = match is_stdout(&path) {
        true => None,
        false => {
            let mut outputs = outputs(&arguments.described.file, &source, arguments.force);
            Some(outputs.file(&path, format.signature)?)
        }
    };
    let mut solved = match arguments.initial_estimate {
        true => Solved {
            shown: Some(Pose::drawn(&derived.pool, &derived.system)),
            ..Solved::default()
        },
        false => solved(arguments, &source, &derived)?,
    };
    if let Some(error) = &solved.error {
        say(&format!(
            "error: `{}` {error}",
            derived.system.mechanism.title()
        ));
    }
    let Some(shown) = solved.shown.take() else {
        return Ok(Outcome::Failed);
    };
    let bodies = derived.system.mechanism.moving_bodies().iter();
    let mut shapeless = bodies.filter(|body| !body.is_angle() && body.marks.is_empty());
    if let Some(body) = shapeless.next() {
        say(&format!(
            "warning: body `{}` has no points, so that it has no shape in the picture\n  = help: {}",
            body.name,
            motion::named_point(&derived.system)
        ));
    }
    match arguments.links {
        true => options.caption = format!("links of {}", options.caption),
        false => options.caption += &solved.caption,
    }
    let bytes = match format.printer {
        Printer::Picture(encode) => {
            let svg = svg(arguments, &derived, &shown, &solved, &options)?;
            encode(&svg, arguments.size.is_some())?
        }
        Printer::Dxf => dxf(arguments, &derived, &shown, &solved, &options)?.into_bytes(),
    };
    match output {
        None => print(|output| output.write_all(&bytes))?,
        Some(output) => {
            output.write(|output| output.write_all(&bytes))?;
            print(|output| writeln!(output, "wrote {}", path.display()))?;
        }
    }
    Ok(match solved.error {
        None => Outcome::Done,
        Some(_) => Outcome::Failed,
    })
}

fn svg(
    arguments: &Draw,
    derived: &Derived,
    shown: &Pose,
    solved: &Solved,
    options: &Options,
) -> Result<String, Problem> {
    let Derived { pool, system } = derived;
    match arguments.links {
        true => drawing::links(pool, system, shown, options).ok_or_else(|| linkless(system)),
        false => {
            let (others, paths) = (&solved.others, &solved.paths);
            Ok(drawing::draw(pool, system, shown, others, paths, options))
        }
    }
}

fn dxf(
    arguments: &Draw,
    derived: &Derived,
    shown: &Pose,
    solved: &Solved,
    options: &Options,
) -> Result<String, Problem> {
    let Derived { pool, system } = derived;
    let undrawable = |reason: Undrawable| {
        Problem(format!(
            "error: cannot draw `{}` as a DXF: {reason}\n  = help: check the units and the exponents of the description",
            system.mechanism.title()
        ))
    };
    let drawing = match arguments.links {
        true => drawing::links_dxf(pool, system, shown, options)
            .map_err(undrawable)?
            .ok_or_else(|| linkless(system))?,
        false => {
            let (others, paths) = (&solved.others, &solved.paths);
            drawing::dxf(pool, system, shown, others, paths, options).map_err(undrawable)?
        }
    };
    Ok(signed(&drawing))
}

/// Returns the error of `--links` for a mechanism without links.
fn linkless(system: &System) -> Problem {
    Problem(format!(
        "error: `{}` has no links to draw: none of its bodies has a point\n  = help: {}",
        system.mechanism.title(),
        motion::named_point(system)
    ))
}

/// Contents of a drawing.
#[derive(Default)]
struct Solved {
    shown: Option<Pose>,
    others: Vec<Pose>,
    paths: Vec<Traced>,
    /// Caption behind the name.
    caption: String,
    /// Reason that the mechanism cannot be assembled, or that its motion ends early; `None` without such a failure.
    error: Option<String>,
}

fn solved(arguments: &Draw, source: &Source, derived: &Derived) -> Result<Solved, Problem> {
    let system = &derived.system;
    let refused = |text: String| Problem(format!("error: {text}"));
    let points = match arguments.paths.is_empty() {
        true => Vec::new(),
        false => motion::points(system, &arguments.paths).map_err(refused)?,
    };
    let at = arguments.at.unwrap_or(arguments.from);
    let (from, to, step) = (arguments.from, arguments.to, arguments.step);
    let schedule = Schedule::instants(from, &[at], step).map_err(refused)?;
    let whole = match points.is_empty() {
        true => None,
        false => Some(Schedule::range(from, to, step).map_err(refused)?),
    };
    let view = interpreted(derived, source)?;
    let mut frames = Frames::new(1);
    let error = follow(arguments, &view, Vec::new(), &schedule, &mut frames)?;
    let mut solved = Solved {
        shown: frames.poses(&view).pop(),
        caption: format!(", t = {at} s"),
        error,
        ..Solved::default()
    };
    if let (Some(whole), None) = (whole, &solved.error) {
        let ticks = tick_steps(to - from, step);
        let mut frames = Frames::new((whole.wanted() / POSES).max(1));
        solved.error = follow(arguments, &view, points.clone(), &whole, &mut frames)?;
        solved.others = frames.poses(&view);
        solved.paths = frames.paths(system, &points, ticks);
        solved.caption += &format!(", ticks every {} s", rounded(ticks as f64 * step));
    }
    Ok(solved)
}

/// Removes the rounding of a product from a time.
fn rounded(time: f64) -> f64 {
    format!("{time:.12e}").parse().unwrap_or(time)
}

/// Follows the motion and returns the reason of an early end; `None` if the motion is complete.
pub(super) fn follow(
    arguments: &Draw,
    view: &Interpreted,
    points: Vec<usize>,
    schedule: &Schedule,
    frames: &mut Frames,
) -> Result<Option<String>, Problem> {
    let start = chosen(&arguments.setting.branch, view, schedule.start.t)?;
    let selection = Wanted {
        points,
        ..Wanted::default()
    };
    let mut progress = Progress::new(schedule.visits());
    let mut motion = Followed::new(view.clone(), selection, schedule.start.t, start);
    let followed = motion.follow(schedule, &mut [frames], |count| progress.reached(count));
    progress.finish();
    followed.map_err(Problem::of)?;
    Ok(motion.error)
}

/// Instants of a motion, as many as a drawing needs.
pub(super) struct Frames {
    /// Stride of the instants that are kept.
    every: usize,
    count: usize,
    instants: Vec<Instant>,
    /// Positions of the selected points at every instant.
    places: Vec<Vec<[f64; 2]>>,
}

impl Frames {
    pub fn new(every: usize) -> Frames {
        Frames {
            every,
            count: 0,
            instants: Vec::new(),
            places: Vec::new(),
        }
    }

    pub fn poses(&self, view: &Interpreted) -> Vec<Pose> {
        let instants = self.instants.iter();
        instants.map(|instant| pose(view, instant)).collect()
    }
}

impl Frames {
    /// Returns the paths of these points, with a tick at every `ticks`-th instant.
    pub fn paths(&self, system: &System, points: &[usize], ticks: usize) -> Vec<Traced> {
        let every = (self.places.len() / PLACES).max(1);
        let path = |(place, point): (usize, &usize)| {
            let places: Vec<[f64; 2]> = self.places.iter().map(|it| it[place]).collect();
            let mut path = traced(&system.outputs[*point].name, &places, ticks);
            // Ticks are placed before positions are left out.
            path.points = path.points.into_iter().step_by(every).collect();
            path
        };
        points.iter().enumerate().map(path).collect()
    }
}

impl Sink for Frames {
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()> {
        if self.count.is_multiple_of(self.every) {
            self.instants.push(shown.instant.clone());
        }
        self.count += 1;
        let places = shown.motions.iter().map(|motion| motion.position);
        self.places.push(places.collect());
        Ok(())
    }
}

/// Returns the bodies of these names.
pub(super) fn frames(system: &System, names: &[String]) -> Result<Vec<usize>, Problem> {
    let bodies = &system.mechanism.bodies;
    let known = || bodies.iter().map(|body| body.name.as_str());
    let mut indices = Vec::new();
    for name in names {
        match known().position(|it| it == name) {
            Some(body) if indices.contains(&body) => {}
            Some(body) => indices.push(body),
            None => {
                let guess = match nearest(name, known()) {
                    Some(guess) => format!("; did you mean `{guess}`?"),
                    None => String::new(),
                };
                let list: Vec<&str> = known().collect();
                return Err(Problem(format!(
                    "error: no body `{name}` in `{}`{guess}\n  its bodies are: {}",
                    system.mechanism.name,
                    list.join(", ")
                )));
            }
        }
    }
    Ok(indices)
}

/// Returns the path of the picture's file.
pub(super) fn path(arguments: &Draw, system: &System) -> PathBuf {
    if let Some(path) = &arguments.out {
        return path.clone();
    }
    let mechanism = &system.mechanism;
    let motion = mechanism.motion.as_ref();
    let motion = motion.map_or(String::new(), |motion| format!("_{}", motion.name));
    // An animation or a sheet of links does not replace a picture.
    let moving = match (arguments.animate, arguments.links) {
        (true, _) => "_animated",
        (false, true) => "_links",
        (false, false) => "",
    };
    let ending = if arguments.png { "png" } else { "svg" };
    PathBuf::from(format!("{}{motion}{moving}.{ending}", mechanism.name))
}

pub(super) fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}
