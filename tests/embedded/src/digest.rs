//! Words of 64 bits → one word that tells them from others.

/// What has been seen so far, by the function FNV-1a over words, each folded once.
#[derive(Clone, Copy)]
pub struct Digest(u64);

impl Digest {
    /// Nothing has been seen.
    pub const EMPTY: Self = Self(0xcbf2_9ce4_8422_2325);

    /// Sees one more word.
    pub fn add(&mut self, word: u64) {
        let mixed = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        self.0 = mixed ^ (mixed >> 32);
    }

    /// The word.
    pub fn value(self) -> u64 {
        self.0
    }
}
