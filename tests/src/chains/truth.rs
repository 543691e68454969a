//! Exact pose, velocity and acceleration of a chain in 384 bits.
//!
//! All bars u are at the angle α and all bars v at β. With half bars hₖ and S = h₁ + … + hₙ₋₁ the pin of the last
//! cell is at h₀ cos α + S (cos α + cos β), and the end of its bar v lies hₙ cos β beyond. So both drivers give both
//! cosines.

use crate::pantograph::{OPENING, Pantograph, SWING};
use crate::stability::precise::Precise;

/// A value, its rate and its acceleration.
type Motion = [Precise; 3];

/// The exact levels at an instant, in the order of the coordinates: x, y and φ of u0, v0, u1, …
pub type Exact = [Vec<Precise>; 3];

fn number(value: f64) -> Precise {
    Precise::from_f64(value)
}

/// Sum of two motions with factors.
fn sum(terms: [(&Precise, &Motion); 2]) -> Motion {
    let [(first, one), (second, other)] = terms;
    std::array::from_fn(|level| first.times(&one[level]).plus(&second.times(&other[level])))
}

/// Position that oscillates about another one as the sine of a multiple of t.
fn swinging(place: Precise, width: f64, times: f64, t: f64) -> Motion {
    let phase = number(times).times(&number(t));
    let [width, rate, acceleration] = [width, width * times, -width * times * times].map(number);
    let (sine, cosine) = (phase.sin(), phase.cos());
    [
        place.plus(&width.times(&sine)),
        rate.times(&cosine),
        acceleration.times(&sine),
    ]
}

/// A direction by its cosine: its angle, its cosine and its sine.
fn turned(cosine: Motion, is_negative: bool) -> [Motion; 3] {
    let sign = number(if is_negative { -1.0 } else { 1.0 });
    let [c, c_rate, c_acceleration] = &cosine;
    let none = number(0.0);
    let s = sign.times(&number(1.0).minus(&c.times(c)).sqrt());
    let rate = none.minus(c_rate).over(&s);
    let square = rate.times(&rate);
    let acceleration = none.minus(&c_acceleration.plus(&c.times(&square))).over(&s);
    let sine = [
        s.clone(),
        c.times(&rate),
        c.times(&acceleration).minus(&s.times(&square)),
    ];
    [[sign.times(&c.acos()), rate, acceleration], cosine, sine]
}

/// Exact levels of a chain at an instant (s).
pub fn exact(chain: &Pantograph, t: f64) -> Exact {
    let halves: Vec<Precise> = chain.halves.iter().map(|&it| number(it)).collect();
    let (first, last) = (&halves[0], halves.len() - 1);
    // Sums of the half bars of the cells before each one.
    let mut before = vec![number(0.0)];
    for half in &halves {
        before.push(before[before.len() - 1].plus(half));
    }
    let middle = swinging(number(chain.middle), SWING, 1.0, t);
    let width = number(chain.end).minus(&number(chain.middle));
    let along_v = swinging(width, OPENING, 2.0, t).map(|it| it.over(&halves[last]));
    let all = &before[last];
    let pairs = first.minus(all);
    let along_u = sum([(&number(1.0), &middle), (&pairs, &along_v)]).map(|it| it.over(all));
    let [u, ux, uy] = turned(along_u, false);
    let [v, vx, vy] = turned(along_v, true);
    let mut levels: Exact = Default::default();
    for cell in before.windows(2).take(last) {
        let (here, beyond) = (&cell[0], &cell[1]);
        // Its bar u begins at the end of the last bar v, and the other way round; the chain begins with the bar u of the first cell.
        for (angle, by_u, by_v) in [(&u, here, beyond), (&v, beyond, here)] {
            let by_v = by_v.minus(first);
            let [x, y] = [(&ux, &vx), (&uy, &vy)].map(|(u, v)| sum([(by_u, u), (&by_v, v)]));
            for motion in [&x, &y, angle] {
                for (level, value) in levels.iter_mut().zip(motion) {
                    level.push(value.clone());
                }
            }
        }
    }
    levels
}
