//! *The parts of a page* → *the page*.

use std::fmt::Write as _;

use linkwright_codegen::stages::emit::drawing::{self, Gap, Options, Pose};
use linkwright_codegen::stages::emit::markup::escaped;
use linkwright_solver::check::Check;
use linkwright_solver::condition::{Condition, jacobian};
use linkwright_solver::drawn::pose;
use linkwright_solver::instant::Instant;
use linkwright_solver::open_loop::open_loop;
use linkwright_solver::schedule::Schedule;
use linkwright_solver::supplied::Modes;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::view::View as _;
use nalgebra::DVector;

use super::number::number;
use super::players::{Player, Players};
use super::{constraints, equations, given, solution, start};

const STYLE: &str = include_str!("page.css");

/// One script in parts, each of which knows those before it.
const SCRIPT: &str = concat!(
    "\"use strict\";\n(() => {\n",
    include_str!("script/data.js"),
    include_str!("script/motion.js"),
    include_str!("script/stage.js"),
    include_str!("script/shown.js"),
    include_str!("script/plots.js"),
    include_str!("script/pointing.js"),
    include_str!("script/time.js"),
    include_str!("script/assemblies.js"),
    include_str!("script/first.js"),
    "})();\n"
);
const RELOAD: &str = include_str!("reload.js");

/// How many poses guides are made long enough for.
const POSES: usize = 200;

/// What a page is made of.
pub struct Page<'a> {
    /// What was checked, the mechanism in it.
    pub check: &'a Check,
    /// When the motion is shown.
    pub schedule: &'a Schedule,
    /// The time between frames (s).
    pub step: f64,
    /// Where and in which modes it starts, where that is not the drawing.
    pub chosen: Option<(Instant, Modes)>,
    /// What the description's findings are, as the terminal shows them.
    pub findings: &'a str,
}

/// Whether a page stands in a file, or is served and follows its description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Live {
    /// It stands in a file.
    No,
    /// It asks its server for the version after this one.
    Version(u64),
}

/// The page with its style and scripts, and why the motion ends early, where it does.
pub fn page(page: &Page<'_>, live: Live) -> (String, Option<String>) {
    let check = page.check;
    let view = &check.interpreted;
    let system = view.system();
    let mechanism = &system.mechanism;
    let mut players = Players::new(check, page.schedule, page.chosen.clone());
    let title = escaped(&mechanism.title());
    let mut body = format!(
        "<header><h1>{title}</h1>\n{}</header>\n",
        given::docs(&mechanism.docs)
    );
    body += include_str!("contents.html");
    body += &warnings(page, &players);
    body += "<main>\n<div id=\"stage\">\n";
    let _ = writeln!(
        body,
        "<figure id=\"drawing\">{}</figure>",
        drawn(page, &mut players)
    );
    body += include_str!("controls.html");
    body += "</div>\n<article>\n";
    let section = |id: &str, heading: &str, text: &str| {
        format!(
            "<section aria-labelledby=\"{id}\"><h2 id=\"{id}\">{heading}</h2>\n{text}</section>\n"
        )
    };
    body += &section("bodies", given::moving(system).0, &given::bodies(system));
    body += &given::values(system);
    body += &section(
        "constraints",
        "Constraints and degrees of freedom",
        &constraints::section(system, check),
    );
    body += &section("equations", "Equations", &equations::section(system));
    if let Some(first) = players.drawn().and_then(|it| it.instants.first()) {
        let heading = format!(
            "Position, velocity and acceleration at t = {} s",
            number(first.t())
        );
        body += &section("start", &heading, &start::values(view, first));
        let next = first.t() + page.step;
        body += &section(
            "newton",
            "The first Newton-Raphson step",
            &start::first_step(system, first, next),
        );
    }
    body += &section(
        "derivation",
        "Solution block by block",
        &solution::derivation(check),
    );
    body += &section(
        "singular",
        "Singular poses",
        &solution::singular(check, determinant(check, &players), page.chosen.is_none()),
    );
    body += &section("assemblies", "Assemblies", &assemblies(check));
    body += "</article>\n</main>\n";
    body += "<section id=\"plots\" aria-labelledby=\"plots-heading\"><h2 id=\"plots-heading\">Plots</h2><div id=\"chips\"></div><div id=\"charts\"></div></section>\n";
    let data = serde_json::to_string(&players).unwrap_or_default();
    let _ = writeln!(
        body,
        "<script type=\"application/json\" id=\"data\">{}</script>\n<script>\n{SCRIPT}</script>",
        data.replace('<', "\\u003c")
    );
    let error = players.error().map(str::to_string);
    (shell(&title, &body, live), error)
}

