//! The motion of one variant on a Cortex-M, which QEMU counts.
//!
//! The panic handler calls a symbol that nothing defines: a program that contains a panic path does not link.
#![no_std]
#![no_main]

use core::arch::asm;
use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, syscall};
use linkwright_embedded::{Machine, run};

unsafe extern "C" {
    #[allow(non_snake_case, reason = "The name is what the linker reports.")]
    fn PANIC_PATH() -> !;
}

#[cfg(not(feature = "may_panic"))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    // SAFETY: the symbol is never defined, so a program that still contains this call does not link.
    unsafe { PANIC_PATH() }
}

/// A program with a panic path that is to be linked nevertheless.
#[cfg(feature = "may_panic")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// A board of the family MPS2, and the debugger's handle of the standard output.
struct Board {
    output: usize,
}

/// The timer 0 of the board, which counts down at 25 MHz: its control, value and reload registers.
const CONTROL: *mut u32 = 0x4000_0000 as *mut u32;
const VALUE: *mut u32 = 0x4000_0004 as *mut u32;
const RELOAD: *mut u32 = 0x4000_0008 as *mut u32;

/// With `-icount shift=8` an instruction takes 256 ns, and the timer ticks every 40 ns.
fn instructions(ticks: u32) -> u64 {
    (u64::from(ticks) * 40 + 128) / 256
}

/// Depth below a call to which the stack is examined, in bytes, and the pattern written there before.
const DEPTH: usize = 0x2_0000;
const PAINT: u32 = 0xa5a5_5a5a;

impl Board {
    fn new() -> Self {
        // SAFETY: registers of the board that nothing else uses.
        unsafe {
            RELOAD.write_volatile(u32::MAX);
            VALUE.write_volatile(u32::MAX);
            CONTROL.write_volatile(1);
        }
        // The debugger's terminal, to be written to.
        const NAME: &[u8] = b":tt\0";
        const WRITE: usize = 4;
        // SAFETY: the name outlives the call.
        let output = unsafe { syscall!(OPEN, NAME.as_ptr(), WRITE, NAME.len() - 1) };
        Self { output }
    }

    #[inline(always)]
    fn now() -> u32 {
        // SAFETY: as above.
        unsafe { VALUE.read_volatile() }
    }
}

impl Machine for Board {
    fn write(&mut self, text: &str) {
        // SAFETY: the text outlives the call.
        let _ = unsafe { syscall!(WRITE, self.output, text.as_ptr(), text.len()) };
    }

    #[inline(always)]
    fn count<R>(&mut self, call: impl FnOnce() -> R) -> (u64, R) {
        let start = Self::now();
        let result = call();
        let end = Self::now();
        (instructions(start.wrapping_sub(end)), result)
    }

    #[inline(never)]
    fn stack<R>(&mut self, call: impl FnOnce(&mut Self) -> R) -> (u64, R) {
        let top: usize;
        // SAFETY: reads a register.
        unsafe { asm!("mov {}, sp", out(reg) top) };
        // The top of the stack belongs to this function.
        let words = (top - DEPTH..top - 64).step_by(4);
        for place in words.clone() {
            // SAFETY: the memory below the stack is unused.
            unsafe { (place as *mut u32).write_volatile(PAINT) };
        }
        let result = black_box(call(self));
        // SAFETY: as above.
        let changed = |place: &usize| unsafe { (*place as *const u32).read_volatile() } != PAINT;
        let lowest = words.clone().find(changed).unwrap_or(top);
        ((top - lowest) as u64, result)
    }
}

#[entry]
fn main() -> ! {
    let mut board = Board::new();
    run(&mut board);
    #[cfg(feature = "planted_panic")]
    board.number(planted::panic(black_box(&[1, 2, 3]), black_box(1)));
    #[cfg(feature = "planted_formatting")]
    planted::formatting(&mut board, black_box(0.1));
    #[cfg(feature = "planted_recursion")]
    board.number(planted::recursion(black_box(27)));
    debug::exit(debug::EXIT_SUCCESS);
    loop {}
}

/// Faults that firmware must not contain.
#[allow(dead_code)]
mod planted {
    use core::fmt::Write as _;

    use linkwright_embedded::Machine;

    /// An index that only the caller knows.
    pub fn panic(values: &[u64], index: usize) -> u64 {
        values[index]
    }

    struct Written<'a>(&'a mut super::Board);

    impl core::fmt::Write for Written<'_> {
        fn write_str(&mut self, text: &str) -> core::fmt::Result {
            self.0.write(text);
            Ok(())
        }
    }

    pub fn formatting(board: &mut super::Board, value: f32) {
        let _ = write!(Written(board), "{value}");
    }

    /// The steps of Collatz's sequence, by a call for each.
    #[inline(never)]
    pub fn recursion(number: u64) -> u64 {
        match number {
            0 | 1 => 0,
            even if even % 2 == 0 => recursion(number / 2) + (number & 3),
            _ => recursion(3 * number + 1) ^ number,
        }
    }
}
