//! Two cells of bars, each of which follows from those before it by hand: a cosine, another one, and two circles that meet.

use linkwright_solver::Interpreted;
use linkwright_solver::assemblies::assemblies;
use linkwright_tests::description::written;
use linkwright_tests::random::Random;

use super::{ANGLES, Point, assert_agrees, difference, direction, from_to, length, placed};

/// How many chains are tried.
const CHAINS: u32 = 40;

/// Two cells of bars that cross, as drawn, and where the last one is driven.
struct Chain {
    p0: Point,
    m0: Point,
    q1: Point,
    q0: Point,
    p1: Point,
    m1: Point,
    q2: Point,
    p2: Point,
    driven: [f64; 2],
}

/// How near two poses or the ends of a reach may be: nearer ones are left out.
const APART: f64 = 1e-4;
const TOUCHING: f64 = 1e-6;

impl Chain {
    /// Corners of two squares and their middles, displaced by up to 0.4, and driven as drawn or beside it.
    fn random(random: &mut Random) -> Chain {
        let mut number = |around: f64, off: f64| {
            let value = random.between(around - off, around + off);
            (1000.0 * value).round() / 1000.0
        };
        let mut beside = |x: f64, y: f64| [number(x, 0.4), number(y, 0.4)];
        let (m0, q1, q0) = (beside(0.5, 0.5), beside(1.0, 1.0), beside(0.0, 1.0));
        let (p1, m1, q2, p2) = (
            beside(1.0, 0.0),
            beside(1.5, 0.5),
            beside(2.0, 1.0),
            beside(2.0, 0.0),
        );
        let off = if number(0.0, 1.0) < 0.0 { 0.0 } else { 0.2 };
        let driven = [m1[0], p2[0]].map(|x| (1000.0 * number(x, off)).round() / 1000.0);
        Chain {
            p0: [0.0, 0.0],
            m0,
            q1,
            q0,
            p1,
            m1,
            q2,
            p2,
            driven,
        }
    }

    fn description(&self) -> String {
        let names = ["P0", "M0", "Q1", "Q0", "P1", "M1", "Q2", "P2"];
        let places = [
            self.p0, self.m0, self.q1, self.q0, self.p1, self.m1, self.q2, self.p2,
        ];
        let points = names.iter().zip(places);
        let points: Vec<String> = points
            .map(|(name, [x, y])| format!("{name} = ({x:.3}, {y:.3})"))
            .collect();
        let [middle, end] = self.driven;
        format!(
            "mechanism chain {{ point {};
            body u0 at P0 {{ P0, M0, Q1 }}
            body v0 at Q0 {{ Q0, M0, P1 }}
            body u1 at P1 {{ P1, M1, Q2 }}
            body v1 at Q1 {{ Q1, M1, P2 }}
            revolute P0(ground, u0); revolute M0(u0, v0); revolute M1(u1, v1);
            revolute P1(v0, u1); revolute Q1(u0, v1);
            drive u1.M1.x = {middle:.3}; drive v1.P2.x = {end:.3}; }}",
            points.join(", ")
        )
    }

    /// The angles of u0, v0, u1 and v1 in every pose; `None` where a reach just ends.
    fn poses(&self) -> Option<Vec<Vec<f64>>> {
        let [middle, end] = self.driven;
        let mut poses = Vec::new();
        for v1 in turned_to(from_to(self.m1, self.p2), end - middle)? {
            let to_middle = placed([0.0, 0.0], v1, from_to(self.q1, self.m1));
            for u0 in turned_to(
                from_to(self.p0, self.q1),
                middle - to_middle[0] - self.p0[0],
            )? {
                let on_u0 = |point: Point| placed(self.p0, u0, from_to(self.p0, point));
                let (m0, q1) = (on_u0(self.m0), on_u0(self.q1));
                let m1 = placed(q1, v1, from_to(self.q1, self.m1));
                // P1 is so far from both.
                let (a, b) = (from_to(self.m0, self.p1), from_to(self.p1, self.m1));
                let (near, far, apart) = (length(a), length(b), from_to(m0, m1));
                let between = length(apart);
                let cosine = (near * near + between * between - far * far) / (2.0 * near * between);
                for opening in angles_of(cosine)? {
                    let to_p1 = direction(apart) + opening;
                    let p1 = placed(m0, to_p1, [near, 0.0]);
                    let v0 = to_p1 - direction(a);
                    let u1 = direction(from_to(p1, m1)) - direction(b);
                    poses.push(vec![u0, v0, u1, v1]);
                }
            }
        }
        Some(poses)
    }
}

/// Both angles of a cosine, or none; `None` where both are almost one.
fn angles_of(cosine: f64) -> Option<Vec<f64>> {
    match cosine.abs() {
        beside if (beside - 1.0).abs() < TOUCHING => None,
        beyond if beyond > 1.0 => Some(Vec::new()),
        _ => Some(vec![cosine.acos(), -cosine.acos()]),
    }
}

/// By which angles a vector is turned where its x is this.
fn turned_to(vector: Point, x: f64) -> Option<Vec<f64>> {
    let angles = angles_of(x / length(vector))?;
    Some(angles.iter().map(|it| it - direction(vector)).collect())
}

fn methods(solved: &Interpreted) -> Vec<String> {
    let forms = solved.program().forms.iter().flatten();
    forms.map(|form| form.name()).collect()
}

#[test]
fn chains_of_two_cells_are_assembled_as_by_hand_and_in_no_other_way() {
    let mut random = Random::new(5);
    let (mut left_out, mut decided, mut counts) = (0, 0, [0_usize; 9]);
    for number in 0..CHAINS {
        let chain = Chain::random(&mut random);
        let text = chain.description();
        let poses = chain.poses().filter(|poses| {
            let mut pairs =
                (0..poses.len()).flat_map(|one| (0..one).map(move |other| (one, other)));
            pairs.all(|(one, other)| difference(&poses[one], &poses[other]) > APART)
        });
        let Some(known) = poses else {
            left_out += 1;
            continue;
        };
        let solved = Interpreted::new(&written(&text)).expect("a plan");
        assert_eq!(methods(&solved), ["Newton of size 2 for 4 unknowns"]);
        let all = assemblies(&solved, 0.0);
        assert!(all.proven, "{number}: {text}");
        assert_agrees(&all, &ANGLES, &known, &text);
        decided += u32::from(all.undecided.is_empty());
        counts[known.len()] += 1;
    }
    println!(
        "{left_out} left out, all decided in {decided}; so many with 0 to 8 poses: {counts:?}"
    );
}
