//! What stands between the stages of the pipeline, for tools that go on from one of them: the solver and the command line.
//!
//! A build script needs nothing of it. What is here may change with every release.

pub use crate::checks::{check_all, findings, findings_of_derivation, report};

/// Expressions: the graph, its evaluation, and straight-line code that evaluates several at once.
pub mod expr {
    #[doc(inline)]
    pub use crate::expr::{
        Assembler, Code, Computation, ExprId, Factor, Graph, Lanes, Node, Number, Recorder,
        Register, SplineId, SymbolId, Tape,
    };
}

/// The kinds of joints and drivers, what they measure and where their points are.
pub mod joint {
    #[doc(inline)]
    pub use crate::joint::geometry;
    #[doc(inline)]
    pub use crate::joint::{CONSTRAINTS, DRIVERS, Feature, Kind, Line, Quantity, Slot, Value};
}

/// Descriptions with their names resolved, and the words that have a meaning in formulas.
pub mod model {
    #[doc(inline)]
    pub use crate::model::{
        Body, Dimension, ENDS_OF_TABLES, FUNCTIONS, Joint, LAWS, Mechanism, Requested, Role,
        follow_points, set, unit,
    };
    #[doc(inline)]
    pub use crate::units::UNITS;
}

/// Units of measurement, and those of output.
pub mod units {
    #[doc(inline)]
    pub use crate::units::{OutputUnit, OutputUnits, ReportUnits, Unit};
}

/// Descriptions as they are written.
pub mod syntax {
    #[doc(inline)]
    pub use crate::syntax::*;
}

/// Expressions, and symbols with their roles, which grow behind the equations.
pub mod pool {
    #[doc(inline)]
    pub use crate::pool::{Arm, Draft, Pool, SymbolRole};
}

/// The equations of the textbook view.
pub mod system {
    #[doc(inline)]
    pub use crate::system::{Carried, Cause, Component, Derived, Described, Passing, Row, System};
}

/// In which order the unknowns are found.
pub mod structure {
    #[doc(inline)]
    pub use crate::structure::{Freedom, Shift, SolvedPlan, Unplanned, analyze, plan};
}

/// What is computed, statement by statement.
pub mod program {
    #[doc(inline)]
    pub use crate::program::{
        Arithmetic, Block, Branch, Choice, EVALUATIONS, Effort, Elementary, Energy, Evaluation,
        Forces, Found, Function, Kept, Lengths, Level, NewtonBlock, Operations, Output, Program,
        Reaction, Reduced, Report, Requirements, STEPS, Statement, Tearing, Work, forms_of, lower,
        unpruned, work,
    };
}

/// A motion with its solution.
pub mod solved {
    #[doc(inline)]
    pub use crate::solved::Solved;
}

/// Every pose of a block that Newton-Raphson solves.
pub mod assemblies {
    #[doc(inline)]
    pub use crate::assemblies::{
        Enclosed, Enclosing, Interval, Place, Pose, Poses, counts_turns, never_meet, order, poses,
        read,
    };
}

/// What is written of it.
pub mod emit {
    pub use crate::emit::{
        Conventions, Notation, derivation, drawing, inspection, latex, markup, mathml, report, text,
    };

    /// Modules of Rust.
    pub mod rust {
        pub use crate::emit::rust::type_name;
    }
}

/// Files that are named in messages as a person names them.
pub mod files {
    pub use crate::files::{
        attach_files, folder_of, make_folder, may_write_in, noun, read, reason, replace, sweep,
    };
}

/// Tables as other programs export them.
pub mod columns {
    #[doc(inline)]
    pub use crate::columns::{
        Column, Columns, Decimal, Delimiter, Dialect, Encoding, Fault, Header, Known, MAX_BYTES,
        Unit, Unreadable,
    };
}
