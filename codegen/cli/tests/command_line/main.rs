//! The command from the outside: exit codes, output and files.

mod animate;
mod branch;
#[cfg(feature = "calibrate")]
mod calibrate;
#[cfg(feature = "calibrate")]
mod calibrate_measures;
#[cfg(feature = "calibrate")]
mod calibrate_ranges;
#[cfg(feature = "calibrate")]
mod calibrate_trust;
mod check;
mod check_assemblies;
mod check_crank_rocker;
mod compare;
mod derivatives;
mod draw;
mod draw_loads;
mod draw_workshop;
mod equilibrium;
mod file_owners;
mod files;
#[cfg(unix)]
mod files_on_unix;
mod fmt;
mod folder;
mod forces;
mod generate_and_inspect;
mod generate_c;
mod generate_lanes;
#[cfg(all(feature = "calibrate", feature = "png"))]
mod guide;
#[cfg(not(all(
    feature = "calibrate",
    feature = "lsp",
    feature = "man",
    feature = "parquet",
    feature = "png"
)))]
mod left_out;
#[cfg(all(
    feature = "calibrate",
    feature = "lsp",
    feature = "man",
    feature = "png"
))]
mod licenses;
mod losses;
#[cfg(feature = "man")]
mod man;
mod measures;
mod motions;
mod new;
mod plan;
#[cfg(feature = "png")]
mod png;
mod pressure;
mod printed;
mod reach;
mod set;
mod shell;
mod simulate;
mod singular;
mod solve;
mod solve_files;
mod solve_shown;
mod sweep;
mod sweep_branch;
#[cfg(feature = "parquet")]
mod sweep_parquet;
#[cfg(unix)]
mod sweep_resumed;
mod sweep_sets;
#[cfg(feature = "calibrate")]
mod synthesize;
mod tolerance;
mod travel;
mod travel_region;
mod units;
mod view;
