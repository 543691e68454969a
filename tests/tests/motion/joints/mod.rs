//! The smallest mechanism of every joint and driver against its motion in closed form, in both views.

mod angles;
mod distances;
mod exact;
mod lines;
mod plans;
mod positions;
