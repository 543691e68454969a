//! Instruction sets for which generated modules and C are compiled.

/// Instruction set of this machine.
#[derive(Clone, Copy, Debug)]
pub struct InstructionSet {
    /// Name in tables.
    pub name: &'static str,
    /// Processor that compilers are told to compile for.
    pub processor: &'static str,
    /// Further flags of rustc.
    pub flags: &'static str,
}

/// Sets that are measured. By default, compilers for `x86-64-v4` use registers of 256 bits.
pub const SETS: [InstructionSet; 3] = [
    InstructionSet {
        name: "SSE2",
        processor: "x86-64",
        flags: "",
    },
    InstructionSet {
        name: "AVX2",
        processor: "x86-64-v3",
        flags: "",
    },
    InstructionSet {
        name: "AVX-512",
        processor: "x86-64-v4",
        flags: " -Ctarget-feature=-prefer-256-bit",
    },
];

impl InstructionSet {
    /// True if this machine has the instructions.
    #[cfg(target_arch = "x86_64")]
    pub fn is_present(&self) -> bool {
        match self.processor {
            "x86-64-v4" => {
                std::is_x86_feature_detected!("avx512f")
                    && std::is_x86_feature_detected!("avx512vl")
            }
            "x86-64-v3" => std::is_x86_feature_detected!("avx2"),
            _ => true,
        }
    }

    /// True if this machine has the instructions.
    #[cfg(not(target_arch = "x86_64"))]
    pub fn is_present(&self) -> bool {
        false
    }
}
