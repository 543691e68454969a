//! Keeps a bounded number of positions along the path of a point.

/// Largest number of positions.
const PLACES: usize = 4000;

/// Positions of a point: every one of a short motion, every second, fourth, … of a long one.
#[derive(Clone, Debug)]
pub struct Path {
    places: Vec<[f64; 2]>,
    last: Option<[f64; 2]>,
    count: usize,
    stride: usize,
}

impl Default for Path {
    fn default() -> Self {
        Path {
            places: Vec::new(),
            last: None,
            count: 0,
            stride: 1,
        }
    }
}

impl Path {
    /// Adds the next position.
    pub fn push(&mut self, place: [f64; 2]) {
        if self.count.is_multiple_of(self.stride) {
            if self.places.len() == PLACES {
                let mut number = 0;
                self.places.retain(|_| {
                    number += 1;
                    number % 2 == 1
                });
                self.stride *= 2;
            }
            // The position that exceeded the limit may lie between the longer strides.
            if self.count.is_multiple_of(self.stride) {
                self.places.push(place);
            }
        }
        self.count += 1;
        self.last = Some(place);
    }

    /// Returns the positions in order, with the last one of the motion.
    pub fn places(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let last = self.last.filter(|last| self.places.last() != Some(last));
        self.places.iter().copied().chain(last)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_path_is_thinned_evenly() {
        let mut path = Path::default();
        for k in 0..100_000 {
            path.push([f64::from(k), 0.0]);
        }
        let places: Vec<f64> = path.places().map(|it| it[0]).collect();
        assert!(
            (PLACES / 2..=PLACES + 1).contains(&places.len()),
            "{}",
            places.len()
        );
        let (last, rest) = places.split_last().expect("places");
        assert_eq!((rest[0], *last), (0.0, 99_999.0));
        assert!(
            rest.windows(2).all(|it| it[1] - it[0] == rest[1]),
            "{rest:?}"
        );
    }

    #[test]
    fn a_short_path_is_what_it_was() {
        let mut path = Path::default();
        for place in [[0.0, 1.0], [2.0, 3.0]] {
            path.push(place);
        }
        assert_eq!(path.places().collect::<Vec<_>>(), [[0.0, 1.0], [2.0, 3.0]]);
    }
}
