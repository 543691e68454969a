//! Styles of outlines: lines in pixels, light and dark.

use super::figure::{Figure, Look};

/// Class of a style in the file.
pub(super) fn class(look: Look) -> &'static str {
    match look {
        Look::Body => "body",
        Look::Disc => "body disc",
        Look::Part => "part",
        Look::Edge => "edge",
        Look::Face => "face",
        Look::Thought => "thought",
        Look::Mark => "mark",
        Look::Massless => "massless",
        Look::Hatch => "hatch",
        Look::Drive => "drive",
        Look::DriveHead => "drive-head",
        Look::Axis => "axis",
        Look::AxisHead => "axis-head",
        Look::Path => "path",
        Look::Tick => "tick",
        Look::Ink => "ink",
        Look::Element => "element",
        Look::Load => "load",
        Look::LoadHead => "load-head",
        Look::Gap => "gap",
    }
}

/// Number of tints of bodies: those of Okabe and Ito, which remain distinct for the color-blind.
pub(super) const TINTS: usize = 7;

const TINT: [&str; TINTS] = [
    "#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#b3a500",
];

/// Source of the choice between light and dark.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Themes {
    /// System of the reader.
    #[default]
    System,
    /// Page of `rustdoc`, whose background the picture has.
    Rustdoc,
}

/// Rules of dimensions on light and on dark paper.
const DIMENSIONS: [&str; 2] = [
    "\
.linkwright path.dimension { stroke: #0e7490; stroke-width: 0.9; }
.linkwright path.mark { stroke-width: 0.8; }
.linkwright .dimension-head { fill: #0e7490; stroke: none; }
.linkwright .dimension-text { fill: #0e7490; font-size: 11px; }
",
    "\
.linkwright path.dimension { stroke: #67e8f9; }
.linkwright .dimension-head, .linkwright .dimension-text { fill: #67e8f9; }
",
];

/// The style sheet of a figure.
pub(super) fn sheet(themes: Themes, figure: &Figure) -> String {
    let [light, dark] = match figure.dimensions.is_empty() {
        true => [""; 2],
        false => DIMENSIONS,
    };
    let dark = &format!("{DARK}{dark}");
    let mut text = String::from(LIGHT);
    for (tint, color) in TINT.iter().enumerate() {
        text += &format!(".linkwright .tint-{tint} .body {{ fill: {color}; }}\n");
        text += &format!(".linkwright .tint-{tint} .tag {{ fill: {color}; stroke: {color}; }}\n");
    }
    text += light;
    match themes {
        Themes::System => {
            text += &format!("@media (prefers-color-scheme: dark) {{\n{dark}}}\n");
        }
        Themes::Rustdoc => {
            // A condition without weight, so that the rules stand in the same order of precedence.
            text += &dark.replace(".linkwright", &format!("{DARK_THEMES} .linkwright"));
            text += BACKGROUND;
        }
    }
    text
}

/// Selector of a dark page of `rustdoc`.
const DARK_THEMES: &str = ":where([data-theme=\"dark\"], [data-theme=\"ayu\"])";

/// The background of a page of `rustdoc`.
const BACKGROUND: &str = "\
.linkwright .paper { fill: none; }
.linkwright .part { fill: var(--main-background-color, #ffffff); }
";

/// Rules of light paper, except for the tints.
const LIGHT: &str = "\
.linkwright { color: #1c2024; font: 13px Helvetica, Arial, \"Liberation Sans\", \"DejaVu Sans\", sans-serif; }
.linkwright .paper { fill: #ffffff; }
.linkwright path, .linkwright circle { fill: none; stroke: #1c2024; stroke-width: 1.4; stroke-linecap: round; stroke-linejoin: round; }
.linkwright .body { fill-opacity: 0.28; fill-rule: evenodd; }
.linkwright .disc { stroke: none; }
.linkwright .part { fill: #ffffff; }
.linkwright .face { stroke-width: 2.6; }
.linkwright .thought { stroke-width: 1; stroke-dasharray: 9 3 2 3; }
.linkwright .massless { stroke-width: 1.6; stroke-dasharray: 6 4; }
.linkwright .hatch { stroke-width: 0.9; }
.linkwright .ink { fill: #1c2024; stroke: none; }
.linkwright .drive { stroke: #c2410c; stroke-width: 2; }
.linkwright .drive-head { fill: #c2410c; stroke: none; }
.linkwright .gap { stroke: #c2185b; stroke-width: 1.8; stroke-dasharray: 5 4; }
.linkwright .element { stroke-width: 1.5; }
.linkwright .load { stroke: #15803d; stroke-width: 2; }
.linkwright .load-head { fill: #15803d; stroke: none; }
.linkwright .axis { stroke: #6d28d9; stroke-width: 1.4; }
.linkwright .axis-head { fill: #6d28d9; stroke: none; }
.linkwright .path { stroke: #1d4ed8; stroke-width: 1.4; }
.linkwright .tick { fill: #1d4ed8; stroke: none; }
.linkwright .leader { stroke-width: 0.7; }
.linkwright .tag { fill-opacity: 0.2; stroke-width: 0.8; stroke-opacity: 0.9; }
.linkwright text { fill: #1c2024; text-anchor: middle; }
.linkwright .name { font-style: italic; }
.linkwright .gap-name { fill: #c2185b; font-weight: 600; }
.linkwright .point { font-weight: 600; }
.linkwright .note { fill: #57606a; text-anchor: start; }
.linkwright .caption { fill: #57606a; text-anchor: end; }
.linkwright .axis-name { fill: #6d28d9; font-style: italic; }
";

/// Rules that differ on dark paper.
const DARK: &str = "\
.linkwright { color: #e6e8eb; }
.linkwright .paper, .linkwright .part { fill: #16191d; }
.linkwright path, .linkwright circle { stroke: #e6e8eb; }
.linkwright text, .linkwright .ink { fill: #e6e8eb; }
.linkwright .body { fill-opacity: 0.42; }
.linkwright .drive { stroke: #fb923c; }
.linkwright .drive-head { fill: #fb923c; }
.linkwright .gap { stroke: #ff7eb6; }
.linkwright .gap-name { fill: #ff7eb6; }
.linkwright .load { stroke: #4ade80; }
.linkwright .load-head { fill: #4ade80; }
.linkwright .axis { stroke: #c4b5fd; }
.linkwright .axis-head, .linkwright .axis-name { fill: #c4b5fd; }
.linkwright .path { stroke: #7fb0ff; }
.linkwright .tick { fill: #7fb0ff; }
.linkwright .note, .linkwright .caption { fill: #9aa4af; }
";
