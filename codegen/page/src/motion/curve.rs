//! Keeps the extremes of values that change with time, in a bounded number of stretches.
//!
//! No peak of a motion is lost, however long the motion is.

/// Largest number of stretches.
const STRETCHES: usize = 2000;

/// A value, and its time (s).
pub type Extreme = (f64, f64);

/// Course of `N` values.
#[derive(Clone, Debug)]
pub struct Curve<const N: usize> {
    stretches: Vec<Stretch<N>>,
    /// Number of instants in a full stretch, and in the last one.
    length: usize,
    filled: usize,
    ends: Option<[Stretch<N>; 2]>,
}

/// Smallest and largest value of each component, with their times.
#[derive(Clone, Copy, Debug)]
struct Stretch<const N: usize>([[Extreme; 2]; N]);

impl<const N: usize> Default for Curve<N> {
    fn default() -> Self {
        Curve {
            stretches: Vec::new(),
            length: 1,
            filled: 1,
            ends: None,
        }
    }
}

impl<const N: usize> Curve<N> {
    /// Adds the next instant.
    pub fn push(&mut self, t: f64, values: [f64; N]) {
        let stretch = Stretch(values.map(|value| [(t, value); 2]));
        self.ends = Some([self.ends.map_or(stretch, |[first, _]| first), stretch]);
        match self.stretches.last_mut() {
            Some(last) if self.filled < self.length => {
                last.extend(&stretch);
                self.filled += 1;
                return;
            }
            _ => {}
        }
        if self.stretches.len() == STRETCHES {
            let pairs = self.stretches.chunks_exact(2).map(|pair| {
                let mut both = pair[0];
                both.extend(&pair[1]);
                both
            });
            self.stretches = pairs.collect();
            self.length *= 2;
        }
        self.stretches.push(stretch);
        self.filled = 1;
    }

    /// Returns the first and the last time (s); `None` without instants.
    pub fn range(&self) -> Option<[f64; 2]> {
        self.ends.map(|ends| ends.map(|end| end.0[0][0].0))
    }

    /// Returns the extremes of a component in the order of time, with both ends of the motion.
    pub fn component(&self, component: usize) -> Vec<Extreme> {
        let mut points = Vec::with_capacity(2 * self.stretches.len() + 2);
        points.extend(self.ends.map(|[first, _]| first.0[component][0]));
        for stretch in &self.stretches {
            let [low, high] = stretch.0[component];
            points.extend(if low.0 <= high.0 {
                [low, high]
            } else {
                [high, low]
            });
        }
        points.extend(self.ends.map(|[_, last]| last.0[component][0]));
        points.dedup_by_key(|point| point.0);
        points
    }
}

impl<const N: usize> Stretch<N> {
    fn extend(&mut self, other: &Stretch<N>) {
        for ([low, high], [lower, higher]) in self.0.iter_mut().zip(other.0) {
            if lower.1 < low.1 {
                *low = lower;
            }
            if higher.1 > high.1 {
                *high = higher;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_curve_keeps_its_peaks_and_its_ends() {
        let mut curve = Curve::default();
        for k in 0..100_001 {
            let value = if k == 54_321 { 7.0 } else { 0.0 };
            curve.push(f64::from(k), [value]);
        }
        let points = curve.component(0);
        assert!(points.len() <= 2 * STRETCHES + 2, "{}", points.len());
        assert!(points.contains(&(54_321.0, 7.0)));
        assert!(points.is_sorted_by(|a, b| a.0 < b.0));
        assert_eq!(curve.range(), Some([0.0, 100_000.0]));
        assert_eq!((points[0].0, points[points.len() - 1].0), (0.0, 100_000.0));
    }

    #[test]
    fn a_short_curve_is_what_it_was() {
        let mut curve = Curve::default();
        for k in 0..STRETCHES {
            curve.push(k as f64, [(k as f64).sin()]);
        }
        let expected: Vec<Extreme> = (0..STRETCHES)
            .map(|k| (k as f64, (k as f64).sin()))
            .collect();
        assert_eq!(curve.component(0), expected);
    }
}
