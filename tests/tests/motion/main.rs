//! Positions, velocities and accelerations against closed forms, references and other formulations.

mod angles;
mod arm;
mod batch;
mod curves;
mod derivatives;
mod drawn_points;
mod equations;
mod exam;
mod excavator;
mod excavator_motions;
mod gallery;
mod given;
mod interpreters;
mod joints;
mod laws;
mod math;
mod motions;
mod references;
mod rods;
mod same_bits;
mod sensitivities;
mod set;
mod solved;
mod tables;
mod units;
mod wound;
