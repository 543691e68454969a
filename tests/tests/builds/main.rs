//! Generated Rust and C in packages of users: compilers, documentation, macros and libraries without std.

mod build_script;
mod c;
mod comments;
mod control;
mod freestanding;
mod lanes;
mod lints;
mod macros;
mod representatives;
mod work;
