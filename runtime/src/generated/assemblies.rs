//! *The ways in which a mechanism can be assembled as described* → *constants of its modes, and the poses that Newton-Raphson starts from*.

/// Assemblies with their labels, modes and the values of some fields of a frame there.
#[doc(hidden)]
#[macro_export]
macro_rules! assemblies {
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

            /// What `linkwright check` calls them.
            pub const LABELS: [&'static str; $count] = [$($label,)*];

            /// One of them by its label; `None` where there is none of that name.
            pub fn labelled(label: &str) -> Option<Self> {
                let mut pairs = Self::LABELS.iter().zip(Self::ASSEMBLIES);
                pairs.find_map(|(own, branches)| (*own == label).then_some(branches))
            }

            /// Puts a frame near the assembly that is wanted, where one is.
            fn begin(&mut self, at: &mut Frame) {
                let poses = [$($pose,)*];
                let wanted = self.assembly.take();
                if let Some(pose) = wanted.and_then(|number| poses.get(usize::from(number))) {
                    [$(at.$($field).+),*] = *pose;
                }
            }
        }
    };
}
