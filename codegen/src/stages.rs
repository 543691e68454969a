//! Exposes the stages of the pipeline to the solver and the command line.
//!
//! Build scripts need none of these items, which may change in every release.

pub use crate::checks::{check, check_all, findings_of};

/// Expressions: the graph, its evaluation, and straight-line code for several expressions.
pub mod expr {
    #[doc(inline)]
    pub use crate::expr::{
        Assembler, Code, Computation, ExprId, Factor, Graph, LANES, Lanes, Node, Number, Reads,
        Recorder, Register, SplineId, SymbolId, Tape,
    };
}

/// Kinds of joints and drivers, with their measured quantities and points.
pub mod joint {
    #[doc(inline)]
    pub use crate::joint::geometry;
    #[doc(inline)]
    pub use crate::joint::{CONSTRAINTS, DRIVERS, Feature, Kind, Line, Quantity, Slot, Value};
}

/// Resolved descriptions, and the words with a meaning in formulas.
pub mod model {
    #[doc(inline)]
    pub use crate::model::{
        Body, Clearance, Dimension, Distribution, ENDS_OF_TABLES, FUNCTIONS, Joint, LAWS, Limit,
        MEASURE_FUNCTIONS, Measurement, Mechanism, Mention, Motor, Parameter, Requested, Role,
        Surfaces, follow_points, range_text, set, si_unit, unit, value_text,
    };
    #[doc(inline)]
    pub use crate::read::mentions;
    #[doc(inline)]
    pub use crate::units::UNITS;
}

/// Units of measurement, and those of output.
pub mod units {
    #[doc(inline)]
    pub use crate::units::{OutputUnit, OutputUnits, ReportUnits, Unit};
}

/// Syntax of descriptions.
pub mod syntax {
    #[doc(inline)]
    pub use crate::syntax::*;
}

/// Expressions, and symbols with their roles, to which later stages add.
pub mod pool {
    #[doc(inline)]
    pub use crate::pool::{Arm, Draft, Pool, SymbolRole};
}

/// Equations of the textbook formulation.
pub mod system {
    #[doc(inline)]
    pub use crate::system::{
        Carried, Cause, Component, Derived, Described, ForceColumn, Passing, Row, System,
    };
}

/// Order of solution: blocks and their subsystems.
pub mod structure {
    #[doc(inline)]
    pub use crate::structure::{Freedom, Shift, SolvedPlan, Unplanned, analyze, driven};
}

/// Computation of a motion, statement by statement.
pub mod program {
    #[doc(inline)]
    pub use crate::program::{
        Arithmetic, Block, Branch, Choice, EVALUATIONS, Effort, Elementary, Energy, Evaluation,
        Forces, Found, Function, Kept, Lengths, Level, NewtonBlock, Operations, Output, Program,
        Reaction, Reduced, Report, Requirements, STEPS, Statement, Tearing, Work, work,
    };
}

/// Motion with its solution.
pub mod solved {
    #[doc(inline)]
    pub use crate::solved::Solved;
}

/// Findings about motions without a solution.
pub mod finiteness {
    #[doc(inline)]
    pub use crate::finiteness::of_unplanned;
}

/// All poses of a block that Newton-Raphson solves.
pub mod assemblies {
    #[doc(inline)]
    pub use crate::assemblies::{
        Enclosed, Enclosing, Interval, Place, Pose, Poses, counts_turns, exchanges, never_meet,
        order, poses, read,
    };
}

/// Printers of modules, formulas, pictures and documents.
pub mod emit {
    pub use crate::emit::{
        Conventions, Notation, derivation, drawing, inspection, latex, markup, mathml, report, text,
    };

    /// Modules of Rust.
    pub mod rust {
        pub use crate::emit::rust::type_name;
    }
}

/// Access to files, with messages that name a file as the user does.
pub mod files {
    pub use crate::files::{
        attach_files, folder_of, make_folder, may_write_in, noun, read, reason, replace, sweep,
    };
}

/// Tables in the formats that other programs export.
pub mod columns {
    #[doc(inline)]
    pub use crate::columns::{
        Column, Columns, Decimal, Delimiter, Dialect, Encoding, Fault, Header, Known, MAX_BYTES,
        Unit, Unreadable,
    };
}
