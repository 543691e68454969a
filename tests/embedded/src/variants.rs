//! The variants that the build script has generated, each as what [`crate::motion`] moves.

use linkwright::Failure;

use crate::machine::Machine;
use crate::motion::{self, Moved, Real};

macro_rules! moved {
    ($module:ident, $mechanism:ident, $real:ty) => {
        impl Moved for $module::$mechanism {
            type Real = $real;

            fn assemble(t: $real) -> Result<Self, Failure<$real>> {
                $module::$mechanism::assemble(t)
            }

            fn advance(&mut self, t: $real) -> Result<(), Failure<$real>> {
                $module::$mechanism::advance(self, t).map(|_| ())
            }

            fn numbers(&self, mut each: impl FnMut(u64)) {
                let $module::Frame { t, q, qd, qdd, .. } = self.frame();
                each(t.bits());
                for level in [q, qd, qdd] {
                    level.to_array().iter().for_each(|value| each(value.bits()));
                }
            }

            #[cfg(feature = "planted_textbook")]
            fn textbook(&self) -> u64 {
                let $module::Frame { t, q, .. } = self.frame();
                // Through a pointer, so that it is not taken apart.
                let phi_q: fn(&$module::Coordinates, $real) -> _ =
                    core::hint::black_box($module::phi_q);
                let jacobian = phi_q(q, *t);
                jacobian.iter().fold(0, |sum, it| sum ^ it.bits())
            }
        }
    };
}

include!(concat!(env!("OUT_DIR"), "/variants.rs"));
