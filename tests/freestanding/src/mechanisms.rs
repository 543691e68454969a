//! The generated mechanisms → functions of the library: assemble, advance, one Newton-Raphson step, and every point.
//!
//! One exported function per mechanism does it all, so that nothing of a module can be dropped. A test compares the list
//! with the descriptions.

use linkwright::Motion;

macro_rules! export {
    ($($module:ident: $mechanism:ident { $($point:ident),+ $(,)? })+) => {
        $(
            /// Assembles at `start` from an estimate, advances to `end` and takes one Newton-Raphson step; false and
            /// untouched points where one of them fails.
            #[unsafe(no_mangle)]
            pub extern "C" fn $module(
                estimate: &linkwright_mechanisms::$module::Coordinates,
                start: f64,
                end: f64,
                points: &mut [Motion; [$(stringify!($point)),+].len()],
                update: &mut [f64; linkwright_mechanisms::$module::Coordinates::COUNT],
            ) -> bool {
                use linkwright_mechanisms::$module::$mechanism;
                let settings = linkwright::Settings::default();
                let Ok(mut mechanism) = $mechanism::assemble_from(estimate, start, settings) else { return false };
                let Ok(frame) = mechanism.advance(end) else { return false };
                *points = [$(frame.$point()),+];
                let Ok(step) = $mechanism::newton_step(&frame.q, end) else { return false };
                *update = step.update.data.0[0];
                true
            }
        )+
    };
}

export! {
    two_body: TwoBody { point_p, point_q }
    excavator: Excavator {
        point_a, point_b, point_d, point_e, point_f, point_g, point_h, point_i, point_j, point_l, point_m, point_n, point_k,
    }
    excavator_pins: ExcavatorPins {
        point_a, point_b, point_d, point_e, point_f, point_g, point_h, point_i, point_j, point_l, point_m, point_n, point_k,
    }
    arm: Arm {
        point_a, point_b, point_d, point_e, point_f, point_g, point_h, point_i, point_j, point_k, point_l, point_m, point_n,
    }
    four_bar: FourBar { point_a, point_d, point_b, point_c, point_p }
    slider_crank: SliderCrank { point_a, point_b, point_c }
    inverted_slider_crank: InvertedSliderCrank { point_a, point_b, point_d, point_s }
    platform_3rpr: Platform3rpr { point_a, point_b, point_c, point_p, point_q, point_r }
    scissor: Scissor {
        point_a, point_b, point_m1, point_l1, point_r1, point_m2, point_l2, point_r2, point_m3, point_l3, point_r3,
        point_m4, point_l4, point_r4, point_m5, point_l5, point_r5, point_m6, point_l6, point_r6,
    }
    stephenson: Stephenson { point_a, point_b, point_c, point_d, point_e, point_f, point_g }
}

/// Assembles at `start`, advances to `end`, and gives the motion of the one point that is asked for; false where one of them
/// fails.
#[unsafe(no_mangle)]
pub extern "C" fn excavator_tool(start: f64, end: f64, point: &mut Motion) -> bool {
    use linkwright_mechanisms::excavator_tool::ExcavatorTool;
    let Ok(mut mechanism) = ExcavatorTool::assemble(start) else {
        return false;
    };
    let Ok(frame) = mechanism.advance(end) else {
        return false;
    };
    *point = frame.point_k();
    true
}
