//! No assembly of random platforms on three legs is missed: as many are found as their polynomial has real roots.
//!
//! With τ = tan(φ/2), two differences of the circle equations are linear in the position of the platform, and what remains is a
//! polynomial in τ with integer coefficients (Gosselin and Sefrioui 1991, after which six of its zeros are poses). Sturm's theorem
//! counts its real zeros in whole numbers, so no rounding takes part.

use std::ops::{Add, Mul, Sub};

use linkwright_solver::Interpreted;
use linkwright_solver::assemblies::assemblies;
use linkwright_tests::description::written;
use linkwright_tests::random::Random;
use num_bigint::{BigInt, Sign};
use num_integer::Integer;

/// How many platforms are looked at.
const PLATFORMS: u64 = 1000;

/// All lengths are multiples of this (m).
const UNIT: f64 = 1e-6;

/// Coefficients, that of the highest power last and not zero.
#[derive(Clone, Debug)]
struct Polynomial(Vec<BigInt>);

impl Polynomial {
    fn new(mut coefficients: Vec<BigInt>) -> Polynomial {
        while coefficients
            .last()
            .is_some_and(|it| it.sign() == Sign::NoSign)
        {
            coefficients.pop();
        }
        Polynomial(coefficients)
    }

    fn of<const N: usize>(coefficients: [i64; N]) -> Polynomial {
        Polynomial::new(coefficients.map(BigInt::from).to_vec())
    }

    fn derivative(&self) -> Polynomial {
        let terms = self.0.iter().enumerate().skip(1);
        Polynomial::new(terms.map(|(power, value)| value * power).collect())
    }

    /// Minus the remainder of a division, times a positive number.
    fn negative_remainder(&self, divisor: &Polynomial) -> Polynomial {
        let mut rest = self.0.clone();
        let Some(leading) = divisor.0.last() else {
            return Polynomial::new(Vec::new());
        };
        let size = BigInt::from(leading.magnitude().clone());
        while rest.len() >= divisor.0.len() {
            let Some(highest) = rest.pop() else { break };
            let quotient = match leading.sign() {
                Sign::Minus => -highest,
                _ => highest,
            };
            rest.iter_mut().for_each(|value| *value *= &size);
            let shift = rest.len() + 1 - divisor.0.len();
            let (_, others) = divisor.0.split_last().expect("a leading coefficient");
            for (value, own) in rest[shift..].iter_mut().zip(others) {
                *value -= &quotient * own;
            }
        }
        // Without what all coefficients have in common, which would double their digits at every division.
        let common = rest
            .iter()
            .fold(BigInt::default(), |common, it| common.gcd(it));
        match common.sign() {
            Sign::NoSign => Polynomial(Vec::new()),
            _ => Polynomial::new(rest.into_iter().map(|value| -value / &common).collect()),
        }
    }

    /// The signs far to the left and far to the right.
    fn ends(&self) -> [Sign; 2] {
        let right = self.0.last().map_or(Sign::NoSign, BigInt::sign);
        match self.0.len().is_multiple_of(2) {
            true => [-right, right],
            false => [right, right],
        }
    }

    /// How many different real zeros it has (Sturm 1829).
    fn real_zeros(&self) -> usize {
        let mut sequence = vec![self.clone(), self.derivative()];
        while let [.., before, last] = &sequence[..] {
            let next = before.negative_remainder(last);
            if next.0.is_empty() {
                break;
            }
            sequence.push(next);
        }
        let [left, right] = [0, 1].map(|end| {
            let signs: Vec<Sign> = sequence.iter().map(|it| it.ends()[end]).collect();
            signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
        });
        left - right
    }
}

impl Add for &Polynomial {
    type Output = Polynomial;

    fn add(self, other: &Polynomial) -> Polynomial {
        let length = self.0.len().max(other.0.len());
        let at = |of: &Polynomial, place: usize| of.0.get(place).cloned().unwrap_or_default();
        Polynomial::new((0..length).map(|it| at(self, it) + at(other, it)).collect())
    }
}

impl Sub for &Polynomial {
    type Output = Polynomial;

    fn sub(self, other: &Polynomial) -> Polynomial {
        self + &(other * &Polynomial::of([-1]))
    }
}

impl Mul for &Polynomial {
    type Output = Polynomial;

    fn mul(self, other: &Polynomial) -> Polynomial {
        let length = (self.0.len() + other.0.len()).saturating_sub(1);
        let mut product = vec![BigInt::default(); length];
        for (i, one) in self.0.iter().enumerate() {
            for (j, two) in other.0.iter().enumerate() {
                product[i + j] += one * two;
            }
        }
        Polynomial::new(product)
    }
}

/// A platform, in units.
struct Platform {
    base: [[i64; 2]; 3],
    pins: [[i64; 2]; 3],
    legs: [i64; 3],
    /// x and y in units, φ in rad.
    drawn: ([i64; 2], f64),
}

/// A whole number, up to this many in size.
fn within(random: &mut Random, most: i64) -> i64 {
    let most = most as f64;
    random.between(-most, most).round() as i64
}

fn pair(random: &mut Random, most: i64) -> [i64; 2] {
    [within(random, most), within(random, most)]
}

