//! Finds the extremes of a quantity over the instants of a motion.

/// Smallest and largest value with their instants, each the first of equal ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// Value and time (s) of the minimum.
    pub minimum: [f64; 2],
    /// Value and time (s) of the maximum.
    pub maximum: [f64; 2],
}

impl Extremes {
    /// Returns the extremes of values at times; `None` if a value is not finite, or if there are none.
    pub fn of(times: &[f64], values: impl Iterator<Item = f64>) -> Option<Extremes> {
        let mut reached: Option<Extremes> = None;
        for (t, value) in times.iter().zip(values) {
            if !value.is_finite() {
                return None;
            }
            let extremes = reached.get_or_insert(Extremes {
                minimum: [value, *t],
                maximum: [value, *t],
            });
            if value < extremes.minimum[0] {
                extremes.minimum = [value, *t];
            }
            if value > extremes.maximum[0] {
                extremes.maximum = [value, *t];
            }
        }
        reached
    }
}

#[cfg(test)]
mod tests {
    use super::Extremes;

    #[test]
    fn the_first_of_equal_extremes_counts() {
        let times = [0.0, 0.5, 1.0, 1.5];
        let reached = Extremes::of(&times, [2.0, -1.0, 2.0, -1.0].into_iter());
        let expected = Extremes {
            minimum: [-1.0, 0.5],
            maximum: [2.0, 0.0],
        };
        assert_eq!(reached, Some(expected));
        assert_eq!(Extremes::of(&times, [0.0, f64::NAN].into_iter()), None);
        assert_eq!(Extremes::of(&times, std::iter::empty()), None);
    }
}
