//! Draws the mechanism in given poses as an SVG or a DXF.
//!
//! A mechanism is drawn as a mechanical engineer draws it: supports and guides of the ground are hatched, links are
//! rounded shapes around the points of their bodies, cylinders have a barrel and a rod, gears are their pitch
//! circles. The kind of a joint decides its sign (`Feature`). Lines and signs are measured in pixels, for any size of
//! the mechanism.
//!
//! The text is equal on every run. It begins with `<svg`, refers to nothing outside, and follows the reader's choice
//! of light or dark. Every moving body is one element `<g id="body-NAME" transform="…">` drawn in its own frame, and
//! every joint one `<g id="joint-…">`; a script that moves them reads their positions from `data-` attributes:
//! - on the drawing, `data-scale`: pixels per metre;
//! - `data-body="K"`: the frame of body K;
//! - `data-at="K x y" data-turned="L"`: at a point of body K, in pixels of its frame with y downwards, turned as body
//!   L is;
//! - `data-from="K x y" data-to="L x y"`: at the one point, turned towards the other;
//! - `data-length="l"` besides: drawn for a distance of l pixels between the points, so that x grows with their
//!   distance;
//! - `data-force="N"` or `data-torque="N a"` beside `data-at`: the arrow of load N, drawn along x with the length of
//!   the longest. It has the direction of a force, or is turned by `a` degrees clockwise and mirrored at x for a
//!   clockwise torque;
//! - `data-still=""`: valid in this pose only;
//! - `data-follows="K x y"` on a name, on request: it keeps its place beside the point, and is not turned; `data-first="x y"` is the
//!   point where the name was placed.

mod animation;
mod arrow;
mod contact;
mod cylinder;
mod dial;
mod dimension;
mod dimension_svg;
mod dimensioning;
mod draft;
mod dxf;
mod extras;
mod figure;
mod guide;
mod keyframes;
mod label;
mod legend;
mod lettering;
mod letters;
mod link;
mod link_shapes;
mod link_sheet;
mod load_signs;
mod loads;
mod measurable;
mod motions;
mod naming;
mod numbers;
mod obstacles;
mod picture;
mod pin;
mod plane;
mod plate;
mod pose;
mod scale_bar;
mod sheet;
mod slides;
mod stance;
mod style;
mod svg;
mod wheel;

pub use animation::Animation;
pub use dxf::Undrawable;
pub use extras::{Gap, Traced};
pub use letters::width;
pub use link_sheet::{links, links_dxf};
pub use loads::ActingLoads;
pub use motions::{Moving, moving};
pub use picture::{Options, draw};
pub use plane::Point;
pub use plate::dxf;
pub use pose::Pose;
pub use sheet::{Panel, sheet};
pub use style::Themes;
