//! Writes an animation as a GIF that repeats forever.
//!
//! All pictures share one palette: the most frequent colors, and colors near all others. A picture holds only the rectangle that
//! differs from the picture before. A comment behind the palette marks a GIF of Linkwright.

use std::collections::HashMap;

use gif::{AnyExtension, DisposalMethod, Encoder, Frame, Repeat};
use linkwright_codegen::stages::emit::drawing::Animation;

use super::raster::Rasterizer;
use crate::output::{Beginning, Record, Signature};

/// Number of colors of a palette, the transparent one included.
const COLORS: usize = 256;

/// Index of the transparent color, which keeps the pixel of the picture before.
const UNCHANGED: u8 = 255;

/// Increment of the least distance of two colors, which grows until all colors fit.
const STEP: usize = 2;

/// Largest number of pictures in which colors are counted.
const COUNTED: usize = 12;

/// Number of bytes before the palette, and up to its end.
const HEAD: usize = 13;
const PALETTE: usize = HEAD + 3 * COLORS;

/// Label of a comment.
const COMMENT: u8 = 0xfe;

/// Comment behind the palette.
const WORDS: &[u8] = b"linkwright";

/// Beginning of the second comment, which names the source.
const SOURCE: &[u8] = b"Generated from ";

/// Signature of a GIF of Linkwright.
pub const SIGNATURE: Signature = Signature {
    noun: "a picture that this command has drawn",
    beginning: Beginning::Bytes(is_ours),
    record: Record::Inside {
        found: source,
        added: |gif, source| {
            let mut gif = gif.to_vec();
            let words = [SOURCE, source.as_bytes()].concat();
            gif.splice(SECOND..SECOND, comment(&words));
            gif
        },
    },
};

/// Position of the second comment.
const SECOND: usize = PALETTE + 2 + 1 + WORDS.len() + 1;

fn is_ours(bytes: &[u8]) -> bool {
    bytes.starts_with(b"GIF89a") && bytes.get(PALETTE..SECOND) == Some(&comment(WORDS)[..])
}

/// Returns the name of the source of a picture.
fn source(bytes: &[u8]) -> Option<String> {
    let mut rest = bytes.get(SECOND..)?.strip_prefix(&[b'!', COMMENT])?;
    let mut words = Vec::new();
    loop {
        let (length, blocks) = rest.split_first()?;
        let (block, next) = blocks.split_at_checked(usize::from(*length))?;
        if block.is_empty() {
            break;
        }
        words.extend(block);
        rest = next;
    }
    String::from_utf8(words.strip_prefix(SOURCE)?.to_vec()).ok()
}

/// Encodes a comment extension, in blocks of at most 255 bytes.
fn comment(words: &[u8]) -> Vec<u8> {
    let mut bytes = vec![b'!', COMMENT];
    for block in words.chunks(255) {
        bytes.push(block.len() as u8);
        bytes.extend(block);
    }
    bytes.push(0);
    bytes
}

/// Colors of all pixels of a picture.
struct Pixels {
    size: [u16; 2],
    colors: Vec<[u8; 3]>,
}

/// Encodes an animation with an interval between pictures, in s.
///
/// # Errors
/// A picture is too large for a GIF or for the memory.
pub fn gif(animation: &Animation, interval: f64) -> Result<Vec<u8>, String> {
    let rasterizer = Rasterizer::with_letters();
    let pixels = |place: usize| -> Result<Pixels, String> {
        let pixels = rasterizer.pixels(&animation.frame(place), 1.0)?;
        let side = |length: u32| u16::try_from(length).map_err(|_| "it is too large".to_string());
        let colors = pixels.pixels().iter().map(|it| {
            let color = it.demultiply();
            [color.red(), color.green(), color.blue()]
        });
        Ok(Pixels {
            size: [side(pixels.width())?, side(pixels.height())?],
            colors: colors.collect(),
        })
    };
    let mut palette = Palette::default();
    for place in (0..animation.count()).step_by(animation.count().div_ceil(COUNTED)) {
        palette.count(&pixels(place)?.colors);
    }
    palette.choose();
    let first = pixels(0)?;
    let [width, height] = first.size;
    let failed = |error: gif::EncodingError| error.to_string();
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height, &palette.bytes()).map_err(failed)?;
    let extension = AnyExtension(COMMENT);
    encoder
        .write_raw_extension(extension, &[WORDS])
        .map_err(failed)?;
    encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
    let mut previous: Option<Vec<u8>> = None;
    for place in 0..animation.count() {
        let picture = pixels(place)?;
        let indices = palette.indices(&picture.colors);
        let mut frame = match &previous {
            None => Frame {
                width,
                height,
                buffer: indices.clone().into(),
                ..Frame::default()
            },
            Some(before) => difference(before, &indices, width),
        };
        // Delays are rounded from the sum, in hundredths of a second, so that the pictures keep pace with the motion.
        let at = |place: usize| (100.0 * interval * place as f64).round();
        frame.delay = (at(place + 1) - at(place)) as u16;
        frame.dispose = DisposalMethod::Keep;
        encoder.write_frame(&frame).map_err(failed)?;
        previous = Some(indices);
    }
    drop(encoder);
    Ok(bytes)
}

