//! Generated mechanisms.
#![no_std]
