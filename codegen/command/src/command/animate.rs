//! Draws the motion of a description as an animation, an SVG or a GIF.

use linkwright_codegen::stages::emit::drawing::{Animation, Options};
use linkwright_solver::Schedule;

use super::animation_format::AnimationFormat;
use super::description::{determined, interpreted, outputs, set_all, source};
use super::draw::{Frames, follow, frames, is_stdout, path};
use super::{Outcome, Problem, print, say};
use crate::arguments::Draw;
use crate::report::drawing::tick_steps;
use linkwright_page::motion;

/// Smallest interval between two pictures, in s: 25 per second.
const INTERVAL: f64 = 0.04;

/// Largest number of pictures of an animation.
const PICTURES: usize = 250;

/// Draws the motion.
///
/// # Errors
/// The description has errors, an option cannot be used, or the picture cannot be written. An [`Outcome`] reports a mechanism that
/// cannot be assembled or whose motion ends early.
pub fn run(arguments: &Draw) -> Result<Outcome, Problem> {
    let format = AnimationFormat::of(arguments)?;
    let refused = |text: String| Problem(format!("error: {text}"));
    let source =
        source(&arguments.described.file)?.reported_in(arguments.reported_in.units.clone());
    let derived = determined(&source, arguments.described.motion.as_deref())?;
    let derived = set_all(derived, &arguments.setting.set)?;
    let options = Options {
        size: arguments.size,
        frames: frames(&derived.system, &arguments.frame)?,
        caption: derived.system.mechanism.title(),
        ..Options::default()
    };
    let points = match arguments.paths.is_empty() {
        true => Vec::new(),
        false => motion::points(&derived.system, &arguments.paths).map_err(refused)?,
    };
    let (from, to, step) = (arguments.from, arguments.to, arguments.step);
    let schedule = Schedule::range(from, to, step).map_err(refused)?;
    let path = path(arguments, &derived.system);
    let output = match is_stdout(&path) {
        true => None,
        false => {
            let mut outputs = outputs(&arguments.described.file, &source, arguments.force);
            Some(outputs.file(&path, format.signature)?)
        }
    };
    let view = interpreted(&derived, &source)?;
    let every = ((INTERVAL / step).round() as usize)
        .max(schedule.wanted().div_ceil(PICTURES))
        .max(1);
    let mut kept = Frames::new(every);
    let error = follow(arguments, &view, points.clone(), &schedule, &mut kept)?;
    if let Some(error) = &error {
        say(&format!(
            "error: `{}` {error}",
            derived.system.mechanism.title()
        ));
    }
    let paths = kept.paths(&derived.system, &points, tick_steps(to - from, step));
    let animation = Animation::new(
        &derived.pool,
        &derived.system,
        &kept.poses(&view),
        &paths,
        &options,
    );
    let Some(animation) = animation else {
        return Ok(Outcome::Failed);
    };
    let bytes = (format.encode)(&animation, every as f64 * step)?;
    match output {
        None => print(|output| output.write_all(&bytes))?,
        Some(output) => {
            output.write(|output| output.write_all(&bytes))?;
            print(|output| writeln!(output, "wrote {}", path.display()))?;
        }
    }
    Ok(match error {
        None => Outcome::Done,
        Some(_) => Outcome::Failed,
    })
}
