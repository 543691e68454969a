//! Evaluates a periodic cubic spline from its definition, independently of the product.
//!
//! The curvatures at the knots solve the cyclic system of the spline (de Boor, *A Practical Guide to Splines*, chapter IV); value, rate and
//! curvature between two knots follow from them.

use std::fmt::Write as _;

use nalgebra::{Matrix4, Vector4};

/// Places of the knots in periods; the last one repeats the first.
const PLACES: [f64; 5] = [0.0, 0.1875, 0.4375, 0.75, 1.0];

/// Table of four heights that repeats itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Periodic {
    /// Number that distinguishes its name.
    pub number: usize,
    /// First argument (s).
    pub first: f64,
    /// Period (s).
    pub period: f64,
    /// Heights at the knots.
    pub heights: [f64; 4],
}

impl Periodic {
    fn knot(&self, index: usize) -> f64 {
        self.first + self.period * PLACES[index]
    }

    fn height(&self, index: usize) -> f64 {
        self.heights[index % 4]
    }

    /// Width of the piece behind a knot, counted around the period.
    fn width(&self, index: usize) -> f64 {
        let index = index % 4;
        self.knot(index + 1) - self.knot(index)
    }

    fn slope(&self, index: usize) -> f64 {
        let index = index % 4;
        (self.height(index + 1) - self.height(index)) / self.width(index)
    }

    /// Second derivatives at the knots.
    fn curvatures(&self) -> Vector4<f64> {
        let mut matrix = Matrix4::zeros();
        let mut right = Vector4::zeros();
        for row in 0..4 {
            let (before, after) = (self.width(row + 3), self.width(row));
            matrix[(row, (row + 3) % 4)] += before;
            matrix[(row, row)] += 2.0 * (before + after);
            matrix[(row, (row + 1) % 4)] += after;
            right[row] = 6.0 * (self.slope(row) - self.slope(row + 3));
        }
        let solution = matrix.full_piv_lu().solve(&right);
        solution.expect("a diagonally dominant derived")
    }

    /// Value, first and second derivative at an argument.
    pub fn at(&self, argument: f64) -> [f64; 3] {
        let within = (argument - self.first).rem_euclid(self.period) + self.first;
        let piece = (1..4).rfind(|it| self.knot(*it) <= within).unwrap_or(0);
        let curvatures = self.curvatures();
        let (m, n) = (curvatures[piece], curvatures[(piece + 1) % 4]);
        let (h, s) = (self.width(piece), within - self.knot(piece));
        let slope = self.slope(piece) - h * (2.0 * m + n) / 6.0;
        let third = (n - m) / h;
        [
            self.height(piece) + s * (slope + s * (0.5 * m + s * third / 6.0)),
            slope + s * (m + 0.5 * s * third),
            m + s * third,
        ]
    }

    /// Table with heights that are so many times as large.
    pub fn scaled(&self, factor: f64) -> Periodic {
        Periodic {
            heights: self.heights.map(|it| factor * it),
            ..*self
        }
    }

    /// Name of the table.
    pub fn name(&self) -> String {
        format!("repeated{}", self.number)
    }

    /// Statement that declares the table.
    pub fn declaration(&self) -> String {
        let mut text = format!("table {} = [", self.name());
        for index in 0..5 {
            let separator = if index == 0 { "" } else { ", " };
            let (knot, height) = (self.knot(index), self.height(index));
            let _ = write!(text, "{separator}({knot:?}, {height:?})");
        }
        text + "] periodic;"
    }
}
