//! Guards values that only the module `system` may change.
//!
//! Later stages read [`Settled`] values like the values inside. Afterwards only the arena of expressions grows, with the symbols,
//! roles, rotated vectors and rates that methods of `system` add.

use std::ops::Deref;

/// Value that only the module `system` writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settled<T>(T);

impl<T> Settled<T> {
    pub(in crate::system) fn new(value: T) -> Settled<T> {
        Settled(value)
    }

    /// Returns the value for changes.
    pub(in crate::system) fn write(&mut self) -> &mut T {
        &mut self.0
    }
}

impl<T> Deref for Settled<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0
    }
}

impl<'a, T> IntoIterator for &'a Settled<Vec<T>> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}
