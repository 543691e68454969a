//! Abilities of a machine besides arithmetic.

/// Machine that runs the program.
pub trait Machine {
    /// Prints a text.
    fn write(&mut self, text: &str);

    /// Calls a function and returns the number of its instructions, if they can be counted.
    fn count<R>(&mut self, call: impl FnOnce() -> R) -> (u64, R);

    /// Calls a function and returns the bytes of its stack, if they can be counted.
    fn stack<R>(&mut self, call: impl FnOnce(&mut Self) -> R) -> (u64, R);

    /// Prints a number in base 16, after a space.
    fn number(&mut self, value: u64) {
        const DIGITS: [&str; 16] = [
            "0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "a", "b", "c", "d", "e", "f",
        ];
        self.write(" ");
        let digits = 16 - (value | 1).leading_zeros() / 4;
        for digit in (0..digits).rev() {
            // The mask keeps the index below 16, so that no panic remains.
            self.write(DIGITS[(value >> (4 * digit)) as usize & 15]);
        }
    }
}
