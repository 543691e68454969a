//! *A way to solve a mechanism* → *its motion, and a loop that can be timed.*
//!
//! [`methods`] lists all of a mechanism, the baseline first. Each one sweeps through given times from the drawing, in the state
//! that a user's loop would keep.

mod dense;
mod solved;
mod textbook;

pub use dense::Dense;

use linkwright_codegen::structure::{self, Step};

use crate::description;

/// A setting under which iterations are measured: label, tolerance, polish.
type Setting = (&'static str, f64, bool);

/// The settings that make sense in a scalar: no residual can be smaller than its rounding.
fn settings(scalar: &str) -> &'static [Setting] {
    match scalar {
        "f32" => &[
            ("1e-4", 1e-4, false),
            ("1e-5", 1e-5, false),
            ("1e-5, polished", 1e-5, true),
        ],
        _ => &[
            ("1e-6", 1e-6, false),
            ("1e-9", 1e-9, false),
            ("1e-12", 1e-12, false),
            ("1e-12, polished", 1e-12, true),
        ],
    }
}

/// q, q̇ and q̈ at a time.
pub type Levels = [Vec<f64>; 3];

/// One way to solve a mechanism.
pub trait Method {
    /// What it does, as a line of the legend: methods that differ in a setting only have this in common.
    fn family(&self) -> &str;
    /// The setting; empty where there is none.
    fn setting(&self) -> &str;
    /// `f64` or `f32`.
    fn scalar(&self) -> &'static str;
    /// Assembles the drawing at the first time and moves to each of the others. Nothing is kept: this is what is timed.
    fn sweep(&mut self, times: &[f64]);
    /// The same sweep; the frames at the times of these indices, which ascend.
    fn record(&mut self, times: &[f64], indices: &[usize]) -> Vec<Levels>;

    /// Family and setting.
    fn name(&self) -> String {
        if self.setting().is_empty() {
            self.family().to_string()
        } else {
            format!("{}, {}", self.family(), self.setting())
        }
    }
}

/// All methods of a mechanism; the first is the baseline.
///
/// # Panics
/// If the mechanism is not described, or its module is not in the list below.
pub fn methods(mechanism: &str) -> Vec<Box<dyn Method>> {
    let mut methods: Vec<Box<dyn Method>> =
        vec![Box::new(Dense::new(&description::system(mechanism)))];
    methods.extend(generated(mechanism));
    methods
}

/// Whether a block of the mechanism's solved view has no closed form.
fn iterates(mechanism: &str) -> bool {
    let mut system = description::system(mechanism);
    let plan = structure::plan(&mut system);
    let plan = plan.unwrap_or_else(|| panic!("`{mechanism}` has no solved view"));
    let mut steps = plan.blocks.iter().flat_map(|block| &block.steps);
    steps.any(|step| matches!(step, Step::Newton { .. }))
}

/// A line per mechanism whose methods are compared: those that the baseline is written for. Types of different modules have nothing in common, so a macro per kind of generated solver
/// implements [`Method`] in a module of its own; further kinds are further macros with their lines below.
macro_rules! generated {
    ($($module:ident: $mechanism:ident),+ $(,)?) => {
        $(mod $module {
            pub(super) mod textbook {
                $crate::method::textbook::textbook!([linkwright_mechanisms::$module], f64, "f64");
            }

            pub(super) mod single_textbook {
                $crate::method::textbook::textbook!([$crate::single::$module], f32, "f32");
            }

            pub(super) mod solved {
                $crate::method::solved::solved!([linkwright_mechanisms::$module], $mechanism, f64, "f64");
            }

            pub(super) mod single {
                $crate::method::solved::solved!([$crate::single::$module], $mechanism, f32, "f32");
            }
        })+

        /// The mechanisms whose methods are compared.
        pub const STUDIED: &[&str] = &[$(stringify!($module)),+];

        /// The generated solvers of a mechanism.
        fn generated(mechanism: &str) -> Vec<Box<dyn Method>> {
            match mechanism {
                $(stringify!($module) => {
                    let mut methods: Vec<Box<dyn Method>> = Vec::new();
                    methods.extend($module::textbook::methods());
                    methods.extend($module::single_textbook::methods());
                    methods.extend($module::solved::methods(iterates(mechanism)));
                    methods.extend($module::single::methods(iterates(mechanism)));
                    // Further kinds: `methods.extend($module::<kind>::methods());`
                    methods
                })+
                other => panic!("`{other}` is not compiled"),
            }
        }
    };
}

generated! {
    two_body: TwoBody,
    four_bar: FourBar,
    slider_crank: SliderCrank,
    inverted_slider_crank: InvertedSliderCrank,
    stephenson: Stephenson,
    platform_3rpr: Platform3rpr,
    excavator: Excavator,
    excavator_pins: ExcavatorPins,
    arm: Arm,
    scissor: Scissor,
}
