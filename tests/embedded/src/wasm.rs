//! The motion of every variant as a module of WebAssembly, which prints through a function of its host.

use core::arch::wasm32::unreachable;

use crate::machine::Machine;

#[link(wasm_import_module = "host")]
unsafe extern "C" {
    /// Prints so many bytes of the module's memory.
    fn write(text: *const u8, length: usize);
}

struct Host;

impl Machine for Host {
    fn write(&mut self, text: &str) {
        // SAFETY: the host reads what the module lends it for this call.
        unsafe { write(text.as_ptr(), text.len()) }
    }

    fn count<R>(&mut self, call: impl FnOnce() -> R) -> (u64, R) {
        (0, call())
    }

    fn stack<R>(&mut self, call: impl FnOnce(&mut Self) -> R) -> (u64, R) {
        (0, call(self))
    }
}

/// Moves every variant.
#[unsafe(no_mangle)]
pub extern "C" fn run() {
    crate::variants::run(&mut Host);
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unreachable()
}
