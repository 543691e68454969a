//! *Where a point is, instant by instant* → *a bounded number of places along its path*.

/// How many places are kept at most.
const PLACES: usize = 4000;

/// The places that a point has been at: every one of a short motion, every second, fourth, … of a long one.
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
    /// Takes the next place.
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
            // The number that made the list too long may lie between the longer strides.
            if self.count.is_multiple_of(self.stride) {
                self.places.push(place);
            }
        }
        self.count += 1;
        self.last = Some(place);
    }

    /// The places in their order, the last one included.
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
