//! Linkages whose links are collinear at target times to the last bit, and several loops that become collinear at
//! once.

use super::super::course::Course;
use super::change_points::four_bar;
use super::{below, sign, size, turning};
use crate::random::Random;

/// Length of a course, in periods.
const LASTS: f64 = 2.5;

/// A law that is zero at a time which steps of a quarter of the period hit exactly; its value at t = 0 and the period (s).
fn through_zero(random: &mut Random) -> (String, f64, f64) {
    let period = 2.0_f64.powi(below(random, 7) as i32 - 3);
    let zero = 0.25 * period * (1 + below(random, 8)) as f64;
    let speed = sign(random) * random.between(0.4, 2.7) / zero;
    (format!("{speed:?}*(t - {zero:?})"), speed * -zero, period)
}

fn course(text: String, size: f64, period: f64, loops: usize) -> Course {
    Course {
        span: [0.0, LASTS * period],
        loops,
        ..Course::drawn(text, size, period)
    }
}

/// A parallelogram, parallel or crossed, whose change point is a target.
pub fn parallelogram(random: &mut Random, _: u64) -> Course {
    let size = size(random);
    let crank = size * random.between(0.4, 1.0);
    let ground = size * random.between(0.4, 2.5);
    let (law, start, period) = through_zero(random);
    let elbow = sign(random);
    let text = four_bar([crank, ground, crank, ground], start, 0.0, elbow, &law);
    course(text, size, period, 1)
}

/// Equal cranks in a row, coupled by rods of the length of the ground between them: all loops become collinear at
/// once.
pub fn row(random: &mut Random, number: u64) -> Course {
    let size = size(random);
    let crank = size * random.between(0.3, 1.0);
    let loops = 2 + below(random, 2);
    let (law, start, period) = match number % 2 {
        0 => through_zero(random),
        _ => {
            let start = sign(random) * random.between(0.4, 2.7);
            let (law, period) = turning(random, start, 2.5);
            (law, start, period)
        }
    };
    let pin = |center: f64, angle: f64| [center + crank * angle.cos(), crank * angle.sin()];
    let mut cranks = vec![(0.0, start)];
    let mut bodies = format!(
        "    point D0 = (0, 0);
    body crank0 at D0 turned {start:?} {{ D0, P: ({crank:?}, 0) }}\n"
    );
    let mut joints = "    revolute D0(ground, crank0);\n".to_string();
    for next in 1..=loops {
        // From the crank before it, or from the first one.
        let from = [next - 1, 0][below(random, 2)];
        let (center, angle) = cranks[from];
        let farthest = cranks.iter().fold(0.0_f64, |most, it| most.max(it.0));
        let next_center = farthest + size * random.between(0.4, 2.0);
        let ground = next_center - center;
        // Parallel, or crossed: mirrored in the diagonal from the pin to the other center.
        let [x, y] = pin(center, angle);
        let parallel = pin(next_center, angle);
        let (tip, turned) = match below(random, 3) {
            0 => {
                let tip = mirrored([x, y], [next_center, 0.0], parallel);
                (tip, tip[1].atan2(tip[0] - next_center))
            }
            _ => (parallel, angle),
        };
        let rod = (tip[1] - y).atan2(tip[0] - x);
        bodies += &format!(
            "    point D{next} = ({next_center:?}, 0);
    body crank{next} at D{next} turned {turned:?} {{ D{next}, P: ({crank:?}, 0) }}
    body rod{next} at ({x:?}, {y:?}, {rod:?}) {{ P: (0, 0), Q: ({ground:?}, 0) }}\n"
        );
        joints += &format!(
            "    revolute D{next}(ground, crank{next});
    revolute (crank{from}.P, rod{next}.P);
    revolute (rod{next}.Q, crank{next}.P);\n"
        );
        cranks.push((next_center, turned));
    }
    let text = format!("mechanism row {{\n{bodies}{joints}    drive phi(crank0) = {law};\n}}\n");
    course(text, size, period, loops)
}

/// A point mirrored in the line through two others.
fn mirrored(from: [f64; 2], to: [f64; 2], point: [f64; 2]) -> [f64; 2] {
    let way = [to[0] - from[0], to[1] - from[1]];
    let off = [point[0] - from[0], point[1] - from[1]];
    let along = (way[0] * off[0] + way[1] * off[1]) / (way[0] * way[0] + way[1] * way[1]);
    [0, 1].map(|axis| from[axis] + 2.0 * along * way[axis] - off[axis])
}
