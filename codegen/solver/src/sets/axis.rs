//! Spaces values evenly between two ends.

/// Evenly spaced values, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Ends.
    pub ends: [f64; 2],
    /// Number of values.
    pub count: u64,
}

impl Axis {
    /// Returns the value of this index.
    pub fn value(&self, index: u64) -> f64 {
        let [first, last] = self.ends;
        let steps = self.count.saturating_sub(1);
        match index {
            0 => first,
            index if index == steps => last,
            index => {
                let share = index as f64 / steps as f64;
                let sum = first * (steps - index) as f64 + last * index as f64;
                match sum.is_finite() {
                    true => sum / steps as f64,
                    false => first * (1.0 - share) + last * share,
                }
            }
        }
    }
}
