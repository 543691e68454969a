//! Points, places of frames and outlines in the plane.

/// Relative size of rounding in a picture.
pub(super) const RELATIVE_ROUNDING: f64 = 1e-9;

/// Components along x and y.
pub type Point = [f64; 2];

/// Position of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place {
    /// Its origin.
    pub origin: Point,
    /// Its angle, in rad, counterclockwise.
    pub angle: f64,
}

impl Place {
    /// A vector of the frame in global components.
    pub fn rotate(&self, v: Point) -> Point {
        let (sine, cosine) = self.angle.sin_cos();
        [cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1]]
    }

    /// A global vector in the components of the frame.
    pub fn unrotate(&self, v: Point) -> Point {
        let (sine, cosine) = self.angle.sin_cos();
        [cosine * v[0] + sine * v[1], cosine * v[1] - sine * v[0]]
    }

    /// Global position of a point of the frame.
    pub fn globally(&self, local: Point) -> Point {
        sum(self.origin, self.rotate(local))
    }

    /// Point of the frame at a global position.
    pub fn locally(&self, global: Point) -> Point {
        self.unrotate(difference(global, self.origin))
    }
}

pub(super) fn sum(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1]]
}

/// a − b.
pub(super) fn difference(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(super) fn scaled(a: Point, factor: f64) -> Point {
    [a[0] * factor, a[1] * factor]
}

/// a + length·b.
pub(super) fn onward(a: Point, length: f64, b: Point) -> Point {
    [a[0] + length * b[0], a[1] + length * b[1]]
}

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// `a` turned by a quarter turn counterclockwise.
pub(super) fn left_of(a: Point) -> Point {
    [-a[1], a[0]]
}

pub(super) fn distance(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Distance of a point from the segment between two others.
pub(super) fn distance_to_segment(point: Point, [a, b]: [Point; 2]) -> f64 {
    let along = difference(b, a);
    let squared = dot(along, along);
    let part = match squared > 0.0 {
        true => (dot(difference(point, a), along) / squared).clamp(0.0, 1.0),
        false => 0.0,
    };
    distance(point, onward(a, part, along))
}

/// The unit vector at an angle.
pub(super) fn heading(angle: f64) -> Point {
    let (sine, cosine) = angle.sin_cos();
    [cosine, sine]
}

/// The angle of a vector.
pub(super) fn angle_of(v: Point) -> f64 {
    v[1].atan2(v[0])
}

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub low: Point,
    pub high: Point,
}

impl Bounds {
    /// Around nothing.
    pub const EMPTY: Bounds = Bounds {
        low: [f64::INFINITY; 2],
        high: [f64::NEG_INFINITY; 2],
    };

    pub fn around(center: Point, half: Point) -> Bounds {
        Bounds {
            low: difference(center, half),
            high: sum(center, half),
        }
    }

    pub fn of(points: impl IntoIterator<Item = Point>) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        points.into_iter().for_each(|point| bounds.include(point));
        bounds
    }

    pub fn include(&mut self, point: Point) {
        for axis in [0, 1] {
            self.low[axis] = self.low[axis].min(point[axis]);
            self.high[axis] = self.high[axis].max(point[axis]);
        }
    }

    pub fn widened(self, by: f64) -> Bounds {
        Bounds {
            low: [self.low[0] - by, self.low[1] - by],
            high: [self.high[0] + by, self.high[1] + by],
        }
    }

    pub fn is_empty(&self) -> bool {
        self.low[0] > self.high[0]
    }

    pub fn size(&self) -> Point {
        match self.is_empty() {
            true => [0.0; 2],
            false => difference(self.high, self.low),
        }
    }

    pub fn center(&self) -> Point {
        match self.is_empty() {
            true => [0.0; 2],
            false => scaled(sum(self.low, self.high), 0.5),
        }
    }

    pub fn meets(&self, other: &Bounds) -> bool {
        (0..2).all(|axis| self.low[axis] < other.high[axis] && other.low[axis] < self.high[axis])
    }

    pub fn holds(&self, other: &Bounds) -> bool {
        (0..2).all(|axis| self.low[axis] <= other.low[axis] && other.high[axis] <= self.high[axis])
    }

    pub fn encloses(&self, point: Point) -> bool {
        (0..2).all(|axis| self.low[axis] <= point[axis] && point[axis] <= self.high[axis])
    }

    /// Length of the segment from `a` to `b` inside the box (Liang and Barsky 1984).
    pub fn length_inside(&self, a: Point, b: Point) -> f64 {
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        let along = difference(b, a);
        for axis in [0, 1] {
            let (low, high) = (self.low[axis] - a[axis], self.high[axis] - a[axis]);
            if along[axis] == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return 0.0;
                }
                continue;
            }
            let ends = [low / along[axis], high / along[axis]];
            enters = enters.max(ends[0].min(ends[1]));
            leaves = leaves.min(ends[0].max(ends[1]));
        }
        (leaves - enters).max(0.0) * along[0].hypot(along[1])
    }
}

/// The corners of the convex hull, counterclockwise (Andrew 1979); of points on a line its ends.
pub(super) fn hull(points: &[Point]) -> Vec<Point> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let size = Bounds::of(points.iter().copied()).size();
    // A point closer to a line than this lies on it.
    let slack = RELATIVE_ROUNDING * (size[0] + size[1]).powi(2);
    sorted.dedup_by(|a, b| distance(*a, *b) <= RELATIVE_ROUNDING * (size[0] + size[1]));
    if sorted.len() < 3 {
        return sorted;
    }
    let turn = |a: Point, b: Point, c: Point| dot(left_of(difference(b, a)), difference(c, a));
    let chain = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && turn(a, b, point) <= slack
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut corners = chain(&mut sorted.iter().copied());
    corners.extend(chain(&mut sorted.iter().rev().copied()));
    corners
}

/// True if a point lies inside a closed polygon.
pub(super) fn is_inside(point: Point, polygon: &[Point]) -> bool {
    let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
    edges
        .filter(|(a, b)| {
            (a[1] > point[1]) != (b[1] > point[1])
                && point[0] < a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
        })
        .count()
        % 2
        == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_leaves_out_what_lies_within_and_on_its_edges() {
        let corners = hull(&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 0.5], [1.0, 2.0]]);
        assert_eq!(corners, [[0.0, 0.0], [2.0, 0.0], [1.0, 2.0]]);
        assert_eq!(
            hull(&[[0.0, 0.0], [1.0, 1.0], [0.5, 0.5]]),
            [[0.0, 0.0], [1.0, 1.0]]
        );
        assert_eq!(hull(&[[1.0, 1.0], [1.0, 1.0]]).len(), 1);
    }

    #[test]
    fn the_part_of_a_segment_in_a_box_is_measured() {
        let unit = Bounds::around([0.0, 0.0], [1.0, 1.0]);
        assert_eq!(unit.length_inside([-3.0, 0.0], [3.0, 0.0]), 2.0);
        assert_eq!(unit.length_inside([-3.0, 2.0], [3.0, 2.0]), 0.0);
        assert_eq!(unit.length_inside([0.0, 0.0], [0.0, 0.5]), 0.5);
    }

    #[test]
    fn a_place_and_its_opposite_cancel() {
        let place = Place {
            origin: [1.0, 2.0],
            angle: 0.7,
        };
        let back = place.locally(place.globally([0.3, -0.4]));
        assert!(distance(back, [0.3, -0.4]) < 1e-15, "{back:?}");
    }
}
