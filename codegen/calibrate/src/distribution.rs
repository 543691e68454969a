//! Student's and Fisher's distributions, by the regularized incomplete beta function.
//!
//! Its continued fraction is evaluated by Lentz's method (Press et al. 2007, *Numerical Recipes*, section 6.4).

/// Degrees of freedom that represent a known deviation.
pub(crate) const KNOWN: f64 = 1e7;

/// Coefficients of Lanczos's series for ln Γ with g = 7 (Godfrey 2001).
const LANCZOS: [f64; 9] = [
    0.999_999_999_999_809_9,
    676.520_368_121_885_1,
    -1_259.139_216_722_402_8,
    771.323_428_777_653_1,
    -176.615_029_162_140_6,
    12.507_343_278_686_905,
    -0.138_571_095_265_720_12,
    9.984_369_578_019_572e-6,
    1.505_632_735_149_311_6e-7,
];

/// Largest number of terms of the continued fraction; its value then stays unchanged.
const TERMS: u32 = 500;

/// Relative change of the continued fraction at which it ends.
const CONVERGED: f64 = 1e-15;

/// Number that replaces a vanishing denominator.
const TINY: f64 = 1e-300;

/// Number of halvings after which a quantile is as near as numbers are.
const HALVINGS: u32 = 200;

/// ln Γ(x) of x > 0.
fn ln_gamma(x: f64) -> f64 {
    let shifted = x - 1.0;
    let mut sum = LANCZOS[0];
    let mut place = 0.0;
    for coefficient in &LANCZOS[1..] {
        place += 1.0;
        sum += coefficient / (shifted + place);
    }
    let base = shifted + 7.5;
    0.5 * std::f64::consts::TAU.ln() + (shifted + 0.5) * base.ln() - base + sum.ln()
}

/// Regularized incomplete beta function I_x(a, b).
fn incomplete_beta(x: f64, a: f64, b: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    if x >= 1.0 {
        return 1.0;
    }
    // The fraction converges fast on this side only.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta_below(1.0 - x, b, a);
    }
    incomplete_beta_below(x, a, b)
}

fn incomplete_beta_below(x: f64, a: f64, b: f64) -> f64 {
    let ends = a * x.ln() + b * (-x).ln_1p() + ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b);
    let guarded = |it: f64| if it.abs() < TINY { TINY } else { it };
    let mut numerator = 1.0;
    let mut denominator = 1.0 / guarded(1.0 - (a + b) * x / (a + 1.0));
    let mut fraction = denominator;
    for term in 1..=TERMS {
        let m = f64::from(term);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let mut change = 1.0;
        for coefficient in [even, odd] {
            denominator = 1.0 / guarded(1.0 + coefficient * denominator);
            numerator = guarded(1.0 + coefficient / numerator);
            change = denominator * numerator;
            fraction *= change;
        }
        if (change - 1.0).abs() < CONVERGED {
            break;
        }
    }
    ends.exp() * fraction / a
}

/// Probability that a ratio of mean squares with these degrees of freedom exceeds `ratio` (Fisher's distribution).
pub(crate) fn exceeded(ratio: f64, above: f64, below: f64) -> f64 {
    incomplete_beta(below / (below + above * ratio), below / 2.0, above / 2.0)
}

/// Number of standard deviations that hold a share of Student's distribution on both sides together.
pub(crate) fn half_width(share: f64, freedom: f64) -> f64 {
    // P(|T| > t) falls from 1 to 0.
    let outside = |t: f64| incomplete_beta(freedom / (freedom + t * t), freedom / 2.0, 0.5);
    let mut high = 1.0;
    while outside(high) > 1.0 - share {
        high *= 2.0;
    }
    let mut low = 0.0;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if outside(middle) > 1.0 - share {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::{exceeded, half_width};

    /// Table 2 of Fisher and Yates 1963, and the normal distribution.
    #[test]
    fn quantiles_are_those_of_printed_tables() {
        for (freedom, expected) in [
            (1.0, 12.7062),
            (2.0, 4.3027),
            (5.0, 2.5706),
            (10.0, 2.2281),
            (30.0, 2.0423),
            (120.0, 1.9799),
            (1e7, 1.9600),
        ] {
            let half_width = half_width(0.95, freedom);
            assert!(
                (half_width - expected).abs() < 6e-5,
                "{freedom}: {half_width}"
            );
        }
    }

    /// Upper points of Fisher's and of the chi-square distribution, from the same tables.
    #[test]
    fn chances_are_those_of_printed_tables() {
        for (ratio, above, below, expected) in [
            (3.3258, 5.0, 10.0, 0.05),
            (4.1028, 2.0, 10.0, 0.05),
            (10.4803, 5.0, 10.0, 0.001),
            (18.307 / 10.0, 10.0, 1e7, 0.05),
            (124.342 / 100.0, 100.0, 1e7, 0.05),
        ] {
            let probability = exceeded(ratio, above, below);
            assert!(
                (probability / expected - 1.0).abs() < 1e-3,
                "{ratio}: {probability}"
            );
        }
    }
}
