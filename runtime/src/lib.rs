//! Newton-Raphson and linear solves for generated mechanisms.
#![no_std]
