//! Loops of which all unknowns follow from a few: six-bars and chains that are driven at their far end, and platforms at poses in
//! which two of their circle equations do not determine a point.

use std::f64::consts::TAU;

use super::super::course::Course;
use super::{below, sign, size};
use crate::random::Random;

/// A rate (rad/s) with its period (s).
fn rate(random: &mut Random) -> (f64, f64) {
    let speed = 10.0_f64.powf(random.between(-0.5, 0.5));
    (speed * sign(random), TAU / speed)
}

/// A Stephenson six-bar whose far link is driven.
pub fn six_bar(random: &mut Random, _: u64) -> Course {
    six_bar_driven(random, |_, _, _| "phi(arm) = ".to_string())
}

/// A Stephenson six-bar that is driven between two of its links.
pub fn six_bar_between(random: &mut Random, _: u64) -> Course {
    six_bar_driven(random, |random, [b, f], size| match below(random, 4) {
        0 => "relative_angle(coupler, link) = ".to_string(),
        1 => "relative_angle(crank, arm) = ".to_string(),
        2 => format!(
            "relative_y(crank.B, link.F) = {:?} + {size:?}*",
            f[1] - b[1]
        ),
        _ => {
            let distance = (f[0] - b[0]).hypot(f[1] - b[1]);
            format!(
                "distance(coupler.B, arm.F) = {distance:?} + {:?}*",
                0.3 * size
            )
        }
    })
}

/// The six-bar with what is driven and where that is in the drawing; given are the places of B and F, and the size.
fn six_bar_driven(
    random: &mut Random,
    driven: impl Fn(&mut Random, &[[f64; 2]; 2], f64) -> String,
) -> Course {
    let size = size(random);
    let drawn = [
        ("A", [0.0, 0.0]),
        ("B", [-0.4, 0.8]),
        ("C", [1.0, 1.0]),
        ("D", [1.0, 0.0]),
        ("E", [0.3, 1.5]),
        ("F", [1.9, 1.5]),
        ("G", [2.0, 0.8]),
    ];
    let drawn = drawn.map(|(name, place)| {
        (
            name,
            place.map(|it| size * (it + random.between(-0.35, 0.35))),
        )
    });
    let points = drawn.map(|(name, [x, y])| format!("{name} = ({x:?}, {y:?})"));
    let (speed, period) = rate(random);
    let reach = random.between(0.05, 1.0);
    let law = match below(random, 3) {
        0 => format!("{:?}*t", 0.2 * speed),
        1 => format!("{reach:?}*(1 - cos({speed:?}*t))"),
        _ => format!("{reach:?}*sin({speed:?}*t)"),
    };
    let quantity = driven(random, &[drawn[1].1, drawn[5].1], size);
    let text = format!(
        "mechanism six_bar {{
    point {};
    body crank at A {{ A, B }}
    body coupler at B {{ B, C, E }}
    body rocker at D {{ C, D }}
    body link at F {{ E, F }}
    body arm at G {{ F, G }}
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    revolute E(coupler, link);
    revolute F(link, arm);
    revolute G(ground, arm);
    drive {quantity}{law};
}}
",
        points.join(", ")
    );
    Course::drawn(text, size, period)
}

