//! Derives systems of the same motion with other requests.
//!
//! Requests are not part of the equations. So a system may be asked for everything, with no calculation omitted, or for the
//! motion alone.

use super::System;

impl System {
    /// Returns the system without the effect of `output` and `monitor` statements, so that nothing is omitted.
    pub fn in_full(&self) -> System {
        let mut system = self.clone();
        system.mechanism.requests.clear();
        system.mechanism.monitor = false;
        system
    }

    /// Returns the system without derivatives along directions and without omissions.
    pub fn without_directions(&self) -> System {
        let mut system = self.clone();
        system.mechanism.requests.clear();
        system.mechanism.transmissions.clear();
        system.directions.clear();
        system
    }
}
