//! Finds the vectors that depend linearly on earlier ones, with their combinations.
//!
//! Modified Gram-Schmidt, orthogonalized twice (Björck, Numerical Methods for Least Squares Problems, 1996, section 2.4). The
//! combination of a dependent vector is unique, so its vectors are a smallest dependent set: without any one of them, the others
//! are independent.

/// Largest remainder that counts as rounding, relative to its vector.
pub(super) const TOLERANCE: f64 = 1e-10;

/// Largest factor of a combination that counts as rounding.
const PART: f64 = 1e-7;

/// Independent vectors, in the order of insertion.
#[derive(Clone, Debug, Default)]
pub(super) struct Basis {
    /// Orthonormal directions, one per vector.
    directions: Vec<Vec<f64>>,
    /// Numbers of the vectors.
    members: Vec<usize>,
    /// Components of each vector in the directions up to its own.
    components: Vec<Vec<f64>>,
}

/// Vector reduced by a basis.
#[derive(Clone, Debug)]
pub(super) struct Reduced {
    components: Vec<f64>,
    rest: Vec<f64>,
    /// Independent fraction of the vector: 0 for a vector in the span, 1 for an orthogonal one.
    pub independent: f64,
}

impl Basis {
    /// Returns the number of vectors.
    pub fn rank(&self) -> usize {
        self.members.len()
    }

    /// Decomposes a vector. A zero vector counts as dependent, with an empty combination.
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

    /// Inserts a vector that is independent of the earlier ones.
    pub fn insert(&mut self, member: usize, reduced: Reduced) {
        let size = norm(&reduced.rest);
        let mut components = reduced.components;
        components.push(size);
        self.directions
            .push(reduced.rest.iter().map(|part| part / size).collect());
        self.components.push(components);
        self.members.push(member);
    }

    /// Inserts the vector if it is independent; otherwise returns the combination of members that gives the vector.
    pub fn take(&mut self, member: usize, vector: &[f64]) -> Result<(), Vec<(usize, f64)>> {
        let reduced = self.reduce(vector);
        if reduced.independent > TOLERANCE {
            self.insert(member, reduced);
            Ok(())
        } else {
            Err(self.combination(&reduced))
        }
    }

    /// Returns the members and factors whose sum the vector is, without negligible factors.
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
