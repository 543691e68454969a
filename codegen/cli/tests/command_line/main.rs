//! The command from the outside: exit codes, output and files.

mod branch;
mod calibrate;
mod check;
mod compare;
mod derivatives;
mod draw;
mod files;
mod fmt;
mod folder;
mod forces;
mod generate_and_inspect;
mod generate_c;
mod guide;
mod motions;
mod new;
mod plan;
mod pressure;
mod printed;
mod set;
mod shell;
mod simulate;
mod singular;
mod solve;
mod view;
