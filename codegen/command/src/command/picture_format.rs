//! Chooses the file format of a drawing: SVG, or PNG in builds with the feature `png`.

use super::Problem;
use crate::arguments::Draw;
use crate::output::Signature;
use crate::report::picture;

/// File format of a drawing.
#[derive(Clone, Copy, Debug)]
pub struct PictureFormat {
    /// Beginning of such a file.
    pub signature: Signature,
    /// Returns the bytes of a file from the text of an SVG. The flag is true if the arguments name a size, which is that of the file.
    pub encode: fn(&str, bool) -> Result<Vec<u8>, Problem>,
}

impl PictureFormat {
    /// Returns the format that the arguments request.
    ///
    /// # Errors
    /// The arguments request a PNG, and this build leaves it out.
    pub fn of(arguments: &Draw) -> Result<PictureFormat, Problem> {
        let extension = arguments.out.as_ref().and_then(|it| it.extension());
        let is_png = arguments.png || extension.is_some_and(|it| it.eq_ignore_ascii_case("png"));
        match is_png {
            true => png(),
            false => Ok(SVG),
        }
    }
}

const SVG: PictureFormat = PictureFormat {
    signature: picture::SIGNATURE,
    encode: |svg, _| Ok(picture::signed(svg).into_bytes()),
};

#[cfg(feature = "png")]
fn png() -> Result<PictureFormat, Problem> {
    use crate::report::raster;
    Ok(PictureFormat {
        signature: raster::SIGNATURE,
        encode: |svg, has_size| {
            let factor = if has_size { 1.0 } else { raster::FINE };
            raster::raster(svg, factor)
                .map_err(|text| Problem(format!("error: cannot make a PNG: {text}")))
        },
    })
}

#[cfg(not(feature = "png"))]
fn png() -> Result<PictureFormat, Problem> {
    Err(super::left_out::refusal("png", "draws pictures in pixels"))
}