/// Returns the rectangle in which two pictures differ.
fn difference(before: &[u8], now: &[u8], width: u16) -> Frame<'static> {
    let across = usize::from(width);
    let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
    for (place, _) in before
        .iter()
        .zip(now)
        .enumerate()
        .filter(|(_, (a, b))| a != b)
    {
        for (axis, at) in [place % across, place / across].into_iter().enumerate() {
            low[axis] = low[axis].min(at);
            high[axis] = high[axis].max(at);
        }
    }
    if low[0] == usize::MAX {
        // A picture has at least one pixel.
        (low, high) = ([0; 2], [0; 2]);
    }
    let rows = low[1]..=high[1];
    let places = rows.flat_map(|row| (low[0]..=high[0]).map(move |column| row * across + column));
    let changed = places.map(|at| match before[at] == now[at] {
        true => UNCHANGED,
        false => now[at],
    });
    Frame {
        left: low[0] as u16,
        top: low[1] as u16,
        width: (high[0] - low[0] + 1) as u16,
        height: (high[1] - low[1] + 1) as u16,
        transparent: Some(UNCHANGED),
        buffer: changed.collect::<Vec<u8>>().into(),
        ..Frame::default()
    }
}

/// Returns the squared distance of two colors.
fn off(a: &[u8; 3], b: &[u8; 3]) -> i32 {
    let parts = a.iter().zip(b);
    parts
        .map(|(a, b)| (i32::from(*a) - i32::from(*b)).pow(2))
        .sum()
}

/// Palette of a GIF.
#[derive(Default)]
struct Palette {
    counts: HashMap<[u8; 3], usize>,
    colors: Vec<[u8; 3]>,
    /// Index of the nearest color; only looked up.
    nearest: HashMap<[u8; 3], u8>,
}

impl Palette {
    fn count(&mut self, colors: &[[u8; 3]]) {
        for color in colors {
            *self.counts.entry(*color).or_default() += 1;
        }
    }

    /// Keeps the most frequent colors, and adds others at the least distance of all colors from the palette that fits.
    fn choose(&mut self) {
        let mut all: Vec<([u8; 3], usize)> = self.counts.drain().collect();
        all.sort_by_key(|(color, count)| (std::cmp::Reverse(*count), *color));
        for apart in (0..).step_by(STEP) {
            self.colors.clear();
            for (color, _) in &all {
                if self.colors.len() == COLORS {
                    break;
                }
                let square = apart * apart;
                if self.colors.iter().all(|it| off(it, color) > square) || apart == 0 {
                    self.colors.push(*color);
                }
            }
            if self.colors.len() < COLORS {
                break;
            }
        }
    }

    fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.colors.concat();
        bytes.resize(3 * COLORS, 0);
        bytes
    }

    /// Returns the indices of the nearest colors.
    fn indices(&mut self, colors: &[[u8; 3]]) -> Vec<u8> {
        let place = |color: &[u8; 3]| {
            let palette = &self.colors;
            *self.nearest.entry(*color).or_insert_with(|| {
                let places =
                    (0..palette.len()).min_by_key(|place| (off(&palette[*place], color), *place));
                places.unwrap_or(0) as u8
            })
        };
        colors.iter().map(place).collect()
    }
}

