//! Describes what the table of a sweep holds, so that an interrupted run is continued only by the same sweep.

use std::fmt::Write as _;

use linkwright_codegen::diagnostic::Source;

use super::sets::Sets;

/// Start and factor of the hash FNV-1a with 64 bits.
const FNV_START: u64 = 0xcbf2_9ce4_8422_2325;
const FNV_FACTOR: u64 = 0x0000_0100_0000_01b3;

/// Returns the definition of a table, line by line: all that its numbers depend on.
pub fn definition(
    source: &Source,
    motion: Option<&str>,
    assignments: &[String],
    branches: &[String],
    sets: &Sets,
    times: &[f64],
    header: &[u8],
) -> String {
    let mut text = String::new();
    let attachments = format!("{:?}", source.attachments);
    let description = [source.text.as_bytes(), attachments.as_bytes()];
    let times = times.iter().map(|it| it.to_bits().to_le_bytes());
    let times: Vec<[u8; 8]> = times.collect();
    let mut values = Vec::new();
    if let Sets::Rows { values: own, .. } = sets {
        values.extend(own.iter().flat_map(|it| it.to_bits().to_le_bytes()));
    }
    let lines = [
        ("linkwright", env!("CARGO_PKG_VERSION").to_string()),
        ("description", hash(description)),
        ("motion", motion.unwrap_or_default().to_string()),
        ("set", assignments.join(", ")),
        ("branch", branches.join(", ")),
        (
            "columns",
            String::from_utf8_lossy(header).trim_end().to_string(),
        ),
        (
            "frames",
            format!(
                "{} {}",
                times.len(),
                hash(times.iter().map(<[u8; 8]>::as_slice))
            ),
        ),
        ("sets", sets.count().to_string()),
        ("rows", hash([values.as_slice()])),
        ("ranges", sets.ranges()),
    ];
    for (name, line) in lines {
        let _ = writeln!(text, "{name}: {}", line.replace(['\n', '\r'], " "));
    }
    text
}

/// Returns the hash of some texts as hexadecimal digits.
fn hash<'a>(parts: impl IntoIterator<Item = &'a [u8]>) -> String {
    let bytes = parts.into_iter().flatten();
    let hash = bytes.fold(FNV_START, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(FNV_FACTOR)
    });
    format!("{hash:016x}")
}
