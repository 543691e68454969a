//! Decodes bytes by their byte order mark, by zeros in every other byte, as UTF-8, or else as Windows-1252.

use super::{Fault, Unreadable};
use crate::diagnostic::Span;

/// Encoding of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// UTF-8, including ASCII.
    Utf8,
    /// UTF-16, little-endian.
    Utf16Little,
    /// UTF-16, big-endian.
    Utf16Big,
    /// Windows-1252, which covers the printable part of Latin-1.
    Windows1252,
}

impl Encoding {
    /// Returns the name for messages.
    pub fn name(self) -> &'static str {
        match self {
            Encoding::Utf8 => "UTF-8",
            Encoding::Utf16Little => "UTF-16 (little-endian)",
            Encoding::Utf16Big => "UTF-16 (big-endian)",
            Encoding::Windows1252 => "Windows-1252, since it is not UTF-8",
        }
    }
}

/// Characters 0x80 to 0x9f in Windows-1252; five are undefined.
const WINDOWS: [Option<char>; 32] = [
    Some('€'),
    None,
    Some('‚'),
    Some('ƒ'),
    Some('„'),
    Some('…'),
    Some('†'),
    Some('‡'),
    Some('ˆ'),
    Some('‰'),
    Some('Š'),
    Some('‹'),
    Some('Œ'),
    None,
    Some('Ž'),
    None,
    None,
    Some('‘'),
    Some('’'),
    Some('“'),
    Some('”'),
    Some('•'),
    Some('–'),
    Some('—'),
    Some('˜'),
    Some('™'),
    Some('š'),
    Some('›'),
    Some('œ'),
    None,
    Some('ž'),
    Some('Ÿ'),
];

/// First bytes of files that are not text, and their kinds.
const OTHERS: [(&[u8], &str); 4] = [
    (b"PK\x03\x04", "a workbook or an archive"),
    (b"\xd0\xcf\x11\xe0", "a workbook"),
    (b"MATLAB 5.0 MAT-file", "a MAT-file"),
    (b"\x89HDF", "an HDF5 file"),
];

/// Decodes a text and removes its byte order mark.
pub(super) fn decoded(bytes: &[u8]) -> Result<(String, Encoding), Unreadable> {
    if let Some((_, what)) = OTHERS.iter().find(|(start, _)| bytes.starts_with(start)) {
        return Err(refused(
            String::new(),
            0,
            format!("the file is {what}, not text"),
            "export the table as CSV",
        ));
    }
    match bytes {
        [0xff, 0xfe, rest @ ..] => utf16(rest, Encoding::Utf16Little),
        [0xfe, 0xff, rest @ ..] => utf16(rest, Encoding::Utf16Big),
        [0xef, 0xbb, 0xbf, rest @ ..] => eight(rest),
        [first, 0, ..] if *first != 0 => utf16(bytes, Encoding::Utf16Little),
        [0, second, ..] if *second != 0 => utf16(bytes, Encoding::Utf16Big),
        _ => eight(bytes),
    }
}

fn refused(text: String, at: usize, message: String, help: &str) -> Unreadable {
    let end = text[at..]
        .chars()
        .next()
        .map_or(at, |it| at + it.len_utf8());
    Unreadable {
        faults: vec![Fault::new(Span::new(at, end), message, help)],
        text,
    }
}

fn utf16(bytes: &[u8], encoding: Encoding) -> Result<(String, Encoding), Unreadable> {
    let unit = |pair: &[u8]| match encoding {
        Encoding::Utf16Big => u16::from_be_bytes([pair[0], pair[1]]),
        _ => u16::from_le_bytes([pair[0], pair[1]]),
    };
    let mut text = String::with_capacity(bytes.len() / 2);
    for character in char::decode_utf16(bytes.chunks_exact(2).map(unit)) {
        match character {
            Ok('\0') | Err(_) => {
                let at = text.len();
                text.push(char::REPLACEMENT_CHARACTER);
                let message = format!("this is not a character of {}", encoding.name());
                return Err(refused(text, at, message, "save the file as UTF-8"));
            }
            Ok(character) => text.push(character),
        }
    }
    match bytes.len() % 2 {
        0 => Ok((text, encoding)),
        _ => {
            let at = text.len();
            let message = format!("half a character of {} is left", encoding.name());
            Err(refused(
                text,
                at,
                message,
                "check that the file is complete",
            ))
        }
    }
}

fn eight(bytes: &[u8]) -> Result<(String, Encoding), Unreadable> {
    if let Some(at) = bytes.iter().position(|it| *it == 0) {
        let text: String = String::from_utf8_lossy(&bytes[..at]).into_owned() + "\u{fffd}";
        let at = text.len() - char::REPLACEMENT_CHARACTER.len_utf8();
        return Err(refused(
            text,
            at,
            "a byte of zero, which is not text".to_string(),
            "export the table as CSV",
        ));
    }
    if let Ok(text) = std::str::from_utf8(bytes) {
        return Ok((text.to_string(), Encoding::Utf8));
    }
    let mut text = String::with_capacity(bytes.len());
    for byte in bytes {
        match (
            byte,
            byte.checked_sub(0x80)
                .and_then(|it| WINDOWS.get(usize::from(it))),
        ) {
            (_, Some(Some(character))) => text.push(*character),
            (_, Some(None)) => {
                let at = text.len();
                text.push(char::REPLACEMENT_CHARACTER);
                let message =
                    format!("the byte 0x{byte:02x} is not a character of UTF-8 or of Windows-1252");
                return Err(refused(text, at, message, "save the file as UTF-8"));
            }
            (byte, None) => text.push(char::from(*byte)),
        }
    }
    Ok((text, Encoding::Windows1252))
}
