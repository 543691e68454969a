//! Programs that are measured: a mechanism, a language, a scalar and a processor.

use std::fmt;

/// Mechanisms with the types generated for them.
pub const MECHANISMS: [(&str, &str); 5] = [
    ("two_body", "TwoBody"),
    ("four_bar", "FourBar"),
    ("excavator", "Excavator"),
    ("arm", "Arm"),
    ("platform_3rpr", "Platform3rpr"),
];

/// Mechanisms of the programs whose scalar is not that of the processor's unit, unless all programs are requested: closed forms, and
/// Newton-Raphson.
const OF_OTHER_SCALARS: [&str; 2] = ["four_bar", "platform_3rpr"];

/// Language of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Language {
    /// Generated module.
    Rust,
    /// Generated C.
    C,
    /// Hand-written C.
    ByHand,
}

/// A scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Scalar {
    /// In single precision.
    F32,
    /// In double precision.
    F64,
}

/// Processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Processor {
    /// With a floating-point unit for f32.
    CortexM4F,
    /// With one for f64.
    CortexM7,
}

/// Firmware of one mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Program {
    /// Processor.
    pub processor: Processor,
    /// Scalar.
    pub scalar: Scalar,
    /// Index in [`MECHANISMS`].
    pub mechanism: usize,
    /// Language.
    pub language: Language,
    /// True if `advance` proves that its frames lie on the path.
    pub is_guarded: bool,
    /// True if compiled for size rather than for speed.
    pub is_small: bool,
}

impl Scalar {
    /// Name in Rust.
    pub fn name(self) -> &'static str {
        match self {
            Scalar::F32 => "f32",
            Scalar::F64 => "f64",
        }
    }
}

impl Processor {
    /// Both processors.
    pub const ALL: [Self; 2] = [Self::CortexM4F, Self::CortexM7];

    /// Name in options of compilers.
    pub fn name(self) -> &'static str {
        match self {
            Processor::CortexM4F => "cortex-m4",
            Processor::CortexM7 => "cortex-m7",
        }
    }

    /// Board with the processor, in QEMU.
    pub fn board(self) -> &'static str {
        match self {
            Processor::CortexM4F => "mps2-an386",
            Processor::CortexM7 => "mps2-an500",
        }
    }

    /// Floating-point unit, in options of GCC.
    pub fn unit(self) -> &'static str {
        match self {
            Processor::CortexM4F => "fpv4-sp-d16",
            Processor::CortexM7 => "fpv5-d16",
        }
    }

    /// Name in reports.
    pub fn title(self) -> &'static str {
        match self {
            Processor::CortexM4F => "Cortex-M4F",
            Processor::CortexM7 => "Cortex-M7",
        }
    }
}

impl Program {
    /// Name of the mechanism.
    pub fn mechanism(&self) -> &'static str {
        MECHANISMS[self.mechanism].0
    }

    /// Name of the mechanism in a program of the host: `four_bar_f32_unguarded`.
    pub fn variant(&self) -> String {
        let guard = if self.is_guarded { "" } else { "_unguarded" };
        format!("{}_{}{guard}", self.mechanism(), self.scalar.name())
    }

    /// True for the programs that stand for all others.
    pub fn is_representative(&self) -> bool {
        let is_of_unit = matches!(
            (self.processor, self.scalar),
            (Processor::CortexM4F, Scalar::F32) | (Processor::CortexM7, Scalar::F64)
        );
        is_of_unit || OF_OTHER_SCALARS.contains(&self.mechanism())
    }

    /// All programs: every mechanism in Rust, guarded and not, and in C; one by hand; and one for size.
    pub fn all() -> Vec<Self> {
        let mut programs = Vec::new();
        for processor in Processor::ALL {
            for scalar in [Scalar::F32, Scalar::F64] {
                for (mechanism, (name, _)) in MECHANISMS.iter().enumerate() {
                    let program = |language, is_guarded| Program {
                        processor,
                        scalar,
                        mechanism,
                        language,
                        is_guarded,
                        is_small: false,
                    };
                    programs.extend([true, false].map(|it| program(Language::Rust, it)));
                    programs.push(program(Language::C, true));
                    if *name == "four_bar" {
                        programs.push(program(Language::ByHand, false));
                    }
                }
            }
        }
        let is_meant = |it: &&Program| {
            (it.processor, it.scalar, it.language)
                == (Processor::CortexM4F, Scalar::F32, Language::Rust)
                && it.mechanism() == "platform_3rpr"
        };
        let small: Vec<Program> = programs
            .iter()
            .filter(is_meant)
            .map(|it| Program {
                is_small: true,
                ..*it
            })
            .collect();
        programs.extend(small);
        programs
    }
}

impl fmt::Display for Program {
    /// Writes `cortex-m4 f32 four_bar rust`, then `unguarded` and `small` if they apply.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let language = match self.language {
            Language::Rust => "rust",
            Language::C => "c",
            Language::ByHand => "c by hand",
        };
        let (processor, scalar) = (self.processor.name(), self.scalar.name());
        write!(
            formatter,
            "{processor} {scalar} {} {language}",
            self.mechanism()
        )?;
        if !self.is_guarded && self.language != Language::ByHand {
            write!(formatter, " unguarded")?;
        }
        if self.is_small {
            write!(formatter, " small")?;
        }
        Ok(())
    }
}
