//! Turns an SVG of a drawing into a PNG, with letters that come with the program.
//!
//! Fonts of the machine are not used, so that a drawing has the same bytes everywhere. The first text chunk marks a PNG of Linkwright.

use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb::Database};

use crate::output::{Beginning, Record, Signature};

/// Pixels of a PNG per pixel of the drawing.
pub const FINE: f32 = 2.0;

/// Number of bytes before the first text chunk: the signature of a PNG, and the chunk that holds its size.
const HEAD: usize = 8 + 25;

/// First text chunk; `Software` is the registered keyword for the program that made an image.
const WORDS: &[u8] = b"tEXtSoftware\0linkwright";

/// Beginning of the second text chunk, which names the source.
const SOURCE: &[u8] = b"tEXtComment\0Generated from ";

/// Style that compensates for the light letters.
const BOLDER: &str = "\
.linkwright text { stroke: #1c2024; stroke-width: 0.25; }
.linkwright .point { stroke-width: 0.7; }
.linkwright .note, .linkwright .caption { stroke: #57606a; }
";

/// Signature of a PNG of Linkwright.
pub const SIGNATURE: Signature = Signature {
    noun: "a picture that this command has drawn",
    beginning: Beginning::Bytes(is_ours),
    record: Record::Inside {
        found: source,
        added: |png, source| {
            let mut png = png.to_vec();
            insert(&mut png, SECOND, &[SOURCE, source.as_bytes()].concat());
            png
        },
    },
};

/// Position of the second text chunk.
const SECOND: usize = HEAD + 8 + WORDS.len();

fn is_ours(bytes: &[u8]) -> bool {
    bytes.get(HEAD + 4..HEAD + 4 + WORDS.len()) == Some(WORDS)
}

/// Renderer of pictures with its letters.
pub struct Rasterizer {
    options: Options<'static>,
}

impl Rasterizer {
    /// Loads the letters.
    pub fn with_letters() -> Rasterizer {
        let mut fonts = Database::new();
        fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
        let families = fonts.faces().next().map(|face| face.families.clone());
        let family = families.and_then(|all| all.into_iter().next());
        let family = family.map_or(String::new(), |(name, _)| name);
        // The last font that drawings name is a generic sans serif.
        fonts.set_sans_serif_family(&family);
        Rasterizer {
            options: Options {
                font_family: family,
                fontdb: Arc::new(fonts),
                ..Options::default()
            },
        }
    }

    /// Renders a picture with `factor` pixels per pixel of the drawing.
    ///
    /// # Errors
    /// The picture has no size, or is too large for the memory.
    pub fn pixels(&self, svg: &str, factor: f32) -> Result<Pixmap, String> {
        let svg = svg.replacen("</style>", &format!("{BOLDER}</style>"), 1);
        let tree = Tree::from_str(&svg, &self.options).map_err(|error| error.to_string())?;
        let size = tree.size();
        let [width, height] = [size.width(), size.height()].map(|it| (it * factor).ceil() as u32);
        let mut pixels =
            Pixmap::new(width, height).ok_or("the picture does not fit into memory")?;
        let transform = Transform::from_scale(factor, factor);
        resvg::render(&tree, transform, &mut pixels.as_mut());
        Ok(pixels)
    }
}

/// Renders a picture as a PNG with `factor` pixels per pixel of the drawing.
///
/// # Errors
/// The picture has no size, or is too large for the memory.
pub fn raster(svg: &str, factor: f32) -> Result<Vec<u8>, String> {
    let pixels = Rasterizer::with_letters().pixels(svg, factor)?;
    let png = pixels.encode_png().map_err(|error| error.to_string())?;
    Ok(marked(png))
}

/// Returns the name of the source of a picture.
fn source(bytes: &[u8]) -> Option<String> {
    let (length, chunk) = bytes.get(SECOND..)?.split_first_chunk()?;
    let length = usize::try_from(u32::from_be_bytes(*length)).ok()?;
    let words = chunk.get(..length.checked_add(4)?)?;
    String::from_utf8(words.strip_prefix(SOURCE)?.to_vec()).ok()
}

/// Inserts the text chunk that marks a picture of Linkwright.
fn marked(mut png: Vec<u8>) -> Vec<u8> {
    insert(&mut png, HEAD, WORDS);
    png
}

/// Inserts a chunk; `words` begin with its kind.
fn insert(png: &mut Vec<u8>, place: usize, words: &[u8]) {
    let mut chunk = (words.len() as u32 - 4).to_be_bytes().to_vec();
    chunk.extend(words);
    chunk.extend(checksum(words).to_be_bytes());
    png.splice(place..place, chunk);
}

/// Returns the cyclic redundancy check of a chunk (PNG specification, annex D).
fn checksum(bytes: &[u8]) -> u32 {
    let step = |remainder: u32, byte: &u8| {
        (0..8).fold(remainder ^ u32::from(*byte), |it, _| match it & 1 {
            1 => it >> 1 ^ 0xedb8_8320,
            _ => it >> 1,
        })
    };
    !bytes.iter().fold(u32::MAX, step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_checksum_is_that_of_the_specification() {
        // Every PNG ends with the chunk IEND.
        assert_eq!(checksum(b"IEND"), 0xae42_6082);
    }

    #[test]
    fn a_picture_is_known_again_and_has_letters() {
        let svg = |text: &str| {
            format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"60\" height=\"20\"><text x=\"30\" y=\"15\">{text}</text></svg>"
            )
        };
        let [empty, written] = ["", "Q"].map(|it| raster(&svg(it), 2.0).expect("a picture"));
        assert!(is_ours(&empty) && is_ours(&written));
        assert_ne!(empty, written);
        assert_eq!(written, raster(&svg("Q"), 2.0).expect("a picture"));
        assert!(!is_ours(b"\x89PNG\r\n\x1a\n"));
        // The picture stays readable with the name of its source.
        let Record::Inside { found, added } = SIGNATURE.record else {
            unreachable!("it is named inside")
        };
        let named = added(&written, "../a.mech");
        assert!(is_ours(&named));
        assert_eq!(found(&named).as_deref(), Some("../a.mech"));
        assert_eq!(found(&written), None);
        let decoded = |png: &[u8]| Pixmap::decode_png(png).expect("a picture");
        assert_eq!(decoded(&named), decoded(&written));
    }
}
