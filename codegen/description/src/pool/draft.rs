//! Copies a pool for expressions that are made only while output is produced.
//!
//! A draft cannot become a pool again. So nothing that output adds changes the ids, and with them the bits, of later stages.

use std::ops::{Deref, DerefMut};

use super::Pool;

/// Copy of a pool that is discarded after use; its ids continue where those of the pool end.
#[derive(Clone, Debug)]
pub struct Draft(Pool);

impl Pool {
    /// Returns a draft of the pool.
    pub fn draft(&self) -> Draft {
        Draft(self.clone())
    }
}

impl Deref for Draft {
    type Target = Pool;

    fn deref(&self) -> &Pool {
        &self.0
    }
}

impl DerefMut for Draft {
    fn deref_mut(&mut self) -> &mut Pool {
        &mut self.0
    }
}
