//! Assembles the sections of a page.

use std::fmt::Write as _;

use linkwright_codegen::stages::emit::markup::escaped;
use linkwright_solver::condition::Condition;
use linkwright_solver::condition::jacobian;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::{Check, Instant, Modes, Schedule, View as _};
use nalgebra::DVector;

use super::number::number;
use super::picture::picture;
use super::players::{Chosen, Players};
use super::recorded::{Examination, Precision};
use super::{constraints, equations, given, solution, start};

const STYLE: &str = include_str!("page.css");

/// Script in parts; each part uses those before it.
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

/// Contents of a page.
pub struct Page<'a> {
    /// Results of the checks, with the mechanism.
    pub check: &'a Check,
    /// Times of the displayed motion.
    pub schedule: &'a Schedule,
    /// Time between frames (s).
    pub step: f64,
    /// Pose and modes at the start; `None` for those of the drawing.
    pub chosen: Option<(Instant, Modes)>,
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
    let chosen = page.chosen.clone().map(|start| Chosen {
        label: "as chosen".to_string(),
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
        picture(view, &mut players, page.schedule.start.t, None)
    );
    body += include_str!("controls.html");
    body += "</div>\n<article>\n";
    let section = |id: &str, heading: &str, text: &str| {
        format!(
            "<section aria-labelledby=\"{id}\"><h2 id=\"{id}\">{heading}</h2>\n{text}</section>\n"
        )
    };
    body += &section("bodies", given::moving(system).0, &given::bodies(system));
    body += &given::values(view.pool(), system);
    body += &section(
        "constraints",
        "Constraints and degrees of freedom",
        &constraints::section(view.pool(), system, check),
    );
    body += &section(
        "equations",
        "Equations",
        &equations::section(view.derived()),
    );
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
            &start::first_step(view.pool(), system, first, next),
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

/// Returns a page that shows an error instead of a mechanism.
pub fn problem(name: &str, text: &str, version: u64) -> String {
    let title = escaped(name);
    let body = format!(
        "<h1>{title}</h1>\n<pre id=\"problem\" role=\"alert\">{}</pre>\n",
        lines(text)
    );
    shell(&title, &body, Live::Version(version))
}

/// Escapes a text of several lines.
fn lines(text: &str) -> String {
    text.lines().map(|line| escaped(line) + "\n").collect()
}

/// Returns the frame of every page. The page cannot load anything, whatever names and documentation contain.
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

/// Returns the determinant of Φ_q at the start; `None` without a motion.
fn determinant(check: &Check, players: &Players) -> Option<f64> {
    let first = players.drawn()?.instants.first()?;
    let textbook = TextbookEquations::new(check.interpreted.pool(), check.interpreted.system());
    let q = DVector::from_column_slice(first.q());
    Some(Condition::of(&jacobian(&textbook, &q, first.t())).determinant)
}

/// Returns the warnings at the top of a page.
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

/// Returns the text about assemblies; scripts make their pictures from the drawing.
fn assemblies(check: &Check) -> String {
    let assemblies = &check.assemblies.found;
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
        true => "; the list is complete.",
        false => "; others may exist.",
    };
    let choice = match assemblies.len() {
        0 | 1 => "",
        _ => " Select one to see its motion.",
    };
    format!(
        "<p>At t = {} s the mechanism can be assembled in {} {}{rest}{modes}{choice}</p>\n<div id=\"thumbnails\" role=\"group\" aria-labelledby=\"assemblies\"></div>\n<p id=\"assembly-error\" class=\"error\" hidden></p>\n",
        number(check.start),
        assemblies.len(),
        if assemblies.len() == 1 { "way" } else { "ways" },
    )
}
