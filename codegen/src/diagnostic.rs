//! Located messages.
