//! Generates points of Sobol's sequence by their index, with the direction numbers of Joe and Kuo.
//!
//! S. Joe and F. Y. Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM J. Sci. Comput. 30 (2008) 2635-2654.
//! Every 2^m points from a multiple of 2^m on have one point in each of 2^m equal intervals of a dimension, also if they are scrambled.

/// Number of bits of a coordinate; the sequence has `1 << BITS` points.
pub const BITS: u32 = 32;

/// Largest number of dimensions.
pub const MAX_DIMENSIONS: usize = 31;

/// Degree of the primitive polynomial, its inner coefficients as bits, and the first direction numbers, for each dimension after the first.
type Direction = (u32, u32, &'static [u32]);

const DIRECTIONS: [Direction; MAX_DIMENSIONS - 1] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
    (5, 4, &[1, 1, 5, 5, 5]),
    (5, 7, &[1, 1, 7, 11, 19]),
    (5, 11, &[1, 1, 5, 1, 1]),
    (5, 13, &[1, 1, 1, 3, 11]),
    (5, 14, &[1, 3, 5, 5, 31]),
    (6, 1, &[1, 3, 3, 9, 7, 49]),
    (6, 13, &[1, 1, 1, 15, 21, 21]),
    (6, 16, &[1, 3, 1, 13, 27, 49]),
    (6, 19, &[1, 1, 1, 15, 7, 5]),
    (6, 22, &[1, 3, 1, 15, 13, 25]),
    (6, 25, &[1, 1, 5, 5, 19, 61]),
    (7, 1, &[1, 3, 7, 11, 23, 15, 103]),
    (7, 4, &[1, 3, 7, 13, 13, 15, 69]),
    (7, 7, &[1, 1, 3, 13, 7, 35, 63]),
    (7, 8, &[1, 3, 5, 9, 1, 25, 53]),
    (7, 14, &[1, 3, 1, 13, 9, 35, 107]),
    (7, 19, &[1, 3, 1, 5, 27, 61, 31]),
    (7, 21, &[1, 1, 5, 11, 19, 41, 61]),
    (7, 28, &[1, 3, 5, 3, 3, 13, 69]),
    (7, 31, &[1, 1, 7, 13, 1, 19, 1]),
    (7, 32, &[1, 3, 7, 5, 13, 19, 59]),
    (7, 37, &[1, 1, 3, 9, 25, 29, 41]),
    (7, 41, &[1, 3, 5, 13, 23, 1, 55]),
];

/// Sobol's sequence in some dimensions.
#[derive(Clone, Debug)]
pub struct Sobol {
    /// Direction numbers of each dimension, as fractions of 2^[`BITS`].
    directions: Vec<[u32; BITS as usize]>,
    /// Seed of the scrambling; `None` for the sequence itself.
    seed: Option<u64>,
}

impl Sobol {
    /// Creates the sequence; `None` for more than [`MAX_DIMENSIONS`] dimensions.
    pub fn new(dimensions: usize, seed: Option<u64>) -> Option<Sobol> {
        (dimensions <= MAX_DIMENSIONS).then(|| Sobol {
            directions: (0..dimensions).map(directions).collect(),
            seed,
        })
    }

    /// Seed of the scrambling; `None` for the sequence itself.
    pub fn seed(&self) -> Option<u64> {
        self.seed
    }

    /// Returns a coordinate of the point with this index, from 0 to below 1. Points are in the order of the Gray code.
    pub fn coordinate(&self, index: u32, dimension: usize) -> f64 {
        let gray = index ^ (index >> 1);
        let directions = self.directions[dimension].iter().enumerate();
        let chosen = directions.filter(|(bit, _)| gray >> bit & 1 == 1);
        let bits = chosen.fold(0, |bits, (_, direction)| bits ^ direction);
        let bits = match self.seed {
            None => bits,
            Some(seed) => scrambled(bits, mixed(seed ^ mixed(dimension as u64))),
        };
        f64::from(bits) / (1_u64 << BITS) as f64
    }

    /// Returns a value of the sample with this index, between two ends.
    pub fn within(&self, index: u32, dimension: usize, [first, last]: [f64; 2]) -> f64 {
        let share = self.coordinate(index, dimension);
        first * (1.0 - share) + last * share
    }
}

/// Returns the direction numbers of a dimension by the recurrence of its polynomial.
fn directions(dimension: usize) -> [u32; BITS as usize] {
    let mut numbers = [0; BITS as usize];
    let Some((degree, inner, first)) = dimension.checked_sub(1).map(|it| DIRECTIONS[it]) else {
        for (bit, number) in (0..BITS).zip(&mut numbers) {
            *number = 1 << (BITS - 1 - bit);
        }
        return numbers;
    };
    let degree = degree as usize;
    for bit in 0..BITS as usize {
        numbers[bit] = match first.get(bit) {
            Some(number) => number << (BITS as usize - 1 - bit),
            None => {
                let oldest = numbers[bit - degree];
                let inner = (1..degree).filter(|it| inner >> (degree - 1 - it) & 1 == 1);
                inner.fold(oldest ^ oldest >> degree, |sum, it| sum ^ numbers[bit - it])
            }
        };
    }
    numbers
}

