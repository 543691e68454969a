//! Exports functions of mechanisms with parameters and signals.

use linkwright::generated::newton;
use linkwright::nalgebra::{Const, SVector};
use linkwright::{Blocks, Equations, Mechanism, PointMotion, Settings, Shell};

type Parameters<M> = <<M as Mechanism>::Blocks as Blocks>::Parameters;
type Inputs<M> = <<M as Mechanism>::Blocks as Blocks>::Inputs;

/// Inputs of a mechanism, with memory for the results.
pub struct Call<'a, M: Mechanism> {
    parameters: &'a [Parameters<M>; 2],
    inputs: &'a [Inputs<M>; 2],
    times: &'a [f64; 2],
    points: &'a mut [PointMotion],
    update: &'a mut [f64],
}

/// Assembles with the first parameters, changes them, advances with the second signals and takes one Newton-Raphson
/// step. If one of them fails, or if the second parameters are refused, returns false and leaves the points
/// unchanged.
fn run<M, E, const N: usize>(
    call: &mut Call<'_, M>,
    textbook: fn(Parameters<M>, Inputs<M>) -> E,
) -> bool
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>,
    E: Equations<f64, Const<N>>,
{
    let (blocks, settings) = (M::Blocks::default(), Settings::default());
    let [start, end] = *call.times;
    let [before, after] = call.parameters;
    let [first, second] = call.inputs;
    let (pose, branches) = (blocks.drawn_pose(before), blocks.drawn_branches());
    let assembled = Shell::assemble(blocks, before, &pose, branches, start, first, settings);
    let Ok(mut mechanism) = assembled else {
        return false;
    };
    if mechanism.set_parameters(after).is_err() {
        return false;
    }
    let Ok(frame) = mechanism.advance(end, second).cloned() else {
        return false;
    };
    let blocks = mechanism.blocks();
    for (index, place) in call.points.iter_mut().enumerate() {
        if let Some(motion) = blocks.point(&frame, index) {
            *place = motion;
        }
    }
    let mut pose = SVector::<f64, N>::zeros();
    for (index, value) in pose.iter_mut().enumerate() {
        if let Some([found, ..]) = blocks.coordinate(&frame, index) {
            *value = found;
        }
    }
    let equations = textbook(after.clone(), second.clone());
    let Ok(step) = newton::step(&equations, &pose, end, &settings) else {
        return false;
    };
    for (place, value) in call.update.iter_mut().zip(step.update.iter()) {
        *place = *value;
    }
    true
}

mod generated {
    pub mod four_bar {
        linkwright::include_mechanism!(four_bar_given);
    }
    pub mod platform {
        linkwright::include_mechanism!(platform_given);
    }
    pub mod slider {
        linkwright::include_mechanism!(slider_given);
    }
}

use generated::{four_bar, platform, slider};

/// See [`run`].
#[unsafe(no_mangle)]
pub fn four_bar_given(call: &mut Call<'_, four_bar::FourBarGiven>) -> bool {
    run(call, |parameters, inputs| four_bar::Textbook {
        parameters,
        inputs,
    })
}

/// See [`run`].
#[unsafe(no_mangle)]
pub fn platform_given(call: &mut Call<'_, platform::PlatformGiven>) -> bool {
    run(call, |parameters, inputs| platform::Textbook {
        parameters,
        inputs,
    })
}

/// See [`run`].
#[unsafe(no_mangle)]
pub fn slider_given(call: &mut Call<'_, slider::SliderGiven>) -> bool {
    run(call, |parameters, inputs| slider::Textbook {
        parameters,
        inputs,
    })
}
