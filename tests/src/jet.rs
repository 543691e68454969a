//! Value, rate and acceleration of a closed form in t.
//!
//! A jet holds f, f' and f'' of a function of t; the operations follow the product and chain rules. So a test states
//! a position and gets its velocity and acceleration, without a derivation by hand and without the generator's
//! differentiation.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// f, f', f''.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet(pub [f64; 3]);

impl Jet {
    /// t itself.
    pub fn time(t: f64) -> Jet {
        Jet([t, 1.0, 0.0])
    }

    /// g(f), from g, g' and g'' at f.
    fn chain(self, [value, first, second]: [f64; 3]) -> Jet {
        let [_, rate, acceleration] = self.0;
        Jet([
            value,
            first * rate,
            second * rate * rate + first * acceleration,
        ])
    }

    /// The sine.
    pub fn sin(self) -> Jet {
        let (sine, cosine) = self.0[0].sin_cos();
        self.chain([sine, cosine, -sine])
    }

    /// The cosine.
    pub fn cos(self) -> Jet {
        let (sine, cosine) = self.0[0].sin_cos();
        self.chain([cosine, -sine, -cosine])
    }

    /// The positive root.
    pub fn sqrt(self) -> Jet {
        let root = self.0[0].sqrt();
        self.chain([root, 0.5 / root, -0.25 / (root * self.0[0])])
    }

    /// The square.
    pub fn square(self) -> Jet {
        self * self
    }

    fn inverse(self) -> Jet {
        let inverse = 1.0 / self.0[0];
        self.chain([inverse, -inverse * inverse, 2.0 * inverse.powi(3)])
    }

    /// The angle in [0, π] whose cosine this is.
    pub fn acos(self) -> Jet {
        let cosine = self.0[0];
        let sine = (1.0 - cosine * cosine).sqrt();
        self.chain([cosine.acos(), -1.0 / sine, -cosine / sine.powi(3)])
    }

    /// The angle of the vector (x, self), between −π and π.
    pub fn atan2(self, x: Jet) -> Jet {
        let square = x.square() + self.square();
        // d atan2(y, x) = (x dy − y dx)/(x² + y²), differentiated once more as a quotient.
        let rate = (x.0[0] * self.0[1] - self.0[0] * x.0[1]) / square.0[0];
        let turning = x.0[0] * self.0[2] - self.0[0] * x.0[2];
        let acceleration = (turning - rate * square.0[1]) / square.0[0];
        Jet([self.0[0].atan2(x.0[0]), rate, acceleration])
    }
}

impl From<f64> for Jet {
    fn from(value: f64) -> Jet {
        Jet([value, 0.0, 0.0])
    }
}

impl Add for Jet {
    type Output = Jet;
    fn add(self, other: Jet) -> Jet {
        Jet([0, 1, 2].map(|order| self.0[order] + other.0[order]))
    }
}

impl Neg for Jet {
    type Output = Jet;
    fn neg(self) -> Jet {
        Jet(self.0.map(|part| -part))
    }
}

impl Sub for Jet {
    type Output = Jet;
    fn sub(self, other: Jet) -> Jet {
        self + -other
    }
}

impl Mul for Jet {
    type Output = Jet;
    fn mul(self, other: Jet) -> Jet {
        let ([f, df, ddf], [g, dg, ddg]) = (self.0, other.0);
        Jet([f * g, df * g + f * dg, ddf * g + 2.0 * df * dg + f * ddg])
    }
}

impl Div for Jet {
    type Output = Jet;
    #[expect(clippy::suspicious_arithmetic_impl, reason = "a quotient is a product")]
    fn div(self, other: Jet) -> Jet {
        self * other.inverse()
    }
}

macro_rules! with_numbers {
    ($($operator:ident $function:ident),+) => {$(
        impl $operator<f64> for Jet {
            type Output = Jet;
            fn $function(self, other: f64) -> Jet {
                $operator::$function(self, Jet::from(other))
            }
        }

        impl $operator<Jet> for f64 {
            type Output = Jet;
            fn $function(self, other: Jet) -> Jet {
                $operator::$function(Jet::from(self), other)
            }
        }
    )+};
}

with_numbers!(Add add, Sub sub, Mul mul, Div div);
