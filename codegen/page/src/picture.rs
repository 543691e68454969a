//! Draws the mechanism of a page, for scripts that move it.

use linkwright_codegen::stages::emit::drawing::{self, Gap, Options, Pose};
use linkwright_solver::drawn::pose;
use linkwright_solver::open_loop::open_loop;
use linkwright_solver::{Interpreted, View as _};

use super::compact::dense;
use super::number::number;
use super::players::{Player, Players};

/// Largest number of poses that guides are made long enough for.
const POSES: usize = 200;

/// Draws the mechanism at the start, `t` (s), with room for the whole motion, and gives each other assembly the elements that differ.
///
/// With a `scale` (pixels per metre) it draws the first instant alone: a picture of a moment while a control moves.
pub fn picture(view: &Interpreted, players: &mut Players, t: f64, scale: Option<f64>) -> String {
    let system = view.system();
    let motion = |player: &Player| -> Vec<Pose> {
        let instants = match scale {
            None => player.instants(),
            Some(_) => &player.instants()[..player.instants().len().min(1)],
        };
        let every = instants.len().div_ceil(POSES).max(1);
        let kept = instants.iter().step_by(every);
        kept.map(|it| pose(view, it)).collect()
    };
    let mut motions: Vec<Vec<Pose>> = players.assemblies.iter().map(motion).collect();
    let mut first = motions.remove(0).into_iter();
    let mut gap = None;
    let pose = first.next().unwrap_or_else(|| {
        let Some(open) = open_loop(view, t) else {
            return Pose::drawn(view.pool(), system);
        };
        let unit = system.mechanism.units.of_messages().of("m");
        gap = Some(Gap {
            ends: open.ends,
            text: format!("{} {}", number(unit.of_si(open.distance())), unit.name),
            title: format!(
                "the loop does not close at {}",
                system.mechanism.joints[open.joint].label
            ),
        });
        open.pose(view.pool())
    });
    let others: Vec<Pose> = first.collect();
    let options = Options {
        gap,
        scale,
        is_sketch: scale.is_some(),
        ..Options::default()
    };
    let moving = drawing::moving(view.pool(), system, &pose, &others, &motions, &options);
    let rest = players.assemblies.iter_mut().skip(1);
    for (player, elements) in rest.zip(moving.others) {
        player.elements = elements;
    }
    // Prints are dark on white.
    let picture = moving.picture;
    let picture = picture.replace("@media (prefers", "@media screen and (prefers");
    let parts = picture.split_once("<style>");
    let parts = parts.and_then(|(head, rest)| Some((head, rest.split_once("</style>")?)));
    match parts {
        Some((head, (style, rest))) => format!("{head}<style>{}</style>{rest}", dense(style)),
        None => picture,
    }
}