#[cfg(test)]
mod tests {
    use gif::{ColorOutput, DecodeOptions};
    use linkwright_codegen::diagnostic::Source;
    use linkwright_codegen::stages::emit::drawing::{Options, Pose};
    use linkwright_codegen::stages::system::Derived;

    use super::*;

    /// Bar of 1 m at these angles.
    fn turning(angles: &[f64]) -> Animation {
        let text = "mechanism bar { point O = (0, 0); body arm at O { O, P: (1, 0) } revolute O(ground, arm); drive phi(arm) = t; }";
        let read = linkwright_codegen::read(&Source::new("bar.mech", text));
        let derived = read.expect("a description").only().expect("one motion");
        let Derived { pool, system } = &derived;
        let poses = angles.iter().map(|angle| {
            let place = system
                .coordinates
                .iter()
                .position(|it| it.name == "phi_arm");
            let symbol = system.coordinates[place.expect("an angle")].position;
            Pose::new(pool, [(symbol, *angle)])
        });
        let poses: Vec<Pose> = poses.collect();
        Animation::new(pool, system, &poses, &[], &Options::default()).expect("a pose")
    }

    /// Decodes all pictures, each composed with those before, and their delays in hundredths of a second.
    fn shown(bytes: &[u8]) -> (Vec<Vec<[u8; 3]>>, Vec<u16>) {
        let mut options = DecodeOptions::new();
        options.set_color_output(ColorOutput::RGBA);
        let mut decoder = options.read_info(bytes).expect("a GIF");
        assert_eq!(decoder.repeat(), Repeat::Infinite);
        let width = usize::from(decoder.width());
        let mut canvas = vec![[0; 3]; width * usize::from(decoder.height())];
        let (mut pictures, mut delays) = (Vec::new(), Vec::new());
        while let Some(frame) = decoder.read_next_frame().expect("a picture") {
            let frame_width = usize::from(frame.width);
            for (place, pixel) in frame.buffer.chunks_exact(4).enumerate() {
                if pixel[3] > 0 {
                    let row = usize::from(frame.top) + place / frame_width;
                    let column = usize::from(frame.left) + place % frame_width;
                    canvas[row * width + column] = [pixel[0], pixel[1], pixel[2]];
                }
            }
            pictures.push(canvas.clone());
            delays.push(frame.delay);
        }
        (pictures, delays)
    }

    #[test]
    fn pictures_are_those_of_the_drawing_room_up_to_their_colors() {
        let animation = turning(&[0.0, 0.4, 0.4, 0.8]);
        let bytes = gif(&animation, 0.035).expect("a GIF");
        let (pictures, delays) = shown(&bytes);
        // The times 0, 3.5, 7, 10.5 and 14 hundredths are rounded to whole ones.
        assert_eq!(delays, [4, 3, 4, 3]);
        assert_eq!(pictures.len(), 4);
        assert!(pictures[0] != pictures[1] && pictures[1] == pictures[2]);
        for (place, picture) in pictures.iter().enumerate() {
            let drawn = Rasterizer::with_letters().pixels(&animation.frame(place), 1.0);
            let drawn = drawn.expect("pixels");
            let off = drawn.pixels().iter().zip(picture).map(|(a, b)| {
                let parts = [a.red(), a.green(), a.blue()].into_iter().zip(b);
                parts.map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
            });
            let most = off.max().expect("a pixel");
            assert!(most < 20, "a color is off by {most}");
        }
    }

    #[test]
    fn a_gif_has_the_same_bytes_again_and_is_known_again() {
        let made = || gif(&turning(&[0.0, 1.0]), 0.04).expect("a GIF");
        let bytes = made();
        assert_eq!(bytes, made());
        assert!(is_ours(&bytes));
        assert_eq!(source(&bytes), None);
        let Record::Inside { found, added } = SIGNATURE.record else {
            unreachable!("it is named inside")
        };
        let long = "a/".repeat(300) + "b.mech";
        for name in ["../a.mech", &long] {
            let named = added(&bytes, name);
            assert!(is_ours(&named));
            assert_eq!(found(&named).as_deref(), Some(name));
            assert_eq!(shown(&named), shown(&bytes));
        }
        assert!(!is_ours(b"GIF89a"));
    }
}