/// A page that says why there is none.
pub fn problem(name: &str, text: &str, version: u64) -> String {
    let title = escaped(name);
    let body = format!(
        "<h1>{title}</h1>\n<pre id=\"problem\" role=\"alert\">{}</pre>\n",
        lines(text)
    );
    shell(&title, &body, Live::Version(version))
}

/// A text of several lines, escaped.
fn lines(text: &str) -> String {
    text.lines().map(|line| escaped(line) + "\n").collect()
}

/// What every page has around it. Nothing may be loaded, whatever names and documentation hold.
fn shell(title: &str, body: &str, live: Live) -> String {
    let (connect, reload) = match live {
        Live::No => ("'none'", String::new()),
        Live::Version(version) => (
            "'self'",
            format!(
                "<script>\n{}</script>\n",
                RELOAD.replace("VERSION", &version.to_string())
            ),
        ),
    };
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"generator\" content=\"linkwright\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:; connect-src {connect}\">\n\
         <link rel=\"icon\" href=\"data:,\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{body}{reload}</body>\n</html>\n"
    )
}

/// The drawing at the start, with room for the whole motion; what it shows otherwise of other assemblies goes to these.
fn drawn(page: &Page<'_>, players: &mut Players) -> String {
    let view = &page.check.interpreted;
    let system = view.system();
    let motion = |player: &Player| -> Vec<Pose> {
        let instants = player.instants();
        let every = instants.len().div_ceil(POSES).max(1);
        let kept = instants.iter().step_by(every);
        kept.map(|it| pose(view, it)).collect()
    };
    let mut motions: Vec<Vec<Pose>> = players.assemblies.iter().map(motion).collect();
    let mut first = motions.remove(0).into_iter();
    let mut gap = None;
    let shown = first.next().unwrap_or_else(|| {
        let Some(open) = open_loop(view, page.schedule.start.t) else {
            return Pose::drawn(system);
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
        open.pose(system)
    });
    let others: Vec<Pose> = first.collect();
    let options = Options {
        gap,
        ..Options::default()
    };
    let moving = drawing::moving(system, &shown, &others, &motions, &options);
    let rest = players.assemblies.iter_mut().skip(1);
    for (player, elements) in rest.zip(moving.others) {
        player.elements = elements;
    }
    // On paper everything is dark on white.
    let picture = moving.picture;
    picture.replace("@media (prefers", "@media screen and (prefers")
}

/// Φ_q at the start.
fn determinant(check: &Check, players: &Players) -> Option<f64> {
    let first = players.drawn()?.instants.first()?;
    let textbook = TextbookEquations::new(check.interpreted.system());
    let q = DVector::from_column_slice(first.q());
    Some(Condition::of(&jacobian(&textbook, &q, first.t())).determinant)
}

/// What to look at before anything else.
fn warnings(page: &Page<'_>, players: &Players) -> String {
    let mut text = String::new();
    if let Some(error) = players.error() {
        let _ = writeln!(
            text,
            "<p class=\"error\"><b>Error:</b> {}</p>",
            escaped(error)
        );
    }
    let followed = players.drawn().map_or(&[][..], |it| &it.warnings);
    let checked = page.check.warnings.iter();
    let others = followed
        .iter()
        .filter(|it| !page.check.warnings.contains(it));
    for warning in checked.chain(others) {
        let _ = writeln!(
            text,
            "<p class=\"warning\"><b>Warning:</b> {}</p>",
            escaped(warning)
        );
    }
    if !page.findings.trim().is_empty() {
        let _ = writeln!(
            text,
            "<pre class=\"warning\">{}</pre>",
            lines(page.findings)
        );
    }
    match text.is_empty() {
        true => text,
        false => format!("<section id=\"warnings\" role=\"status\">\n{text}</section>\n"),
    }
}

/// The words about assemblies; their pictures are made of the drawing.
fn assemblies(check: &Check) -> String {
    let found = &check.assemblies.found;
    let names: Vec<String> = check
        .interpreted
        .mode_names()
        .iter()
        .map(|it| format!("<code>{}</code>", escaped(&it.name)))
        .collect();
    let modes = match names.is_empty() {
        true => String::new(),
        false => format!(
            " A label has one character for each of {}, in this order: the sign of its determinant, or a letter that numbers its poses.",
            names.join(", ")
        ),
    };
    let rest = match check.assemblies.are_all() {
        true => "; there are no others.",
        false => "; there may be others.",
    };
    let choice = match found.len() {
        0 | 1 => "",
        _ => " Select one to see its motion.",
    };
    format!(
        "<p>At t = {} s the mechanism can be assembled in {} {}{rest}{modes}{choice}</p>\n<div id=\"thumbnails\" role=\"group\" aria-labelledby=\"assemblies\"></div>\n<p id=\"assembly-error\" class=\"error\" hidden></p>\n",
        number(check.start),
        found.len(),
        if found.len() == 1 { "way" } else { "ways" },
    )
}
