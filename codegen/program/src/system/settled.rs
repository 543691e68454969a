//! *What the equations say* → *the same, to be read by everyone and written in this room alone*.
//!
//! The rooms behind `system` read [`Settled`] values like what they hold. Only the arena of expressions grows there, and what the
//! methods of this room add for it: symbols with their roles, arms, rates.

use std::ops::Deref;

/// A value that only the room of equations writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settled<T>(T);

impl<T> Settled<T> {
    pub(in crate::system) fn new(value: T) -> Settled<T> {
        Settled(value)
    }

    /// The value, to be written.
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
