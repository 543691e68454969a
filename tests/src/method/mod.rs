//! Solution methods of a mechanism, each as a loop that can be timed.
//!
//! [`methods`] lists all of a mechanism, the baseline first. Each one sweeps through given times from the design
//! configuration, with the state that a user's loop would keep.

mod dense;
mod solved;
mod textbook;

pub use dense::Dense;

use linkwright::math::Real;
use linkwright::nalgebra::Const;
use linkwright::{Blocks, Equations, Mechanism, Settings};
use linkwright_codegen::stages::program::Kept;
use linkwright_codegen::stages::solved::Solved;
use linkwright_codegen::stages::structure::Shift;

use crate::description;
pub use crate::values::Levels;

/// Settings for a scalar, with their labels: no residual can be smaller than its rounding.
fn settings<T: Real>() -> Vec<(&'static str, Settings<T>)>
where
    Settings<T>: Default,
{
    let (double, single) = (
        [
            ("1e-6", 1e-6, false),
            ("1e-9", 1e-9, false),
            ("1e-12", 1e-12, false),
            ("1e-12, polished", 1e-12, true),
        ],
        [
            ("1e-4", 1e-4, false),
            ("1e-5", 1e-5, false),
            ("1e-5, polished", 1e-5, true),
        ],
    );
    let is_double = T::EPSILON.to_f64() == f64::EPSILON;
    let all = if is_double { &double[..] } else { &single[..] };
    let with = |&(label, tolerance, polish): &(_, f64, _)| {
        let settings = Settings {
            tolerance: T::from_f64(tolerance),
            polish,
            ..Settings::default()
        };
        (label, settings)
    };
    all.iter().map(with).collect()
}

/// Solution method of a mechanism.
pub trait Method {
    /// Label in the legend; methods that differ only in a setting share it.
    fn family(&self) -> &str;
    /// Setting; empty if the method has none.
    fn setting(&self) -> &str;
    /// `f64` or `f32`.
    fn scalar(&self) -> &'static str;
    /// Assembles at the first time and moves to each of the others. Nothing is kept: this is timed.
    fn sweep(&mut self, times: &[f64]);
    /// Sweeps and returns the frames at the times of these indices, which ascend.
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
    let (_, generated) = GENERATED
        .iter()
        .find(|(name, _)| *name == mechanism)
        .unwrap_or_else(|| panic!("`{mechanism}` is not compiled"));
    methods.extend(generated(iterates(mechanism)));
    methods
}

/// True if a block of the mechanism's solved formulation has no closed form.
fn iterates(mechanism: &str) -> bool {
    let derived = description::system(mechanism);
    let solved = Solved::of(derived, Shift::Directions, Kept::Methods);
    let solved = solved.unwrap_or_else(|_| panic!("`{mechanism}` has no solved view"));
    let mut forms = solved.program().forms.iter().flatten();
    forms.any(|form| form.modes().is_none())
}

/// Generated solvers of a mechanism, in double precision, then in single precision. The argument is true if one of
/// its blocks has no closed form.
type Generated = fn(bool) -> Vec<Box<dyn Method>>;

fn generated<M, E, M32, E32, const N: usize>(iterates: bool) -> Vec<Box<dyn Method>>
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default + Clone + 'static>,
    E: Equations<f64, Const<N>> + Default + 'static,
    M32: Mechanism<Blocks: Blocks<Scalar = f32> + Default + Clone + 'static>,
    E32: Equations<f32, Const<N>> + Default + 'static,
{
    let mut methods = textbook::methods::<M, E, N>();
    methods.extend(textbook::methods::<M32, E32, N>());
    methods.extend(solved::methods::<M>(iterates));
    methods.extend(solved::methods::<M32>(iterates));
    methods
}

/// Mechanisms whose methods are compared: those of the baseline.
const GENERATED: &[(&str, Generated)] = {
    use crate::single;
    use linkwright_mechanisms::{
        arm, excavator, excavator_pins, four_bar, inverted_slider_crank, platform_3rpr, scissor,
        slider_crank, stephenson, two_body,
    };
    &[
        (
            "two_body",
            generated::<
                two_body::TwoBody,
                two_body::Textbook,
                single::two_body::TwoBody,
                single::two_body::Textbook,
                _,
            >,
        ),
        (
            "four_bar",
            generated::<
                four_bar::FourBar,
                four_bar::Textbook,
                single::four_bar::FourBar,
                single::four_bar::Textbook,
                _,
            >,
        ),
        (
            "slider_crank",
            generated::<
                slider_crank::SliderCrank,
                slider_crank::Textbook,
                single::slider_crank::SliderCrank,
                single::slider_crank::Textbook,
                _,
            >,
        ),
        (
            "inverted_slider_crank",
            generated::<
                inverted_slider_crank::InvertedSliderCrank,
                inverted_slider_crank::Textbook,
                single::inverted_slider_crank::InvertedSliderCrank,
                single::inverted_slider_crank::Textbook,
                _,
            >,
        ),
        (
            "stephenson",
            generated::<
                stephenson::Stephenson,
                stephenson::Textbook,
                single::stephenson::Stephenson,
                single::stephenson::Textbook,
                _,
            >,
        ),
        (
            "platform_3rpr",
            generated::<
                platform_3rpr::Platform3rpr,
                platform_3rpr::Textbook,
                single::platform_3rpr::Platform3rpr,
                single::platform_3rpr::Textbook,
                _,
            >,
        ),
        (
            "excavator",
            generated::<
                excavator::Excavator,
                excavator::Textbook,
                single::excavator::Excavator,
                single::excavator::Textbook,
                _,
            >,
        ),
        (
            "excavator_pins",
            generated::<
                excavator_pins::ExcavatorPins,
                excavator_pins::Textbook,
                single::excavator_pins::ExcavatorPins,
                single::excavator_pins::Textbook,
                _,
            >,
        ),
        (
            "arm",
            generated::<arm::Arm, arm::Textbook, single::arm::Arm, single::arm::Textbook, _>,
        ),
        (
            "scissor",
            generated::<
                scissor::Scissor,
                scissor::Textbook,
                single::scissor::Scissor,
                single::scissor::Textbook,
                _,
            >,
        ),
    ]
};

/// Names of the mechanisms whose methods are compared.
pub fn studied() -> impl Iterator<Item = &'static str> {
    GENERATED.iter().map(|(name, _)| *name)
}
