//! Assembly modes, paths through singular poses, and failures.

mod antiparallelograms;
mod change_points;
mod driven_lengths;
mod failing_blocks;
mod failures;
mod given_modes;
mod guard;
mod modes;
mod normalized_determinants;
mod paths;
mod platforms;
mod proven_assemblies;
mod recovery;
mod redundant;
mod standing_time;
mod starts;
mod statement_order;
mod stored_assemblies;
mod tears;
mod two_links;
