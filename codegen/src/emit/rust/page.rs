//! Writes the page that `rustdoc` adds to a module: drawing, equations of the joints and solution.
//!
//! The page is one block of HTML without empty lines, so `rustdoc` does not read it as Markdown, links or tests. Words of a description
//! are escaped. The page has no external references, and follows the theme of the reader.

use std::fmt::Write as _;

use crate::emit::derivation::{self, Derivation, HtmlSection};
use crate::emit::drawing::{self, Pose, Themes};
use crate::emit::markup::escaped;
use crate::program::LARGEST_TEXTBOOK;
use crate::structure::Shift;
use crate::system::Derived;

/// Styles of the page.
const STYLE: &str = "\
.linkwright-page > svg { display: block; max-width: 100%; height: auto; margin: 0 auto; }
.linkwright-page .wide, .linkwright-page .equation { overflow-x: auto; }
.linkwright-page .equation { display: flex; flex-wrap: wrap; gap: 0 1em; align-items: baseline; padding: 2px 0 2px 2em; }
.linkwright-page .equation > span { flex: 1 1 16em; padding-left: 1.2em; text-indent: -1.2em; line-height: 1.9; }
.linkwright-page .equation > span > * { text-indent: 0; }
.linkwright-page .equation > small { max-width: 45%; opacity: 0.75; }
.linkwright-page .equation + p { margin-top: 0.75em; }
.linkwright-page math { font-size: 1.06em; }
.linkwright-page .equation math { math-style: normal; }
.linkwright-page .bold { font-weight: bold; }
.linkwright-page .cases mtd { text-align: left; }
.linkwright-page summary { cursor: pointer; margin: 0.4em 0; }
";

/// Returns the page of all motions, which are planned anew: the derivation shows the motion without the shifts of drivers.
pub fn page(motions: &[Derived]) -> String {
    let mut text = format!("<div class=\"linkwright-page\">\n<style>\n{STYLE}</style>\n");
    for derived in motions {
        if let Some(motion) = &derived.system.mechanism.motion {
            let _ = writeln!(
                text,
                "<h2>Motion <code>{}</code></h2>",
                escaped(&motion.name)
            );
        }
        text += &of_motion(derived);
    }
    text += "</div>\n";
    let lines = text.lines().filter(|line| !line.trim().is_empty());
    // What stands before the page is a paragraph of its own.
    lines.fold(String::from("\n"), |text, line| text + line + "\n")
}

fn of_motion(derived: &Derived) -> String {
    let Derived { pool, system } = derived;
    if system.coordinates.len() > LARGEST_TEXTBOOK {
        return format!(
            "<p>A drawing and a derivation of {} coordinates are not shown here.</p>\n",
            system.coordinates.len()
        );
    }
    let options = drawing::Options {
        themes: Themes::Rustdoc,
        ..drawing::Options::default()
    };
    let mut text = drawing::draw(pool, system, &Pose::drawn(pool, system), &[], &[], &options);
    text += "<details>\n<summary>What its joints and drivers ask for</summary>\n<ul>\n";
    for sentence in derivation::constraints_in_html(pool, system) {
        let _ = writeln!(text, "<li>{sentence}</li>");
    }
    text += "</ul>\n</details>\n";
    let Ok(derivation) = Derivation::of(derived.clone(), Shift::Efforts) else {
        return text;
    };
    let derived = derivation.html();
    let _ = writeln!(
        text,
        "<p>How its motion is found: {}.</p>\n<div class=\"wide\"><table><thead><tr><th>Block</th><th>Unknowns</th><th>Method</th><th>Joints</th></tr></thead><tbody>\n{}</tbody></table></div>",
        derived.summary, derived.outline
    );
    for HtmlSection { heading, body } in &derived.sections {
        let _ = writeln!(
            text,
            "<details>\n<summary>{heading}</summary>\n{body}</details>"
        );
    }
    text
}