impl Platform {
    fn random(random: &mut Random) -> Platform {
        let base = [(); 3].map(|()| pair(random, 1_000_000));
        let pins = [(); 3].map(|()| pair(random, 800_000));
        let (place, angle) = (
            pair(random, 1_000_000),
            within(random, 3_000_000) as f64 * UNIT,
        );
        let (sine, cosine) = angle.sin_cos();
        let legs = [0, 1, 2].map(|leg| {
            let [x, y] = pins[leg].map(|it| it as f64);
            let reached = [
                place[0] as f64 + cosine * x - sine * y - base[leg][0] as f64,
                place[1] as f64 + sine * x + cosine * y - base[leg][1] as f64,
            ];
            reached[0].hypot(reached[1]).round() as i64
        });
        Platform {
            base,
            pins,
            legs,
            drawn: (place, angle),
        }
    }

    fn description(&self) -> String {
        let point = |[x, y]: [i64; 2]| format!("({:.6}, {:.6})", x as f64 * UNIT, y as f64 * UNIT);
        let ([x, y], angle) = self.drawn;
        let names = [("A", "P"), ("B", "Q"), ("C", "R")];
        let base = names.iter().zip(self.base);
        let base: Vec<String> = base
            .map(|((name, _), it)| format!("{name} = {}", point(it)))
            .collect();
        let pins = names.iter().zip(self.pins);
        let pins: Vec<String> = pins
            .map(|((_, name), it)| format!("{name}: {}", point(it)))
            .collect();
        let legs = names.iter().zip(self.legs);
        let legs = legs.map(|((base, pin), length)| {
            format!(
                "drive distance(ground.{base}, platform.{pin}) = {:.6};",
                length as f64 * UNIT
            )
        });
        format!(
            "mechanism random {{ point {}; body platform at ({:.6}, {:.6}, {angle:.6}) {{ {} }} {} }}",
            base.join(", "),
            x as f64 * UNIT,
            y as f64 * UNIT,
            pins.join(", "),
            legs.collect::<String>()
        )
    }

    /// In how many poses it can be assembled.
    fn poses(&self) -> usize {
        let one = Polynomial::of([1, 0, 1]);
        // (1 + τ²) times the vector from the base to the pin of a leg, where the platform's origin is at zero.
        let arms: [[Polynomial; 2]; 3] = [0, 1, 2].map(|leg| {
            let ([x, y], [a, b]) = (self.pins[leg], self.base[leg]);
            [
                Polynomial::of([x - a, -2 * y, -x - a]),
                Polynomial::of([y - b, 2 * x, -y - b]),
            ]
        });
        // p² + 2 p·arm + arm² = leg², times (1 + τ²) where that makes it a polynomial: the part without p.
        let constants: [Polynomial; 3] = [0, 1, 2].map(|leg| {
            let squared = |[x, y]: [i64; 2]| BigInt::from(x) * x + BigInt::from(y) * y;
            let ([x, y], [a, b]) = (self.pins[leg], self.base[leg]);
            let size = squared([x, y]) + squared([a, b]) - BigInt::from(self.legs[leg]).pow(2);
            let [x, y, a, b] = [x, y, a, b].map(BigInt::from);
            let along: BigInt = (&a * &x + &b * &y) * 2;
            let across: BigInt = (&b * &x - &a * &y) * 4;
            Polynomial::new(vec![&size - &along, -across, &size + &along])
        });
        let two = Polynomial::of([2]);
        let rows = [1, 2].map(|leg| {
            let [dx, dy] = [0, 1].map(|it| &two * &(&arms[leg][it] - &arms[0][it]));
            (dx, dy, &constants[0] - &constants[leg])
        });
        let [(a, b, r), (c, d, s)] = rows;
        let determinant = &(&a * &d) - &(&b * &c);
        let x = &(&r * &d) - &(&b * &s);
        let y = &(&a * &s) - &(&r * &c);
        let squares = &one * &(&(&x * &x) + &(&y * &y));
        let along = &(&x * &arms[0][0]) + &(&y * &arms[0][1]);
        let middle = &two * &(&determinant * &along);
        let rest = &(&determinant * &determinant) * &constants[0];
        (&(&squares + &middle) + &rest).real_zeros()
    }
}

#[test]
fn sturm_counts_real_zeros() {
    // (τ - 1)(τ - 2)(τ + 3)(τ² + 1)
    let factors = [[-1, 1], [-2, 1], [3, 1]].map(Polynomial::of);
    let product = factors
        .iter()
        .fold(Polynomial::of([1, 0, 1]), |all, it| &all * it);
    assert_eq!(product.real_zeros(), 3);
}

#[test]
fn no_assembly_of_a_platform_is_missed() {
    let mut random = Random::new(12);
    let mut counts = [0; 7];
    for number in 0..PLATFORMS {
        let platform = Platform::random(&mut random);
        let text = platform.description();
        let found = assemblies(&Interpreted::new(&written(&text)).expect("a plan"), 0.0);
        assert!(
            found.proven && found.undecided.is_empty(),
            "{number}: {text}"
        );
        assert_eq!(found.found.len(), platform.poses(), "{number}: {text}");
        counts[found.found.len()] += 1;
    }
    // All numbers of poses occur that a platform with legs of a pose can have.
    assert!(
        counts[2] > 0 && counts[4] > 0 && counts[6] > 0,
        "{counts:?}"
    );
}
