//! Declares the stored assemblies of a mechanism: their modes, and the poses from which Newton-Raphson starts.

/// Assemblies with their labels, modes and the values of some fields of a frame there.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_assemblies {
    (
        $(#[$docs:meta])*
        $name:ident [$count:literal] of [$($($field:ident).+),* $(,)?] {
            $($number:literal, $label:literal { $($mode:ident: $value:expr),* $(,)? } at $pose:expr;)*
        }
    ) => {
        // A start may be near a constant of mathematics.
        #[allow(dead_code, clippy::approx_constant)]
        impl $name {
            $(#[$docs])*
            pub const ASSEMBLIES: [Self; $count] = [$(Self { $($mode: $value,)* assembly: Some($number) },)*];

            /// Labels of the assemblies, as `linkwright check` prints them.
            pub const LABELS: [&'static str; $count] = [$($label,)*];

            /// Assembly with this label; `None` without such a label.
            pub fn labelled(label: &str) -> Option<Self> {
                let mut pairs = Self::LABELS.iter().zip(Self::ASSEMBLIES);
                pairs.find_map(|(own, branches)| (*own == label).then_some(branches))
            }

            /// Moves a frame near the requested assembly, if any.
            fn begin(&mut self, at: &mut Frame) {
                let poses = [$($pose,)*];
                let requested = self.assembly.take();
                if let Some(pose) = requested.and_then(|number| poses.get(usize::from(number))) {
                    [$(at.$($field).+),*] = *pose;
                }
            }
        }
    };
}
