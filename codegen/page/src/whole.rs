//! Assembles a page from its drawing, its sections and its scripts.

use std::fmt::Write as _;

use linkwright_codegen::stages::emit::markup::escaped;
use linkwright_codegen::stages::model::Requested;
use linkwright_solver::{Check, Instant, Modes, Schedule, View as _};

use super::answer::Answer;
use super::body::Body;
use super::compact::{compact, dense};
use super::controls::{controls, described};
use super::dense_script::dense_script;
use super::given;
use super::picture::picture;
use super::players::{Chosen, Players};
use super::question::Range;
use super::recorded::{Examination, Precision};
use super::sections::sections;

const STYLE: &str = concat!(include_str!("page.css"), include_str!("pulling.css"));
const LIVE_STYLE: &str = include_str!("live.css");

/// Scripts of every page; each uses those before it.
const SCRIPT: &str = concat!(
    include_str!("script/elements.js"),
    include_str!("script/motion.js"),
    include_str!("script/stage.js"),
    include_str!("script/drawing.js"),
    include_str!("script/curves.js"),
    include_str!("script/charts.js"),
    include_str!("script/chooser.js"),
    include_str!("script/assemblies.js"),
    include_str!("script/pointing.js"),
    include_str!("script/clock.js"),
    include_str!("script/values.js"),
    include_str!("script/given.js"),
    include_str!("script/entries.js"),
    include_str!("script/scene.js"),
    include_str!("script/pulling.js"),
    include_str!("script/mount.js"),
);

/// Scripts of a page whose values can be changed, after those of every page.
const LIVE_SCRIPT: &str = concat!(
    include_str!("script/questions.js"),
    include_str!("script/controls.js"),
    include_str!("script/replacing.js"),
    include_str!("script/answering.js"),
);
const SERVER: &str = include_str!("script/server.js");
const START: &str = include_str!("script/first.js");
const RELOAD: &str = include_str!("reload.js");

/// Contents of a page.
pub struct Page<'a> {
    /// Results of the checks, with the mechanism.
    pub check: &'a Check,
    /// Times of the displayed motion.
    pub schedule: &'a Schedule,
    /// Times as they are requested.
    pub range: Range,
    /// Quantities of `output` statements, whose curves are displayed first.
    pub requested: Vec<Requested>,
    /// Pose and modes at the start; `None` for those of the drawing.
    pub chosen: Option<(Instant, Modes)>,
    /// Label of the chosen assembly, if it is one of those that the check knows.
    pub label: Option<&'a str>,
    /// Findings of the description as text for the terminal.
    pub findings: &'a str,
}

/// Source of a page: a file, or a server that follows the description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Live {
    /// The page is a file.
    No,
    /// The page is served, and waits for the version after this one.
    Version(u64),
}

/// Returns the page with its style and scripts, and the reason of an early end of the motion; `None` if it is complete.
pub fn page(page: &Page<'_>, live: Live) -> (String, Option<String>) {
    let check = page.check;
    let view = &check.interpreted;
    let system = view.system();
    let mechanism = &system.mechanism;
    let range = page.range;
    let chosen = page.chosen.clone().map(|start| Chosen {
        label: page.label.unwrap_or("as chosen").to_string(),
        start,
    });
    let mut players = Players::new(
        view,
        &check.assemblies.found,
        page.schedule,
        chosen,
        Precision::Single,
        Examination::Full,
    );
    let title = escaped(&mechanism.title());
    let drawing = picture(view, &mut players, page.schedule.start.t, None);
    let sections = sections(
        check,
        players.first(),
        page.range.step,
        page.chosen.is_none(),
    );
    let mut body = Body {
        title: &title,
        lead: &given::leading_docs(&mechanism.docs),
        drawing: &drawing,
        messages: &warnings(page, &players),
        requested: &requested(&page.requested).join(" "),
        sections: &sections,
        is_part: false,
    }
    .text();
    let error = players.error().map(str::to_string);
    let controls = match live {
        Live::No => described(view),
        Live::Version(_) => controls(view, range),
    };
    let answer = Answer {
        players: Some(players),
        controls: Some(controls),
        ..Answer::without_motion(range, Vec::new())
    };
    let data = serde_json::to_string(&answer).unwrap_or_default();
    let _ = writeln!(
        body,
        "<script type=\"application/json\" id=\"data\">{}</script>\n<script>\n\"use strict\";\n(() => {{\n{}{}{}}})();\n</script>",
        data.replace('<', "\\u003c"),
        dense_script(&compact(SCRIPT)),
        if live == Live::No {
            String::new()
        } else {
            dense_script(&(compact(LIVE_SCRIPT) + &compact(SERVER)))
        },
        dense_script(&compact(START))
    );
    (shell(&title, &body, live), error)
}

/// Returns a page that shows an error instead of a mechanism.
pub fn problem(name: &str, text: &str, version: u64) -> String {
    let title = escaped(name);
    let body = format!(
        "<main class=\"page\"><h1>{title}</h1>\n<pre id=\"problem\" role=\"alert\">{}</pre></main>\n",
        lines(text)
    );
    shell(&title, &body, Live::Version(version))
}

/// Returns the requested points, coordinates and measures as a page names them.
pub fn requested(requested: &[Requested]) -> Vec<String> {
    let names = requested.iter().map(|quantity| match quantity {
        Requested::Point(point) => format!("p{point}"),
        Requested::Coordinate(coordinate) => format!("q{coordinate}"),
        Requested::Measure(measure) => format!("v{measure}"),
    });
    names.collect()
}

/// Escapes a text of several lines.
fn lines(text: &str) -> String {
    text.lines().map(|line| escaped(line) + "\n").collect()
}

/// Returns the frame of every page. The page cannot load anything, whatever names and documentation contain.
fn shell(title: &str, body: &str, live: Live) -> String {
    let live_style = if live == Live::No { "" } else { LIVE_STYLE };
    let style = dense(&compact(STYLE)) + &dense(&compact(live_style));
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
         <link rel=\"icon\" href=\"data:,\">\n<title>{title}</title>\n<style>\n{style}</style>\n</head>\n<body>\n{body}{reload}</body>\n</html>\n"
    )
}

/// Returns the error of the motion and all warnings as messages beside the drawing.
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
            "<pre class=\"warning\" tabindex=\"0\">{}</pre>",
            lines(page.findings)
        );
    }
    text
}
