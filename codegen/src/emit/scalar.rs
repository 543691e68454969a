//! Digits of numbers in the scalar of the code.

/// Limits of magnitudes without an exponent: from the first to below the second.
const SMALLEST_PLAIN: f64 = 1e-5;
const LARGEST_PLAIN: f64 = 1e16;

/// The scalar of the generated code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scalar {
    /// Double precision.
    #[default]
    F64,
    /// Single precision, for processors without hardware for double precision.
    F32,
}

impl Scalar {
    /// Number of mechanisms that a module with lanes solves at once.
    pub fn lanes(self) -> usize {
        match self {
            Scalar::F64 => 8,
            Scalar::F32 => 16,
        }
    }

    /// Magnitude of a finite number in the fewest digits that reproduce it.
    pub(super) fn digits(self, value: f64) -> String {
        let size = value.abs();
        match self {
            // Beyond single precision a number would become infinite or zero; it stays, and the compiler reports it.
            Scalar::F32 if (size as f32).is_finite() => digits(size, size as f32),
            _ => digits(size, size),
        }
    }
}

/// Digits of a number; at extreme magnitudes a literal would be hundreds of digits long.
fn digits<T: std::fmt::Display + std::fmt::LowerExp>(size: f64, value: T) -> String {
    if size != 0.0 && !(SMALLEST_PLAIN..LARGEST_PLAIN).contains(&size) {
        return format!("{value:e}");
    }
    let text = value.to_string();
    match text.contains('.') {
        true => text,
        false => format!("{text}.0"),
    }
}
