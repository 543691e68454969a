//! Answers the requests of a live page in a browser.
//!
//! A request and its reply are JSON in the memory of the module: the page reserves room with [`reserve`], writes a request there, calls
//! [`reply`], and reads as many bytes as it returns at [`replied`]. There is one request at a time.

mod code;
mod request;

use std::cell::RefCell;

pub use request::{Desk, Request};

thread_local! {
    static EXCHANGE: RefCell<Exchange> = RefCell::default();
}

/// Request and reply, with what is kept between them.
#[derive(Default)]
struct Exchange {
    request: Vec<u8>,
    reply: Vec<u8>,
    desk: Desk,
}

/// Reserves room for a request of so many bytes, and returns its address.
#[expect(unsafe_code, reason = "the name is exported")]
#[unsafe(no_mangle)]
pub extern "C" fn reserve(length: usize) -> *mut u8 {
    EXCHANGE.with_borrow_mut(|it| {
        it.request = vec![0; length];
        it.request.as_mut_ptr()
    })
}

/// Replies to the request, and returns the number of bytes of the reply.
#[expect(unsafe_code, reason = "the name is exported")]
#[unsafe(no_mangle)]
pub extern "C" fn reply() -> usize {
    EXCHANGE.with_borrow_mut(|it| {
        it.reply = it.desk.reply(&it.request);
        it.request = Vec::new();
        it.reply.len()
    })
}

/// Returns the address of the reply, which is valid until the next request.
#[expect(unsafe_code, reason = "the name is exported")]
#[unsafe(no_mangle)]
pub extern "C" fn replied() -> *const u8 {
    EXCHANGE.with_borrow(|it| it.reply.as_ptr())
}
