//! Racks, which roll on by whole turns.

use std::f64::consts::TAU;

use super::super::course::Course;
use super::{sign, size};
use crate::random::Random;

/// A pinion that moves a rack, whose tie rods turn two arms, farther than they reach or not.
pub fn rack(random: &mut Random, _: u64) -> Course {
    let size = size(random);
    let radius = size * 10.0_f64.powf(random.between(-1.7, 0.0));
    let mut joints = String::new();
    let mut bodies = String::new();
    for (side, name) in [(-1.0, "left"), (1.0, "right")] {
        let end = side * size * random.between(0.2, 0.5);
        let pivot = [
            side * size * random.between(0.7, 1.2),
            size * random.between(0.2, 0.6),
        ];
        let arm = size * random.between(0.2, 0.6);
        let angle = random.between(-2.6, -0.6);
        let tip = [pivot[0] + arm * angle.cos(), pivot[1] + arm * angle.sin()];
        let rod = (tip[0] - end).hypot(tip[1]);
        bodies += &format!(
            "    point {name}_pivot = ({:?}, {:?});
    body {name} at {name}_pivot turned {angle:?} {{ {name}_pivot, T: ({arm:?}, 0) }}
",
            pivot[0], pivot[1]
        );
        joints += &format!(
            "    revolute {name}_pivot(ground, {name});\n    revolute_revolute (rack_bar.{name}_end, {name}.T) = {rod:?};\n"
        );
        bodies = bodies.replace(&format!("{name}_END"), &format!("{end:?}"));
        joints += &format!("// {name} {end:?}\n");
    }
    let ends: Vec<String> = joints
        .lines()
        .filter_map(|line| line.strip_prefix("// "))
        .filter_map(|line| line.split_once(' '))
        .map(|(name, end)| format!("{name}_end: ({end}, 0)"))
        .collect();
    let speed = 10.0_f64.powf(random.between(-1.0, 1.0));
    let reach = size / radius * random.between(0.05, 0.8);
    let rate = speed * sign(random);
    let text = format!(
        "mechanism steering {{
    body pinion at (0, {radius:?}) {{ C: (0, 0) }}
    body rack_bar at (0, 0) {{ U: ({:?}, 0), V: ({size:?}, 0), {} }}
{bodies}    absolute_x(pinion) = 0;
    absolute_y(pinion) = {radius:?};
    absolute_y(rack_bar) = 0;
    absolute_angle(rack_bar) = 0;
    rack (pinion.C, rack_bar) along U -> V = {radius:?};
{joints}    drive phi(pinion) = {reach:?}*sin({rate:?}*t);
}}
",
        -size,
        ends.join(", ")
    );
    let period = TAU / speed;
    Course::drawn(text, size, period)
}
