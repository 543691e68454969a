//! Recognizes tables of frames that the command has written.

use linkwright_page::comma_separated::is_header;

use crate::output::{Beginning, Record, Signature};

/// Signature of a table of frames as CSV, also of that of another mechanism.
pub const SIGNATURE: Signature = Signature {
    noun: "a table of frames that this command has written",
    beginning: Beginning::Line(is_header),
    record: Record::Beside,
};
