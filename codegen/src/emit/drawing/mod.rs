//! System and poses → a picture of the mechanism as an SVG.
//!
//! A mechanism is drawn as a mechanical engineer draws it: supports and guides of the ground are hatched, links are rounded shapes
//! around the points of their bodies, cylinders have a barrel and a rod, gears are their pitch circles. Which sign a joint has is its
//! kind's (`Feature`). Lines and signs are measured in pixels, whatever the size of the mechanism.
//!
//! The text is the same on every run. It begins with `<svg`, refers to nothing outside, and follows the reader's choice of light or
//! dark. Every moving body is one element `<g id="body-NAME" transform="…">` drawn in its own frame, and every joint
//! one `<g id="joint-…">`; whoever moves them reads where to from `data-` attributes:
//! - on the drawing, `data-scale`: pixels per metre;
//! - `data-body="K"`: the frame of body K;
//! - `data-at="K x y" data-turned="L"`: at a point of body K, in pixels of its frame with y downwards, turned as body L is;
//! - `data-from="K x y" data-to="L x y"`: at the one point, turned towards the other;
//! - `data-length="l"` besides: drawn as if the points were l pixels apart, so that x grows with their distance;
//! - `data-force="N"` or `data-torque="N a"` beside `data-at`: the arrow of load N, which is along x and as long as the longest. It has
//!   the direction of a force, or is turned by `a` degrees clockwise and mirrored at x where a torque is clockwise;
//! - `data-still=""`: right in this pose only;
//! - `data-follows="K x y"` on a name, where that is asked for: it keeps its place beside the point, and is not turned.
//!
//! Deliberately unknown here: how a pose is found, files, and what is not drawn in the plane.

mod animation;
mod arrow;
mod contact;
mod cylinder;
mod dial;
mod draft;
mod extras;
mod figure;
mod guide;
mod keyframes;
mod label;
mod legend;
mod lettering;
mod letters;
mod link;
mod load_signs;
mod loads;
mod motions;
mod naming;
mod numbers;
mod obstacles;
mod picture;
mod pin;
mod plane;
mod pose;
mod scale_bar;
mod sheet;
mod stance;
mod style;
mod svg;
mod wheel;

pub use animation::Animation;
pub use extras::{Gap, Traced};
pub use letters::width;
pub use loads::ActingLoads;
pub use motions::{Moving, moving};
pub use picture::{Options, draw};
pub use plane::Point;
pub use pose::Pose;
pub use sheet::{Panel, sheet};
pub use style::Themes;
