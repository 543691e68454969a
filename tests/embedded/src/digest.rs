//! Digests words of 64 bits.

/// Digest of all words so far, by the function FNV-1a over words, each folded once.
#[derive(Clone, Copy)]
pub struct Digest(u64);

impl Digest {
    /// Digest of no words.
    pub const EMPTY: Self = Self(0xcbf2_9ce4_8422_2325);

    /// Adds a word.
    pub fn add(&mut self, word: u64) {
        let mixed = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        self.0 = mixed ^ (mixed >> 32);
    }

    /// Value of the digest.
    pub fn value(self) -> u64 {
        self.0
    }
}
