//! Vectors one after another → which of them depend on those before, and how.
//!
//! Modified Gram-Schmidt, orthogonalised twice (Björck, Numerical Methods for Least Squares Problems, 1996, section 2.4). The
//! combination that gives a dependent vector is unique, so the vectors with a part in it are a smallest dependent set: leave
//! out any of them and the rest are independent. Deliberately unknown here: what the vectors are.

/// A remainder smaller than this part of its vector is rounding.
pub(super) const TOLERANCE: f64 = 1e-10;

/// A part smaller than this in a combination is rounding.
const PART: f64 = 1e-7;

/// Independent vectors, as they were taken in.
#[derive(Clone, Debug, Default)]
pub(super) struct Basis {
    /// Orthonormal, one for each vector.
    directions: Vec<Vec<f64>>,
    /// The numbers under which the vectors were taken in.
    members: Vec<usize>,
    /// Each vector by the directions up to its own.
    components: Vec<Vec<f64>>,
}

/// A vector against a basis.
#[derive(Clone, Debug)]
pub(super) struct Reduced {
    components: Vec<f64>,
    rest: Vec<f64>,
    /// How much of the vector is independent: 0 for a vector of the span, 1 for one across it.
    pub independent: f64,
}

impl Basis {
    /// How many vectors it holds.
    pub fn rank(&self) -> usize {
        self.members.len()
    }

    /// Takes a vector apart. A zero vector depends on nothing and is dependent all the same.
    pub fn reduce(&self, vector: &[f64]) -> Reduced {
        let size = norm(vector);
        let mut rest = vector.to_vec();
        let mut components = vec![0.0; self.directions.len()];
        for _ in 0..2 {
            for (component, direction) in components.iter_mut().zip(&self.directions) {
                let part = dot(direction, &rest);
                *component += part;
                for (rest, along) in rest.iter_mut().zip(direction) {
                    *rest -= part * along;
                }
            }
        }
        let independent = if size > 0.0 { norm(&rest) / size } else { 0.0 };
        Reduced {
            components,
            rest,
            independent,
        }
    }

    /// Takes in a vector that is independent of those before.
    pub fn insert(&mut self, member: usize, reduced: Reduced) {
        let size = norm(&reduced.rest);
        let mut components = reduced.components;
        components.push(size);
        self.directions
            .push(reduced.rest.iter().map(|part| part / size).collect());
        self.components.push(components);
        self.members.push(member);
    }

    /// Takes in the vector where it is independent; otherwise says of which members it consists.
    pub fn take(&mut self, member: usize, vector: &[f64]) -> Result<(), Vec<(usize, f64)>> {
        let reduced = self.reduce(vector);
        if reduced.independent > TOLERANCE {
            self.insert(member, reduced);
            Ok(())
        } else {
            Err(self.combination(&reduced))
        }
    }

    /// The members with their factors whose sum the vector is, leaving out those without a part in it.
    fn combination(&self, reduced: &Reduced) -> Vec<(usize, f64)> {
        let mut open = reduced.components.clone();
        let mut factors = vec![0.0; open.len()];
        for last in (0..open.len()).rev() {
            let factor = open[last] / self.components[last][last];
            for (open, component) in open.iter_mut().zip(&self.components[last]) {
                *open -= factor * component;
            }
            factors[last] = factor;
        }
        let largest = factors.iter().fold(0.0_f64, |most, it| most.max(it.abs()));
        let parts = self.members.iter().copied().zip(factors);
        parts
            .filter(|(_, factor)| factor.abs() > PART * largest)
            .collect()
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(super) fn norm(vector: &[f64]) -> f64 {
    let largest = vector.iter().fold(0.0_f64, |most, it| most.max(it.abs()));
    if largest > 0.0 && largest.is_finite() {
        let scaled = vector.iter().map(|it| (it / largest) * (it / largest));
        largest * scaled.sum::<f64>().sqrt()
    } else {
        largest
    }
}

#[cfg(test)]
mod tests {
    use super::Basis;

    #[test]
    fn a_dependent_vector_names_only_what_it_consists_of() {
        let mut basis = Basis::default();
        assert!(basis.take(0, &[1.0, 2.0, 0.0, 0.0]).is_ok());
        assert!(basis.take(1, &[0.0, 1.0, 3.0, 0.0]).is_ok());
        assert!(basis.take(2, &[0.0, 0.0, 0.0, 1.0]).is_ok());
        // 2 a − b, by hand.
        let parts = basis
            .take(3, &[2.0, 3.0, -3.0, 0.0])
            .expect_err("dependent");
        assert_eq!(parts.iter().map(|part| part.0).collect::<Vec<_>>(), [0, 1]);
        assert!((parts[0].1 - 2.0).abs() < 1e-14 && (parts[1].1 + 1.0).abs() < 1e-14);
        assert_eq!(basis.rank(), 3);
    }

    #[test]
    fn a_zero_vector_is_dependent_on_nothing() {
        let mut basis = Basis::default();
        assert!(basis.take(0, &[0.0, 1.0]).is_ok());
        assert_eq!(basis.take(1, &[0.0, 0.0]), Err(Vec::new()));
    }

    #[test]
    fn nearly_parallel_vectors_are_independent() {
        let mut basis = Basis::default();
        assert!(basis.take(0, &[1.0, 0.0]).is_ok());
        assert!(basis.take(1, &[1.0, 1e-8]).is_ok());
        assert!(basis.take(2, &[0.3, 0.7]).is_err());
    }
}
