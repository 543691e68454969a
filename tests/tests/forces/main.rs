//! Driving forces, reactions, simulated motions and transmissions.

mod coordinate_changes;
mod equilibrium;
mod forces;
mod forces_by_hand;
mod forces_generated;
mod free_motion;
mod friction;
mod least_norm;
mod near_singular;
mod simulation;
mod stiff;
mod transmissions;
