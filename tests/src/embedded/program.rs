//! Which programs there are.

use std::fmt;

/// The mechanisms that are moved, and the types that they become.
pub const MECHANISMS: [(&str, &str); 5] = [
    ("two_body", "TwoBody"),
    ("four_bar", "FourBar"),
    ("excavator", "Excavator"),
    ("arm", "Arm"),
    ("platform_3rpr", "Platform3rpr"),
];

/// What a mechanism is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Language {
    /// The generated module.
    Rust,
    /// The generated C.
    C,
    /// C that was not generated.
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

/// A processor, and how it is compiled for.
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
    /// What runs it.
    pub processor: Processor,
    /// In which scalar.
    pub scalar: Scalar,
    /// Its place in [`MECHANISMS`].
    pub mechanism: usize,
    /// In which language.
    pub language: Language,
    /// Whether `advance` shows that its frames lie on the path.
    pub is_guarded: bool,
    /// Whether it is compiled for size rather than for speed.
    pub is_small: bool,
}

impl Scalar {
    /// As Rust calls it.
    pub fn name(self) -> &'static str {
        match self {
            Scalar::F32 => "f32",
            Scalar::F64 => "f64",
        }
    }
}

impl Processor {
    /// Both of them.
    pub const ALL: [Self; 2] = [Self::CortexM4F, Self::CortexM7];

    /// As compilers call it.
    pub fn name(self) -> &'static str {
        match self {
            Processor::CortexM4F => "cortex-m4",
            Processor::CortexM7 => "cortex-m7",
        }
    }

    /// The board that has it, as QEMU calls it.
    pub fn board(self) -> &'static str {
        match self {
            Processor::CortexM4F => "mps2-an386",
            Processor::CortexM7 => "mps2-an500",
        }
    }

    /// Its floating-point unit, as GCC calls it.
    pub fn unit(self) -> &'static str {
        match self {
            Processor::CortexM4F => "fpv4-sp-d16",
            Processor::CortexM7 => "fpv5-d16",
        }
    }

    /// As people call it.
    pub fn title(self) -> &'static str {
        match self {
            Processor::CortexM4F => "Cortex-M4F",
            Processor::CortexM7 => "Cortex-M7",
        }
    }
}

impl Program {
    /// The mechanism's name.
    pub fn mechanism(&self) -> &'static str {
        MECHANISMS[self.mechanism].0
    }

    /// What a program of the host calls the same mechanism: `four_bar_f32_unguarded`.
    pub fn variant(&self) -> String {
        let guard = if self.is_guarded { "" } else { "_unguarded" };
        format!("{}_{}{guard}", self.mechanism(), self.scalar.name())
    }

    /// All of them: every mechanism in Rust, guarded and not, and in C; one by hand; and one for size.
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
                    if (*name, scalar, processor)
                        == ("platform_3rpr", Scalar::F32, Processor::CortexM4F)
                    {
                        programs.extend([true, false].map(|it| Program {
                            is_small: true,
                            ..program(Language::Rust, it)
                        }));
                    }
                }
            }
        }
        programs
    }
}

impl fmt::Display for Program {
    /// `cortex-m4 f32 four_bar rust`, then `unguarded` and `small` where it is.
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
