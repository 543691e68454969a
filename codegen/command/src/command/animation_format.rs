//! Chooses the file format of an animation: SVG, or GIF in builds with the feature `png`.

use std::path::Path;

use linkwright_codegen::stages::emit::drawing::Animation;

use super::Problem;
use crate::arguments::Draw;
use crate::output::Signature;
use crate::report::picture;

/// File format of an animation.
#[derive(Clone, Copy, Debug)]
pub struct AnimationFormat {
    /// Signature of such a file.
    pub signature: Signature,
    /// Returns the bytes of a file with this time between two pictures, in s.
    pub encode: fn(&Animation, f64) -> Result<Vec<u8>, Problem>,
}

impl AnimationFormat {
    /// Returns the format that the file is named after, otherwise SVG.
    ///
    /// # Errors
    /// The file has the extension of a format without motion, or of a GIF, which this build leaves out.
    pub fn of(arguments: &Draw) -> Result<AnimationFormat, Problem> {
        let path = arguments.out.as_deref();
        let Some(extension) = path.and_then(Path::extension) else {
            return Ok(SVG);
        };
        if extension.eq_ignore_ascii_case("svg") {
            return Ok(SVG);
        }
        if extension.eq_ignore_ascii_case("gif") {
            return gif();
        }
        Err(Problem(format!(
            "error: cannot write `{}`: animations cannot be written as `.{}`\n  = help: name a file that ends in `.svg` or `.gif`",
            path.unwrap_or(Path::new("")).display(),
            extension.display()
        )))
    }
}

const SVG: AnimationFormat = AnimationFormat {
    signature: picture::SIGNATURE,
    encode: |animation, interval| {
        let passed = (animation.count() - 1) as f64;
        let svg = animation.smil(passed * interval);
        Ok(picture::signed(&svg).into_bytes())
    },
};

#[cfg(feature = "png")]
fn gif() -> Result<AnimationFormat, Problem> {
    use crate::report::gif;
    Ok(AnimationFormat {
        signature: gif::SIGNATURE,
        encode: |animation, interval| {
            gif::gif(animation, interval)
                .map_err(|text| Problem(format!("error: cannot make a GIF: {text}")))
        },
    })
}

#[cfg(not(feature = "png"))]
fn gif() -> Result<AnimationFormat, Problem> {
    Err(super::left_out::refusal("png", "draws pictures in pixels"))
}