/// A pantograph whose last cell is driven, each cell so many times as large as the one before it; every other one has bars that are bent
/// at their pins, so that no two cells are alike.
pub fn chain(random: &mut Random, number: u64) -> Course {
    let size = size(random);
    let cells = 2 + below(random, 9);
    let growth = [1.0, 0.8, 1.4][(number % 3) as usize];
    let opening = random.between(0.25, 0.9);
    let (cosine, sine) = (opening.cos(), opening.sin());
    let largest = if number.is_multiple_of(2) { 0.0 } else { 0.03 };
    let mut near = |x: f64, y: f64, scale: f64| {
        [x, y].map(|value| value + largest * scale * random.between(-1.0, 1.0))
    };
    let (mut x, mut scale) = (0.0, size);
    let ground = -0.5 * size * sine;
    // Where bars u and v of a cell begin, below and above.
    let mut begins = [[0.0, ground], [0.0, -ground]];
    let mut middle = [0.0; 2];
    let mut bodies = String::new();
    let mut joints = String::new();
    for cell in 0..cells {
        let (half, next) = (0.5 * scale, 0.5 * scale * growth);
        middle = near(x + half * cosine, 0.0, scale);
        x += (half + next) * cosine;
        let ends = [1.0, -1.0].map(|side| near(x, side * next * sine, scale));
        for (bar, side, begin, end) in [
            ("u", 1.0, begins[0], ends[0]),
            ("v", -1.0, begins[1], ends[1]),
        ] {
            let local_text = |point: [f64; 2]| {
                let [x, y] = [0, 1].map(|axis| point[axis] - begin[axis]);
                let y = side * y;
                format!(
                    "({:?}, {:?})",
                    x * cosine + y * sine,
                    side * (y * cosine - x * sine)
                )
            };
            bodies += &format!(
                "    body {bar}{cell} at ({:?}, {:?}, {:?}) {{ A: (0, 0), M: {}, B: {} }}\n",
                begin[0],
                begin[1],
                side * opening,
                local_text(middle),
                local_text(end)
            );
        }
        joints += &format!("    revolute M(u{cell}, v{cell});\n");
        if cell > 0 {
            let before = cell - 1;
            joints += &format!(
                "    revolute (v{before}.B, u{cell}.A);\n    revolute (u{before}.B, v{cell}.A);\n"
            );
        }
        begins = [ends[1], ends[0]];
        scale *= growth;
    }
    let last = cells - 1;
    let (speed, period) = rate(random);
    let [reach, other] = [0.1, 0.01].map(|most| most * size * random.between(0.2, 1.0));
    let text = format!(
        "mechanism chain {{
    point G = (0, {ground:?});
{bodies}{joints}    revolute (ground.G, u0.A);
    drive u{last}.M.x = {:?} + {reach:?}*sin({speed:?}*t);
    drive v{last}.B.x = {:?} + {reach:?}*sin({speed:?}*t) + {other:?}*sin({:?}*t);
}}
",
        middle[0],
        begins[0][0],
        2.0 * speed
    );
    Course::drawn(text, size, 0.5 * period)
}

/// A platform on three legs that is drawn where the lines between the ends of its arms are parallel, and goes through such poses.
pub fn level_platform(random: &mut Random, _: u64) -> Course {
    let size = size(random);
    let mut point = |reach: f64| [0; 2].map(|_| size * random.between(-reach, reach));
    let (base, place) = (point(1.0), point(1.0));
    let pins = [point(0.8), point(0.8), point(0.8)];
    let first = point(1.5);
    let factor = random.between(0.4, 2.0) * sign(random);
    // From each pin back: the differences to the first leg are parallel.
    let others = [first, first.map(|it| factor * it)];
    let mut bases = vec![base];
    for (pin, difference) in pins[1..].iter().zip(others) {
        bases.push([0, 1].map(|it| base[it] + pin[it] - pins[0][it] - difference[it]));
    }
    let (mut legs, mut period) = (String::new(), f64::INFINITY);
    let names = [("A", "P"), ("B", "Q"), ("C", "R")];
    for ((base, pin), (at, on)) in bases.iter().zip(pins).zip(names) {
        let way = [0, 1].map(|it| place[it] + pin[it] - base[it]);
        let length = way[0].hypot(way[1]);
        let (speed, own) = rate(random);
        period = period.min(own);
        let reach = length * random.between(0.01, 0.2);
        legs += &format!(
            "    drive distance(ground.{at}, platform.{on}) = {length:?} + {reach:?}*sin({speed:?}*t);\n"
        );
    }
    let listed = |separator: &str, second: bool, all: &[[f64; 2]]| {
        let named = names.iter().zip(all).map(|((at, on), [x, y])| {
            format!("{}{separator}({x:?}, {y:?})", if second { on } else { at })
        });
        named.collect::<Vec<String>>().join(", ")
    };
    let text = format!(
        "mechanism level {{
    point {};
    body platform at ({:?}, {:?}, 0) {{ {} }}
{legs}}}
",
        listed(" = ", false, &bases),
        place[0],
        place[1],
        listed(": ", true, &pins)
    );
    Course::drawn(text, size, period)
}
