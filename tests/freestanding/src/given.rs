//! Mechanisms that are given parameters and signals → functions of the library.

use linkwright::Motion;

macro_rules! given {
    ($($module:ident: $mechanism:ident { $($motion:ident)+ })+) => {
        $(
            mod $module {
                linkwright::include_mechanism!($module);
            }

            /// Assembles with these parameters, changes them, advances with the second signals and takes one Newton-Raphson
            /// step; false and untouched points where one of them fails.
            #[unsafe(no_mangle)]
            extern "C" fn $module(
                parameters: &[$module::Parameters; 2],
                inputs: &[$module::Inputs; 2],
                times: &[f64; 2],
                points: &mut [Motion; [$(stringify!($motion)),+].len()],
                update: &mut [f64; $module::Coordinates::COUNT],
            ) -> bool {
                use $module::$mechanism;
                let [start, end] = times;
                let Ok(mut mechanism) = $mechanism::assemble_for(&parameters[0], *start, &inputs[0]) else { return false };
                mechanism.set_parameters(&parameters[1]);
                let Ok(frame) = mechanism.advance(*end, &inputs[1]) else { return false };
                *points = [$(frame.$motion()),+];
                let step = $mechanism::newton_step(&frame.q, &parameters[1], &inputs[1], *end);
                let Ok(step) = step else { return false };
                *update = step.update.data.0[0];
                true
            }
        )+
    };
}

given! {
    four_bar_given: FourBarGiven { point_a point_b point_c point_d point_p }
    platform_given: PlatformGiven { point_a point_p point_q point_r }
    slider_given: SliderGiven { point_b point_t }
}
