//! A system → the same motion with less asked for.
//!
//! What is asked for is no part of the equations, so others may ask for less of them: for everything, so that nothing is left out, or for the
//! motion alone.

use super::System;

impl System {
    /// The same with nothing left out: without what `output` and `monitor` statements ask for.
    pub fn in_full(&self) -> System {
        let mut system = self.clone();
        system.mechanism.requests.clear();
        system.mechanism.monitor = false;
        system
    }

    /// The same without what is derived along directions, and with nothing left out.
    pub fn without_directions(&self) -> System {
        let mut system = self.clone();
        system.mechanism.requests.clear();
        system.mechanism.transmissions.clear();
        system.directions.write().clear();
        system
    }
}