/// Scrambles a coordinate as Owen does: each bit is flipped or not, depending on all bits before it.
fn scrambled(bits: u32, seed: u64) -> u32 {
    (0..BITS).fold(bits, |result, bit| {
        // A leading one tells prefixes of different lengths apart.
        let prefix = (1 << bit) | u64::from(bits) >> (BITS - bit);
        let flip = (mixed(seed ^ prefix) >> 63) as u32;
        result ^ flip << (BITS - 1 - bit)
    })
}

/// Mixes all bits of a number: a step of the generator SplitMix64.
pub(super) fn mixed(number: u64) -> u64 {
    let number = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let number = (number ^ number >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let number = (number ^ number >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    number ^ number >> 31
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bits(sobol: &Sobol, index: u32, dimension: usize) -> u64 {
        (sobol.coordinate(index, dimension) * (1_u64 << BITS) as f64) as u64
    }

    /// The points that Joe and Kuo print for their program.
    #[test]
    fn the_first_points_are_those_of_the_authors() {
        let sobol = Sobol::new(3, None).expect("few dimensions");
        let expected = [
            [0.0, 0.0, 0.0],
            [0.5, 0.5, 0.5],
            [0.75, 0.25, 0.25],
            [0.25, 0.75, 0.75],
            [0.375, 0.375, 0.625],
            [0.875, 0.875, 0.125],
            [0.625, 0.125, 0.875],
            [0.125, 0.625, 0.375],
            [0.1875, 0.3125, 0.9375],
            [0.6875, 0.8125, 0.4375],
        ];
        for (index, point) in (0..).zip(expected) {
            assert_eq!([0, 1, 2].map(|it| sobol.coordinate(index, it)), point);
        }
    }

    /// Point 1000 of SciPy 1.17, times 2³².
    #[test]
    fn all_dimensions_are_those_of_another_program() {
        let expected: [u64; MAX_DIMENSIONS] = [
            943718400, 415236096, 2227175424, 2906652672, 1203765248, 3896508416, 197132288,
            3862953984, 2151677952, 297795584, 364904448, 1094713344, 692060160, 1648361472,
            616562688, 1589641216, 3091202048, 1480589312, 4257218560, 3116367872, 2243952640,
            2361393152, 4081057792, 2319450112, 2503999488, 3896508416, 171966464, 4206886912,
            255852544, 1463812096, 633339904,
        ];
        let sobol = Sobol::new(MAX_DIMENSIONS, None).expect("as many as there are");
        let point = std::array::from_fn(|dimension| bits(&sobol, 1000, dimension));
        assert_eq!(point, expected);
        assert!(Sobol::new(MAX_DIMENSIONS + 1, None).is_none());
    }

    /// L2 star discrepancy by the formula of Warnock.
    fn discrepancy(points: &[Vec<f64>]) -> f64 {
        let (count, dimensions) = (points.len() as f64, points[0].len() as i32);
        let single = |point: &Vec<f64>| point.iter().map(|it| 1.0 - it * it).product::<f64>();
        let pair = |one: &Vec<f64>, other: &Vec<f64>| {
            let both = one.iter().zip(other);
            both.map(|(a, b)| 1.0 - a.max(*b)).product::<f64>()
        };
        let singles: f64 = points.iter().map(single).sum();
        let all = || points.iter();
        let pairs: f64 = all()
            .flat_map(|one| all().map(move |it| pair(one, it)))
            .sum();
        let square = 3.0_f64.powi(-dimensions) - 2.0_f64.powi(1 - dimensions) / count * singles
            + pairs / (count * count);
        square.sqrt()
    }

    /// The value is that of SciPy for the same points; scrambled points are more even than random ones, too.
    #[test]
    fn points_are_even() {
        let points = |seed| -> Vec<Vec<f64>> {
            let sobol = Sobol::new(5, seed).expect("few dimensions");
            let point = |index| (0..5).map(|it| sobol.coordinate(index, it)).collect();
            (0..1024).map(point).collect()
        };
        let plain = discrepancy(&points(None));
        assert!(
            (plain - 0.001_521_307_358_498_849_3).abs() < 1e-12,
            "{plain}"
        );
        // The mean square of independent random points.
        let random = ((2.0_f64.powi(-5) - 3.0_f64.powi(-5)) / 1024.0).sqrt();
        for seed in 0..4 {
            let scrambled = discrepancy(&points(Some(seed)));
            assert!(scrambled < 0.5 * random, "{seed}: {scrambled} {random}");
        }
    }

    #[test]
    fn scrambled_points_fill_every_interval() {
        let plain = Sobol::new(8, None).expect("few dimensions");
        let scrambled = Sobol::new(8, Some(7)).expect("few dimensions");
        let other = Sobol::new(8, Some(8)).expect("few dimensions");
        for dimension in 0..8 {
            let cell = |index| bits(&scrambled, index, dimension) >> (BITS - 8);
            let mut cells: Vec<u64> = (512..768).map(cell).collect();
            cells.sort_unstable();
            assert!(cells.into_iter().eq(0..256), "{dimension}");
            let differs = |one: &Sobol, other: &Sobol| {
                (0..16).any(|it| bits(one, it, dimension) != bits(other, it, dimension))
            };
            assert!(differs(&plain, &scrambled) && differs(&scrambled, &other));
        }
    }
}
